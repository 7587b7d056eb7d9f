// The weighted mean over the taps of a kernel of any width: texels are gathered, unpacked and weighed tap by tap, sums stay in registers.
#include "texunit/fetch_edges-inl.h"
#include "texunit/texel_window-inl.h"
#include "texunit/wide_taps-inl.h"

#include <hwy/highway.h>

// Included once per instruction set (highway's guard for -inl.h files).
#if defined(RAWTEXEL_TEXUNIT_WIDE_FILTER_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_TEXUNIT_WIDE_FILTER_INL_H_
#undef RAWTEXEL_TEXUNIT_WIDE_FILTER_INL_H_
#else
#define RAWTEXEL_TEXUNIT_WIDE_FILTER_INL_H_
#endif

HWY_BEFORE_NAMESPACE();
namespace rawtexel::texunit {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// The taps of one level: columns, rows and, of volumes, slices.
struct WideTaps {
    const WaveInt* level;
    const WaveInt* slice;  ///< of everything but volumes; null: slice 0
    bool cube, volume;
    AxisTaps x, y, z;  ///< z of volumes only

    bool leaves() const { return x.leaves || y.leaves || (volume && z.leaves); }
};

/// The terms of a tap's index (texunit/level_table.h): column + row + slice.
struct TapOffsets {
    WaveInt column[kMostAxisTaps], row[kMostAxisTaps], slice[kMostAxisTaps];
    int slices = 1;
};

template <StorageClass storage>
HWY_NOINLINE void tap_offsets(const LevelTable& table, const WideTaps& taps, TapOffsets& offsets) {
    const IntTag d;
    offsets.slices = taps.volume ? taps.z.count : 1;
    for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
        const auto level = hn::Load(d, taps.level->lane + i);
        const auto row_stride = look_up_level(d, table.row_stride, level);
        const auto base = slice_offset(table, level, taps.volume ? nullptr : taps.slice, i);
        hn::Store(base, d, offsets.slice[0].lane + i);
        for (int k = 0; k < taps.x.count; ++k) {
            hn::Store(column_offset_v<storage>(hn::Load(d, taps.x.texel[k].lane + i)), d, offsets.column[k].lane + i);
        }
        for (int j = 0; j < taps.y.count; ++j) {
            hn::Store(row_offset_v<storage>(hn::Load(d, taps.y.texel[j].lane + i), row_stride), d, offsets.row[j].lane + i);
        }
        if (!taps.volume) continue;
        const auto slice_stride = look_up_level(d, table.slice_stride, level);
        for (int z = 0; z < taps.z.count; ++z) {
            hn::Store(hn::Add(base, hn::Mul(hn::Load(d, taps.z.texel[z].lane + i), slice_stride)), d, offsets.slice[z].lane + i);
        }
    }
}

/// Lanes that see nothing but the border repeat the texels of a lane that reads some. False where there is none.
HWY_NOINLINE inline bool spare_border_lanes(const WideTaps& taps, TapOffsets& offsets) {
    const WaveMask readable = taps.x.readable & taps.y.readable & (taps.volume ? taps.z.readable : kWaveFull);
    if (readable == kWaveFull) return true;
    if (readable == 0) return false;
    const auto first = size_t(hwy::Num0BitsBelowLS1Bit_Nonzero32(readable));
    const IntTag d;
    const auto repeat = [&](WaveInt* offset, int count) HWY_ATTR {
        for (int k = 0; k < count; ++k) {
            const auto repeated = hn::Set(d, offset[k].lane[first]);
            for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
                int32_t* const at = offset[k].lane + i;
                hn::Store(hn::IfThenElse(lanes_of(d, readable, i), hn::Load(d, at), repeated), d, at);
            }
        }
    };
    repeat(offsets.column, taps.x.count);
    repeat(offsets.row, taps.y.count);
    repeat(offsets.slice, offsets.slices);
    return true;
}

/// Index of tap (k, j) of slice z, for taps on the texture.
HWY_INLINE hn::Vec<IntTag> tap_index(const TapOffsets& offsets, int k, int j, int z, size_t i) {
    const IntTag d;
    return hn::Add(hn::Add(hn::Load(d, offsets.slice[z].lane + i), hn::Load(d, offsets.row[j].lane + i)),
                   hn::Load(d, offsets.column[k].lane + i));
}

