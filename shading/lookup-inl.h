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

HWY_BEFORE_NAMESPACE();
namespace rawtexel::shading {
namespace HWY_NAMESPACE {

/// Where a worker's counts go; ignored by kernels that do not count.
struct LookupCounts {
    texunit::FetchCounts* textures = nullptr;  ///< per scene texture
    texunit::Wave<uint32_t>* pixel = nullptr;  ///< texels requested by the wave's pixels
};

/// One map. Not inlined: the sampler is large, and every map of every material shares this copy.
template <class Count>
HWY_NOINLINE void look_up(const MapState& map, const texunit::WaveCoordinates& at, WaveMask mask, const LookupCounts& counts,
                          texunit::WaveColor& out, WaveFloat* lod) {
    Count count;
    if constexpr (Count::kCounts) {
        count.texture = &counts.textures[map.texture_index];
        count.pixel = counts.pixel;
    }
    texunit::HWY_NAMESPACE::sample_lanes(*map.texture, map.sampler, at, mask, count, out, lod);
}

/// Filtered values of a material's maps; those without a texture are left as they were.
struct MapColors {
    texunit::WaveColor slot[kMapSlots];
};

/// The base colour of a surface that is not opaque was asked for by its coverage already: it is one lookup, counted there.
template <class Count>
HWY_INLINE void look_up_maps(const MaterialState& material, const FragmentWave& fragment, WaveMask mask, const LookupCounts& counts,
                             MapColors& out, WaveFloat* lod) {
    const bool counted_by_coverage = material.material->alpha_mode != AlphaMode::Opaque;
    for (int slot = 0; slot < kMapSlots; ++slot) {
        const MapState& map = material.maps[size_t(slot)];
        if (!map.texture) continue;
        const texunit::WaveCoordinates& at = fragment.coordinates[map.coordinates];
        if (slot == kBaseColor && counted_by_coverage) {
            look_up<texunit::NoFetchCount>(map, at, mask, counts, out.slot[slot], lod);
        } else {
            look_up<Count>(map, at, mask, counts, out.slot[slot], slot == kBaseColor ? lod : nullptr);
        }
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::shading
HWY_AFTER_NAMESPACE();
#endif
