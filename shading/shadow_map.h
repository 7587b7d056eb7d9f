// The sun's shadow map: depth along a directional light, drawn with raster, tested with percentage-closer filtering.
#pragma once

#include <glm/glm.hpp>

#include <cstdint>
#include <vector>

namespace rawtexel::shading {

/// Depth as raster defines it: 1 nearest to the light, 0 farthest; 0 where nothing casts.
struct ShadowMap {
    int size = 0;                    ///< texels along each side
    std::vector<float> depth;        ///< size x size, row by row from the top; texel (x, y) holds the depth at (x + 0.5, y + 0.5)
    glm::mat4 map_from_world{1.0f};  ///< (x right, y down) in texels, z as stored depth
    float texel_world = 0.0f;        ///< metres covered by one texel
    float depth_world = 0.0f;        ///< metres between depth 1 and depth 0
};

/// Orthographic frame of a directional light that just holds a sphere, texels square, with room around it for the filter.
/// `direction` is the way the light travels (unit); a radius of 0 is taken as tiny. Depth is all 0: nothing casts yet.
ShadowMap make_shadow_frame(const glm::vec3& direction, const glm::vec3& center, float radius, int size);

/// Share of the light that reaches a point of a flat surface through `position` with unit `normal`: 16 depth tests weighted by a tent
/// three texels wide, integrated over each texel (Reeves et al. 1987). Every test compares with the depth of the *surface's plane* at that
/// texel's centre, so a lit plane does not shadow itself at any slope and a shadow begins where its caster stands.
/// 0 on surfaces that face away from the light; 1 outside the map. shadow-inl.h is the vector form, bit-equal.
float shadow_visibility(const ShadowMap& map, const glm::vec3& position, const glm::vec3& normal);

/// A caster hides a point when it is nearer to the light by more than  texel * (constant + slope * tan(angle of incidence)),  which covers
/// what the rasterizer's vertex grid (1/256 texel) and curved surfaces deviate from the plane, plus the rounding of the stored depth.
inline constexpr float kShadowConstantBias = 0.25f;
inline constexpr float kShadowSlopeBias = 1.0f / 64.0f;
inline constexpr float kShadowDepthRounding = 5e-7f;
/// Planes steeper than this cosine of incidence are taken as being at it.
inline constexpr float kShadowMinCosine = 0.01f;

}  // namespace rawtexel::shading
