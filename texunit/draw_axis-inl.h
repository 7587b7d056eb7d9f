// A draw along one axis: of few taps, of many, of those of one sign, or by a jittered coordinate.
#include "texunit/draw_jitter-inl.h"
#include "texunit/wide_taps-inl.h"

#include <hwy/highway.h>

// Included once per instruction set (highway's guard for -inl.h files).
#if defined(RAWTEXEL_TEXUNIT_DRAW_AXIS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_TEXUNIT_DRAW_AXIS_INL_H_
#undef RAWTEXEL_TEXUNIT_DRAW_AXIS_INL_H_
#else
#define RAWTEXEL_TEXUNIT_DRAW_AXIS_INL_H_
#endif

HWY_BEFORE_NAMESPACE();
namespace rawtexel::texunit {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Sums of an axis's positive weights and of its negative ones' magnitudes.
struct SignedSums {
    WaveFloat positive, negative;
};

HWY_INLINE void sum_signs(const AxisTaps& taps, SignedSums& sums) {
    const FloatTag d;
    const auto zero = hn::Zero(d);
    for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
        auto positive = zero, negative = zero;
        for (int k = 0; k < taps.count; ++k) {
            const auto weight = hn::Load(d, taps.weight[k].lane + i);
            positive = hn::Add(positive, hn::Max(weight, zero));
            negative = hn::Add(negative, hn::Max(hn::Neg(weight), zero));
        }
        hn::Store(positive, d, sums.positive.lane + i);
        hn::Store(negative, d, sums.negative.lane + i);
    }
}

/// What turns an axis's weights into probabilities: the weights themselves, or those of one sign over their sum.
class AsProbabilities {
  public:
    HWY_INLINE FloatVec operator()(FloatVec weight, size_t) const { return weight; }
};
class OfOneSign {
  public:
    /// Lanes of `negative` take the negative weights.
    OfOneSign(const SignedSums& sums, WaveMask negative) : sums_(sums), negative_(negative) {}
    HWY_INLINE FloatVec operator()(FloatVec weight, size_t i) const {
        const FloatTag d;
        const auto flips = lanes_of(d, negative_, i);
        const auto sum = hn::IfThenElse(flips, hn::Load(d, sums_.negative.lane + i), hn::Load(d, sums_.positive.lane + i));
        const auto magnitude = hn::Max(hn::IfThenElse(flips, hn::Neg(weight), weight), hn::Zero(d));
        return hn::IfThenElseZero(sum > hn::Zero(d), hn::Div(magnitude, sum));
    }

  private:
    const SignedSums& sums_;
    WaveMask negative_;
};
class OfMagnitude {
  public:
    explicit OfMagnitude(const SignedSums& sums) : sums_(sums) {}
    HWY_INLINE FloatVec operator()(FloatVec weight, size_t i) const {
        const FloatTag d;
        return hn::Div(hn::Abs(weight), hn::Add(hn::Load(d, sums_.positive.lane + i), hn::Load(d, sums_.negative.lane + i)));
    }

  private:
    const SignedSums& sums_;
};

/// Of the taps that weigh anything the last one before which the probabilities sum to no more than the number; tells take(lanes, tap, i) of
/// the lanes whose choice moves on to a tap.
template <class Probabilities, class Take>
HWY_INLINE void walk_axis(const AxisTaps& taps, const Probabilities& probabilities, const WaveFloat& number, const Take& take) {
    const FloatTag d;
    for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
        const auto random = hn::Load(d, number.lane + i);
        auto before = hn::Zero(d);
        for (int k = 0; k < taps.count; ++k) {
            const auto probability = probabilities(hn::Load(d, taps.weight[k].lane + i), i);
            take(hn::And(probability > hn::Zero(d), random >= before), k, i);
            before = hn::Add(before, probability);
        }
    }
}

