// The sun's shadow map: depth along a directional light, drawn with raster, tested with percentage-closer filtering.
#pragma once

#include "raster/frame.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <vector>

namespace rawtexel::shading {

/// Depth as raster defines it: 1 nearest to the light, 0 farthest; 0 where nothing casts.
struct ShadowMap {
    int size = 0;                         ///< texels along each side
    std::vector<float> depth;             ///< size x size, row by row
    glm::mat4 map_from_world{1.0f};       ///< (x, y) in texels, z as stored depth
    float texel_world = 0.0f;             ///< metres covered by one texel
    float depth_world = 0.0f;             ///< metres between depth 1 and depth 0
};

/// Orthographic frame of a directional light that just holds a sphere: clip_from_world with reversed depth, texels square.
ShadowMap make_shadow_frame(const glm::vec3& direction, const glm::vec3& center, float radius, int size);

/// Share of light that reaches `position` (0..1): 4x4 depth tests (a 3-texel tent) about the point, moved off the surface along
/// `normal` by the depth a texel of slope can hide. Outside the map: 1. Reeves et al. 1987. The vector form is in shadow-inl.h.
float shadow_visibility(const ShadowMap& map, const glm::vec3& position, const glm::vec3& normal);

}  // namespace rawtexel::shading
