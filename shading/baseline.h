// What others do about filtering and shading, to compare with: corrections of gloss for filtered normals, ordered dithers, and the
// stochastic levels of production renderers.
#pragma once

#include "texunit/dither.h"
#include "texunit/sampler.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace rawtexel::shading {

enum class Baseline : uint8_t {
    None,
    Toksvig,         ///< Toksvig 2005, "Mipmapping Normal Maps"
    Lean,            ///< Olano and Baker 2010, "LEAN Mapping"
    Clean,           ///< Baker 2011, its isotropic form
    UeDither,        ///< texunit::Dither::Unreal
    StartrekDither,  ///< texunit::Dither::StarTrek
    OiioStochastic,  ///< OpenImageIO's StochasticTrilinear
    Moonray,         ///< closest texel of the closest level where minified, bilinear where magnified
};

struct BaselineInfo {
    Baseline baseline;
    std::string_view name;
    std::string_view description;  ///< one line for people
};
std::span<const BaselineInfo> all_baselines();

std::string_view to_string(Baseline baseline);
std::optional<Baseline> parse_baseline(std::string_view text);

texunit::Dither dither_of(Baseline baseline);
inline bool is_dither(Baseline baseline) { return dither_of(baseline) != texunit::Dither::None; }
/// Whether one of two levels is drawn for each fragment.
constexpr bool draws_level(Baseline baseline) { return baseline == Baseline::OiioStochastic; }
constexpr bool takes_moments(Baseline baseline) { return baseline == Baseline::Lean || baseline == Baseline::Clean; }
constexpr bool corrects_gloss(Baseline baseline) { return baseline == Baseline::Toksvig || takes_moments(baseline); }

/// Makes `sampler` look up as the baseline does. Samplers without levels stay so.
void override_baseline(Baseline baseline, texunit::SamplerState& sampler);

}  // namespace rawtexel::shading
