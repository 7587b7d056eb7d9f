// The vector form of texunit/random.h: the numbers of a wave's pixels, the same bits.
#include "texunit/random.h"
#include "texunit/wave.h"

#include <hwy/highway.h>

// Included once per instruction set (highway's guard for -inl.h files).
#if defined(RAWTEXEL_TEXUNIT_RANDOM_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_TEXUNIT_RANDOM_INL_H_
#undef RAWTEXEL_TEXUNIT_RANDOM_INL_H_
#else
#define RAWTEXEL_TEXUNIT_RANDOM_INL_H_
#endif

HWY_BEFORE_NAMESPACE();
namespace rawtexel::texunit {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

template <class V>
HWY_INLINE V mix_bits_v(V bits) {
    const hn::DFromV<V> d;
    bits = hn::Mul(hn::Xor(bits, hn::ShiftRight<16>(bits)), hn::Set(d, 0x7FEB352Du));
    bits = hn::Mul(hn::Xor(bits, hn::ShiftRight<15>(bits)), hn::Set(d, 0x846CA68Bu));
    return hn::Xor(bits, hn::ShiftRight<16>(bits));
}

/// 32 well-mixed bits a lane, from a state that all lanes share (random_state).
template <class V>
HWY_INLINE V random_bits_v(uint32_t state, V x, V y) {
    return mix_bits_v(hn::Xor(mix_bits_v(hn::Xor(hn::Set(hn::DFromV<V>(), state), x)), y));
}

/// In [0, 1): the top 24 bits times 2^-24.
template <class D, class V = hn::Vec<D>>
HWY_INLINE hn::Vec<hn::Rebind<float, D>> unit_float_v(D, V bits) {
    const hn::Rebind<float, D> df;
    const hn::Rebind<int32_t, D> di;
    return hn::Mul(hn::ConvertTo(df, hn::BitCast(di, hn::ShiftRight<8>(bits))), hn::Set(df, 0x1p-24f));
}

/// i, i + 1 … as Iota, which highway makes number by number where `i` is not a constant.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V lane_numbers(D d, size_t i) {
    return hn::Add(hn::Iota(d, 0u), hn::Set(d, uint32_t(i)));
}

/// Columns and rows of lanes i .. of a wave whose first pixel is (x, y).
template <class D, class V = hn::Vec<D>>
HWY_INLINE V columns_v(D d, uint32_t x, size_t i) {
    return hn::Add(hn::Set(d, x), hn::And(lane_numbers(d, i), hn::Set(d, kWaveWidth - 1)));
}
template <class D, class V = hn::Vec<D>>
HWY_INLINE V rows_v(D d, uint32_t y, size_t i) {
    static_assert(kWaveWidth == 1 << 3);
    return hn::Add(hn::Set(d, y), hn::ShiftRight<3>(lane_numbers(d, i)));
}

/// The numbers of a wave whose first pixel is (x, y).
HWY_INLINE void random_wave(uint32_t state, uint32_t x, uint32_t y, WaveFloat& numbers) {
    const hn::ScalableTag<uint32_t> d;
    const auto of_columns = [&](size_t i) HWY_ATTR { return mix_bits_v(hn::Xor(hn::Set(d, state), columns_v(d, x, i))); };
    // Vectors of whole rows all have the same columns.
    constexpr bool whole_rows = hn::MaxLanes(hn::ScalableTag<uint32_t>()) % kWaveWidth == 0;
    const auto first = of_columns(0);
    for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
        const auto bits = mix_bits_v(hn::Xor(whole_rows ? first : of_columns(i), rows_v(d, y, i)));
        hn::Store(unit_float_v(d, bits), hn::Rebind<float, decltype(d)>(), numbers.lane + i);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::texunit
HWY_AFTER_NAMESPACE();

#endif  // RAWTEXEL_TEXUNIT_RANDOM_INL_H_
