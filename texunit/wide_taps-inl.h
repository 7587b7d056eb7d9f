// The first stage of a lookup for kernels of any width: the taps along one axis, from one run-time definition for all of them.
#include "texunit/kernel_weights-inl.h"
#include "texunit/select-inl.h"

#include <hwy/highway.h>

#include <algorithm>

// Included once per instruction set (highway's guard for -inl.h files).
#if defined(RAWTEXEL_TEXUNIT_WIDE_TAPS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_TEXUNIT_WIDE_TAPS_INL_H_
#undef RAWTEXEL_TEXUNIT_WIDE_TAPS_INL_H_
#else
#define RAWTEXEL_TEXUNIT_WIDE_TAPS_INL_H_
#endif

HWY_BEFORE_NAMESPACE();
namespace rawtexel::texunit {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// The taps of a kernel along one axis, those that no lane weighs left out. A lane's weight is 0 where it does not weigh a tap; its texel
/// is then one that it reads anyway.
struct AxisTaps {
    int count = 0;
    bool leaves = false;              ///< some bit of `outside` is set
    WaveMask readable = kWaveFull;    ///< lanes that weigh a texel of the texture; only a border leaves some without
    WaveMask outside[kMostAxisTaps];  ///< lanes that weigh this tap and find it beyond an edge of a border or a cube map
    WaveInt texel[kMostAxisTaps];     ///< wrapped; of a cube map not
    WaveFloat weight[kMostAxisTaps];
};

/// i modulo `period`, for |i| < 2^21. The quotient of two such integers is at least 1/period away from an integer or is one, and a
/// correctly rounded division keeps its floor.
template <class V>
HWY_INLINE V modulo_period(V i, V period) {
    const hn::DFromV<V> d;
    const hn::Rebind<float, decltype(d)> df;
    const auto quotient = hn::Div(hn::ConvertTo(df, i), hn::ConvertTo(df, period));
    const V whole = hn::ConvertTo(d, quotient);
    const V floor = hn::Sub(whole, hn::IfThenElseZero(hn::RebindMask(d, hn::ConvertTo(df, whole) > quotient), hn::Set(d, 1)));
    return hn::Sub(i, hn::Mul(floor, period));
}

/// Texels of the taps from `start` on, and which lanes weigh them, of lanes i .. whose weights are there already.
template <EdgeRule rule>
HWY_INLINE void place_taps(hn::Vec<IntTag> start, hn::Vec<IntTag> extent, int count, size_t i, AxisTaps& taps, WaveMask* weighed) {
    const FloatTag d;
    const IntTag di;
    const auto one = hn::Set(di, 1);
    const auto period = rule == EdgeRule::MirroredRepeat ? hn::Add(extent, extent) : extent;
    const auto last = hn::Sub(extent, one);
    auto place = rule == EdgeRule::RepeatBits ? hn::And(start, last) : repeats(rule) ? modulo_period(start, period) : start;
    // The heaviest texel stands in for those of weight 0.
    auto heaviest = hn::Zero(d);
    auto stand_in = hn::Zero(di);
    for (int k = 0; k < count; ++k) {
        hn::Vec<IntTag> texel;
        if constexpr (repeats(rule)) {
            texel = fold_period<rule>(place, period);
        } else {
            texel = limit_index<rule>(place, extent);
        }
        const auto weight = hn::Abs(hn::Load(d, taps.weight[k].lane + i));
        const auto used = weight > hn::Zero(d);
        weighed[k] |= wave_mask(d, used, i);
        auto readable = weight > heaviest;
        if constexpr (can_leave(rule)) {
            const auto outside = hn::And(hn::RebindMask(di, used), beyond_edges(place, extent));
            taps.outside[k] |= wave_mask(di, outside, i);
            if (rule == EdgeRule::ClampToBorder) readable = hn::AndNot(hn::RebindMask(d, outside), readable);
        }
        heaviest = hn::IfThenElse(readable, weight, heaviest);
        stand_in = hn::IfThenElse(hn::RebindMask(di, readable), texel, stand_in);
        hn::Store(texel, di, taps.texel[k].lane + i);

        place = hn::Add(place, one);
        if constexpr (rule == EdgeRule::RepeatBits) {
            place = hn::And(place, last);
        } else if constexpr (repeats(rule)) {
            place = hn::IfThenElse(place < period, place, hn::Zero(di));
        }
    }
    for (int k = 0; k < count; ++k) {
        auto unread = hn::RebindMask(di, hn::Eq(hn::Load(d, taps.weight[k].lane + i), hn::Zero(d)));
        if constexpr (rule == EdgeRule::ClampToBorder) unread = hn::Or(unread, lanes_of(di, taps.outside[k], i));
        int32_t* const texel = taps.texel[k].lane + i;
        hn::Store(hn::IfThenElse(unread, stand_in, hn::Load(di, texel)), di, texel);
    }
    if constexpr (rule == EdgeRule::ClampToBorder) {
        taps.readable &= ~wave_mask(d, hn::Eq(heaviest, hn::Zero(d)), i);
    }
}

/// Leaves out the taps that no lane weighs.
HWY_INLINE void drop_unweighed(const WaveMask* weighed, int count, AxisTaps& taps) {
    taps.count = 0;
    for (int k = 0; k < count; ++k) {
        if (weighed[k] == 0) continue;
        const int to = taps.count++;
        if (to == k) continue;
        taps.texel[to] = taps.texel[k];
        taps.weight[to] = taps.weight[k];
        taps.outside[to] = taps.outside[k];
    }
}

template <EdgeRule rule>
HWY_NOINLINE void select_wide_axis_as(const Kernel& kernel, const WaveFloat& coordinate, const std::array<int32_t, 16>& extents,
                                      const WaveInt& level, const CoordinateReading& reading, AxisTaps& taps) {
    const FloatTag d;
    const IntTag di;
    const int count = axis_taps(kernel);
    WaveMask weighed[kMostAxisTaps];
    std::fill(weighed, weighed + count, WaveMask{0});
    std::fill(taps.outside, taps.outside + count, WaveMask{0});
    taps.readable = kWaveFull;
    for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
        const auto extent = look_up_level(di, extents, hn::Load(di, level.lane + i));
        hn::Vec<FloatTag> integer, remainder;
        locate<rule>(coordinate, reading, hn::ConvertTo(d, extent), i, integer, remainder);
        const auto first = kernel_weights(kernel, remainder, taps.weight[0].lane + i, kWaveLanes);
        place_taps<rule>(small_to_int(hn::Add(integer, first)), extent, count, i, taps, weighed);
    }
    drop_unweighed(weighed, count, taps);
    taps.leaves = std::any_of(taps.outside, taps.outside + taps.count, [](WaveMask lanes) { return lanes != 0; });
}

