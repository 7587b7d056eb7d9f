// What those who listen to a lookup hear of it (texunit/fetch_log.h).
#include "texunit/cube-inl.h"
#include "texunit/fetch-inl.h"
#include "texunit/fetch_log.h"
#include "texunit/wide_taps-inl.h"

#include <hwy/highway.h>

#include <bit>

// Included once per instruction set (highway's guard for -inl.h files).
#if defined(RAWTEXEL_TEXUNIT_COUNT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_TEXUNIT_COUNT_INL_H_
#undef RAWTEXEL_TEXUNIT_COUNT_INL_H_
#else
#define RAWTEXEL_TEXUNIT_COUNT_INL_H_
#endif

HWY_BEFORE_NAMESPACE();
namespace rawtexel::texunit {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// The taps of one axis as the policies see them, whatever the kernel's width.
struct AxisView {
    int count;
    const WaveInt* texel;
    const WaveFloat* weight;  ///< 0 where a lane does not weigh the tap
    const WaveMask* outside;  ///< lanes beyond an edge, or null
};

/// The taps of one slice of one level: the product of two axes.
struct TapGrid {
    AxisView x, y;
    const WaveInt* level;
    const WaveInt* slice;         ///< null: slice 0
    const WaveFloat* scale;       ///< weight of the slice in a volume, or null
    WaveMask outside_slice;       ///< lanes whose slice is beyond a border
    const int32_t* cube_extents;  ///< by level, of cube maps; else null
};

HWY_INLINE AxisView view(const AxisTaps& taps) { return {taps.count, taps.texel, taps.weight, taps.leaves ? taps.outside : nullptr}; }

/// Lanes of `mask` that weigh tap k.
HWY_NOINLINE inline WaveMask weighing_lanes(const WaveFloat& weight, WaveMask mask) {
    const FloatTag d;
    WaveMask lanes = 0;
    for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
        lanes |= wave_mask(d, hn::Ne(hn::Load(d, weight.lane + i), hn::Zero(d)), i);
    }
    return lanes & mask;
}

/// The vector form of texel_index for textures of any storage class.
class TexelIndexer {
  public:
    TexelIndexer(const Texture& texture, const WaveInt& level, const WaveInt* slice, size_t i)
        : page_(page_shape(texture.texel_layout().storage)) {
        const IntTag d;
        const auto levels = hn::Load(d, level.lane + i);
        offset_ = slice_offset(texture.levels(), levels, slice, i);
        row_stride_ = look_up_level(d, texture.levels().row_stride, levels);
    }
    IntVec column(IntVec x) const {
        const IntTag d;
        const auto bit = [&](IntVec value, int place) HWY_ATTR { return hn::And(value, hn::Set(d, 1 << place)); };
        auto within = hn::Or(hn::And(x, hn::Set(d, 3)), hn::ShiftLeft<2>(bit(x, 2)));
        within = hn::Or(within, hn::ShiftLeft<3>(bit(x, 3)));
        if (page_.log2_width > 4) within = hn::Or(within, hn::ShiftLeft<4>(bit(x, 4)));
        const auto page = hn::ShiftLeftSame(hn::ShiftRightSame(x, page_.log2_width), page_.log2_texels());
        return hn::Add(offset_, hn::Or(within, page));
    }
    IntVec row(IntVec y) const {
        const IntTag d;
        const auto bit = [&](int place) HWY_ATTR { return hn::And(y, hn::Set(d, 1 << place)); };
        auto within = hn::Or(hn::ShiftLeft<2>(hn::And(y, hn::Set(d, 3))), hn::ShiftLeft<3>(bit(2)));
        within = hn::Or(within, hn::ShiftLeft<4>(bit(3)));
        if (page_.log2_height > 4) within = hn::Or(within, hn::ShiftLeft<5>(bit(4)));
        return hn::Add(within, hn::Mul(hn::ShiftRightSame(y, page_.log2_height), row_stride_));
    }

  private:
    PageShape page_;
    IntVec offset_, row_stride_;
};

/// Marks the texels of `lanes`.
HWY_INLINE void mark_lanes(IntVec index, hn::Mask<IntTag> lanes, const TouchedBits& touched) {
    const IntTag d;
    const auto texel = hn::IfThenElseZero(lanes, index);
    const auto words = hn::GatherIndex(d, reinterpret_cast<const int32_t*>(touched.words), hn::ShiftRight<5>(texel));
    const auto bit = hn::Shl(hn::Set(d, 1), hn::And(texel, hn::Set(d, 31)));
    const auto missing = hn::And(lanes, hn::Eq(hn::And(words, bit), hn::Zero(d)));
    if (HWY_LIKELY(hn::AllFalse(d, missing))) return;
    alignas(64) int32_t texels[hn::MaxLanes(d)];
    hn::Store(texel, d, texels);
    for (WaveMask rest = wave_mask(d, missing, 0); rest != 0; rest &= rest - 1) touched.mark(texels[std::countr_zero(rest)]);
}

