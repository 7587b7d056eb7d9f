// One definition of every kernel: the weights of its taps along an axis, from where the coordinate lies among the texels. The weighted sum,
// and every stochastic draw, follow from it. Plain products, sums and quotients: the same bits on every instruction set.
#include "texunit/kernel.h"
#include "texunit/math-inl.h"
#include "texunit/select-inl.h"

#include <hwy/highway.h>

#include <cassert>
#include <cmath>
#include <cstddef>
#include <numbers>

// Included once per instruction set (highway's guard for -inl.h files).
#if defined(RAWTEXEL_TEXUNIT_KERNEL_WEIGHTS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_TEXUNIT_KERNEL_WEIGHTS_INL_H_
#undef RAWTEXEL_TEXUNIT_KERNEL_WEIGHTS_INL_H_
#else
#define RAWTEXEL_TEXUNIT_KERNEL_WEIGHTS_INL_H_
#endif

HWY_BEFORE_NAMESPACE();
namespace rawtexel::texunit {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// a*x + b, rounded twice.
template <class V>
HWY_INLINE V horner(V a, V x, float b) {
    return hn::Add(hn::Mul(a, x), hn::Set(hn::DFromV<V>(), b));
}

/// The polynomial with coefficients c[0], c[1], … of rising powers.
template <int n, class V>
HWY_INLINE V polynomial(const float (&c)[n], V x) {
    V sum = hn::Set(hn::DFromV<V>(), c[n - 1]);
    for (int k = n - 2; k >= 0; --k) sum = horner(sum, x, c[k]);
    return sum;
}

/// e^x for -80 <= x <= 0, to 2^-22 relative: 2^n * e^r with |r| <= ln(2)/2 and the Taylor series of e^r.
template <class V>
HWY_INLINE V exp_negative(V x) {
    const hn::DFromV<V> d;
    const hn::RebindToSigned<decltype(d)> di;
    const V n = round_small(hn::Mul(x, hn::Set(d, std::numbers::log2e_v<float>)));
    // ln(2) in two parts, the first of so few bits that n times it is exact (Cody and Waite 1980).
    const V r = hn::Sub(hn::Sub(x, hn::Mul(n, hn::Set(d, 0x1.63p-1f))), hn::Mul(n, hn::Set(d, -0x1.bd0106p-13f)));
    const float series[] = {1, 1, 1.0f / 2, 1.0f / 6, 1.0f / 24, 1.0f / 120, 1.0f / 720, 1.0f / 5040};
    const V power = hn::BitCast(d, hn::ShiftLeft<23>(hn::Add(hn::ConvertTo(di, n), hn::Set(di, 127))));
    return hn::Mul(polynomial(series, r), power);
}

/// The mass of the normal distribution, cut at 4 sigma and renormalised, between its mean and t*sqrt(2)*sigma, t >= 0:
/// erf(t)/(2*erf(sqrt(8))) and 1/2 from t = sqrt(8) on. Absolute error below 2^-24. Chebyshev interpolants of that function over [0, 1],
/// divided by t and in t^2, and over [1, sqrt(8)], computed in double precision.
template <class V>
HWY_INLINE V normal_half_mass(V t) {
    const hn::DFromV<V> d;
    const float inner[] = {0.564225322f, -0.188075048f, 0.0564215612f, -0.013428015f, 0.00259482033f, -0.000400968148f, 3.94149822e-05f};
    constexpr float kMiddle = 0x1.ea09e6p+0f;
    const float outer[] = {0.00336216558f,  -0.0144579898f, 0.0276752822f,    -0.0304960717f,   0.0199680694f,  -0.00615501888f,
                           -0.00142238754f, 0.00228298214f, -0.000732886796f, -0.000179221185f, 0.000142815503f};
    const V half = hn::Set(d, 0.5f);
    const V bounded = hn::Min(t, hn::Set(d, 2.82842708f));
    const V near_mean = hn::Mul(bounded, polynomial(inner, hn::Mul(bounded, bounded)));
    const V tail = hn::Sub(half, polynomial(outer, hn::Sub(bounded, hn::Set(d, kMiddle))));
    const V mass = hn::IfThenElse(t < hn::Set(d, 1.0f), near_mean, tail);
    return hn::IfThenElse(t < hn::Set(d, 2.82842708f), hn::Min(mass, half), half);
}

/// The same on both sides of the mean: odd, -1/2 to 1/2.
template <class V>
HWY_INLINE V normal_mass(V t) {
    return hn::CopySign(normal_half_mass(hn::Abs(t)), t);
}

/// Weights below this are 0: far below the rounding of any sum, and products along three axes stay normal numbers.
inline constexpr float kLeastWeight = 0x1p-40f;

/// Uniform quadratic B-spline about the nearest texel, whose centre lies d = fraction or fraction - 1 before the coordinate.
template <class V>
HWY_INLINE V quadratic_weights(V fraction, V (&weight)[3]) {
    const hn::DFromV<V> d;
    const V half = hn::Set(d, 0.5f), one = hn::Set(d, 1.0f);
    const auto upper = fraction >= half;
    const V distance = hn::Sub(fraction, hn::IfThenElseZero(upper, one));
    const V before = hn::Sub(half, distance), after = hn::Add(half, distance);
    weight[0] = hn::Mul(half, hn::Mul(before, before));
    weight[1] = hn::Sub(hn::Set(d, 0.75f), hn::Mul(distance, distance));
    weight[2] = hn::Mul(half, hn::Mul(after, after));
    return hn::IfThenElseZero(hn::Not(upper), hn::Set(d, -1.0f));
}

/// Mitchell and Netravali 1988, equation 8: within 1 of the centre a cubic in the distance x, beyond a cubic in s = 2 - x, which has a
/// double root at s = 0. B-spline: B = 1, C = 0. Catmull-Rom: B = 0, C = 1/2.
template <class V>
HWY_INLINE V mitchell_weights(double b, double c, V fraction, V (&weight)[4]) {
    const hn::DFromV<V> d;
    const V rest = hn::Sub(hn::Set(d, 1.0f), fraction);
    const float inner[] = {float(1 - b / 3), float(2 * b + c - 3), float(2 - 1.5 * b - c)};
    const auto within = [&](V x) HWY_ATTR { return horner(horner(hn::Set(d, inner[2]), x, inner[1]), hn::Mul(x, x), inner[0]); };
    const auto beyond = [&](V s) HWY_ATTR { return hn::Mul(hn::Mul(s, s), horner(hn::Set(d, float(b / 6 + c)), s, float(-c))); };
    weight[0] = beyond(rest);
    weight[1] = within(fraction);
    weight[2] = within(rest);
    weight[3] = beyond(fraction);
    return hn::Set(d, -1.0f);
}

/// cos and sin of pi*k/a for a = 2 and 3.
template <int a>
constexpr double cos_of_part(int k) {
    constexpr double kHalves[] = {1, 0, -1, 0}, kThirds[] = {1, 0.5, -0.5, -1, -0.5, 0.5};
    const int place = (k + 2 * a) % (2 * a);
    return a == 2 ? kHalves[place] : kThirds[place];
}
template <int a>
constexpr double sin_of_part(int k) {
    constexpr double h = std::numbers::sqrt3 / 2;
    constexpr double kHalves[] = {0, 1, 0, -1}, kThirds[] = {0, h, h, 0, -h, -h};
    const int place = (k + 2 * a) % (2 * a);
    return a == 2 ? kHalves[place] : kThirds[place];
}

/// Lanczos with `a` lobes, normalised. With g the distance of the nearest texel and k - g that of the k-th beyond the coordinate, the ratio
/// of their weights is free of the zeros of the sines: (-1)^k * g * (g*cos(pi*k/a) - sin(pi*k/a)*cos(pi*g/a)*g/sin(pi*g/a)) / (k - g)^2.
template <int a, class V>
HWY_INLINE V lanczos_weights(V fraction, V (&weight)[2 * a]) {
    const hn::DFromV<V> d;
    const V one = hn::Set(d, 1.0f);
    const auto upper = fraction >= hn::Set(d, 0.5f);
    const V g = hn::IfThenElse(upper, hn::Sub(one, fraction), fraction);

    // sin(pi*g/a)/g and cos(pi*g/a) by their series, up to an angle of pi/4.
    constexpr double p = std::numbers::pi / a, q = p * p;
    const float sine[] = {float(p), float(-p * q / 6), float(p * q * q / 120), float(-p * q * q * q / 5040),
                          float(p * q * q * q * q / 362880)};
    const float cosine[] = {
        1, float(-q / 2), float(q * q / 24), float(-q * q * q / 720), float(q * q * q * q / 40320), float(-q * q * q * q * q / 3628800)};
    const V g2 = hn::Mul(g, g);
    const V cotangent = hn::Div(polynomial(cosine, g2), polynomial(sine, g2));

    V ratio[2 * a];
    V sum = one;
    for (int k = 1 - a; k <= a; ++k) {
        V& at = ratio[k + a - 1];
        at = one;
        if (k == 0) continue;
        const double sign = k % 2 == 0 ? 1 : -1;
        const V distance = hn::Sub(hn::Set(d, float(k)), g);
        const V numerator = hn::Sub(hn::Mul(g, hn::Set(d, float(sign * cos_of_part<a>(k)))),
                                    hn::Mul(cotangent, hn::Set(d, float(sign * sin_of_part<a>(k)))));
        at = hn::Div(hn::Mul(g, numerator), hn::Mul(distance, distance));
        sum = hn::Add(sum, at);
    }
    const V scale = hn::Div(one, sum);
    for (int j = 0; j < 2 * a; ++j) weight[j] = hn::Mul(hn::IfThenElse(upper, ratio[2 * a - 1 - j], ratio[j]), scale);
    return hn::Set(d, float(1 - a));
}

/// The normal of `sigma` texels cut at 4 sigma, convolved with the texel's box: the differences of its distribution between texel edges.
/// `remainder` is the coordinate less an edge. Weights go to `weights`, `stride` floats apart. Returns the first texel after that edge.
template <class V>
HWY_INLINE V gaussian_weights(float sigma, int taps, V remainder, float* weights, size_t stride) {
    const hn::DFromV<V> d;
    // The first texel that the interval meets is floor(remainder - 4*sigma), taken apart so that nothing rounds.
    const float reach = 4 * sigma, whole = std::floor(reach), part = reach - whole;
    const V one = hn::Set(d, 1.0f);
    const V below =
        hn::Add(hn::IfThenElseZero(remainder < hn::Set(d, part), one), hn::IfThenElseZero(remainder < hn::Set(d, part - 1), one));
    const V first = hn::Neg(hn::Add(hn::Set(d, whole), below));
    const V scale = hn::Set(d, float(1 / (double(sigma) * std::numbers::sqrt2)));
    const auto mass_before = [&](float tap)
                                 HWY_ATTR { return normal_mass(hn::Mul(hn::Sub(hn::Add(first, hn::Set(d, tap)), remainder), scale)); };
    V before = mass_before(0);
    for (int k = 0; k < taps; ++k) {
        const V after = mass_before(float(k + 1));
        const V weight = hn::Sub(after, before);
        hn::Store(hn::IfThenElseZero(weight >= hn::Set(d, kLeastWeight), weight), d, weights + size_t(k) * stride);
        before = after;
    }
    return first;
}

/// The normal density at those texel centres that lie within 4 sigma, and at the nearest in any case, normalised. Taken relative to the
/// nearest one, whose centre lies delta after the coordinate: exp(-((m + delta)^2 - delta^2) / (2*sigma^2)) = exp(-m*(m + 2*delta)/…) at
/// the m-th texel after it. `remainder` as above; `before` and `fraction` are split_between_centres of it. Returns the first texel like
/// that does.
template <class V>
HWY_INLINE V gaussian_point_weights(float sigma, int taps, V remainder, V before, V fraction, float* weights, size_t stride) {
    const hn::DFromV<V> d;
    const V zero = hn::Zero(d), one = hn::Set(d, 1.0f);
    // Texels ceil(fraction - 4*sigma) to floor(fraction + 4*sigma), taken apart so that nothing rounds.
    const float reach = 4 * sigma, whole = std::floor(reach), part = reach - whole;
    const V nearest = hn::Sub(nearest_texel(remainder), before);
    const V lowest = hn::Sub(hn::IfThenElseZero(fraction > hn::Set(d, part), one), hn::Set(d, whole));
    const V last = hn::Add(hn::IfThenElseZero(fraction >= hn::Set(d, 1 - part), one), hn::Set(d, whole));
    const V first = hn::Min(lowest, nearest);

    // 2*delta is 1 - 2*remainder or -1 - 2*remainder; the whole part joins m, so that their sum rounds once.
    const V whole_delta = hn::IfThenElse(remainder < zero, hn::Set(d, -1.0f), one);
    const V twice = hn::Add(remainder, remainder);
    const V scale = hn::Set(d, float(-0.5 / (double(sigma) * double(sigma))));
    V sum = zero;
    for (int k = 0; k < taps; ++k) {
        const V texel = hn::Add(first, hn::Set(d, float(k)));
        const V m = hn::Sub(texel, nearest);
        const V sum_of_offsets = hn::Sub(hn::Add(m, whole_delta), twice);
        const V density = exp_negative(hn::Min(hn::Mul(hn::Mul(m, sum_of_offsets), scale), zero));
        const V weight = hn::IfThenElseZero(hn::Or(hn::Not(texel > last), hn::Eq(m, zero)), density);
        sum = hn::Add(sum, weight);
        hn::Store(weight, d, weights + size_t(k) * stride);
    }
    const V normalise = hn::Div(one, sum);
    for (int k = 0; k < taps; ++k) {
        float* const weight = weights + size_t(k) * stride;
        hn::Store(hn::Mul(hn::Load(d, weight), normalise), d, weight);
    }
    return hn::Add(before, first);
}

/// The kernels of a fixed number of taps, in registers: use(weight, first) with an array of their weights and the texel of the first
/// relative to the coordinate's integer part. `remainder` is the other part (scale_coordinate).
template <class V, class Use>
HWY_INLINE auto with_fixed_weights(const Kernel& kernel, V remainder, const Use& use) {
    const hn::DFromV<V> d;
    V before, fraction;
    split_between_centres(remainder, before, fraction);
    const auto mitchell = [&](double b, double c) HWY_ATTR {
        V weight[4];
        const V first = mitchell_weights(b, c, fraction, weight);
        return use(weight, hn::Add(before, first));
    };
    switch (kernel.kind) {
        case KernelKind::Nearest: {
            V weight[1] = {hn::Set(d, 1.0f)};
            return use(weight, nearest_texel(remainder));
        }
        case KernelKind::Bilinear: {
            V weight[2] = {hn::Sub(hn::Set(d, 1.0f), fraction), fraction};
            return use(weight, before);
        }
        case KernelKind::Quadratic: {
            V weight[3];
            const V first = quadratic_weights(fraction, weight);
            return use(weight, hn::Add(before, first));
        }
        case KernelKind::Lanczos2: {
            V weight[4];
            const V first = lanczos_weights<2>(fraction, weight);
            return use(weight, hn::Add(before, first));
        }
        case KernelKind::Lanczos3: {
            V weight[6];
            const V first = lanczos_weights<3>(fraction, weight);
            return use(weight, hn::Add(before, first));
        }
        case KernelKind::BSpline: return mitchell(1, 0);
        case KernelKind::CatmullRom: return mitchell(0, 0.5);
        default: assert(kernel.kind == KernelKind::Mitchell); return mitchell(double(kernel.b), double(kernel.c));
    }
}
constexpr bool has_fixed_weights(const Kernel& kernel) {
    return kernel.kind != KernelKind::Gaussian && kernel.kind != KernelKind::GaussianPoint;
}

/// Weights of `kernel` along one axis at the texel-space coordinate integer + `remainder` (scale_coordinate). Writes axis_taps(kernel) of
/// them, `stride` floats apart; they sum to 1 up to rounding. Returns the texel of the first, relative to `integer`.
template <class V>
HWY_INLINE V kernel_weights(const Kernel& kernel, V remainder, float* weights, size_t stride) {
    const hn::DFromV<V> d;
    const int taps = axis_taps(kernel);
    if (kernel.kind == KernelKind::Gaussian) return gaussian_weights(kernel.b, taps, remainder, weights, stride);
    if (kernel.kind == KernelKind::GaussianPoint) {
        V before, fraction;
        split_between_centres(remainder, before, fraction);
        return gaussian_point_weights(kernel.b, taps, remainder, before, fraction, weights, stride);
    }
    return with_fixed_weights(kernel, remainder, [&](const auto& weight, V first) HWY_ATTR {
        float* to = weights;
        for (const V& one : weight) {
            hn::Store(hn::IfThenElseZero(hn::Abs(one) >= hn::Set(d, kLeastWeight), one), d, to);
            to += stride;
        }
        return first;
    });
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::texunit
HWY_AFTER_NAMESPACE();

#endif  // RAWTEXEL_TEXUNIT_KERNEL_WEIGHTS_INL_H_
