// What is the same for all fragments of one instance, prepared once per frame in the form the vector code reads.
#pragma once

#include "raster/frame.h"
#include "shading/material_state.h"
#include "shading/slope_moments.h"

#include <cstdint>
#include <map>
#include <vector>

namespace rawtexel::shading {

struct DrawState {
    const Mesh* mesh = nullptr;
    const MaterialState* material = nullptr;
    uint32_t first_triangle_id = 0;
    glm::mat4 world_from_object{1.0f};
    /// Takes object-space normals, geometric ones too, to the world's side of a front face; their length is lost.
    glm::mat3 world_from_normal{1.0f};
    float handedness = 1.0f;    ///< -1 when the transform mirrors
    bool colors_weigh = false;  ///< vertex colours are weights of layers, not colour
};

/// One draw per instance, in scene order.
struct DrawStates {
    std::map<uint32_t, SlopeMoments> moments;  ///< of normal maps, by their index in Scene::textures
    std::vector<MaterialState> materials;
    std::vector<DrawState> draws;
};
/// Bytes of the moments that the normal maps of these materials ask for.
uint64_t moment_bytes(const std::vector<MaterialState>& materials);

DrawStates make_draw_states(const Scene& scene, const LookupOverrides& overrides);

enum class DrawPurpose { Camera, Shadow };
/// The draws as the rasterizer takes them. Shadows fall from both sides of every surface.
std::vector<raster::Draw> make_raster_draws(const DrawStates& states, const glm::mat4& clip_from_world, DrawPurpose purpose);

}  // namespace rawtexel::shading
