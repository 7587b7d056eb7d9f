// One lookup for a wave on this instruction set: select -> fetch -> filter (texunit/sample.h).
#include "texunit/filter-inl.h"
#include "texunit/footprint-inl.h"

#include <hwy/highway.h>

// Included once per instruction set (highway's guard for -inl.h files).
#if defined(RAWTEXEL_TEXUNIT_SAMPLE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_TEXUNIT_SAMPLE_INL_H_
#undef RAWTEXEL_TEXUNIT_SAMPLE_INL_H_
#else
#define RAWTEXEL_TEXUNIT_SAMPLE_INL_H_
#endif

HWY_BEFORE_NAMESPACE();
namespace rawtexel::texunit {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Taps of weight 0 are neither read nor counted: a fraction of 0 halves the taps along its axis.
HWY_INLINE hn::Vec<IntTag> tap_count(const TapWave<1>&, size_t) { return hn::Set(IntTag(), 1); }
HWY_INLINE hn::Vec<IntTag> tap_count(const TapWave<2>& taps, size_t i) {
    const FloatTag d;
    const IntTag di;
    const auto along = [&](const WaveFloat& fraction) HWY_ATTR {
        return hn::IfThenElse(hn::RebindMask(di, hn::Eq(hn::Load(d, fraction.lane + i), hn::Zero(d))), hn::Set(di, 1), hn::Set(di, 2));
    };
    return hn::Mul(along(taps.fraction_x), along(taps.fraction_y));
}

/// Counts the taps of the lanes of `mask`.
template <int W>
HWY_INLINE void count_taps(const TapWave<W>&, WaveMask, const NoFetchCount&) {}
template <int W>
HWY_NOINLINE void count_taps(const TapWave<W>& taps, WaveMask mask, FetchCounter& count) {
    const IntTag d;
    WaveInt counted;
    for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
        hn::Store(hn::IfThenElseZero(lanes_of(d, mask, i), tap_count(taps, i)), d, counted.lane + i);
    }
    uint64_t total = 0;
    for (int i = 0; i < kWaveLanes; ++i) {
        total += uint64_t(counted[i]);
        if (count.pixel != nullptr) (*count.pixel)[i] += uint32_t(counted[i]);
    }
    count.texture->taps += total;
    count.texture->texels_requested += total;
}

HWY_INLINE void count_lookups(WaveMask, const NoFetchCount&) {}
HWY_INLINE void count_lookups(WaveMask mask, FetchCounter& count) { count.texture->lookups += hwy::PopCount(mask); }

/// One level of a lookup, through all three stages.
template <StorageClass storage, int W, class Count>
HWY_INLINE void sample_level(Texture& texture, const SamplerState& sampler, const WavePosition& at, const WaveInt& level,
                             WaveMask nearest, WaveMask counted, Count& count, WaveColor& out) {
    TapWave<W> taps;
    select_taps(texture.levels(), sampler, at, level, nearest, taps);
    count_taps(taps, counted, count);
    TexelWave<W * W> texels;
    fetch<storage>(texture, taps, texels);
    filter<storage>(taps, texels, out);
}

/// Both levels of a lookup through kernels of at most W taps an axis.
template <StorageClass storage, int W, class Count>
HWY_NOINLINE void mix_sampled_levels(Texture& texture, const SamplerState& sampler, const WavePosition& at, const LevelChoice& choice,
                                     WaveMask nearest, WaveMask mask, Count& count, WaveColor& out) {
    sample_level<storage, W>(texture, sampler, at, choice.finer, nearest, mask, count, out);
    if (!choice.mixes) return;
    const FloatTag d;
    WaveMask mixing = 0;
    for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
        mixing |= wave_mask(d, hn::Ne(hn::Load(d, choice.fraction.lane + i), hn::Zero(d)), i);
    }
    WaveColor coarser;
    sample_level<storage, W>(texture, sampler, at, choice.coarser, nearest, mask & mixing, count, coarser);
    mix_levels<storage>(choice.fraction, coarser, out);
}

template <StorageClass storage, class Count>
HWY_INLINE void sample_stored(Texture& texture, const SamplerState& sampler, const WavePosition& at, const LevelChoice& choice,
                              WaveMask mask, Count& count, WaveColor& out) {
    // Waves that mix kernels embed the nearest lanes in the wider one.
    const WaveMask nearest = nearest_lanes(sampler, choice);
    if (nearest == kWaveFull) {
        mix_sampled_levels<storage, 1>(texture, sampler, at, choice, nearest, mask, count, out);
    } else {
        mix_sampled_levels<storage, 2>(texture, sampler, at, choice, nearest, mask, count, out);
    }
}

/// Samples the levels of `choice` at `at` and mixes them: one lookup, or one probe of it. Lanes outside `mask`, which is not 0, repeat an
/// active one in `at` and in `choice`, so that they read what is read anyway; what they get is unspecified but initialised.
template <class Count>
HWY_INLINE void sample_levels(Texture& texture, const SamplerState& sampler, const WavePosition& at, const LevelChoice& choice,
                              WaveMask mask, Count& count, WaveColor& out) {
    switch (texture.texel_layout().storage) {
        case StorageClass::Packed32: return sample_stored<StorageClass::Packed32>(texture, sampler, at, choice, mask, count, out);
        case StorageClass::Packed64: return sample_stored<StorageClass::Packed64>(texture, sampler, at, choice, mask, count, out);
        case StorageClass::Half4: return sample_stored<StorageClass::Half4>(texture, sampler, at, choice, mask, count, out);
        case StorageClass::Float4: return sample_stored<StorageClass::Float4>(texture, sampler, at, choice, mask, count, out);
    }
}

/// Samples `texture` at the lanes of `mask`; other lanes of `out` hold the colour of the first active lane, all zero for an empty mask.
/// `lod`, when asked for, gets lambda clamped to the levels there are. Count is FetchCounter or NoFetchCount.
template <class Count>
HWY_NOINLINE void sample_lanes(Texture& texture, const SamplerState& sampler, const WaveCoordinates& coordinates, WaveMask mask,
                               Count& count, WaveColor& out, WaveFloat* lod) {
    if (mask == 0) {
        out = {};
        if (lod != nullptr) *lod = {};
        return;
    }
    WaveCoordinates filled;
    if (mask != kWaveFull) fill_inactive(coordinates, mask, filled);
    const WaveCoordinates& at = mask == kWaveFull ? coordinates : filled;

    // One kernel and no levels: lambda decides nothing.
    LevelChoice choice;
    if (sampler.mip == MipMode::None && sampler.magnify == sampler.minify && lod == nullptr) {
        choose_base_level(choice);
    } else {
        select_levels(texture.levels(), sampler, at, choice);
        if (lod != nullptr) *lod = choice.lod;
    }

    count_lookups(mask, count);
    sample_levels(texture, sampler, {&at.u, &at.v}, choice, mask, count, out);
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::texunit
HWY_AFTER_NAMESPACE();

#endif  // RAWTEXEL_TEXUNIT_SAMPLE_INL_H_
