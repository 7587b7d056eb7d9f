// The vector form of texunit/random.h: one address per lane, the same bits.
#include "texunit/random.h"

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

/// What all dimensions of a lane's sample and surface share. `D` is a tag of uint32_t; seed and sample are the wave's.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V random_state_v(D d, uint32_t seed, uint32_t sample, V x, V y, V surface) {
    const uint32_t start = mix_bits(mix_bits(kRandomStart ^ seed) ^ sample);
    V state = mix_bits_v(hn::Xor(hn::Set(d, start), x));
    state = mix_bits_v(hn::Xor(state, y));
    return mix_bits_v(hn::Xor(state, surface));
}

/// 32 well-mixed bits a lane for one role.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V random_bits_v(D d, V state, Dimension dimension) {
    return mix_bits_v(mix_bits_v(hn::Xor(state, hn::Set(d, (uint32_t(dimension) + 1) * kRandomStart))));
}
template <class D, class V = hn::Vec<D>>
HWY_INLINE V random_bits_v(D d, uint32_t seed, uint32_t sample, V x, V y, V surface, Dimension dimension) {
    return random_bits_v(d, random_state_v(d, seed, sample, x, y, surface), dimension);
}

/// In [0, 1): the top 24 bits times 2^-24.
template <class D, class V = hn::Vec<D>>
HWY_INLINE hn::Vec<hn::Rebind<float, D>> unit_float_v(D, V bits) {
    const hn::Rebind<float, D> df;
    const hn::Rebind<int32_t, D> di;
    return hn::Mul(hn::ConvertTo(df, hn::BitCast(di, hn::ShiftRight<8>(bits))), hn::Set(df, 0x1p-24f));
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::texunit
HWY_AFTER_NAMESPACE();

#endif  // RAWTEXEL_TEXUNIT_RANDOM_INL_H_
