// What an Environment holds for looking light up: the lat-long image, and octahedral maps prefiltered with GGX lobes.
#pragma once

#include "shading/environment.h"
#include "shading/ggx_albedo.h"
#include "shading/packed_radiance.h"

#include <array>
#include <cstdint>
#include <vector>

namespace rawtexel::shading {

inline constexpr int kSpecularLevels = 25, kCosineLevel = 23;

/// Roughness of the flattest lobe, c / (1 + c)^2 with c = n.l: that of GGX as alpha grows beyond all bounds. No surface has it: between it
/// and the cosine lobe lie the reflections of rough surfaces seen at grazing angles.
inline constexpr float kFlatRoughness = 2.0f;

/// The roughness r of the prefiltered levels. Level 0 is the image itself, level 1 has the narrowest lobe that the image's texels resolve,
/// kCosineLevel has roughness 1: the cosine lobe, which is a white diffuse surface's too. In between the lobes' widths grow about
/// geometrically: level = 1 + (kCosineLevel - 1) (r - first) (1 + kBend) / ((r + kBend) (1 - first)); below, level = (r / first)^2.5,
/// between the shares of the lobes' peaks and of their tails. Above, up to the last level with kFlatRoughness, level = kCosineLevel + r
/// - 1.
struct RoughnessScale {
    static constexpr float kBend = 0.3f;
    float first = 0.1f;  ///< roughness of level 1

    float roughness_of(int level) const;  ///< 0, first, ..., 1, kFlatRoughness
};

struct Environment::Tables {
    const GgxReflectionTable* reflection = &ggx_reflection_table();

    int width = 0, height = 0;
    std::vector<float> latlong;  ///< RGB interleaved, rows from the top, finite and >= 0

    RoughnessScale scale;
    /// Level l is a square of extent[l] + 2 texels a side, one texel of border all around, beginning at texel start[l].
    alignas(64) std::array<int32_t, 32> extent{}, start{};
    std::vector<PackedRadiance> texels;
};

}  // namespace rawtexel::shading
