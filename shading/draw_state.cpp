#include "shading/draw_state.h"

#include <cassert>

namespace rawtexel::shading {
namespace {

/// Gathers with 32-bit indices reach element 4*vertex + 3.
constexpr size_t kMaxVertices = size_t(1) << 29;

/// Gives every material whose gloss is corrected by moments those of its normal map.
void add_moments(DrawStates& states) {
    for (MaterialState& state : states.materials) {
        if (!takes_moments(state.gloss.way)) continue;
        const MapState& normals = state.maps[kNormal];
        SlopeMoments& moments = states.moments[normals.texture_index];
        if (!moments.powers) moments = make_slope_moments(*normals.texture, state.gloss.way == Baseline::Lean);
        state.gloss.moments = {moments.powers.get(), moments.product.get()};
    }
}

/// Columns are cross products of the matrix's columns: M's cofactors, which take cross(a, b) to cross(Ma, Mb).
glm::mat3 cofactors(const glm::mat3& m) { return {glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1])}; }

DrawState make_draw_state(const Mesh& mesh, const MaterialState& material, const glm::mat4& world_from_object, uint32_t first_triangle_id) {
    assert(mesh.positions.size() < kMaxVertices);
    DrawState draw{.mesh = &mesh, .material = &material, .first_triangle_id = first_triangle_id, .world_from_object = world_from_object};
    const glm::mat3 linear(world_from_object);
    draw.handedness = glm::determinant(linear) < 0.0f ? -1.0f : 1.0f;
    draw.world_from_normal = draw.handedness * cofactors(linear);
    draw.colors_weigh = material.layer_count > 0 && !material.mask.texture;
    return draw;
}

raster::CoverageClass coverage_class(AlphaMode mode) {
    switch (mode) {
        case AlphaMode::Mask: return raster::CoverageClass::Masked;
        case AlphaMode::Blend: return raster::CoverageClass::Blended;
        case AlphaMode::Opaque: break;
    }
    return raster::CoverageClass::Opaque;
}

}  // namespace

uint64_t moment_bytes(const std::vector<MaterialState>& materials) {
    std::map<uint32_t, uint64_t> bytes;
    for (const MaterialState& state : materials) {
        if (!takes_moments(state.gloss.way)) continue;
        const MapState& normals = state.maps[kNormal];
        bytes[normals.texture_index] = slope_moment_bytes(normals.texture->shape(), state.gloss.way == Baseline::Lean);
    }
    uint64_t sum = 0;
    for (const auto& [texture, of_texture] : bytes) sum += of_texture;
    return sum;
}

DrawStates make_draw_states(const Scene& scene, const LookupOverrides& overrides) {
    DrawStates states;
    states.materials = make_material_states(scene, overrides);
    add_moments(states);
    states.draws.reserve(scene.instances.size());
    uint32_t triangle_id = 0;
    for (const Instance& instance : scene.instances) {
        const Mesh& mesh = scene.meshes[instance.mesh];
        states.draws.push_back(make_draw_state(mesh, states.materials[mesh.material], instance.world_from_object, triangle_id));
        triangle_id += uint32_t(mesh.indices.size() / 3);
    }
    return states;
}

std::vector<raster::Draw> make_raster_draws(const DrawStates& states, const glm::mat4& clip_from_world, DrawPurpose purpose) {
    std::vector<raster::Draw> draws;
    draws.reserve(states.draws.size());
    for (const DrawState& state : states.draws) {
        const Material& material = *state.material->material;
        const bool both_sides = material.double_sided || purpose == DrawPurpose::Shadow;
        draws.push_back({
            .positions = state.mesh->positions.data(),
            .vertex_count = uint32_t(state.mesh->positions.size()),
            .indices = state.mesh->indices.data(),
            .triangle_count = uint32_t(state.mesh->indices.size() / 3),
            .clusters = state.mesh->clusters.get(),
            .clip_from_object = clip_from_world * state.world_from_object,
            .first_triangle_id = state.first_triangle_id,
            .coverage = coverage_class(material.alpha_mode),
            .cull = both_sides ? raster::CullMode::None : raster::CullMode::Back,
            .front_is_clockwise = state.handedness < 0.0f,
        });
    }
    return draws;
}

}  // namespace rawtexel::shading
