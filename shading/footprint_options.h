// How the footprint of a pixel on a texture is found and filtered, for every lookup of a frame.
#pragma once

#include "texunit/sampler.h"

#include <optional>

namespace rawtexel::shading {

/// Where derivatives come from: the planes of the triangle, or as GPUs do differences within aligned 2x2 quads of pixels, at all four of
/// which the lane's own triangle is evaluated, beyond its edges too.
enum class Derivatives { Analytic, Quad };

/// Whether lookups filter the whole pixel or the part that one of n samples stands for: derivatives divided by sqrt(n).
enum class FootprintArea { Pixel, Sample };

struct FootprintOptions {
    std::optional<int> probes = std::nullopt;  ///< 1..64; nullopt: what the scene says
    float probe_variance = 0.0f;               ///< SamplerState::probe_variance
    float ellipse = 0.0f;                      ///< SamplerState::ellipse
    texunit::LodRule lod_rule = texunit::LodRule::D3d;
    float lod_bias = 0.0f;  ///< levels
    /// How much finer than the nominal level lookups read, levels >= 0. An ellipse gives the variance that its level has not to its draws;
    /// of other lookups the samples of the pixel filter cover it. nullopt: nominal levels, and level 0 for ellipses.
    std::optional<float> hybrid_bias = std::nullopt;
    Derivatives derivatives = Derivatives::Analytic;
    FootprintArea area = FootprintArea::Pixel;

    bool operator==(const FootprintOptions&) const = default;
};

/// What is asked of a frame's derivatives.
struct DerivativeRule {
    bool quad = false;
    float scale = 1.0f;  ///< of every derivative
};
DerivativeRule derivative_rule(const FootprintOptions& options, int spp);

/// Makes `sampler` look up as the options say.
void override_footprint(const FootprintOptions& options, texunit::SamplerState& sampler);

}  // namespace rawtexel::shading
