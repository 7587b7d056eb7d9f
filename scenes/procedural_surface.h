// A generated material: one function of position gives relief, colour and finish; its maps are derived from it together, on first touch.
#pragma once

#include "texunit/texel_source.h"

#include <glm/glm.hpp>

#include <functional>
#include <memory>

namespace rawtexel::scenes {

/// What a generated surface is like at one point.
struct SurfacePoint {
    glm::vec3 color{0.5f};  ///< sRGB-encoded, 0..1
    float alpha = 1.0f;
    float height = 0.0f;     ///< metres above the base
    float roughness = 0.8f;  ///< perceptual, 0..1
    float metallic = 0.0f;
    float occlusion = 1.0f;  ///< 1: open
};

/// A material swatch that repeats: `at(p)` for p in [0,1)^2, p.y downwards as texture rows run.
struct Surface {
    int width = 1024, height = 1024;  ///< texels
    glm::vec2 extent{1.0f};           ///< metres covered by the swatch: gives relief its slopes
    std::function<SurfacePoint(glm::vec2 p)> at;
};

/// A square swatch of `extent` metres and `texels` texels a side.
Surface square_surface(float extent, int texels, std::function<SurfacePoint(glm::vec2 p)> at);

/// glTF's maps of one surface. They share their tiles: whichever map is touched first makes the tile for all.
struct SurfaceMaps {
    std::unique_ptr<texunit::TexelSource> base_color;          ///< RGBA8Srgb
    std::unique_ptr<texunit::TexelSource> metallic_roughness;  ///< RGBA8Unorm: occlusion, roughness, metallic
    std::unique_ptr<texunit::TexelSource> normal;              ///< RGBA8Unorm: tangent space, +Y up the image
};
SurfaceMaps make_surface_maps(Surface surface);

/// Colour alone.
std::unique_ptr<texunit::TexelSource> make_color_map(Surface surface);

}  // namespace rawtexel::scenes
