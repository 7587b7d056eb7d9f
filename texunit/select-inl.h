// The first stage of a lookup: which texels, and how much of each. Needs the texture's shape and the sampler, never its texels, so one
// selection serves every map of a material that shares both. Here the kernels of one and two taps an axis; wide_taps-inl.h has the others.
#include "texunit/address-inl.h"
#include "texunit/lanes-inl.h"
#include "texunit/math-inl.h"

#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <bit>
#include <type_traits>

// Included once per instruction set (highway's guard for -inl.h files).
#if defined(RAWTEXEL_TEXUNIT_SELECT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_TEXUNIT_SELECT_INL_H_
#undef RAWTEXEL_TEXUNIT_SELECT_INL_H_
#else
#define RAWTEXEL_TEXUNIT_SELECT_INL_H_
#endif

HWY_BEFORE_NAMESPACE();
namespace rawtexel::texunit {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Where a wave samples, lane by lane, whatever its footprint: what the probes of an anisotropic lookup move.
struct WavePosition {
    const WaveFloat* u;
    const WaveFloat* v;
    const WaveInt* slice = nullptr;     ///< array layer, or 6*cube + face; null: slice 0
    const WaveFloat* w = nullptr;       ///< third coordinate, of volumes only
    const WaveFloat* u_rest = nullptr;  ///< cube maps only: what rounding took from u,
    const WaveFloat* v_rest = nullptr;  ///< and from v, which are coordinates on the face