/// Marks one texel of each lane of `mask`.
HWY_NOINLINE inline void mark_texels(const WaveInt& level, const WaveInt* slice, const WaveInt& x, const WaveInt& y, WaveMask mask,
                                     const FetchCounter& count) {
    if (count.touched.empty()) return;
    const IntTag d;
    for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
        const TexelIndexer indexer(*count.texture, level, slice, i);
        const auto index = hn::Add(indexer.column(hn::Load(d, x.lane + i)), indexer.row(hn::Load(d, y.lane + i)));
        mark_lanes(index, lanes_of(d, mask, i), count.touched);
    }
}

/// Adds `counted` texels a lane, 0 where the lane does not count.
HWY_NOINLINE inline void add_texels(const WaveInt& counted, const WaveInt& level, FetchCounter& count) {
    uint64_t total = 0;
    for (int i = 0; i < kWaveLanes; ++i) {
        total += uint64_t(counted[i]);
        count.counts->level_texels[size_t(level[i])] += uint64_t(counted[i]);
    }
    count.counts->taps += total;
    count.counts->texels_requested += total;
    if (count.pixel == nullptr) return;
    for (int i = 0; i < kWaveLanes; ++i) (*count.pixel)[i] += uint32_t(counted[i]);
}

/// Lanes i .. that weigh tap k of the axis on the texture itself.
HWY_INLINE hn::Mask<IntTag> weighs_texel(const AxisView& axis, int k, size_t i) {
    const FloatTag d;
    const IntTag di;
    const auto weighs = hn::RebindMask(di, hn::Ne(hn::Load(d, axis.weight[k].lane + i), hn::Zero(d)));
    return axis.outside == nullptr ? weighs : hn::AndNot(lanes_of(di, axis.outside[k], i), weighs);
}

/// Counts and marks the taps of the grid that lie on the texture itself, or on a cube map's own face, for the lanes of `mask`.
HWY_NOINLINE inline void count_grid(const TapGrid& grid, WaveMask mask, FetchCounter& count) {
    const IntTag d;
    WaveInt counted;
    for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
        const auto lanes = lanes_of(d, mask & ~grid.outside_slice, i);
        const TexelIndexer indexer(*count.texture, *grid.level, grid.slice, i);
        auto sum = hn::Zero(d);
        IntVec column[kMostAxisTaps];
        hn::Mask<IntTag> weighs[kMostAxisTaps];
        for (int k = 0; k < grid.x.count; ++k) {
            column[k] = indexer.column(hn::Load(d, grid.x.texel[k].lane + i));
            weighs[k] = weighs_texel(grid.x, k, i);
        }
        for (int j = 0; j < grid.y.count; ++j) {
            const auto in_row = hn::And(lanes, weighs_texel(grid.y, j, i));
            if (hn::AllFalse(d, in_row)) continue;
            const auto row = indexer.row(hn::Load(d, grid.y.texel[j].lane + i));
            for (int k = 0; k < grid.x.count; ++k) {
                const auto reads = hn::And(in_row, weighs[k]);
                sum = hn::Sub(sum, hn::VecFromMask(d, reads));
                if (!count.touched.empty()) mark_lanes(hn::Add(column[k], row), reads, count.touched);
            }
        }
        hn::Store(sum, d, counted.lane + i);
    }
    add_texels(counted, *grid.level, count);
}

/// Product of the weights of tap (k, j).
HWY_NOINLINE inline void tap_weight(const TapGrid& grid, int k, int j, WaveFloat& weight) {
    const FloatTag d;
    for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
        auto product = hn::Mul(hn::Load(d, grid.x.weight[k].lane + i), hn::Load(d, grid.y.weight[j].lane + i));
        if (grid.scale != nullptr) product = hn::Mul(product, hn::Load(d, grid.scale->lane + i));
        hn::Store(product, d, weight.lane + i);
    }
}

/// Calls tell(WaveTap) for a tap of a cube map that lies beyond an edge for the lanes of `folded`, where it is another face's texel or
/// three.
template <class Tell>
HWY_INLINE void for_folded_tap(const TapGrid& grid, int k, int j, WaveMask folded, const WaveFloat& weight, const Tell& tell) {
    const IntTag d;
    const FloatTag df;
    WaveInt x[3], y[3], slice[3];
    WaveFloat third;
    WaveMask corner = 0;
    for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
        alignas(64) int32_t extents[hn::MaxLanes(d)];
        for (size_t lane = 0; lane < hn::Lanes(d); ++lane) extents[lane] = grid.cube_extents[grid.level->lane[i + lane]];
        const auto tap = resolve_cube_tap(hn::Load(d, grid.slice->lane + i), hn::Load(d, grid.x.texel[k].lane + i),
                                          hn::Load(d, grid.y.texel[j].lane + i), hn::Load(d, extents));
        corner |= wave_mask(d, tap.corner, i);
        for (int n = 0; n < 3; ++n) {
            hn::Store(tap.texel[n].x, d, x[n].lane + i);
            hn::Store(tap.texel[n].y, d, y[n].lane + i);
            hn::Store(tap.texel[n].slice(), d, slice[n].lane + i);
        }
        hn::Store(hn::Div(hn::Load(df, weight.lane + i), hn::Set(df, 3.0f)), df, third.lane + i);
    }
    const WaveMask single = folded & ~corner, shared = folded & corner;
    if (single != 0) tell(WaveTap{single, 0, grid.level, &slice[0], &x[0], &y[0], &weight});
    for (int n = 0; n < 3 && shared != 0; ++n) tell(WaveTap{shared, 0, grid.level, &slice[n], &x[n], &y[n], &third});
}

