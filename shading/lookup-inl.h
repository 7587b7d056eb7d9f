// The filter stage: the maps of a material, looked up for a wave.
#if defined(RAWTEXEL_SHADING_LOOKUP_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_SHADING_LOOKUP_INL_H_
#undef RAWTEXEL_SHADING_LOOKUP_INL_H_
#else
#define RAWTEXEL_SHADING_LOOKUP_INL_H_
#endif

#include "shading/draw_state.h"
#include "shading/fragment.h"
#include "texunit/fetch_log.h"
#include "texunit/sample-inl.h"

#include <bit>

HWY_BEFORE_NAMESPACE();
namespace rawtexel::shading {
namespace HWY_NAMESPACE {

/// One map. Not inlined: the sampler is large, and every map of every material shares this copy.
HWY_NOINLINE inline void look_up(const MapState& map, const texunit::WaveCoordinates& at, WaveMask mask, texunit::WaveColor& out,
                                 WaveFloat* lod) {
    texunit::NoFetchCount plain;
    texunit::HWY_NAMESPACE::sample_lanes(*map.texture, map.sampler, at, mask, plain, out, lod);
}

/// Filtered values of a material's maps; those without a texture are left as they were.
struct MapColors {
    texunit::WaveColor slot[kMapSlots];
    texunit::WaveColor moments[2];  ///< as GlossState::moments
};

HWY_NOINLINE inline void fill_constant(const MapState& map, texunit::WaveColor& out) {
    const FloatLanes d;
    const std::array<float, 4> colour = map.texture->texel(0, 0, 0, 0);
    for (size_t c = 0; c < 4; ++c)
        for (size_t i = 0; i < texunit::kWaveLanes; i += hn::Lanes(d)) hn::Store(hn::Set(d, colour[c]), d, out.channel[c].lane + i);
}

/// Reads the maps of `slots`, bits, which are alike; `lod` where asked for.
HWY_INLINE void look_up_alike(const MaterialState& material, const FragmentWave& fragment, WaveMask mask, uint32_t slots, MapColors& out,
                              WaveFloat* lod) {
    static_assert(kMapSlots <= texunit::AlikeTextures::kMost);
    const MapState& first = material.maps[size_t(std::countr_zero(slots))];
    texunit::AlikeTextures textures;
    for (uint32_t rest = slots; rest != 0; rest &= rest - 1) {
        const auto slot = size_t(std::countr_zero(rest));
        textures.add(*material.maps[slot].texture, out.slot[slot]);
    }
    texunit::HWY_NAMESPACE::sample_alike_lanes(textures, first.sampler, fragment.coordinates[first.coordinates], mask, lod);
}

/// Those that no plan draws, for the lanes of `mask`, which is not 0. `lod`: of the base colour's lookup, where asked for.
HWY_INLINE void look_up_maps(const MaterialState& material, const FragmentWave& fragment, WaveMask mask, MapColors& out, WaveFloat* lod) {
    uint32_t slots = 0;
    for (int slot = 0; slot < kMapSlots; ++slot) {
        const MapState& map = material.maps[size_t(slot)];
        if (!map.texture || material.plans.averaged.holds(slot) || material.plans.shaded.holds(slot)) continue;
        const bool finds_lod = slot == kBaseColor && lod != nullptr;
        if (map.may_be_constant && !finds_lod && map.texture->is_one_colour()) {
            fill_constant(map, out.slot[slot]);
        } else {
            slots |= 1u << slot;
        }
    }
    while (slots != 0) {
        const int slot = std::countr_zero(slots);
        const MapState& map = material.maps[size_t(slot)];
        uint32_t together = 1u << slot;
        for (uint32_t rest = map.alike < 0 ? 0 : slots; rest != 0; rest &= rest - 1) {
            const int other = std::countr_zero(rest);
            if (material.maps[size_t(other)].alike == map.alike) together |= 1u << other;
        }
        slots &= ~together;
        WaveFloat* const found_lod = slot == kBaseColor ? lod : nullptr;
        if (std::has_single_bit(together)) {
            look_up(map, fragment.coordinates[map.coordinates], mask, out.slot[slot], found_lod);
        } else {
            look_up_alike(material, fragment, mask, together, out, found_lod);
        }
    }
    for (size_t k = 0; k < 2; ++k) {
        if (!material.gloss.moments[k]) continue;
        MapState map = material.maps[kNormal];
        map.texture = material.gloss.moments[k];
        map.sampler.reads_alpha = true;  // a moment, whatever the material does with alpha
        look_up(map, fragment.coordinates[map.coordinates], mask, out.moments[k], nullptr);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::shading
HWY_AFTER_NAMESPACE();
#endif