    bool cube() const { return u_rest != nullptr; }
};

/// What an index outside the texture means: a Wrap, or for cube maps a texel of another face. RepeatBits is Repeat where every level's
/// extent is a power of two, so that wrapping an index keeps its lower bits.
enum class EdgeRule { Repeat, MirroredRepeat, ClampToEdge, ClampToBorder, MirrorOnce, CubeEdge, RepeatBits };
constexpr EdgeRule edge_rule(Wrap wrap) { return EdgeRule(wrap); }
static_assert(edge_rule(Wrap::Repeat) == EdgeRule::Repeat && edge_rule(Wrap::MirrorOnce) == EdgeRule::MirrorOnce);

/// Texels along both axes that a kernel of `W` taps an axis covers. Lane by lane, tap (i, j) is the texel (x[i], y[j]). For W = 2 its
/// weights along x are 1 - fraction_x and fraction_x; where a fraction is 0 the second index repeats the first. Indices are wrapped, but
/// those of cube maps may be -1 or the extent.
template <int W>
struct TapWave {
    const WaveInt* level;
    const WaveInt* slice;  ///< null: slice 0
    WaveInt x[W], y[W];
    WaveFloat fraction_x, fraction_y;     ///< [0, 1), W = 2 only
    WaveMask outside_x[W], outside_y[W];  ///< lanes whose index is beyond an edge of a border or a cube map; unset unless `leaves`
    bool leaves = false;                  ///< some bit of those is set
};

/// Coordinates are limited to this many widths of the texture on either side: farther off even the widest kernel reads the edge alone.
inline constexpr float kFarthestCoordinate = 80.0f;

/// `coordinate` with its whole periods taken away, which is exact: u - trunc(u) for repeat, in (-1, 1); the remainder by 2 for mirrored
/// repeat, in (-2, 2). Not finite reads as 0.
template <EdgeRule rule, class V>
HWY_INLINE V reduce_range(V coordinate) {
    const hn::DFromV<V> d;
    if constexpr (rule == EdgeRule::Repeat || rule == EdgeRule::RepeatBits) {
        // What is not finite leaves no number.
        const V part = hn::Sub(coordinate, hn::Trunc(coordinate));
        return hn::IfThenElseZero(hn::Eq(part, part), part);
    }
    const V u = hn::IfThenElseZero(hn::IsFinite(coordinate), coordinate);
    if constexpr (rule == EdgeRule::MirroredRepeat) {
        return hn::Sub(u, hn::Mul(hn::Set(d, 2.0f), hn::Trunc(hn::Mul(u, hn::Set(d, 0.5f)))));
    }
    return hn::Min(hn::Max(u, hn::Set(d, -kFarthestCoordinate)), hn::Set(d, kFarthestCoordinate));
}

/// A texel-space coordinate as integer + remainder, |remainder| <= 1/2 (and a little where rounding of the product crosses it), exact but
/// for one rounding of the remainder. The product of coordinate and extent is carried in two terms, so extents up to kMaxExtent keep 2^-24.
template <class V>
HWY_INLINE void scale_coordinate(V reduced, V extent, V& integer, V& remainder) {
    V high, low;
    two_product(reduced, extent, high, low);
    integer = round_small(high);
    remainder = hn::Add(hn::Sub(high, integer), low);
}

/// How the coordinates of an axis are read.
struct CoordinateReading {
    Precision precision;
    const WaveFloat* rest;  ///< what rounding took from the coordinates, of cube maps only
};

/// To the nearest 1/256: 8 fractional bits (D3D11.3 7.18.8).
template <class V>
HWY_INLINE V snap_fraction(V remainder) {
    const hn::DFromV<V> d;
    return hn::Mul(round_small(hn::Mul(remainder, hn::Set(d, 256.0f))), hn::Set(d, 1.0f / 256.0f));
}

/// The texel-space coordinates of lanes i .. in a level `extent` texels wide.
template <EdgeRule rule>
HWY_INLINE void locate(const WaveFloat& coordinate, const CoordinateReading& reading, hn::Vec<FloatTag> extent, size_t i,
                       hn::Vec<FloatTag>& integer, hn::Vec<FloatTag>& remainder) {
    const FloatTag d;
    scale_coordinate(reduce_range<rule>(hn::Load(d, coordinate.lane + i)), extent, integer, remainder);
    if constexpr (rule == EdgeRule::CubeEdge) {
        remainder = hn::Add(remainder, hn::Mul(hn::Load(d, reading.rest->lane + i), extent));
    }
    if (HWY_UNLIKELY(reading.precision == Precision::Gpu)) remainder = snap_fraction(remainder);
}

/// floor(coordinate), the texel that holds it, relative to `integer`.
template <class V>
HWY_INLINE V nearest_texel(V remainder) {
    const hn::DFromV<V> d;
    return hn::IfThenElseZero(remainder < hn::Zero(d), hn::Set(d, -1.0f));
}

/// floor and fraction of coordinate - 1/2 = (integer - 1) + (remainder + 1/2): the texel whose centre is the last one before the
/// coordinate, relative to `integer`, and how far beyond it the coordinate lies, [0, 1). The second sum hardly leaves [0, 1].
template <class V>
HWY_INLINE void split_between_centres(V remainder, V& first, V& fraction) {
    const hn::DFromV<V> d;
    const V raised = hn::Add(remainder, hn::Set(d, 0.5f)), step = hn::Floor(raised);
    first = hn::Sub(step, hn::Set(d, 1.0f));
    fraction = hn::Min(hn::Sub(raised, step), hn::Set(d, 1.0f - 0x1p-24f));
}

/// Wraps index i, -2*extent - 1 <= i <= 2*extent for repeating modes, as an integer: into [0, extent), or for mirrored repeat into the
/// unfolded period [0, 2*extent).
template <class V>
HWY_INLINE V wrap_period(V i, V period) {
    const V zero = hn::Zero(hn::DFromV<V>());
    i = hn::Add(i, hn::IfThenElseZero(i < zero, period));
    i = hn::Add(i, hn::IfThenElseZero(i < zero, period));
    return hn::IfThenElse(i < period, i, hn::Sub(i, period));
}

constexpr bool repeats(EdgeRule rule) {
    return rule == EdgeRule::Repeat || rule == EdgeRule::MirroredRepeat || rule == EdgeRule::RepeatBits;
}

/// Texel of `place` within a period of a repeating mode: the second half of a mirrored period runs backwards.
template <EdgeRule rule, class V>
HWY_INLINE V fold_period(V place, V period) {
    if constexpr (rule != EdgeRule::MirroredRepeat) return place;
    return hn::Min(place, hn::Sub(hn::Sub(period, hn::Set(hn::DFromV<V>(), 1)), place));
}

/// Texel of index i under the modes that do not repeat (Vulkan "Wrapping Operation").
template <EdgeRule rule, class V>
HWY_INLINE V limit_index(V i, V extent) {
    const hn::DFromV<V> d;
    if constexpr (rule == EdgeRule::CubeEdge) return i;
    // -1 - i reflects about the edge at 0.
    if constexpr (rule == EdgeRule::MirrorOnce) i = hn::Max(i, hn::Not(i));
    return hn::Min(hn::Max(i, hn::Zero(d)), hn::Sub(extent, hn::Set(d, 1)));
}

/// Texel indices of the taps i, i + 1, … along one axis of `extent` texels.
template <EdgeRule rule, int W, class V>
HWY_INLINE void wrap_indices(V i, V extent, V (&index)[W]) {
    const hn::DFromV<V> d;
    if constexpr (!repeats(rule)) {
        for (int k = 0; k < W; ++k) index[k] = limit_index<rule>(hn::Add(i, hn::Set(d, k)), extent);
        return;
    }
    if constexpr (rule == EdgeRule::RepeatBits) {
        const V last = hn::Sub(extent, hn::Set(d, 1));
        for (int k = 0; k < W; ++k) index[k] = hn::And(hn::Add(i, hn::Set(d, k)), last);
        return;
    }
    const V period = rule == EdgeRule::MirroredRepeat ? hn::Add(extent, extent) : extent;
    V place = wrap_period(i, period);
    for (int k = 0; k < W; ++k) {
        index[k] = fold_period<rule>(place, period);
        place = hn::Add(place, hn::Set(d, 1));
        place = hn::IfThenElse(place < period, place, hn::Zero(d));
    }
}

/// Rules that ask whether an index is beyond an edge, and the question.
constexpr bool can_leave(EdgeRule rule) { return rule == EdgeRule::ClampToBorder || rule == EdgeRule::CubeEdge; }
template <class V>
HWY_INLINE hn::Mask<hn::DFromV<V>> beyond_edges(V index, V extent) {
    return hn::Or(index < hn::Zero(hn::DFromV<V>()), hn::Not(index < extent));
}

/// Taps along one axis. `outside` gets the lanes beyond the edges where the rule can leave.
template <EdgeRule rule, int W>
HWY_NOINLINE void select_axis_as(const WaveFloat& coordinate, const std::array<int32_t, 16>& extents, const WaveInt& level,
                                 WaveInt (&index)[W], WaveFloat& fraction, const CoordinateReading& reading, WaveMask (&outside)[W]) {
    const FloatTag d;
    const IntTag di;
    if constexpr (can_leave(rule)) std::fill(outside, outside + W, WaveMask{0});
    for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
        const auto extent = look_up_level(di, extents, hn::Load(di, level.lane + i));
        hn::Vec<FloatTag> integer, remainder, first, part;
        locate<rule>(coordinate, reading, hn::ConvertTo(d, extent), i, integer, remainder);
        if constexpr (W == 1) {
            first = nearest_texel(remainder);
        } else {
            split_between_centres(remainder, first, part);
            hn::Store(part, d, fraction.lane + i);
        }

        auto start = small_to_int(hn::Add(integer, first));
        // One texel never leaves the face: a coordinate of 1 belongs to the last.
        if constexpr (W == 1 && rule == EdgeRule::CubeEdge) start = limit_index<EdgeRule::ClampToEdge>(start, extent);
        hn::Vec<IntTag> indices[W];
        wrap_indices<rule>(start, extent, indices);
        if constexpr (can_leave(rule)) {
            for (int k = 0; k < W; ++k) outside[k] |= wave_mask(di, beyond_edges(hn::Add(start, hn::Set(di, k)), extent), i);
        }
        if constexpr (W == 2) {
            const auto unused = hn::RebindMask(di, hn::Eq(part, hn::Zero(d)));
            indices[1] = hn::IfThenElse(unused, indices[0], indices[1]);
            if constexpr (can_leave(rule)) {
                const WaveMask repeating = wave_mask(di, unused, i);
                outside[1] = (outside[1] & ~repeating) | (outside[0] & repeating);
            }
        }
        for (int k = 0; k < W; ++k) hn::Store(indices[k], di, index[k].lane + i);
    }
}

