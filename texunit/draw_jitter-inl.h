// Offsets of the jitter estimator: a uniform number becomes the offset, in texels, whose density convolved with the texel's box is the
// kernel. Inverse distribution functions rise with their number, so the nearest texel after the offset is the texel that the reservoir
// estimator draws with the same number. Products and sums alone: every instruction set moves by the same bits.
#include "texunit/kernel_weights-inl.h"

#include <hwy/highway.h>

#include <cassert>

// Included once per instruction set (highway's guard for -inl.h files).
#if defined(RAWTEXEL_TEXUNIT_DRAW_JITTER_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_TEXUNIT_DRAW_JITTER_INL_H_
#undef RAWTEXEL_TEXUNIT_DRAW_JITTER_INL_H_
#else
#define RAWTEXEL_TEXUNIT_DRAW_JITTER_INL_H_
#endif

HWY_BEFORE_NAMESPACE();
namespace rawtexel::texunit {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Tent of radius 1: the square root of the mass on the nearer side.
template <class V>
HWY_INLINE V tent_offset(V number) {
    const hn::DFromV<V> d;
    const V one = hn::Set(d, 1.0f);
    const auto left = number < hn::Set(d, 0.5f);
    const V mass = hn::IfThenElse(left, number, hn::Sub(one, number));
    const V inward = hn::Sub(one, hn::Sqrt(hn::Add(mass, mass)));
    return hn::IfThenElse(left, hn::Neg(inward), inward);
}

/// Cube root of y in [0, 1], to a few units in the last place: Halley's iteration from a third of the exponent.
template <class V>
HWY_INLINE V cube_root(V y) {
    const hn::DFromV<V> d;
    const hn::RebindToSigned<decltype(d)> di;
    const V bits = hn::ConvertTo(d, hn::BitCast(di, y));
    V root = hn::BitCast(d, hn::Add(hn::ConvertTo(di, hn::Mul(bits, hn::Set(d, 1.0f / 3))), hn::Set(di, 0x2A514067)));
    for (int step = 0; step < 3; ++step) {
        const V cube = hn::Mul(hn::Mul(root, root), root);
        root = hn::Mul(root, hn::Div(hn::Add(cube, hn::Add(y, y)), hn::Add(hn::Add(cube, cube), y)));
    }
    return hn::IfThenElseZero(y > hn::Zero(d), root);
}

/// Uniform quadratic B-spline, radius 3/2. Beyond 1/2 its distribution is a cube; within, 1/2 + 3/4*x - x^3/3, solved by Newton's method,
/// which needs four steps for the bits of a float: its derivative 3/4 - x^2 is at least 1/2.
template <class V>
HWY_INLINE V quadratic_spline_offset(V number) {
    const hn::DFromV<V> d;
    const V half = hn::Set(d, 0.5f), three_halves = hn::Set(d, 1.5f), three_quarters = hn::Set(d, 0.75f);
    const V from_middle = hn::Sub(number, half);
    const V side = hn::Abs(from_middle);
    V x = hn::Mul(side, hn::Set(d, 1.4f));
    for (int step = 0; step < 4; ++step) {
        const V square = hn::Mul(x, x);
        const V mass = hn::Mul(x, hn::Sub(three_quarters, hn::Mul(square, hn::Set(d, 1.0f / 3))));
        x = hn::Sub(x, hn::Div(hn::Sub(mass, side), hn::Max(hn::Sub(three_quarters, square), half)));
    }
    const V tail = hn::Sub(three_halves, cube_root(hn::Mul(hn::Sub(half, side), hn::Set(d, 6.0f))));
    return hn::CopySign(hn::IfThenElse(side > hn::Set(d, 1.0f / 3), tail, x), from_middle);
}

/// The offsets of Mitchell's cubics (texunit/estimator.h), radius 3/2. A side's distribution is s^2*((B/6 + C)*s - C) beyond 1/2, where
/// s = 3/2 - |x|, and m*x - e*x^3/3 from the middle within, m and m - e/4 being the densities at 0 and at 1/2. Either may be 0, where
/// Newton's method would stall: both cubics rise, and halving an interval of 1 or 1/2 finds their places to the bits of a number.
template <class V>
HWY_NOINLINE V mitchell_offset(double b, double c, V number) {
    const hn::DFromV<V> d;
    const V half = hn::Set(d, 0.5f);
    const V from_middle = hn::Sub(number, half);
    const V side = hn::Abs(from_middle), outside = hn::Sub(half, side);
    const auto in_tail = outside < hn::Set(d, float(b / 6));
    const V tail_cube = hn::Set(d, float(b / 6 + c)), tail_square = hn::Set(d, float(-c));
    const V middle_cube = hn::Set(d, float((5 * b + 6 * c - 6) / 3)), middle = hn::Set(d, float(1.5 - 0.75 * b - 0.5 * c));
    const V mass = hn::IfThenElse(in_tail, outside, side);
    V below = hn::Zero(d);
    V step = hn::IfThenElse(in_tail, hn::Set(d, 1.0f), half);
    for (int bit = 0; bit < 25; ++bit) {
        step = hn::Mul(step, half);
        const V x = hn::Add(below, step), square = hn::Mul(x, x);
        const V tail = hn::Mul(square, hn::Add(hn::Mul(tail_cube, x), tail_square));
        const V within = hn::Mul(x, hn::Add(hn::Mul(middle_cube, square), middle));
        below = hn::IfThenElse(hn::IfThenElse(in_tail, tail, within) < mass, x, below);
    }
    return hn::CopySign(hn::IfThenElse(in_tail, hn::Sub(hn::Set(d, 1.5f), below), below), from_middle);
}

/// Inverse error function (Giles 2010, "Approximating the erfinv function", single precision) of |x| < 1.
template <class V>
HWY_INLINE V inverse_erf(V x) {
    const hn::DFromV<V> d;
    const hn::RebindToSigned<decltype(d)> di;
    const V one = hn::Set(d, 1.0f);
    hn::Vec<decltype(di)> exponent;
    V fraction;
    split_log2(hn::Mul(hn::Sub(one, x), hn::Add(one, x)), exponent, fraction);
    const V w = hn::Mul(hn::Add(hn::ConvertTo(d, exponent), fraction), hn::Set(d, -0.693147181f));
    const V central = polynomial({1.50140941f, 0.246640727f, -0.00417768164f, -0.00125372503f, 0.00021858087f, -4.39150654e-06f,
                                  -3.5233877e-06f, 3.43273939e-07f, 2.81022636e-08f},
                                 hn::Sub(w, hn::Set(d, 2.5f)));
    const V tail = polynomial({2.83297682f, 1.00167406f, 0.00943887047f, -0.0076224613f, 0.00573950773f, -0.00367342844f, 0.00134934322f,
                               0.000100950558f, -0.000200214257f},
                              hn::Sub(hn::Sqrt(hn::Max(w, hn::Zero(d))), hn::Set(d, 3.0f)));
    return hn::Mul(x, hn::IfThenElse(w < hn::Set(d, 5.0f), central, tail));
}

inline constexpr float kNormalMassWithin4 = 0.999936657516f;  ///< of the standard normal distribution within 4 sigma

/// The standard normal distribution cut at 4 sigma. One step of Newton's method against the mass that the kernel's weights go by.
template <class V>
HWY_INLINE V normal_offset(V number) {
    const hn::DFromV<V> d;
    const V half = hn::Set(d, 0.5f);
    const V from_middle = hn::Sub(number, half);  // -1/2 .. 1/2 - 2^-24
    const V guess = inverse_erf(hn::Mul(from_middle, hn::Set(d, 2 * kNormalMassWithin4)));
    // density of normal_mass at t: e^(-t^2)/(sqrt(pi)*erf(sqrt(8))).
    const V density = hn::Mul(exp_negative(hn::Neg(hn::Mul(guess, guess))), hn::Set(d, 0.564189584f / kNormalMassWithin4));
    const V refined = hn::Sub(guess, hn::Div(hn::Sub(normal_mass(guess), from_middle), density));
    const V limit = hn::Set(d, 2.82842712f);
    return hn::Mul(hn::Min(hn::Max(refined, hn::Neg(limit)), limit), hn::Set(d, 1.41421356f));
}

/// The offset for `kernel`, which refusal(Estimator::Jitter, kernel) does not refuse.
template <class V>
HWY_INLINE V jitter_offset(const Kernel& kernel, V number) {
    const hn::DFromV<V> d;
    switch (kernel.kind) {
        case KernelKind::Bilinear: return hn::Sub(number, hn::Set(d, 0.5f));
        case KernelKind::Quadratic: return tent_offset(number);
        case KernelKind::BSpline: return quadratic_spline_offset(number);
        case KernelKind::Mitchell: {
            if (kernel.b == 1.0f && kernel.c == 0.0f) return quadratic_spline_offset(number);
            return mitchell_offset(double(kernel.b), double(kernel.c), number);
        }
        case KernelKind::Gaussian: return hn::Mul(hn::Set(d, kernel.b), normal_offset(number));
        default: assert(kernel.kind == KernelKind::Nearest); return hn::Zero(d);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::texunit
HWY_AFTER_NAMESPACE();

#endif  // RAWTEXEL_TEXUNIT_DRAW_JITTER_INL_H_
