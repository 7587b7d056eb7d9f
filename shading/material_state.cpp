#include "shading/material_state.h"

#include <cassert>

namespace rawtexel::shading {
namespace {

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

void find_alike(MaterialState& state) {
    for (int slot = 0; slot < kMapSlots; ++slot) {
        MapState& map = state.maps[size_t(slot)];
        if (!map.texture || !can_sample_alike(*map.texture, map.sampler)) continue;
        map.alike = slot;
        for (int first = slot - 1; first >= 0; --first) {
            const MapState& other = state.maps[size_t(first)];
            if (other.alike == first && draws_alike(other, map)) map.alike = first;
        }
    }
}

void add_to_plan(const MaterialState& state, int slot, TapPlan& plan) {
    const MapState& map = state.maps[size_t(slot)];
    for (int k = 0; k < plan.lookups && !plan.holds(slot); ++k)
        if (draws_alike(state.maps[plan.first[size_t(k)]], map)) plan.lookup_of[size_t(slot)] = int8_t(k);
    if (plan.holds(slot)) return;
    plan.lookup_of[size_t(slot)] = int8_t(plan.lookups);
    plan.first[size_t(plan.lookups++)] = MapSlot(slot);
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

/// Whether a lookup of a texture of one colour is that colour to the bit.
bool keeps_constants(const texunit::SamplerState& sampler) {
    const auto is_narrow = [](const texunit::Kernel& kernel) {
        return kernel == texunit::Kernel::Nearest || kernel == texunit::Kernel::Bilinear;
    };
    return sampler.estimator == texunit::Estimator::All && is_narrow(sampler.magnify) && is_narrow(sampler.minify) &&
           sampler.is_isotropic() && sampler.wrap_s != texunit::Wrap::ClampToBorder && sampler.wrap_t != texunit::Wrap::ClampToBorder;
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
        lookup.sampler.reads_alpha = state.material->alpha_mode != AlphaMode::Opaque;
        lookup.sampler.estimator = asked.filtering.estimator;
        override_baseline(asked.filtering.baseline, lookup.sampler);
        if (asked.policy.filter) lookup.sampler.magnify = lookup.sampler.minify = *asked.policy.filter;
        if (asked.policy.mip) lookup.sampler.mip = *asked.policy.mip;
        lookup.coordinates = coordinates_of(state, map);
        lookup.may_be_constant = overrides.constant_texels && keeps_constants(lookup.sampler);
    }
    make_plans(scene, overrides, state);
    find_alike(state);
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

}  // namespace

void override_sampler(const LookupOverrides& overrides, texunit::SamplerState& sampler) {
    if (overrides.filter) sampler.magnify = sampler.minify = *overrides.filter;
    if (overrides.mip) sampler.mip = *overrides.mip;
    override_footprint(overrides.footprint, sampler);
    sampler.precision = overrides.precision;
    sampler.estimator = overrides.filtering.estimator;
    override_baseline(overrides.filtering.baseline, sampler);
}

AskedLookup asked_lookup(const Scene& scene, const Material& material, int slot, const LookupOverrides& overrides) {
    const TextureMap& map = material.maps[size_t(slot)];
    const LookupPolicy policy = combine(material.policy, scene.textures[size_t(map.texture)].policy);
    return {apply(policy, overrides.filtering), policy};
}

std::vector<MaterialState> make_material_states(const Scene& scene, const LookupOverrides& overrides) {
    std::vector<MaterialState> materials;
    materials.reserve(scene.materials.size());
    for (uint32_t i = 0; i < scene.materials.size(); ++i) materials.push_back(make_material_state(scene, i, overrides));
    link_layers(materials);
    return materials;
}

}  // namespace rawtexel::shading