/// Lanes `nearest` of two taps along an axis take one texel, embedded in the wider kernel with fraction 0.
template <EdgeRule rule>
HWY_NOINLINE void take_nearest(const WaveFloat& coordinate, const std::array<int32_t, 16>& extents, const WaveInt& level, WaveMask nearest,
                               WaveInt (&index)[2], WaveFloat& fraction, const CoordinateReading& reading, WaveMask (&outside)[2]) {
    WaveInt single[1];
    WaveMask single_outside[1];
    select_axis_as<rule>(coordinate, extents, level, single, fraction, reading, single_outside);
    for (WaveMask rest = nearest; rest != 0; rest &= rest - 1) {
        const int lane = std::countr_zero(rest);
        index[0][lane] = index[1][lane] = single[0][lane];
        fraction[lane] = 0.0f;
    }
    if constexpr (can_leave(rule)) {
        for (WaveMask& lanes : outside) lanes = (lanes & ~nearest) | (single_outside[0] & nearest);
    }
}

/// The rule in its cheapest form for an axis of these extents.
HWY_INLINE EdgeRule cheapest_rule(EdgeRule rule, const std::array<int32_t, 16>& extents) {
    return rule == EdgeRule::Repeat && std::has_single_bit(uint32_t(extents[0])) ? EdgeRule::RepeatBits : rule;
}