/// The taps of `kernel` along an axis, for all lanes.
HWY_INLINE void select_wide_axis(const Kernel& kernel, EdgeRule rule, const WaveFloat& coordinate, const std::array<int32_t, 16>& extents,
                                 const WaveInt& level, const CoordinateReading& reading, AxisTaps& taps) {
    with_rule(cheapest_rule(rule, extents), [&](auto constant) HWY_ATTR {
        select_wide_axis_as<decltype(constant)::value>(kernel, coordinate, extents, level, reading, taps);
    });
}

/// What a border of ClampToBorder takes along an axis: the weight of the taps outside, and of those inside.
struct BorderShare {
    WaveFloat outside, inside;
};

/// Splits off what the border takes: its weights become 0.
HWY_NOINLINE inline void take_border(AxisTaps& taps, BorderShare& share) {
    const FloatTag d;
    for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
        auto outside = hn::Zero(d), inside = hn::Zero(d);
        for (int k = 0; k < taps.count; ++k) {
            float* const weight = taps.weight[k].lane + i;
            const auto lost = hn::IfThenElseZero(lanes_of(d, taps.outside[k], i), hn::Load(d, weight));
            const auto kept = hn::Sub(hn::Load(d, weight), lost);
            outside = hn::Add(outside, lost);
            inside = hn::Add(inside, kept);
            hn::Store(kept, d, weight);
        }
        hn::Store(outside, d, share.outside.lane + i);
        hn::Store(inside, d, share.inside.lane + i);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::texunit
HWY_AFTER_NAMESPACE();

#endif  // RAWTEXEL_TEXUNIT_WIDE_TAPS_INL_H_
