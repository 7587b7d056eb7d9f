// From linear radiance to what a screen shows: exposure, tone map, transfer.
#pragma once

#include "shading/image.h"

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace rawtexel::shading {

enum class ToneMap { Aces, Reinhard, None };
enum class Transfer { Srgb, Sqrt, Linear };

struct DisplayOptions {
    float exposure = 0.0f;  ///< EV: radiance is multiplied by 2^exposure
    ToneMap tone_map = ToneMap::Aces;
    Transfer transfer = Transfer::Srgb;
};

std::string_view to_string(ToneMap tone_map);   // aces reinhard none
std::string_view to_string(Transfer transfer);  // srgb sqrt linear
std::optional<ToneMap> parse_tone_map(std::string_view text);
std::optional<Transfer> parse_transfer(std::string_view text);

/// Display-linear [0,1] from linear radiance. ACES: Hill's fit of RRT+ODT. Reinhard: c/(1+c) per channel.
Image tone_mapped(const Image& radiance, const DisplayOptions& options);
/// Codes of an image over white where it covers its pixels only in part. `radiance` is over black; `coverage`, 1 channel, is the share of
/// each pixel that it covers. What is there is shown as if it covered the whole pixel, then mixed with white as encoded, as what is drawn
/// to a transparent canvas appears on a white page.
std::vector<uint8_t> encode_8bit_over_white(const Image& radiance, const Image& coverage, const DisplayOptions& options);
/// 8-bit codes, rounded to nearest in the transfer's own space; NaN gives 0.
std::vector<uint8_t> encode_8bit(const Image& display_linear, Transfer transfer);

}  // namespace rawtexel::shading