/// Calls `act` with the rule as a constant of the type std::integral_constant.
template <class Act>
HWY_INLINE auto with_rule(EdgeRule rule, const Act& act) {
    switch (rule) {
        case EdgeRule::RepeatBits: return act(std::integral_constant<EdgeRule, EdgeRule::RepeatBits>());
        case EdgeRule::MirroredRepeat: return act(std::integral_constant<EdgeRule, EdgeRule::MirroredRepeat>());
        case EdgeRule::ClampToEdge: return act(std::integral_constant<EdgeRule, EdgeRule::ClampToEdge>());
        case EdgeRule::ClampToBorder: return act(std::integral_constant<EdgeRule, EdgeRule::ClampToBorder>());
        case EdgeRule::MirrorOnce: return act(std::integral_constant<EdgeRule, EdgeRule::MirrorOnce>());
        case EdgeRule::CubeEdge: return act(std::integral_constant<EdgeRule, EdgeRule::CubeEdge>());
        default: return act(std::integral_constant<EdgeRule, EdgeRule::Repeat>());
    }
}

/// `nearest`: lanes that take one texel. Returns whether some lane's tap is beyond an edge; `outside` is set only then.
template <int W>
HWY_INLINE bool select_axis(EdgeRule rule, const WaveFloat& coordinate, const std::array<int32_t, 16>& extents, const WaveInt& level,
                            WaveMask nearest, WaveInt (&index)[W], WaveFloat& fraction, const CoordinateReading& reading,
                            WaveMask (&outside)[W]) {
    return with_rule(cheapest_rule(rule, extents), [&](auto constant) HWY_ATTR {
        constexpr EdgeRule kRule = decltype(constant)::value;
        select_axis_as<kRule>(coordinate, extents, level, index, fraction, reading, outside);
        if constexpr (W == 2) {
            if (HWY_UNLIKELY(nearest != 0)) take_nearest<kRule>(coordinate, extents, level, nearest, index, fraction, reading, outside);
        }
        if constexpr (!can_leave(kRule)) return false;
        return std::any_of(outside, outside + W, [](WaveMask lanes) { return lanes != 0; });
    });
}

/// The rules of a texture's two axes at `at`.
HWY_INLINE EdgeRule rule_of(const WavePosition& at, Wrap wrap) { return at.cube() ? EdgeRule::CubeEdge : edge_rule(wrap); }

/// The taps of one level per lane, for all lanes.
template <int W>
HWY_INLINE void select_taps(const LevelTable& table, const SamplerState& sampler, const WavePosition& at, const WaveInt& level,
                            WaveMask nearest, TapWave<W>& taps) {
    taps.level = &level;
    taps.slice = at.slice;
    const bool leaves_x = select_axis(rule_of(at, sampler.wrap_s), *at.u, table.width, level, nearest, taps.x, taps.fraction_x,
                                      {sampler.precision, at.u_rest}, taps.outside_x);
    const bool leaves_y = select_axis(rule_of(at, sampler.wrap_t), *at.v, table.height, level, nearest, taps.y, taps.fraction_y,
                                      {sampler.precision, at.v_rest}, taps.outside_y);
    taps.leaves = leaves_x || leaves_y;
    if (!taps.leaves) return;
    if (!leaves_x) std::fill(taps.outside_x, taps.outside_x + W, WaveMask{0});
    if (!leaves_y) std::fill(taps.outside_y, taps.outside_y + W, WaveMask{0});
}

/// The array layer nearest to each lane's coordinate, ties to even, within the array (Vulkan "Array Layer Selection"). Not a number is 0.
HWY_NOINLINE inline void select_layers(const WaveFloat& layer, WaveMask mask, int layers, WaveInt& slice) {
    const FloatTag d;
    const IntTag di;
    WaveFloat filled;
    repeat_first(layer, mask, filled);
    for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
        const auto a = hn::Load(d, filled.lane + i);
        const auto number = hn::IfThenZeroElse(hn::IsNaN(a), a);
        const auto within = hn::Min(hn::Max(number, hn::Zero(d)), hn::Set(d, float(layers - 1)));
        hn::Store(hn::ConvertTo(di, round_small(within)), di, slice.lane + i);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::texunit
HWY_AFTER_NAMESPACE();

#endif  // RAWTEXEL_TEXUNIT_SELECT_INL_H_
