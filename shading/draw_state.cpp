#include "shading/draw_state.h"

#include <algorithm>
#include <cassert>

namespace rawtexel::shading {
namespace {

/// Gathers with 32-bit indices reach element 4*vertex + 3.
constexpr size_t kMaxVertices = size_t(1) << 29;

/// Whether the value of the map can change what is seen, given the material's factors.
bool map_matters(const Material& material, int slot, const LookupOverrides& overrides) {
    if (slot == kBaseColor) {
        const bool colored = glm::vec3(material.base_color) != glm::vec3(0.0f);
        return colored || (material.alpha_mode != AlphaMode::Opaque && material.base_color.a != 0.0f);
    }
    if (material.unlit) return false;
    switch (slot) {
        case kMetallicRoughness: return material.metallic != 0.0f || material.roughness != 0.0f;
        case kNormal: return material.normal_scale != 0.0f;
        case kOcclusion: return material.occlusion_strength != 0.0f && overrides.occlusion;
        case kEmissive: return material.emission != glm::vec3(0.0f);
        default: return false;
    }
}

bool same_addressing(const CoordinateState& a, const CoordinateState& b) {
    return a.uv_set == b.uv_set && a.uv_from_vertex == b.uv_from_vertex && a.wrap_s == b.wrap_s && a.wrap_t == b.wrap_t;
}

/// Index of the coordinates that a map needs, added when they are new.
int coordinates_of(MaterialState& state, const TextureMap& map) {
    const glm::mat3x2 identity{1, 0, 0, 1, 0, 0};
    const CoordinateState wanted{map.uv_set, map.uv_from_vertex == identity, map.uv_from_vertex, map.sampler.wrap_s, map.sampler.wrap_t};
    for (int i = 0; i < state.coordinate_count; ++i)
        if (same_addressing(state.coordinates[size_t(i)], wanted)) return i;
    state.coordinates[size_t(state.coordinate_count)] = wanted;
    return state.coordinate_count++;
}

/// Whether two maps draw the same texels with the same numbers.
bool draws_alike(const MapState& a, const MapState& b) {
    const texunit::Shape &of_a = a.texture->shape(), &of_b = b.texture->shape();
    const bool same_shape = of_a.width == of_b.width && of_a.height == of_b.height && of_a.levels == of_b.levels;
    return a.coordinates == b.coordinates && a.sampler == b.sampler && same_shape;
}

void add_to_plan(const MaterialState& state, int slot, TapPlan& plan) {
    const MapState& map = state.maps[size_t(slot)];
    for (int k = 0; k < plan.lookups && !plan.holds(slot); ++k)
        if (draws_alike(state.maps[plan.first[size_t(k)]], map)) plan.lookup_of[size_t(slot)] = int8_t(k);
    if (plan.holds(slot)) return;
    plan.lookup_of[size_t(slot)] = int8_t(plan.lookups);
    plan.first[size_t(plan.lookups++)] = MapSlot(slot);
}

/// What is asked of a material's map, and what its policies make of it.
struct AskedLookup {
    FilteringOptions filtering;
    LookupPolicy policy;
};
AskedLookup asked_lookup(const Scene& scene, const Material& material, int slot, const LookupOverrides& overrides) {
    const TextureMap& map = material.maps[size_t(slot)];
    const LookupPolicy policy = combine(material.policy, scene.textures[size_t(map.texture)].policy);
    return {apply(policy, overrides.filtering), policy};
}

void make_plans(const Scene& scene, const LookupOverrides& overrides, MaterialState& state) {
    TapPlans& plans = state.plans;
    plans.taps = overrides.filtering.taps;
    plans.common_numbers = overrides.filtering.common_numbers;
    plans.noise = overrides.filtering.noise;
    state.sharing = overrides.filtering.sharing;
    for (int slot = 0; slot < kMapSlots; ++slot) {
        if (!state.maps[size_t(slot)].texture) continue;
        const FilteringOptions filtering = asked_lookup(scene, *state.material, slot, overrides).filtering;
        if (is_dither(filtering.baseline)) plans.dither = dither_of(filtering.baseline);
        state.draws_level |= draws_level(filtering.baseline);
        const bool bumpy = slot == kNormal && !state.material->unlit;
        if (bumpy && corrects_gloss(filtering.baseline)) state.gloss.way = filtering.baseline;
        const bool after = filtering.effective_order() == FilterOrder::After;
        if (after) add_to_plan(state, slot, plans.shaded);
        if (!after && filtering.draws()) add_to_plan(state, slot, plans.averaged);
        const texunit::NumberRoles roles = roles_of(state.maps[size_t(slot)].sampler);
        plans.roles = {plans.roles.level || roles.level || state.draws_level, plans.roles.probe || roles.probe,
                       plans.roles.sign || roles.sign};
        plans.enumerates |= after && !filtering.draws();
    }
}

/// Whether some of the maps that are shaded tap by tap draw, and others weigh all.
bool disagrees(const MaterialState& state) {
    for (int slot = 0; slot < kMapSlots; ++slot) {
        const MapState& map = state.maps[size_t(slot)];
        if (state.plans.enumerates && state.plans.shaded.holds(slot) && map.sampler.estimator != texunit::Estimator::All) return true;
    }
    return false;
}

/// Whether some of the maps are looked up as the baseline does that gives the whole material its numbers, and others by policies.
bool mixes_baselines(const Scene& scene, const MaterialState& state, const LookupOverrides& overrides) {
    if (state.plans.dither == texunit::Dither::None && !state.draws_level) return false;
    for (int slot = 0; slot < kMapSlots; ++slot) {
        const bool looked_up = state.maps[size_t(slot)].texture != nullptr;
        if (looked_up && asked_lookup(scene, *state.material, slot, overrides).filtering.baseline == Baseline::None) return true;
    }
    return false;
}

/// The mask weighs every tap whatever the estimator: the layers' weights are to be the same for all.
void add_mask(const Scene& scene, const LookupOverrides& overrides, MaterialState& state) {
    const TextureMap& map = state.material->layers->mask;
    if (map.texture < 0) return;
    state.mask.texture = scene.textures[size_t(map.texture)].texture.get();
    state.mask.texture_index = uint32_t(map.texture);
    state.mask.sampler = map.sampler;
    override_sampler(overrides, state.mask.sampler);
    state.mask.sampler.estimator = texunit::Estimator::All;
    state.mask.coordinates = coordinates_of(state, map);
}

MaterialState make_material_state(const Scene& scene, uint32_t index, const LookupOverrides& overrides) {
    MaterialState state;
    state.material = &scene.materials[index];
    state.index = index;
    const FilteringOptions filtering = apply(state.material->policy, overrides.filtering);
    state.blend = filtering.effective_blend();
    state.blends_light = filtering.effective_order() == FilterOrder::After;
    state.plans.noise = overrides.filtering.noise;
    if (state.material->layers) {
        add_mask(scene, overrides, state);
        return state;
    }
    for (int slot = 0; slot < kMapSlots; ++slot) {
        const TextureMap& map = state.material->maps[size_t(slot)];
        if (map.texture < 0 || !map_matters(*state.material, slot, overrides)) continue;
        MapState& lookup = state.maps[size_t(slot)];
        lookup.texture = scene.textures[size_t(map.texture)].texture.get();
        lookup.texture_index = uint32_t(map.texture);
        lookup.sampler = map.sampler;
        const AskedLookup asked = asked_lookup(scene, *state.material, slot, overrides);
        override_sampler(overrides, lookup.sampler);
        lookup.sampler.estimator = asked.filtering.estimator;
        override_baseline(asked.filtering.baseline, lookup.sampler);
        if (asked.policy.filter) lookup.sampler.magnify = lookup.sampler.minify = *asked.policy.filter;
        if (asked.policy.mip) lookup.sampler.mip = *asked.policy.mip;
        lookup.coordinates = coordinates_of(state, map);
    }
    make_plans(scene, overrides, state);
    // Where a policy has taps shaded there is no one surface to blend.
    state.blends_light |= !state.plans.shaded.empty();
    return state;
}

/// `states` has the material of every layer, at its place.
void link_layers(std::vector<MaterialState>& states) {
    for (MaterialState& state : states) {
        if (!state.material->layers) continue;
        const std::vector<uint32_t>& layers = state.material->layers->materials;
        assert(layers.size() >= kFewestLayers && layers.size() <= kMostLayers);
        for (const uint32_t layer : layers) {
            state.layers[size_t(state.layer_count++)] = &states[layer];
            state.blends_light |= states[layer].blends_light;
        }
    }
}

DrawStates make_material_states(const Scene& scene, const LookupOverrides& overrides) {
    DrawStates states;
    states.materials.reserve(scene.materials.size());
    for (uint32_t i = 0; i < scene.materials.size(); ++i) states.materials.push_back(make_material_state(scene, i, overrides));
    link_layers(states.materials);
    return states;
}

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

/// Bytes of the moments that the scene's normal maps ask for.
uint64_t moment_bytes(const DrawStates& states) {
    std::map<uint32_t, uint64_t> bytes;
    for (const MaterialState& state : states.materials) {
        if (!takes_moments(state.gloss.way)) continue;
        const MapState& normals = state.maps[kNormal];
        bytes[normals.texture_index] = slope_moment_bytes(normals.texture->shape(), state.gloss.way == Baseline::Lean);
    }
    uint64_t sum = 0;
    for (const auto& [texture, of_texture] : bytes) sum += of_texture;
    return sum;
}

/// Whether some lookup, branch or shadow test of the frame takes numbers that a noise gives; dithers have numbers of their own.
bool takes_noise(const DrawStates& states, const FilteringOptions& filtering) {
    if (filtering.estimator != texunit::Estimator::All || draws_level(filtering.baseline)) return true;
    if (filtering.texture_jitter != TextureJitter::None || filtering.shadow_taps == ShadowTaps::One) return true;
    if (filtering.effective_blend() == Blend::Draw && !is_dither(filtering.baseline)) return true;
    const auto draws = [](const MapState& map) { return map.texture != nullptr && map.sampler.estimator != texunit::Estimator::All; };
    return std::ranges::any_of(states.materials, [&](const MaterialState& state) {
        return state.plans.dither == texunit::Dither::None && std::ranges::any_of(state.maps, draws);
    });
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

void override_sampler(const LookupOverrides& overrides, texunit::SamplerState& sampler) {
    if (overrides.filter) sampler.magnify = sampler.minify = *overrides.filter;
    if (overrides.mip) sampler.mip = *overrides.mip;
    override_footprint(overrides.footprint, sampler);
    sampler.precision = overrides.precision;
    sampler.estimator = overrides.filtering.estimator;
    override_baseline(overrides.filtering.baseline, sampler);
}

namespace {

/// Why a map cannot be looked up so; empty where it can.
std::string refusal_of_map(const MapState& map, const AskedLookup& asked) {
    const texunit::SamplerState& sampler = map.sampler;
    if (sampler.ellipse > 0 && sampler.estimator == texunit::Estimator::AbsWeight)
        return "abs-weight: an ellipse has no negative weights (allowed with --ewa: all, reservoir, jitter)";
    if (sampler.ellipse > 0 && (asked.policy.filter || asked.policy.mip))
        return "a policy has a filter or a mip mode, which --ewa has no use for";
    if (asked.filtering.texture_jitter != TextureJitter::None && sampler.mip != texunit::MipMode::None)
        return "a policy asks for levels, and texture jitter filters minified textures by itself";
    for (const texunit::Kernel& kernel : {sampler.magnify, sampler.minify}) {
        const std::string_view reason = texunit::refusal(sampler.estimator, kernel);
        if (!reason.empty())
            return std::string(to_string(sampler.estimator)) + " cannot draw " + to_string(kernel) + ", " + std::string(reason);
    }
    return {};
}

bool draws_signs(const MaterialState& state) {
    return std::ranges::any_of(state.maps, [](const MapState& map) {
        return map.texture && map.sampler.estimator == texunit::Estimator::Reservoir && map.sampler.ellipse <= 0 &&
               !(texunit::weighs_as_probability(map.sampler.magnify) && texunit::weighs_as_probability(map.sampler.minify));
    });
}

}  // namespace

std::string refusal(const Scene& scene, const LookupOverrides& overrides) {
    const FilteringOptions& filtering = overrides.filtering;
    const DrawStates states = make_material_states(scene, overrides);
    if (const uint64_t bytes = moment_bytes(states); bytes > kMostMomentBytes)
        return "baseline " + std::string(to_string(filtering.baseline)) + ": moments of the normal maps take " +
               std::to_string(bytes >> 20) + " MiB (allowed: " + std::to_string(kMostMomentBytes >> 20) + ")";
    if (filtering.noise != texunit::Noise::White && !takes_noise(states, filtering))
        return "noise " + std::string(to_string(filtering.noise)) + ": nothing draws (allowed: white, or an estimator that draws)";
    if (filtering.common_numbers && std::ranges::none_of(states.materials, draws_signs))
        return "signed-numbers common: no kernel draws a texel of either sign (allowed: reservoir and a kernel with negative lobes)";
    for (const MaterialState& state : states.materials) {
        const std::string material = "material '" + state.material->name + "': ";
        if (filtering.baseline != Baseline::None && state.branches())
            return material + "baseline " + std::string(to_string(filtering.baseline)) + " knows no planes and layers";
        for (int slot = 0; slot < kMapSlots; ++slot) {
            const MapState& map = state.maps[size_t(slot)];
            if (!map.texture) continue;
            const std::string reason = refusal_of_map(map, asked_lookup(scene, *state.material, slot, overrides));
            if (!reason.empty()) return material + reason;
        }
        if (mixes_baselines(scene, state, overrides))
            return material + "some of its maps are looked up as baseline " + std::string(to_string(filtering.baseline)) +
                   " says, and others as policies say";
        if (disagrees(state)) return material + "of the maps that are shaded tap by tap some weigh every tap and others draw (a policy)";
        if (state.plans.enumerates && state.plans.shaded.lookups > 1 && overrides.footprint.ellipse > 0)
            return material +
                   "its maps differ in extent or coordinates, and ellipses cannot be listed together; --reference converges to it";
    }
    return {};
}

DrawStates make_draw_states(const Scene& scene, const LookupOverrides& overrides) {
    DrawStates states = make_material_states(scene, overrides);
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
