#include "shading/lookup_refusal.h"

#include "shading/draw_state.h"

#include <algorithm>

namespace rawtexel::shading {
namespace {

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

/// Whether some lookup, branch or shadow test of the frame takes numbers that a noise gives; dithers have numbers of their own.
bool takes_noise(const std::vector<MaterialState>& materials, const FilteringOptions& filtering) {
    if (filtering.estimator != texunit::Estimator::All || draws_level(filtering.baseline)) return true;
    if (filtering.texture_jitter != TextureJitter::None || filtering.shadow_taps == ShadowTaps::One) return true;
    if (filtering.effective_blend() == Blend::Draw && !is_dither(filtering.baseline)) return true;
    const auto draws = [](const MapState& map) { return map.texture != nullptr && map.sampler.estimator != texunit::Estimator::All; };
    return std::ranges::any_of(materials, [&](const MaterialState& state) {
        return state.plans.dither == texunit::Dither::None && std::ranges::any_of(state.maps, draws);
    });
}

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
    const std::vector<MaterialState> materials = make_material_states(scene, overrides);
    if (const uint64_t bytes = moment_bytes(materials); bytes > kMostMomentBytes)
        return "baseline " + std::string(to_string(filtering.baseline)) + ": moments of the normal maps take " +
               std::to_string(bytes >> 20) + " MiB (allowed: " + std::to_string(kMostMomentBytes >> 20) + ")";
    if (filtering.noise != texunit::Noise::White && !takes_noise(materials, filtering))
        return "noise " + std::string(to_string(filtering.noise)) + ": nothing draws (allowed: white, or an estimator that draws)";
    if (filtering.common_numbers && std::ranges::none_of(materials, draws_signs))
        return "signed-numbers common: no kernel draws a texel of either sign (allowed: reservoir and a kernel with negative lobes)";
    if (filtering.blend == Blend::Draw && std::ranges::none_of(materials, [](const MaterialState& state) { return state.branches(); }))
        return "blend draw: no material blends planes or layers";
    for (const MaterialState& state : materials) {
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

}  // namespace rawtexel::shading
