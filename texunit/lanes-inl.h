// Lanes of a wave in vectors: masks to and from bits, and inactive lanes made harmless.
#include "texunit/sample.h"

#include <hwy/highway.h>

// Included once per instruction set (highway's guard for -inl.h files).
#if defined(RAWTEXEL_TEXUNIT_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_TEXUNIT_LANES_INL_H_
#undef RAWTEXEL_TEXUNIT_LANES_INL_H_
#else
#define RAWTEXEL_TEXUNIT_LANES_INL_H_
#endif

HWY_BEFORE_NAMESPACE();
namespace rawtexel::texunit {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using FloatTag = hn::ScalableTag<float>;
using IntTag = hn::ScalableTag<int32_t>;
using FloatVec = hn::Vec<FloatTag>;
using IntVec = hn::Vec<IntTag>;

/// Lanes i .. i + Lanes(d) - 1 of a lane mask.
template <class D>
HWY_INLINE hn::Mask<D> lanes_of(D d, WaveMask mask, size_t i) {
    alignas(8) uint8_t bits[8] = {};
    const uint32_t shifted = mask >> i;
    hwy::CopyBytes<4>(&shifted, bits);
    return hn::LoadMaskBits(d, bits);
}

/// The inverse: lane mask bits i .. from a vector mask.
template <class D>
HWY_INLINE WaveMask wave_mask(D d, hn::Mask<D> mask, size_t i) {
    alignas(8) uint8_t bits[8] = {};
    hn::StoreMaskBits(d, mask, bits);
    uint32_t low;
    hwy::CopyBytes<4>(bits, &low);
    return hn::Lanes(d) >= 32 ? low : (low & ((1u << hn::Lanes(d)) - 1)) << i;
}

/// Lanes of `from` outside `mask`, which is not 0, repeat its first one.
template <class T>
HWY_INLINE void repeat_first(const Wave<T>& from, WaveMask mask, Wave<T>& to) {
    const hn::ScalableTag<T> d;
    const auto repeated = hn::Set(d, from.lane[hwy::Num0BitsBelowLS1Bit_Nonzero32(mask)]);
    for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
        hn::Store(hn::IfThenElse(lanes_of(d, mask, i), hn::Load(d, from.lane + i), repeated), d, to.lane + i);
    }
}

/// Inactive lanes repeat the first active one, so that they read texels that are read anyway. `mask` is not 0.
HWY_INLINE void fill_inactive(const WaveCoordinates& at, WaveMask mask, WaveCoordinates& filled) {
    repeat_first(at.u, mask, filled.u);
    repeat_first(at.v, mask, filled.v);
    repeat_first(at.dudx, mask, filled.dudx);
    repeat_first(at.dvdx, mask, filled.dvdx);
    repeat_first(at.dudy, mask, filled.dudy);
    repeat_first(at.dvdy, mask, filled.dvdy);
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::texunit
HWY_AFTER_NAMESPACE();

#endif  // RAWTEXEL_TEXUNIT_LANES_INL_H_
