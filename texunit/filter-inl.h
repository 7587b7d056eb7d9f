// The third stage of a lookup: the weighted mean of its texels.
#include "texunit/fetch_edges-inl.h"

#include <hwy/highway.h>

// Included once per instruction set (highway's guard for -inl.h files).
#if defined(RAWTEXEL_TEXUNIT_FILTER_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_TEXUNIT_FILTER_INL_H_
#undef RAWTEXEL_TEXUNIT_FILTER_INL_H_
#else
#define RAWTEXEL_TEXUNIT_FILTER_INL_H_
#endif

HWY_BEFORE_NAMESPACE();
namespace rawtexel::texunit {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// One texel a lane: nothing to weigh.
template <StorageClass storage>
HWY_INLINE void filter(const TapWave<1>&, const TexelWave<1>& texels, WaveColor& out) {
    for (int c = 0; c < 4; ++c) out.channel[c] = texels.channel[c][0];
}

/// Bilinear: along x, then along y.
template <StorageClass storage>
HWY_NOINLINE void filter(const TapWave<2>& taps, const TexelWave<4>& texels, WaveColor& out) {
    const FloatTag d;
    for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
        const auto x = hn::Load(d, taps.fraction_x.lane + i), y = hn::Load(d, taps.fraction_y.lane + i);
        for (int c = 0; c < 4; ++c) {
            const auto texel = [&](int tap) HWY_ATTR { return hn::Load(d, texels.channel[c][tap].lane + i); };
            const auto upper = mix<storage>(x, texel(0), texel(1));
            const auto lower = mix<storage>(x, texel(2), texel(3));
            hn::Store(mix<storage>(y, upper, lower), d, out.channel[c].lane + i);
        }
    }
}

/// Mixes in the coarser level.
template <StorageClass storage>
HWY_INLINE void mix_levels(const WaveFloat& fraction, const WaveColor& coarser, WaveColor& finer) {
    const FloatTag d;
    for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
        const auto t = hn::Load(d, fraction.lane + i);
        for (int c = 0; c < 4; ++c) {
            float* const mixed = finer.channel[c].lane + i;
            hn::Store(mix<storage>(t, hn::Load(d, mixed), hn::Load(d, coarser.channel[c].lane + i)), d, mixed);
        }
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::texunit
HWY_AFTER_NAMESPACE();

#endif  // RAWTEXEL_TEXUNIT_FILTER_INL_H_