/// Indices of tap (k, j) of a cube map: of one texel, or in the lanes of the mask returned three.
template <StorageClass storage>
HWY_NOINLINE WaveMask cube_tap_indices(const LevelTable& table, const WideTaps& taps, int k, int j, size_t i,
                                       int32_t (&index)[3][kWaveLanes]) {
    const IntTag d;
    const auto level = hn::Load(d, taps.level->lane + i);
    const auto tap = resolve_cube_tap(hn::Load(d, taps.slice->lane + i), hn::Load(d, taps.x.texel[k].lane + i),
                                      hn::Load(d, taps.y.texel[j].lane + i), look_up_level(d, table.width, level));
    for (int n = 0; n < 3; ++n) hn::Store(cube_texel_index<storage>(table, level, tap.texel[n]), d, index[n]);
    return wave_mask(d, tap.corner, i);
}

/// Makes sure that the texels of all taps may be read.
template <StorageClass storage>
HWY_NOINLINE void ensure_wide(Texture& texture, const WideTaps& taps, const TapOffsets& offsets) {
    const uint32_t ready = texture.ready_levels();
    if (ready == texture.all_levels() || (levels_read(*taps.level) & ~ready) == 0) return;
    const IntTag d;
    constexpr int kChunk = 4;
    WaveInt index[kChunk];
    for (int z = 0; z < offsets.slices; ++z) {
        for (int j = 0; j < taps.y.count; ++j) {
            for (int first = 0; first < taps.x.count; first += kChunk) {
                for (int n = 0; n < kChunk; ++n) {
                    const int k = std::min(first + n, taps.x.count - 1);
                    for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) hn::Store(tap_index(offsets, k, j, z, i), d, index[n].lane + i);
                }
                ensure_blocks(texture, index);
            }
        }
    }
}

/// The same for a cube map's taps of which some lie beyond edges.
template <StorageClass storage>
HWY_NOINLINE void ensure_wide_cube(Texture& texture, const WideTaps& taps) {
    const uint32_t ready = texture.ready_levels();
    if (ready == texture.all_levels() || (levels_read(*taps.level) & ~ready) == 0) return;
    const IntTag d;
    WaveInt index[4];
    alignas(64) int32_t three[3][kWaveLanes];
    for (int j = 0; j < taps.y.count; ++j) {
        for (int k = 0; k < taps.x.count; ++k) {
            for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
                cube_tap_indices<storage>(texture.levels(), taps, k, j, i, three);
                for (int n = 0; n < 4; ++n) hn::Store(hn::Load(d, three[n % 3]), d, index[n].lane + i);
            }
            ensure_blocks(texture, index);
        }
    }
}

/// sum += weight * number, where a weight of 0 silences an infinity.
template <StorageClass storage, class V>
HWY_INLINE void add_weighed(V weight, const V (&number)[4], V (&sum)[4]) {
    const hn::DFromV<V> d;
    const auto weighs = hn::Ne(weight, hn::Zero(d));
    for (int c = 0; c < 4; ++c) {
        V product = hn::Mul(weight, number[c]);
        if constexpr (!is_packed(storage)) product = hn::IfThenElseZero(weighs, product);
        sum[c] = hn::Add(sum[c], product);
    }
}

/// Reads tap (k, j) of a cube map where it may lie beyond an edge.
template <StorageClass storage, bool plain, class V>
HWY_INLINE void read_cube_tap(const TexelReader<storage, plain>& reader, const LevelTable& table, const WideTaps& taps, int k, int j,
                              size_t i, V (&texel)[4]) {
    const FloatTag d;
    const IntTag di;
    alignas(64) int32_t index[3][kWaveLanes];
    const WaveMask corner = cube_tap_indices<storage>(table, taps, k, j, i, index);
    reader.read(hn::Load(di, index[0]), texel);
    if (corner == 0) return;
    V second[4], third[4];
    reader.read(hn::Load(di, index[1]), second);
    reader.read(hn::Load(di, index[2]), third);
    const auto shared = lanes_of(d, corner, i);
    for (int c = 0; c < 4; ++c) {
        const V mean = hn::Div(hn::Add(hn::Add(texel[c], second[c]), third[c]), hn::Set(d, 3.0f));
        texel[c] = hn::IfThenElse(shared, mean, texel[c]);
    }
}

