// The first stage of a lookup: which texels, and how much of each. Needs the texture's shape and the sampler, never its texels, so one
// selection serves every map of a material that shares both.
#include "texunit/address-inl.h"
#include "texunit/lanes-inl.h"
#include "texunit/math-inl.h"

#include <hwy/highway.h>

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
};

/// Texels along both axes that a kernel of `W` taps an axis covers, indices already wrapped. Lane by lane, tap (i, j) is the texel
/// (x[i], y[j]). For W = 2 its weights along x are 1 - fraction_x and fraction_x; where a fraction is 0 the second index repeats the first.
template <int W>
struct TapWave {
    WaveInt level;
    WaveInt x[W], y[W];
    WaveFloat fraction_x, fraction_y;   ///< [0, 1), W = 2 only
};

/// `coordinate` with its whole periods taken away, which is exact: u - trunc(u) for repeat, in (-1, 1); the remainder by 2 for mirrored
/// repeat, in (-2, 2). Clamped coordinates are limited to [-10, 10] as D3D11.3 7.18.6 does: still far outside. Not finite reads as 0.
template <Wrap wrap, class V>
HWY_INLINE V reduce_range(V coordinate) {
    const hn::DFromV<V> d;
    const V u = hn::IfThenElseZero(hn::IsFinite(coordinate), coordinate);
    if constexpr (wrap == Wrap::Repeat) return hn::Sub(u, hn::Trunc(u));
    if constexpr (wrap == Wrap::MirroredRepeat) {
        return hn::Sub(u, hn::Mul(hn::Set(d, 2.0f), hn::Trunc(hn::Mul(u, hn::Set(d, 0.5f)))));
    }
    return hn::Min(hn::Max(u, hn::Set(d, -10.0f)), hn::Set(d, 10.0f));
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

/// Wraps index i, -2*extent - 1 <= i <= 2*extent for repeating modes, as an integer: into [0, extent), or for mirrored repeat into the
/// unfolded period [0, 2*extent).
template <class V>
HWY_INLINE V wrap_period(V i, V period) {
    const V zero = hn::Zero(hn::DFromV<V>());
    i = hn::Add(i, hn::IfThenElseZero(i < zero, period));
    i = hn::Add(i, hn::IfThenElseZero(i < zero, period));
    return hn::IfThenElse(i < period, i, hn::Sub(i, period));
}

/// Texel indices of the taps i, i + 1, … along one axis of `extent` texels.
template <Wrap wrap, int W, class V>
HWY_INLINE void wrap_indices(V i, V extent, V (&index)[W]) {
    const hn::DFromV<V> d;
    const V zero = hn::Zero(d), one = hn::Set(d, 1);
    if constexpr (wrap == Wrap::ClampToEdge) {
        const V last = hn::Sub(extent, one);
        for (int k = 0; k < W; ++k) index[k] = hn::Min(hn::Max(hn::Add(i, hn::Set(d, k)), zero), last);
        return;
    }
    const V period = wrap == Wrap::MirroredRepeat ? hn::Add(extent, extent) : extent;
    V place = wrap_period(i, period);
    for (int k = 0; k < W; ++k) {
        // The second half of a mirrored period runs backwards.
        index[k] = wrap == Wrap::MirroredRepeat ? hn::Min(place, hn::Sub(hn::Sub(period, one), place)) : place;
        place = hn::Add(place, one);
        place = hn::IfThenElse(place < period, place, zero);
    }
}

/// Taps along one axis. `nearest`: lanes that take one texel, embedded in a wider kernel with fraction 0.
template <Wrap wrap, int W>
HWY_NOINLINE void select_axis_as(const WaveFloat& coordinate, const std::array<int32_t, 16>& extents, const WaveInt& level,
                                 WaveMask nearest, WaveInt (&index)[W], WaveFloat& fraction) {
    const FloatTag d;
    const IntTag di;
    const auto zero = hn::Zero(d), one = hn::Set(d, 1.0f), half = hn::Set(d, 0.5f);
    for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
        const auto extent = look_up_level(di, extents, hn::Load(di, level.lane + i));
        hn::Vec<FloatTag> integer, remainder;
        scale_coordinate(reduce_range<wrap>(hn::Load(d, coordinate.lane + i)), hn::ConvertTo(d, extent), integer, remainder);

        // Nearest takes the texel that holds the coordinate.
        auto first = hn::Add(integer, hn::IfThenElseZero(remainder < zero, hn::Set(d, -1.0f)));
        if constexpr (W == 2) {
            // Bilinear: floor and fraction of coordinate - 1/2 = (integer - 1) + (remainder + 1/2); the second sum hardly leaves [0, 1].
            const auto raised = hn::Add(remainder, half);
            const auto step = hn::Sub(hn::IfThenElseZero(raised >= one, one), hn::IfThenElseZero(raised < zero, one));
            const auto largest = hn::Set(d, 1.0f - 0x1p-24f);
            const auto part = hn::Min(hn::Sub(raised, step), largest);
            const auto single = lanes_of(d, nearest, i);
            first = hn::IfThenElse(single, first, hn::Add(hn::Sub(integer, one), step));
            hn::Store(hn::IfThenElse(single, zero, part), d, fraction.lane + i);
        }

        hn::Vec<IntTag> indices[W];
        wrap_indices<wrap>(hn::ConvertTo(di, first), extent, indices);
        if constexpr (W == 2) {
            const auto unused = hn::RebindMask(di, hn::Eq(hn::Load(d, fraction.lane + i), zero));
            indices[1] = hn::IfThenElse(unused, indices[0], indices[1]);
        }
        for (int k = 0; k < W; ++k) hn::Store(indices[k], di, index[k].lane + i);
    }
}

template <int W>
HWY_INLINE void select_axis(Wrap wrap, const WaveFloat& coordinate, const std::array<int32_t, 16>& extents, const WaveInt& level,
                            WaveMask nearest, WaveInt (&index)[W], WaveFloat& fraction) {
    switch (wrap) {
        case Wrap::Repeat: return select_axis_as<Wrap::Repeat>(coordinate, extents, level, nearest, index, fraction);
        case Wrap::MirroredRepeat: return select_axis_as<Wrap::MirroredRepeat>(coordinate, extents, level, nearest, index, fraction);
        case Wrap::ClampToEdge:
        case Wrap::ClampToBorder:
        case Wrap::MirrorOnce: return select_axis_as<Wrap::ClampToEdge>(coordinate, extents, level, nearest, index, fraction);
    }
}

/// The taps of one level per lane, for all lanes.
template <int W>
HWY_INLINE void select_taps(const LevelTable& table, const SamplerState& sampler, const WavePosition& at, const WaveInt& level,
                            WaveMask nearest, TapWave<W>& taps) {
    taps.level = level;
    select_axis(sampler.wrap_s, *at.u, table.width, level, nearest, taps.x, taps.fraction_x);
    select_axis(sampler.wrap_t, *at.v, table.height, level, nearest, taps.y, taps.fraction_y);
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::texunit
HWY_AFTER_NAMESPACE();

#endif  // RAWTEXEL_TEXUNIT_SELECT_INL_H_