/// Calls tell(WaveTap) for the taps of the grid: for all of them, or for those of a cube map that leave the face alone.
template <class Tell>
HWY_INLINE void for_each_tap(const TapGrid& grid, WaveMask mask, bool only_folded, const Tell& tell) {
    for (int j = 0; j < grid.y.count; ++j) {
        const WaveMask row = weighing_lanes(grid.y.weight[j], mask);
        for (int k = 0; k < grid.x.count && row != 0; ++k) {
            const WaveMask lanes = weighing_lanes(grid.x.weight[k], row);
            const WaveMask outside = (grid.x.outside == nullptr ? 0 : grid.x.outside[k]) |
                                     (grid.y.outside == nullptr ? 0 : grid.y.outside[j]) | grid.outside_slice;
            const WaveMask folded = grid.cube_extents == nullptr ? 0 : lanes & outside;
            if (lanes == 0 || (only_folded && folded == 0)) continue;
            WaveFloat weight;
            tap_weight(grid, k, j, weight);
            if (!only_folded && (lanes & ~folded) != 0) {
                tell(WaveTap{lanes & ~folded, lanes & outside & ~folded, grid.level, grid.slice, &grid.x.texel[k], &grid.y.texel[j],
                             &weight});
            }
            if (folded != 0) for_folded_tap(grid, k, j, folded, weight, tell);
        }
    }
}

/// Tells the listener of the grid's taps for the lanes of `mask`.
HWY_NOINLINE inline void hear_grid(const TapGrid& grid, WaveMask mask, FetchCounter& count) {
    if (grid.scale != nullptr) mask = weighing_lanes(*grid.scale, mask);
    count_grid(grid, mask, count);
    if (grid.cube_extents == nullptr || (grid.x.outside == nullptr && grid.y.outside == nullptr)) return;
    for_each_tap(grid, mask, true, [&](const WaveTap& tap) HWY_ATTR {
        mark_texels(*tap.level, tap.slice, *tap.x, *tap.y, tap.lanes, count);
        WaveInt counted;
        for (int lane = 0; lane < kWaveLanes; ++lane) counted[lane] = int(tap.lanes >> lane & 1);
        add_texels(counted, *tap.level, count);
    });
}
HWY_NOINLINE inline void hear_grid(const TapGrid& grid, WaveMask mask, FetchRecorder& recorder) {
    if (grid.scale != nullptr) mask = weighing_lanes(*grid.scale, mask);
    for_each_tap(grid, mask, false, [&](const WaveTap& tap) HWY_ATTR { recorder.sink->tap(tap); });
}

template <class Count>
HWY_INLINE void begin_lookups(const Texture& texture, WaveMask mask, Count& count) {
    if constexpr (Count::kCounts) {
        count.counts->lookups += hwy::PopCount(mask);
        count.texture = &texture;
    }
    if constexpr (Count::kRecords) count.sink->begin_lookup(texture, mask);
}

/// Another probe of the same lookups begins.
template <class Count>
HWY_INLINE void begin_probe(const WaveFloat& weight, Count& count) {
    if constexpr (Count::kRecords) count.sink->begin_probe(weight);
}

template <class Count>
HWY_INLINE void begin_level(const WaveFloat& fraction, bool coarser, Count& count) {
    if constexpr (Count::kRecords) count.sink->begin_level(fraction, coarser);
}

/// One texel of each lane of `mask`, drawn; `draw.slice` null: slice 0.
HWY_INLINE void hear_texel(const WaveInt& level, const WaveInt& x, const WaveInt& y, WaveMask mask, WaveMask border, FetchCounter& count) {
    const WaveMask texels = mask & ~border;
    mark_texels(level, nullptr, x, y, texels, count);
    WaveInt counted;
    for (int lane = 0; lane < kWaveLanes; ++lane) counted[lane] = int(texels >> lane & 1);
    add_texels(counted, level, count);
}
HWY_INLINE void hear_texel(const WaveInt& level, const WaveInt& x, const WaveInt& y, WaveMask mask, WaveMask border,
                           FetchRecorder& recorder) {
    WaveFloat weight;
    std::fill_n(weight.lane, kWaveLanes, 1.0f);
    recorder.sink->tap({mask, border & mask, &level, nullptr, &x, &y, &weight});
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::texunit
HWY_AFTER_NAMESPACE();

#endif  // RAWTEXEL_TEXUNIT_COUNT_INL_H_