/// Draws a tap. Returns the lanes whose texel is beyond an edge.
template <class Probabilities>
HWY_INLINE WaveMask draw_of_axis(const AxisTaps& taps, const Probabilities& probabilities, const WaveFloat& number, WaveInt& drawn) {
    const FloatTag d;
    const IntTag di;
    WaveMask border = 0;
    drawn = taps.texel[0];
    walk_axis(taps, probabilities, number, [&](hn::Mask<FloatTag> takes, int k, size_t i) HWY_ATTR {
        int32_t* const texel = drawn.lane + i;
        hn::Store(hn::IfThenElse(hn::RebindMask(di, takes), hn::Load(di, taps.texel[k].lane + i), hn::Load(di, texel)), di, texel);
        if (!taps.leaves) return;
        const WaveMask lanes = wave_mask(d, takes, i);
        border = (border & ~lanes) | (taps.outside[k] & lanes);
    });
    return border;
}

/// Lanes whose drawn tap, by magnitude, weighs less than nothing.
HWY_INLINE WaveMask negative_lanes(const AxisTaps& taps, const SignedSums& sums, const WaveFloat& number) {
    const FloatTag d;
    WaveMask negative = 0;
    walk_axis(taps, OfMagnitude(sums), number, [&](hn::Mask<FloatTag> takes, int k, size_t i) HWY_ATTR {
        const WaveMask lanes = wave_mask(d, takes, i);
        const WaveMask below = wave_mask(d, hn::Load(d, taps.weight[k].lane + i) < hn::Zero(d), i);
        negative = (negative & ~lanes) | (below & lanes);
    });
    return negative;
}

/// The texel that an index of a drawn tap means. `near`: it lies no farther than 3 texels beyond its coordinate, which spares a division.
template <EdgeRule rule, class V>
HWY_INLINE V drawn_texel(V index, V extent, bool near) {
    if constexpr (!repeats(rule)) return limit_index<rule>(index, extent);
    const hn::DFromV<V> d;
    if constexpr (rule == EdgeRule::RepeatBits) return hn::And(index, hn::Sub(extent, hn::Set(d, 1)));
    const V period = rule == EdgeRule::MirroredRepeat ? hn::Add(extent, extent) : extent;
    if (!near) return fold_period<rule>(modulo_period(index, period), period);
    // Of a single texel the index may be more than two periods off.
    return hn::Max(hn::Min(fold_period<rule>(wrap_period(index, period), period), hn::Sub(extent, hn::Set(d, 1))), hn::Zero(d));
}

/// An axis along which a texel is drawn.
struct DrawnAxis {
    const WaveFloat* coordinate;
    const WaveFloat* rest;  ///< of cube maps
    const std::array<int32_t, 16>* extents;
    const WaveFloat* number;
    WaveInt* drawn;  ///< gets the texels, which of a cube map may lie beyond the face
};

/// Texels along axes of one rule without lists of taps: place(remainder, number) is where one lies from the coordinate's integer part.
/// Returns the lanes whose texel is beyond an edge.
template <EdgeRule rule, class Place, size_t axes>
HWY_NOINLINE WaveMask draw_placed_as(const DrawnAxis (&axis)[axes], const WaveInt& level, Precision precision, const Place& place) {
    const FloatTag d;
    const IntTag di;
    const bool near = has_fixed_weights(place.kernel);
    WaveMask border = 0;
    for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
        for (const DrawnAxis& of : axis) {
            const auto extent = look_up_level(di, *of.extents, hn::Load(di, level.lane + i));
            hn::Vec<FloatTag> integer, remainder;
            locate<rule>(*of.coordinate, {precision, of.rest}, hn::ConvertTo(d, extent), i, integer, remainder);
            auto index = small_to_int(hn::Add(integer, place(remainder, hn::Load(d, of.number->lane + i))));
            if constexpr (rule == EdgeRule::CubeEdge) {
                // One texel never leaves the face: a coordinate of 1 belongs to the last.
                if (place.kernel.kind == KernelKind::Nearest) index = limit_index<EdgeRule::ClampToEdge>(index, extent);
            }
            hn::Store(drawn_texel<rule>(index, extent, near), di, of.drawn->lane + i);
            if constexpr (can_leave(rule)) border |= wave_mask(di, beyond_edges(index, extent), i);
        }
    }
    return border;
}

