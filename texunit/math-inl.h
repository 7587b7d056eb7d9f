// Vector arithmetic with pinned results: the same bits on every instruction set.
#include <hwy/highway.h>

#include <cmath>
#include <cstdint>
#include <limits>

// Included once per instruction set (highway's guard for -inl.h files).
#if defined(RAWTEXEL_TEXUNIT_MATH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_TEXUNIT_MATH_INL_H_
#undef RAWTEXEL_TEXUNIT_MATH_INL_H_
#else
#define RAWTEXEL_TEXUNIT_MATH_INL_H_
#endif

// Sets whose MulAdd rounds twice.
#undef RAWTEXEL_TWO_ROUNDINGS
#if HWY_TARGET == HWY_SSSE3 || HWY_TARGET == HWY_SSE4 || HWY_TARGET == HWY_EMU128 || HWY_TARGET == HWY_WASM || HWY_TARGET == HWY_WASM_EMU256
#define RAWTEXEL_TWO_ROUNDINGS 1
#else
#define RAWTEXEL_TWO_ROUNDINGS 0
#endif

HWY_BEFORE_NAMESPACE();
namespace rawtexel::texunit {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if RAWTEXEL_TWO_ROUNDINGS
/// a*b + c in double, rounded to odd: the product of two floats is exact, and when the sum is not, its last bit is set. A value rounded to
/// odd with more than two spare bits rounds to float as the exact value would (Boldo and Melquiond, "Emulation of FMA", 2008).
template <class V>
HWY_INLINE V multiply_add_odd(V a, V b, V c) {
    const hn::DFromV<V> d;
    const hn::RebindToUnsigned<decltype(d)> du;
    const V product = hn::Mul(a, b);
    const V sum = hn::Add(product, c);
    // Knuth's two-sum gives the exact error of the addition; it is NaN, and then ignored, where the sum is not finite.
    const V c_part = hn::Sub(sum, product);
    const V error = hn::Add(hn::Sub(product, hn::Sub(sum, c_part)), hn::Sub(c, c_part));
    const V zero = hn::Zero(d);
    const auto inexact = hn::Or(error<zero, error> zero);
    const auto even = hn::TestBit(hn::Not(hn::BitCast(du, sum)), hn::Set(du, uint64_t{1}));
    // Step one last place towards the exact value: away from zero when error and sum agree in sign.
    const auto grow = hn::Eq(hn::ShiftRight<63>(hn::BitCast(du, error)), hn::ShiftRight<63>(hn::BitCast(du, sum)));
    const auto one = hn::Set(du, uint64_t{1});
    const auto bits = hn::BitCast(du, sum);
    const auto stepped = hn::IfThenElse(grow, hn::Add(bits, one), hn::Sub(bits, one));
    return hn::IfThenElse(hn::And(inexact, hn::MaskFromVec(hn::BitCast(d, hn::VecFromMask(du, even)))), hn::BitCast(d, stepped), sum);
}
#endif

/// a*b + c, rounded once.
template <class V>
HWY_INLINE V fused_multiply_add(V a, V b, V c) {
#if HWY_TARGET == HWY_SCALAR
    return V(std::fma(a.raw, b.raw, c.raw));
#elif RAWTEXEL_TWO_ROUNDINGS
    const hn::DFromV<V> d;
    const hn::Half<decltype(d)> half;
    const hn::Rebind<double, decltype(half)> wide;
    const auto low = multiply_add_odd(hn::PromoteTo(wide, hn::LowerHalf(half, a)), hn::PromoteTo(wide, hn::LowerHalf(half, b)),
                                      hn::PromoteTo(wide, hn::LowerHalf(half, c)));
    const auto high = multiply_add_odd(hn::PromoteTo(wide, hn::UpperHalf(half, a)), hn::PromoteTo(wide, hn::UpperHalf(half, b)),
                                       hn::PromoteTo(wide, hn::UpperHalf(half, c)));
    return hn::Combine(d, hn::DemoteTo(half, high), hn::DemoteTo(half, low));
#else
    return hn::MulAdd(a, b, c);
#endif
}

/// a*b - product, rounded once.
template <class V>
HWY_INLINE V product_rest(V a, V b, V product) {
#if HWY_TARGET == HWY_SCALAR || RAWTEXEL_TWO_ROUNDINGS
    return fused_multiply_add(a, b, hn::Neg(product));
#else
    return hn::MulSub(a, b, product);
#endif
}

/// c - a*b, rounded once.
template <class V>
HWY_INLINE V fused_negative_multiply_add(V a, V b, V c) {
#if HWY_TARGET == HWY_SCALAR || RAWTEXEL_TWO_ROUNDINGS
    return fused_multiply_add(hn::Neg(a), b, c);
#else
    return hn::NegMulAdd(a, b, c);
#endif
}

/// a + t*(b - a) as fma(t, b, fma(-t, a, a)): a where a = b, within [a, b] for t in [0, 1], exact at both ends.
template <class V>
HWY_INLINE V lerp(V t, V a, V b) {
    return fused_multiply_add(t, b, fused_negative_multiply_add(t, a, a));
}

/// lerp for texels that may be infinite, where a*(1 - t) + b*t is meant: an infinite end wins, opposite infinities give NaN.
template <class V>
HWY_INLINE V lerp_unbounded(V t, V a, V b) {
    return hn::IfThenElse(hn::IsInf(a), hn::Add(a, b), lerp(t, a, b));
}

/// The product of two floats in two terms: high = the rounded product, low = what rounding lost, exact short of underflow.
template <class V>
HWY_INLINE void two_product(V a, V b, V& high, V& low) {
    high = hn::Mul(a, b);
    low = product_rest(a, b, high);
}

/// Nearest integer, ties to even, for |v| <= 2^22. By addition: highway's scalar Round does not round 0.49999997 to 0.
template <class V>
HWY_INLINE V round_small(V v) {
    const V shifter = hn::Set(hn::DFromV<V>(), 0x1.8p23f);
    return hn::Sub(hn::Add(v, shifter), shifter);
}

/// An integer |v| <= 2^22 as such: its bits after the same addition.
template <class V>
HWY_INLINE auto small_to_int(V v) {
    const hn::DFromV<V> d;
    const hn::RebindToSigned<decltype(d)> di;
    const auto bits = hn::BitCast(di, hn::Add(v, hn::Set(d, 0x1.8p23f)));
    return hn::Sub(bits, hn::Set(di, 0x4B400000));
}

/// log2 of positive normal `x` as integer + fraction, 0 <= fraction < 1 up to rounding, fraction exact to 2^-23. Plain products and sums.
template <class V, class VI>
HWY_INLINE void split_log2(V x, VI& integer, V& fraction) {
    const hn::DFromV<V> d;
    const hn::RebindToSigned<decltype(d)> di;
    // x = 2^integer * m with m in [1, 2).
    const VI bits = hn::BitCast(di, x);
    integer = hn::Sub(hn::ShiftRight<23>(bits), hn::Set(di, 127));
    const V m = hn::BitCast(d, hn::Or(hn::And(bits, hn::Set(di, 0x007FFFFF)), hn::Set(di, 0x3F800000)));
    // Halve the upper half of that range, so that the series runs over [1/sqrt(2), sqrt(2)).
    const auto upper = m >= hn::Set(d, 0x1.6A09E6p0f);
    const V centred = hn::IfThenElse(upper, hn::Mul(m, hn::Set(d, 0.5f)), m);
    // log2(c) = 2/ln(2) * atanh(s) with s = (c - 1)/(c + 1), |s| < 0.1716: the first term left out is below 2^-29.
    const V one = hn::Set(d, 1.0f);
    const V s = hn::Div(hn::Sub(centred, one), hn::Add(centred, one));
    const V s2 = hn::Mul(s, s);
    constexpr double scale = 2.0 / 0.693147180559945309417;
    V series = hn::Set(d, float(scale / 9));
    series = hn::Add(hn::Mul(series, s2), hn::Set(d, float(scale / 7)));
    series = hn::Add(hn::Mul(series, s2), hn::Set(d, float(scale / 5)));
    series = hn::Add(hn::Mul(series, s2), hn::Set(d, float(scale / 3)));
    series = hn::Add(hn::Mul(series, s2), hn::Set(d, float(scale)));
    fraction = hn::Add(hn::Mul(series, s), hn::IfThenElseZero(upper, one));
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::texunit
HWY_AFTER_NAMESPACE();

#endif  // RAWTEXEL_TEXUNIT_MATH_INL_H_
