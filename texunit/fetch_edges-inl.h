// Fetching the taps of narrow kernels, those included that lie beyond the edges of a border or of a cube map's face.
#include "texunit/cube-inl.h"
#include "texunit/texel_reader-inl.h"

#include <hwy/highway.h>

// Included once per instruction set (highway's guard for -inl.h files).
#if defined(RAWTEXEL_TEXUNIT_FETCH_EDGES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_TEXUNIT_FETCH_EDGES_INL_H_
#undef RAWTEXEL_TEXUNIT_FETCH_EDGES_INL_H_
#else
#define RAWTEXEL_TEXUNIT_FETCH_EDGES_INL_H_
#endif

HWY_BEFORE_NAMESPACE();
namespace rawtexel::texunit {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Index of a texel of a cube map.
template <StorageClass storage>
HWY_INLINE hn::Vec<IntTag> cube_texel_index(const LevelTable& table, hn::Vec<IntTag> level, const CubeTexel<hn::Vec<IntTag>>& at) {
    const IntTag d;
    const auto slice = hn::Mul(at.slice(), look_up_level(d, table.slice_stride, level));
    const auto row = row_offset_v<storage>(at.y, look_up_level(d, table.row_stride, level));
    return hn::Add(hn::Add(look_up_level(d, table.offset, level), slice), hn::Add(column_offset_v<storage>(at.x), row));
}

/// Only halves and floats can hold infinities; everything else takes the shorter form.
template <StorageClass storage, class V>
HWY_INLINE V mix(V t, V a, V b) {
    if constexpr (is_packed(storage)) return lerp(t, a, b);
    return lerp_unbounded(t, a, b);
}

/// Lanes of each tap that lie beyond an edge.
template <int W>
HWY_INLINE void outside_taps(const TapWave<W>& taps, WaveMask (&outside)[W * W]) {
    for (int j = 0; j < W; ++j) {
        for (int k = 0; k < W; ++k) outside[j * W + k] = taps.outside_x[k] | taps.outside_y[j];
    }
}

/// Lets lanes that take the border at a tap repeat a texel that is read anyway. False where no lane reads any.
template <int n>
HWY_NOINLINE bool spare_border_texels(const WaveMask (&outside)[n], WaveInt (&index)[n]) {
    int32_t readable = -1;
    for (int tap = n - 1; tap >= 0; --tap) {
        if (~outside[tap] != 0) readable = index[tap].lane[hwy::Num0BitsBelowLS1Bit_Nonzero32(~outside[tap])];
    }
    if (readable < 0) return false;
    const IntTag d;
    for (int tap = 0; tap < n; ++tap) {
        for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
            int32_t* const at = index[tap].lane + i;
            hn::Store(hn::IfThenElse(lanes_of(d, outside[tap], i), hn::Set(d, readable), hn::Load(d, at)), d, at);
        }
    }
    return true;
}

/// The border colour where a tap is outside.
template <int n>
HWY_NOINLINE void put_border(const WaveMask (&outside)[n], const std::array<float, 4>& border, TexelWave<n>& texels) {
    const FloatTag d;
    for (int tap = 0; tap < n; ++tap) {
        for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
            const auto lanes = lanes_of(d, outside[tap], i);
            for (int c = 0; c < 4; ++c) {
                float* const at = texels.channel[c][tap].lane + i;
                hn::Store(hn::IfThenElse(lanes, hn::Set(d, border[size_t(c)]), hn::Load(d, at)), d, at);
            }
        }
    }
}

/// Taps of a cube map beyond an edge read the face beyond; those beyond a corner, which `corner` gets, repeat the corner's texel.
template <StorageClass storage>
HWY_NOINLINE void fold_cube_taps(const LevelTable& table, const TapWave<2>& taps, WaveInt (&index)[4], WaveMask (&corner)[4]) {
    const IntTag d;
    for (int tap = 0; tap < 4; ++tap) {
        corner[tap] = taps.outside_x[tap % 2] & taps.outside_y[tap / 2];
        for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
            const auto level = hn::Load(d, taps.level->lane + i);
            const auto resolved = resolve_cube_tap(hn::Load(d, taps.slice->lane + i), hn::Load(d, taps.x[tap % 2].lane + i),
                                                   hn::Load(d, taps.y[tap / 2].lane + i), look_up_level(d, table.width, level));
            hn::Store(cube_texel_index<storage>(table, level, resolved.texel[0]), d, index[tap].lane + i);
        }
    }
}

/// A tap beyond a corner is the mean of the three others, the texels that meet there.
template <StorageClass storage>
HWY_NOINLINE void mean_at_corners(const WaveMask (&corner)[4], TexelWave<4>& texels) {
    const FloatTag d;
    for (int tap = 0; tap < 4; ++tap) {
        if (corner[tap] == 0) continue;
        for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
            for (int c = 0; c < 4; ++c) {
                const auto other = [&](int step) HWY_ATTR { return hn::Load(d, texels.channel[c][tap ^ step].lane + i); };
                const auto mean = mix<storage>(hn::Set(d, 1.0f / 3), mix<storage>(hn::Set(d, 0.5f), other(1), other(2)), other(3));
                float* const at = texels.channel[c][tap].lane + i;
                hn::Store(hn::IfThenElse(lanes_of(d, corner[tap], i), mean, hn::Load(d, at)), d, at);
            }
        }
    }
}

/// Ensures and gathers where some taps lie beyond the edges of a border or of a cube map's face.
template <StorageClass storage, int W>
HWY_NOINLINE void fetch_beyond_edges(Texture& texture, const std::array<float, 4>& border, bool cube, const TapWave<W>& taps,
                                     WaveInt (&index)[W * W], TexelWave<W * W>& out) {
    if (!cube) {
        WaveMask outside[W * W];
        outside_taps(taps, outside);
        if (spare_border_texels(outside, index)) {
            ensure(texture, *taps.level, index);
            gather<storage>(texture, index, channels_of(out));
        }
        return put_border(outside, border, out);
    }
    // A single texel is never beyond.
    if constexpr (W == 2) {
        WaveMask corner[W * W];
        fold_cube_taps<storage>(texture.levels(), taps, index, corner);
        ensure(texture, *taps.level, index);
        gather<storage>(texture, index, channels_of(out));
        mean_at_corners<storage>(corner, out);
    }
}

/// Ensures and gathers the texels of `taps`. All lanes are read: inactive ones repeat an active one (fill_inactive).
template <StorageClass storage, int W>
HWY_NOINLINE void fetch(Texture& texture, const std::array<float, 4>& border, bool cube, const TapWave<W>& taps, TexelWave<W * W>& out) {
    WaveInt index[W * W];
    tap_indices<storage>(texture.levels(), taps, index);
    if (taps.leaves) return fetch_beyond_edges<storage>(texture, border, cube, taps, index, out);
    ensure(texture, *taps.level, index);
    gather<storage>(texture, index, channels_of(out));
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::texunit
HWY_AFTER_NAMESPACE();

#endif  // RAWTEXEL_TEXUNIT_FETCH_EDGES_INL_H_
