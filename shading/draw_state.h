// What is the same for all fragments of one instance, prepared once per frame in the form the vector code reads.
#pragma once

#include "raster/frame.h"
#include "shading/filtering_options.h"
#include "shading/footprint_options.h"
#include "shading/scene.h"
#include "shading/slope_moments.h"
#include "shading/tap_plan.h"

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace rawtexel::shading {

/// One way in which maps of a material are addressed. Maps that agree share one, and its coordinates are computed once.
struct CoordinateState {
    int uv_set = 0;
    bool identity = true;  ///< no KHR_texture_transform
    glm::mat3x2 uv_from_vertex{1, 0, 0, 1, 0, 0};
    texunit::Wrap wrap_s = texunit::Wrap::Repeat, wrap_t = texunit::Wrap::Repeat;
};

/// One lookup. `texture` is null where the factor alone decides.
struct MapState {
    texunit::Texture* texture = nullptr;
    uint32_t texture_index = 0;  ///< in Scene::textures
    texunit::SamplerState sampler;
    int coordinates = 0;  ///< in MaterialState::coordinates
};

/// A baseline that corrects gloss for what filtering takes from the normal map.
struct GlossState {
    Baseline way = Baseline::None;               ///< None where the material has nothing to correct
    std::array<texunit::Texture*, 2> moments{};  ///< SlopeMoments::powers and ::product, null where the way has none
};

struct MaterialState {
    const Material* material = nullptr;
    uint32_t index = 0;  ///< in Scene::materials
    std::array<MapState, kMapSlots> maps;
    std::array<CoordinateState, kMapSlots> coordinates;
    int coordinate_count = 0;
    TapPlans plans;
    NumberSharing sharing = NumberSharing::Shared;
    // Of materials that blend planes or layers.
    Blend blend = Blend::All;
    bool blends_light = false;                               ///< where all are blended: what they look like, not what they are
    std::array<const MaterialState*, kMostLayers> layers{};  ///< in place of maps
    int layer_count = 0;
    MapState mask;  ///< of the layers' weights

    bool branches() const { return layer_count > 0 || material->triplanar.has_value(); }
    bool draws_level = false;  ///< shading/baseline.h
    GlossState gloss;
};

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

/// What the caller's options change in every lookup.
struct LookupOverrides {
    std::optional<texunit::Kernel> filter;
    std::optional<texunit::MipMode> mip;
    FootprintOptions footprint;
    FilteringOptions filtering;
    texunit::Precision precision = texunit::Precision::Exact;
    bool occlusion = true;  ///< false: nothing reads occlusion maps
};

/// Makes `sampler` look up as the overrides say.
void override_sampler(const LookupOverrides& overrides, texunit::SamplerState& sampler);

/// Why maps of the scene cannot be looked up so, as a line for people that names the material; empty where they can.
std::string refusal(const Scene& scene, const LookupOverrides& overrides);

/// One draw per instance, in scene order.
struct DrawStates {
    std::map<uint32_t, SlopeMoments> moments;  ///< of normal maps, by their index in Scene::textures
    std::vector<MaterialState> materials;
    std::vector<DrawState> draws;
};
DrawStates make_draw_states(const Scene& scene, const LookupOverrides& overrides);

enum class DrawPurpose { Camera, Shadow };
/// The draws as the rasterizer takes them. Shadows fall from both sides of every surface.
std::vector<raster::Draw> make_raster_draws(const DrawStates& states, const glm::mat4& clip_from_world, DrawPurpose purpose);

}  // namespace rawtexel::shading
