// What is the same for all fragments of one material, prepared once per frame in the form the vector code reads.
#pragma once

#include "shading/filtering_options.h"
#include "shading/footprint_options.h"
#include "shading/scene.h"
#include "shading/tap_plan.h"

#include <array>
#include <cstdint>
#include <optional>
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
    int coordinates = 0;           ///< in MaterialState::coordinates
    bool may_be_constant = false;  ///< where its texture is one colour, the lookup is that colour to the bit
    int alike = -1;  ///< the material's first map that reads the same texels of a texture of its own; -1: must be read by itself
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
    /// Whether shading interpolates at most one set of coordinates and, vertex colours apart, nothing else.
    bool interpolates_coordinates_alone() const {
        return material->unlit && coordinate_count <= 1 && !maps[kNormal].texture && !branches();
    }
    bool draws_level = false;  ///< shading/baseline.h
    GlossState gloss;
};

/// What the caller's options change in every lookup.
struct LookupOverrides {
    std::optional<texunit::Kernel> filter;
    std::optional<texunit::MipMode> mip;
    FootprintOptions footprint;
    FilteringOptions filtering;
    texunit::Precision precision = texunit::Precision::Exact;
    bool occlusion = true;        ///< false: nothing reads occlusion maps
    bool constant_texels = true;  ///< textures of one colour need no lookup
};

/// Makes `sampler` look up as the overrides say.
void override_sampler(const LookupOverrides& overrides, texunit::SamplerState& sampler);

/// What is asked of a material's map, and what its policies make of it.
struct AskedLookup {
    FilteringOptions filtering;
    LookupPolicy policy;
};
/// Of a map that has a texture.
AskedLookup asked_lookup(const Scene& scene, const Material& material, int slot, const LookupOverrides& overrides);

/// One per material, in scene order; layers point at others of them. Moments of normal maps are still to be added.
std::vector<MaterialState> make_material_states(const Scene& scene, const LookupOverrides& overrides);

}  // namespace rawtexel::shading
