// How frames become one image.
#pragma once

#include <optional>
#include <string_view>

namespace rawtexel::shading {

/// Mean: of all samples of all frames, exact. Ema: each frame moves the history towards it by `weight`. Reproject: likewise, the history
/// first fetched from where each surface was in the frame before.
enum class Accumulation { Mean, Ema, Reproject };
std::string_view to_string(Accumulation accumulation);  // mean ema reproject
std::optional<Accumulation> parse_accumulation(std::string_view text);

struct TemporalOptions {
    Accumulation accumulation = Accumulation::Mean;
    float weight = 0.1f;  ///< of the newest frame, above 0 and at most 1; Mean has no use for it
    bool clamp = true;    ///< Reproject: histories stay within what the pixel and its neighbours show now
};

}  // namespace rawtexel::shading
