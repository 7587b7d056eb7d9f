// How maps become light: filtered before shading or after it, with which estimator, from which numbers.
#pragma once

#include "shading/baseline.h"
#include "texunit/estimator.h"
#include "texunit/noise.h"

#include <cstdint>
#include <optional>
#include <string_view>

namespace rawtexel::shading {

/// before: maps are filtered, then shaded once. after: raw texels are shaded, then the light is filtered (Pharr, Wronski, Salvi and Fajardo
/// 2024). Both agree where shading is affine in the maps.
enum class FilterOrder : uint8_t { Before, After };
/// Whether the maps of a material draw with the same numbers. Numbers of their own make the mean of a product the product of means: the
/// result is that of filtering before shading, with noise.
enum class NumberSharing : uint8_t { Shared, PerMap };

/// What is blended at a point, planes of a triplanar material or layers: every one looked up and weighed, or one drawn.
enum class Blend : uint8_t { All, Draw };
/// Depth tests of the sun's shadow: the whole tent of 16, or one drawn from it.
enum class ShadowTaps : uint8_t { All, One };

/// Where in the pixel textures are looked up: with the surface's own sample point, or at a point of their own drawn from the pixel filter,
/// which filters minified textures without levels (the unified scheme of Pharr, Wronski, Salvi and Fajardo 2024). Coordinates there are the
/// triangle's plane's, in perspective or by a step along the derivatives.
enum class TextureJitter : uint8_t { None, Perspective, Affine };

std::string_view to_string(FilterOrder order);      // before after
std::string_view to_string(NumberSharing sharing);  // shared per-map
std::string_view to_string(Blend blend);            // all draw
std::string_view to_string(ShadowTaps taps);        // all one
std::string_view to_string(TextureJitter jitter);   // none perspective affine
std::optional<FilterOrder> parse_filter_order(std::string_view text);
std::optional<NumberSharing> parse_number_sharing(std::string_view text);

inline constexpr int kMostTaps = 1024;

struct FilteringOptions {
    texunit::Estimator estimator = texunit::Estimator::All;
    std::optional<FilterOrder> order = std::nullopt;  ///< nullopt: before with All, after with one that draws
    int taps = 1;                                     ///< draws a lookup, 1..kMostTaps
    NumberSharing sharing = NumberSharing::Shared;
    /// Whether the draws of either sign, of kernels with negative lobes, use the same numbers.
    bool common_numbers = false;
    texunit::Noise noise = texunit::Noise::White;  ///< of the draws
    std::optional<Blend> blend = std::nullopt;     ///< nullopt: Draw with an estimator that draws, else All
    ShadowTaps shadow_taps = ShadowTaps::All;
    TextureJitter texture_jitter = TextureJitter::None;
    Baseline baseline = Baseline::None;  ///< goes with All and its own order alone

    bool draws() const { return estimator != texunit::Estimator::All || is_dither(baseline); }
    FilterOrder effective_order() const { return order.value_or(draws() ? FilterOrder::After : FilterOrder::Before); }
    Blend effective_blend() const { return blend.value_or(draws() ? Blend::Draw : Blend::All); }
};

}  // namespace rawtexel::shading
