// One lookup in several textures that differ in nothing but their texels: levels and taps are chosen once and read in each.
#include "texunit/sample-inl.h"
#include "texunit/sample_lanes-inl.h"

#include <hwy/highway.h>

// Included once per instruction set (highway's guard for -inl.h files).
#if defined(RAWTEXEL_TEXUNIT_SAMPLE_ALIKE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_TEXUNIT_SAMPLE_ALIKE_INL_H_
#undef RAWTEXEL_TEXUNIT_SAMPLE_ALIKE_INL_H_
#else
#define RAWTEXEL_TEXUNIT_SAMPLE_ALIKE_INL_H_
#endif

HWY_BEFORE_NAMESPACE();
namespace rawtexel::texunit {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

void sample_alike_lanes(const AlikeTextures& textures, const SamplerState& sampler, const WaveCoordinates& coordinates, WaveMask mask,
                        WaveFloat* lod) {
    constexpr StorageClass kStorage = StorageClass::Packed32;
    WaveCoordinates filled;
    if (mask != kWaveFull) fill_inactive(coordinates, mask, filled);
    const WaveCoordinates& at = mask == kWaveFull ? coordinates : filled;
    const WavePosition position{&at.u, &at.v};
    const LevelTable& table = textures.texture[0]->levels();

    LevelChoice choice;
    choose_levels(table, sampler, at, choice, lod);
    TapWave<2> taps;
    select_taps(table, sampler, position, choice.finer, 0, taps);
    for (int k = 0; k < textures.count; ++k) read_flat_taps<kStorage>(*textures.texture[k], sampler, false, taps, *textures.out[k]);
    if (!choice.mixes) return;
    select_taps(table, sampler, position, choice.coarser, 0, taps);
    for (int k = 0; k < textures.count; ++k) {
        WaveColor coarser;
        read_flat_taps<kStorage>(*textures.texture[k], sampler, false, taps, coarser);
        mix_levels<kStorage>(choice.fraction, coarser, *textures.out[k]);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::texunit
HWY_AFTER_NAMESPACE();

#endif  // RAWTEXEL_TEXUNIT_SAMPLE_ALIKE_INL_H_
