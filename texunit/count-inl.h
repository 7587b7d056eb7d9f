// What the policies of texunit/fetch_log.h see of a lookup.
#include "texunit/cube-inl.h"
#include "texunit/fetch_log.h"
#include "texunit/select-inl.h"
#include "texunit/wide_taps-inl.h"

#include <hwy/highway.h>

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

/// Texels of the grid that each lane reads.
HWY_NOINLINE inline void grid_texels(const TapGrid& grid, WaveMask mask, WaveInt& counted) {
    // Per lane, the taps of an axis on the texture and beyond its edges.
    struct AxisCount {
        int inside[kWaveLanes] = {}, outside[kWaveLanes] = {};
    };
    const auto count = [&](const AxisView& axis, AxisCount& taps) {
        for (int k = 0; k < axis.count; ++k) {
            const WaveMask weighing = weighing_lanes(axis.weight[k], mask);
            const WaveMask outside = axis.outside == nullptr ? 0 : axis.outside[k];
            for (int i = 0; i < kWaveLanes; ++i) {
                taps.inside[i] += int((weighing & ~outside) >> i & 1);
                taps.outside[i] += int((weighing & outside) >> i & 1);
            }
        }
    };
    AxisCount x, y;
    count(grid.x, x);
    count(grid.y, y);
    for (int i = 0; i < kWaveLanes; ++i) {
        counted[i] = x.inside[i] * y.inside[i];
        // Beyond an edge of a cube's face there is another; beyond a corner three texels share the tap.
        if (grid.cube_extents != nullptr) {
            counted[i] += x.inside[i] * y.outside[i] + x.outside[i] * y.inside[i] + 3 * x.outside[i] * y.outside[i];
        }
        if ((grid.outside_slice >> i & 1) != 0) counted[i] = 0;
    }
}

/// Adds `counted` texels a lane, 0 where the lane does not count.
HWY_NOINLINE inline void add_texels(const WaveInt& counted, FetchCounter& count) {
    uint64_t total = 0;
    for (int i = 0; i < kWaveLanes; ++i) {
        total += uint64_t(counted[i]);
        if (count.pixel != nullptr) (*count.pixel)[i] += uint32_t(counted[i]);
    }
    count.texture->taps += total;
    count.texture->texels_requested += total;
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

/// Tells of a tap of a cube map that lies beyond an edge for the lanes of `folded`, where it is another face's texel or three.
HWY_NOINLINE inline void record_folded_tap(const TapGrid& grid, int k, int j, WaveMask folded, const WaveFloat& weight, TapSink& sink) {
    const IntTag d;
    const FloatTag df;
    WaveInt x[3], y[3], slice[3];
    WaveFloat third;
    WaveMask corner = 0;
    for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
        hn::Vec<IntTag> extent = hn::Zero(d);
        alignas(64) int32_t extents[hn::MaxLanes(d)];
        for (size_t lane = 0; lane < hn::Lanes(d); ++lane) extents[lane] = grid.cube_extents[grid.level->lane[i + lane]];
        extent = hn::Load(d, extents);
        const auto tap = resolve_cube_tap(hn::Load(d, grid.slice->lane + i), hn::Load(d, grid.x.texel[k].lane + i),
                                          hn::Load(d, grid.y.texel[j].lane + i), extent);
        corner |= wave_mask(d, tap.corner, i);
        for (int n = 0; n < 3; ++n) {
            hn::Store(tap.texel[n].x, d, x[n].lane + i);
            hn::Store(tap.texel[n].y, d, y[n].lane + i);
            hn::Store(tap.texel[n].slice(), d, slice[n].lane + i);
        }
        hn::Store(hn::Div(hn::Load(df, weight.lane + i), hn::Set(df, 3.0f)), df, third.lane + i);
    }
    const WaveMask single = folded & ~corner, shared = folded & corner;
    if (single != 0) sink.tap({single, 0, grid.level, &slice[0], &x[0], &y[0], &weight});
    for (int n = 0; n < 3 && shared != 0; ++n) sink.tap({shared, 0, grid.level, &slice[n], &x[n], &y[n], &third});
}

/// Tells the sink of every tap of the grid.
HWY_NOINLINE inline void record_grid(const TapGrid& grid, WaveMask mask, TapSink& sink) {
    if (grid.scale != nullptr) mask = weighing_lanes(*grid.scale, mask);
    for (int j = 0; j < grid.y.count; ++j) {
        const WaveMask row = weighing_lanes(grid.y.weight[j], mask);
        for (int k = 0; k < grid.x.count && row != 0; ++k) {
            const WaveMask lanes = weighing_lanes(grid.x.weight[k], row);
            if (lanes == 0) continue;
            WaveFloat weight;
            tap_weight(grid, k, j, weight);
            const WaveMask outside = (grid.x.outside == nullptr ? 0 : grid.x.outside[k]) |
                                     (grid.y.outside == nullptr ? 0 : grid.y.outside[j]) | grid.outside_slice;
            if (grid.cube_extents != nullptr) {
                if ((lanes & ~outside) != 0) {
                    sink.tap({lanes & ~outside, 0, grid.level, grid.slice, &grid.x.texel[k], &grid.y.texel[j], &weight});
                }
                if ((lanes & outside) != 0) record_folded_tap(grid, k, j, lanes & outside, weight, sink);
            } else {
                sink.tap({lanes, lanes & outside, grid.level, grid.slice, &grid.x.texel[k], &grid.y.texel[j], &weight});
            }
        }
    }
}

/// Counts and records the taps of a grid for the lanes of `mask`.
template <class Count>
HWY_INLINE void count_grid(const TapGrid& grid, WaveMask mask, Count& count) {
    if constexpr (Count::kCounts) {
        WaveInt counted;
        grid_texels(grid, grid.scale == nullptr ? mask : weighing_lanes(*grid.scale, mask), counted);
        add_texels(counted, count);
    }
    if constexpr (Count::kRecords) record_grid(grid, mask, *count.sink);
}

template <class Count>
HWY_INLINE void count_lookups(const Texture& texture, WaveMask mask, Count& count) {
    if constexpr (Count::kCounts) count.texture->lookups += hwy::PopCount(mask);
    if constexpr (Count::kRecords) count.sink->begin_lookup(texture, mask);
}

/// Another probe of the same lookups begins: what anisotropic filters call before each sample_levels.
template <class Count>
HWY_INLINE void begin_probe(const WaveFloat& weight, Count& count) {
    if constexpr (Count::kRecords) count.sink->begin_probe(weight);
}

template <class Count>
HWY_INLINE void begin_level(const WaveFloat& fraction, bool coarser, Count& count) {
    if constexpr (Count::kRecords) count.sink->begin_level(fraction, coarser);
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::texunit
HWY_AFTER_NAMESPACE();

#endif  // RAWTEXEL_TEXUNIT_COUNT_INL_H_