/// Weighs all taps of all lanes.
template <StorageClass storage, bool plain>
HWY_NOINLINE void sum_taps_as(const Texture& texture, const WideTaps& taps, const TapOffsets& offsets, WaveColor& out) {
    const FloatTag d;
    using V = hn::Vec<FloatTag>;
    const TexelReader<storage, plain> reader(texture);
    const bool folds = taps.cube && taps.leaves();
    for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
        V sum[4] = {hn::Zero(d), hn::Zero(d), hn::Zero(d), hn::Zero(d)};
        for (int z = 0; z < offsets.slices; ++z) {
            V plane[4] = {hn::Zero(d), hn::Zero(d), hn::Zero(d), hn::Zero(d)};
            for (int j = 0; j < taps.y.count; ++j) {
                V row[4] = {hn::Zero(d), hn::Zero(d), hn::Zero(d), hn::Zero(d)};
                for (int k = 0; k < taps.x.count; ++k) {
                    V texel[4];
                    if (folds) {
                        read_cube_tap(reader, texture.levels(), taps, k, j, i, texel);
                    } else {
                        reader.read(tap_index(offsets, k, j, z, i), texel);
                    }
                    add_weighed<storage>(hn::Load(d, taps.x.weight[k].lane + i), texel, row);
                }
                add_weighed<storage>(hn::Load(d, taps.y.weight[j].lane + i), row, plane);
            }
            const V weight = taps.volume ? hn::Load(d, taps.z.weight[z].lane + i) : hn::Set(d, 1.0f);
            add_weighed<storage>(weight, plane, sum);
        }
        for (int c = 0; c < 4; ++c) hn::Store(reader.value(c, sum[c]), d, out.channel[c].lane + i);
    }
}

/// The same where all taps fall into a window.
template <StorageClass storage, bool plain, int registers>
HWY_NOINLINE void sum_window_as(Texture& texture, const TexelWindow& window, const WideTaps& taps, WaveColor& out) {
    const FloatTag d;
    const IntTag di;
    const TexelReader<storage, plain> reader(texture);
    IntVec index[registers];
    ensure_window<storage>(texture, window, *taps.level, index);
    FloatVec texel[4][registers];
    for (int r = 0; r < registers; ++r) {
        FloatVec number[4];
        reader.read(index[r], number);
        for (int c = 0; c < 4; ++c) texel[c][r] = number[c];
    }
    for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
        FloatVec sum[4] = {hn::Zero(d), hn::Zero(d), hn::Zero(d), hn::Zero(d)};
        for (int j = 0; j < taps.y.count; ++j) {
            const auto y = hn::Load(di, taps.y.texel[j].lane + i);
            FloatVec row[4] = {hn::Zero(d), hn::Zero(d), hn::Zero(d), hn::Zero(d)};
            for (int k = 0; k < taps.x.count; ++k) {
                const auto at = in_window(window, hn::Load(di, taps.x.texel[k].lane + i), y);
                FloatVec read[4];
                for (int c = 0; c < 4; ++c) read[c] = pick(texel[c], at);
                add_weighed<storage>(hn::Load(d, taps.x.weight[k].lane + i), read, row);
            }
            add_weighed<storage>(hn::Load(d, taps.y.weight[j].lane + i), row, sum);
        }
        for (int c = 0; c < 4; ++c) hn::Store(reader.value(c, sum[c]), d, out.channel[c].lane + i);
    }
}

