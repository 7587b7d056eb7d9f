// The line of an anisotropic lookup's probes in texels of one level: what all probes of a lane share, found once, and the taps of each.
// Positions lose nothing to the rounding of a coordinate: they are an integer and a remainder.
#include "texunit/anisotropy-inl.h"
#include "texunit/fetch-inl.h"

#include <hwy/highway.h>

// Included once per instruction set (highway's guard for -inl.h files).
#if defined(RAWTEXEL_TEXUNIT_PROBE_LINES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_TEXUNIT_PROBE_LINES_INL_H_
#undef RAWTEXEL_TEXUNIT_PROBE_LINES_INL_H_
#else
#define RAWTEXEL_TEXUNIT_PROBE_LINES_INL_H_
#endif

HWY_BEFORE_NAMESPACE();
namespace rawtexel::texunit {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// One axis of a level for some lanes: where the probes' line starts and how it wraps. Texel index i becomes i & mask, folded back where
/// it exceeds fold/2, limited to [0, last].
struct ProbeAxis {
    FloatVec start, direction;  ///< texels from texel `base`, less 1/2; per unit of place
    IntVec base, mask, fold, last;
};

/// Beyond this many texels a line has no meaning; sums with it still convert to integers.
inline constexpr float kLongestProbeAxis = 0x1p21f;

template <EdgeRule rule>
HWY_INLINE ProbeAxis probe_axis_as(FloatVec coordinate, FloatVec axis, IntVec extent) {
    const FloatTag d;
    const IntTag di;
    const auto size = hn::ConvertTo(d, extent);
    FloatVec integer, remainder;
    scale_coordinate(reduce_range<rule>(coordinate), size, integer, remainder);
    const auto longest = hn::Set(d, kLongestProbeAxis);
    ProbeAxis result;
    result.start = hn::Sub(remainder, hn::Set(d, 0.5f));
    result.direction = hn::Min(hn::Max(hn::Mul(axis, size), hn::Neg(longest)), longest);
    result.base = hn::ConvertTo(di, integer);
    const auto one = hn::Set(di, 1), all = hn::Set(di, -1), none = hn::Set(di, INT32_MAX);
    result.last = hn::Sub(extent, one);
    const auto last_mirrored = hn::Sub(hn::Add(extent, extent), one);
    result.mask = rule == EdgeRule::Repeat ? result.last : rule == EdgeRule::MirroredRepeat ? last_mirrored : all;
    result.fold = rule == EdgeRule::MirroredRepeat ? last_mirrored : none;
    return result;
}

HWY_INLINE ProbeAxis probe_axis(Wrap wrap, FloatVec coordinate, FloatVec axis, IntVec extent) {
    if (wrap == Wrap::Repeat) return probe_axis_as<EdgeRule::Repeat>(coordinate, axis, extent);
    if (wrap == Wrap::MirroredRepeat) return probe_axis_as<EdgeRule::MirroredRepeat>(coordinate, axis, extent);
    return probe_axis_as<EdgeRule::ClampToEdge>(coordinate, axis, extent);
}

/// Both bilinear taps of a probe along an axis; where the fraction is 0 the second repeats the first.
struct ProbeTaps {
    IntVec first, second;
    FloatVec fraction;
};

/// Where a probe falls between texel centres: floor, and what is left of it.
HWY_INLINE void split_place(const ProbeAxis& axis, FloatVec place, IntVec& index, FloatVec& fraction) {
    const FloatTag d;
    const auto at = hn::Add(axis.start, hn::Mul(place, axis.direction));
    const auto whole = hn::Floor(at);
    index = hn::Add(axis.base, hn::ConvertTo(IntTag(), whole));
    fraction = hn::Min(hn::Sub(at, whole), hn::Set(d, 1.0f - 0x1p-24f));
}

HWY_INLINE hn::Mask<IntTag> is_zero(FloatVec fraction) { return hn::RebindMask(IntTag(), hn::Eq(fraction, hn::Zero(FloatTag()))); }

HWY_INLINE ProbeTaps probe_taps(const ProbeAxis& axis, FloatVec place) {
    const IntTag di;
    IntVec index;
    ProbeTaps taps;
    split_place(axis, place, index, taps.fraction);
    const auto wrap = [&](IntVec i) HWY_ATTR {
        const auto in_period = hn::And(i, axis.mask);
        const auto folded = hn::Min(in_period, hn::Sub(axis.fold, in_period));
        return hn::Min(hn::Max(folded, hn::Zero(di)), axis.last);
    };
    taps.first = wrap(index);
    taps.second = hn::IfThenElse(is_zero(taps.fraction), taps.first, wrap(hn::Add(index, hn::Set(di, 1))));
    return taps;
}

/// What the probes of some lanes read of one level. The last three are for textures that repeat, whose extents are powers of two: there
/// column and row are disjoint bits of a texel's index, and the next one follows by a carry through the bits of the other.
struct ProbeLevel {
    ProbeAxis s, t;
    IntVec offset, row_stride;
    IntVec column_bits, row_bits, other_rows;  ///< bits in use by columns, by rows; bits that no row has
};

constexpr auto kPacked = StorageClass::Packed32;
/// Bits that no column has: rows within a page (texunit/level_table.h).
inline constexpr int32_t kRowsOfPage = row_offset(kPacked, (1 << page_shape(kPacked).log2_height) - 1, 0);

HWY_INLINE ProbeLevel probe_level(const LevelTable& table, const SamplerState& sampler, const WavePosition& centre,
                                  const ProbeChoice& probes, const WaveInt& levels, size_t i) {
    const FloatTag d;
    const IntTag di;
    const auto level = hn::Load(di, levels.lane + i);
    const auto axis = [&](Wrap wrap, const WaveFloat& coordinate, const WaveFloat& direction,
                          const std::array<int32_t, 16>& extents) HWY_ATTR {
        return probe_axis(wrap, hn::Load(d, coordinate.lane + i), hn::Load(d, direction.lane + i), look_up_level(di, extents, level));
    };
    ProbeLevel result;
    result.s = axis(sampler.wrap_s, *centre.u, probes.axis_u, table.width);
    result.t = axis(sampler.wrap_t, *centre.v, probes.axis_v, table.height);
    result.offset = slice_offset(table, level, centre.slice, i);
    result.row_stride = look_up_level(di, table.row_stride, level);
    result.column_bits = column_offset_v<kPacked>(result.s.last);
    result.row_bits = row_offset_v<kPacked>(result.t.last, result.row_stride);
    result.other_rows = hn::AndNot(hn::Set(di, kRowsOfPage), hn::Sub(result.row_stride, hn::Set(di, 1)));
    return result;
}

/// Places and shares of the probes of some lanes. Those with fewer probes than others stay at their last and take no share.
struct ProbePlaces {
    const ProbeTable* table;
    IntVec row, last;  ///< of the table; count - 1
    int most;          ///< largest count
    bool alike;        ///< all counts are the same

    ProbePlaces(const ProbeTable& probe_table, IntVec count)
        : table(&probe_table),
          row(hn::Mul(count, hn::Set(IntTag(), kMostProbes))),
          last(hn::Sub(count, hn::Set(IntTag(), 1))),
          most(largest_lane(count)),
          alike(hn::AllTrue(IntTag(), hn::Eq(count, hn::Set(IntTag(), most)))) {}

    HWY_INLINE IntVec at(int n) const { return hn::Add(row, hn::Min(hn::Set(IntTag(), n), last)); }
    HWY_INLINE FloatVec place(int n) const {
        const FloatTag d;
        return alike ? hn::Set(d, table->place[size_t(kMostProbes * most + n)]) : gather_from(table->place.data(), at(n));
    }
    HWY_INLINE FloatVec share(int n) const {
        const FloatTag d;
        if (alike) return hn::Set(d, table->share[size_t(kMostProbes * most + n)]);
        const auto past = hn::RebindMask(d, last < hn::Set(IntTag(), n));
        return hn::IfThenZeroElse(past, gather_from(table->share.data(), at(n)));
    }
};

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::texunit
HWY_AFTER_NAMESPACE();

#endif  // RAWTEXEL_TEXUNIT_PROBE_LINES_INL_H_