/// The nearest texel after the coordinate has moved by the kernel's offset.
struct JitteredPlace {
    const Kernel& kernel;
    HWY_INLINE FloatVec operator()(FloatVec remainder, FloatVec number) const {
        return hn::Floor(hn::Add(remainder, jitter_offset(kernel, number)));
    }
};

/// A tap of a kernel of few taps, none of negative weight, as draw_of_axis draws it.
struct WeighedPlace {
    const Kernel& kernel;
    HWY_INLINE FloatVec operator()(FloatVec remainder, FloatVec number) const {
        return with_fixed_weights(kernel, remainder, [&](const auto& weight, FloatVec first) HWY_ATTR {
            const FloatTag d;
            const auto one = hn::Set(d, 1.0f);
            const auto least = hn::Set(d, kLeastWeight);
            auto before = hn::IfThenElseZero(weight[0] >= least, weight[0]), texel = first;
            constexpr size_t last = std::extent_v<std::remove_reference_t<decltype(weight)>> - 1;
            for (size_t k = 1; k <= last; ++k) {
                auto beyond = number >= before;
                // Where a tap weighs nothing the sum does not grow; but rounding may leave the sum of all but the last below 1.
                if (k == last) beyond = hn::And(beyond, weight[last] >= least);
                texel = hn::IfThenElse(beyond, hn::Add(texel, one), texel);
                before = hn::Add(before, weight[k]);
            }
            return texel;
        });
    }
};

/// The same of the cubic B-spline, whose weights sum to polynomials of the coordinate's place f between two centres: (1-f)^3/6, then
/// 5/6 - f/2 - f^2/2 + f^3/3, then 1 - f^3/6; each to 2^-23. Rounding may take f a little out of [0, 1], which harms none of them.
struct BSplinePlace {
    const Kernel& kernel;
    HWY_INLINE FloatVec operator()(FloatVec remainder, FloatVec number) const {
        const FloatTag d;
        const auto set = [&](float value) HWY_ATTR { return hn::Set(d, value); };
        const auto one = set(1.0f), half = set(0.5f), sixth = set(1.0f / 6);
        const auto f = hn::Add(remainder, half), rest = hn::Sub(one, f);
        const auto square = hn::Mul(f, f);
        // On a centre f may be the largest below 1: then the first texel weighs less than kLeastWeight, and no number draws it.
        const auto first = fused_multiply_add(hn::Mul(rest, rest), hn::Mul(rest, sixth), set(-kLeastWeight));
        const auto second = fused_multiply_add(square, fused_multiply_add(f, set(1.0f / 3), hn::Neg(half)),
                                               fused_multiply_add(f, hn::Neg(half), set(5.0f / 6)));
        const auto third = fused_negative_multiply_add(square, hn::Mul(f, sixth), one);
        auto texel = set(-2.0f);
        for (const auto& before : {first, second, third}) texel = hn::IfThenElse(number >= before, hn::Add(texel, one), texel);
        return texel;
    }
};

template <class Place, size_t axes>
HWY_INLINE WaveMask draw_placed(const Place& place, EdgeRule rule, const DrawnAxis (&axis)[axes], const WaveInt& level,
                                Precision precision) {
    return with_rule(rule,
                     [&](auto constant) HWY_ATTR { return draw_placed_as<decltype(constant)::value>(axis, level, precision, place); });
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::texunit
HWY_AFTER_NAMESPACE();

#endif  // RAWTEXEL_TEXUNIT_DRAW_AXIS_INL_H_
