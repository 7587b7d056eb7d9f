// What a glossy surface reflects as a few prefiltered lobes. Seen at an angle a reflection of GGX is stretched within the plane of
// incidence and cut off by the horizon; a row of round lobes in that plane has nearly its shape.
#pragma once

#include <array>
#include <cstdint>

namespace rawtexel::shading {

/// By view = asin(sqrt(n.v)) * 2 / pi, which has many nodes both at grazing angles and along the normal, and by perceptual roughness, both
/// from 0 to 1: probe k looks along mirror direction + lean * (normal - mirror direction) with
/// the lobe of its own roughness, 0..kFlatRoughness, and takes the share `scale` of what F0 scales, the share `bias` of the rest.
/// Shares are at least 0 and sum to one, so the albedo terms stay exact. Fitted by tests/reference/shading/probe_fit.cpp.
struct ReflectionProbeTable {
    static constexpr int kViews = 20, kRoughnesses = 20, kProbes = 7;
    static constexpr int kNodeWords = 2 * kProbes;
    static constexpr float kLeastLean = -1.0f, kLeanRange = 4.0f, kRoughnessRange = 2.0f;

    /// A probe is two words of two 16-bit fractions, the first in the upper half: (lean - kLeastLean) / kLeanRange and
    /// roughness / kRoughnessRange; scale and bias. word + kNodeWords * (view + kViews * roughness)
    std::array<uint32_t, kViews * kRoughnesses * kNodeWords> words;
};

extern const ReflectionProbeTable kReflectionProbes;

}  // namespace rawtexel::shading