/// Filters what fits into a window; false where the taps do not.
template <StorageClass storage>
HWY_INLINE bool filter_window(Texture& texture, const WideTaps& taps, WaveColor& out) {
    if (taps.leaves() || taps.cube || taps.volume || taps.slice != nullptr) return false;
    TexelWindow window;
    const AxisTaps &x = taps.x, &y = taps.y;
    if (!find_window(texture, *taps.level, x.texel, x.count, y.texel, y.count, kMostWindowRegisters, window)) return false;
    with_registers(window, [&](auto registers) HWY_ATTR {
        constexpr int kRegisters = decltype(registers)::value;
        if (is_plain(texture.texel_layout())) {
            sum_window_as<storage, true, kRegisters>(texture, window, taps, out);
        } else {
            sum_window_as<storage, false, kRegisters>(texture, window, taps, out);
        }
    });
    return true;
}

template <StorageClass storage>
HWY_INLINE void sum_taps(const Texture& texture, const WideTaps& taps, const TapOffsets& offsets, WaveColor& out) {
    if constexpr (is_packed(storage)) {
        if (is_plain(texture.texel_layout())) return sum_taps_as<storage, true>(texture, taps, offsets, out);
    }
    sum_taps_as<storage, false>(texture, taps, offsets, out);
}

/// What the border takes of a product of axes.
HWY_INLINE void combine_border(const BorderShare& axis, BorderShare& all) {
    const FloatTag d;
    for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
        const auto out_a = hn::Load(d, axis.outside.lane + i), in_a = hn::Load(d, axis.inside.lane + i);
        const auto out_b = hn::Load(d, all.outside.lane + i), in_b = hn::Load(d, all.inside.lane + i);
        hn::Store(hn::Add(hn::Mul(out_a, hn::Add(out_b, in_b)), hn::Mul(in_a, out_b)), d, all.outside.lane + i);
        hn::Store(hn::Mul(in_a, in_b), d, all.inside.lane + i);
    }
}

/// Adds the border's share to a sum over the texels.
HWY_NOINLINE inline void add_border(const TexelLayout& layout, const std::array<float, 4>& border, const BorderShare& share,
                                    WaveColor& out) {
    const FloatTag d;
    const bool packed = is_packed(layout.storage);
    for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
        const auto outside = hn::Load(d, share.outside.lane + i), inside = hn::Load(d, share.inside.lane + i);
        const auto nothing_inside = hn::Eq(inside, hn::Zero(d));
        const auto untouched = hn::Eq(outside, hn::Zero(d));
        for (int c = 0; c < 4; ++c) {
            const auto colour = hn::Set(d, border[size_t(c)]);
            float* const at = out.channel[c].lane + i;
            auto texels = hn::Load(d, at);
            // A constant was not weighed yet.
            if (packed && layout.mask[c] == 0) texels = hn::Mul(texels, inside);
            const auto both = hn::Add(texels, hn::Mul(outside, colour));
            hn::Store(hn::IfThenElse(untouched, hn::Load(d, at), hn::IfThenElse(nothing_inside, colour, both)), d, at);
        }
    }
}

/// Ensures, gathers and weighs the taps of one level.
template <StorageClass storage>
HWY_NOINLINE void filter_wide(Texture& texture, const std::array<float, 4>& border, WideTaps& taps, WaveColor& out) {
    if constexpr (has_windows(storage)) {
        if (filter_window<storage>(texture, taps, out)) return;
    }
    TapOffsets offsets;
    tap_offsets<storage>(texture.levels(), taps, offsets);
    if (!taps.leaves()) {
        ensure_wide<storage>(texture, taps, offsets);
        return sum_taps<storage>(texture, taps, offsets, out);
    }
    if (taps.cube) {
        ensure_wide_cube<storage>(texture, taps);
        return sum_taps<storage>(texture, taps, offsets, out);
    }
    BorderShare all, axis;
    take_border(taps.x, all);
    take_border(taps.y, axis);
    combine_border(axis, all);
    if (taps.volume) {
        take_border(taps.z, axis);
        combine_border(axis, all);
    }
    if (spare_border_lanes(taps, offsets)) {
        ensure_wide<storage>(texture, taps, offsets);
        sum_taps<storage>(texture, taps, offsets, out);
    } else {
        out = {};
    }
    add_border(texture.texel_layout(), border, all, out);
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::texunit
HWY_AFTER_NAMESPACE();

#endif  // RAWTEXEL_TEXUNIT_WIDE_FILTER_INL_H_
