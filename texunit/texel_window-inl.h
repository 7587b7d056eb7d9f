// Where magnification lets all taps of a wave fall on a few texels, those are read and unpacked once, and taps picked among them.
#include "texunit/texel_reader-inl.h"

#include <hwy/highway.h>

// Included once per instruction set (highway's guard for -inl.h files).
#if defined(RAWTEXEL_TEXUNIT_TEXEL_WINDOW_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_TEXUNIT_TEXEL_WINDOW_INL_H_
#undef RAWTEXEL_TEXUNIT_TEXEL_WINDOW_INL_H_
#else
#define RAWTEXEL_TEXUNIT_TEXEL_WINDOW_INL_H_
#endif

HWY_BEFORE_NAMESPACE();
namespace rawtexel::texunit {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Whether a vector register holds a window, so that a tap is one permutation.
constexpr bool has_windows(StorageClass storage) { return HWY_TARGET == HWY_AVX3 && storage == StorageClass::Packed32; }

/// Texels of one level on either side of a window.
inline constexpr int kWindow = 4;

/// Up to 4x4 texels of one level that hold all taps of a wave, as under magnification.
struct TexelWindow {
    int32_t x, y;  ///< of its first texel
    int32_t last_x, last_y;
};

/// The least and the largest of `count` waves.
HWY_INLINE void find_range(const WaveInt* waves, int count, int32_t& least, int32_t& most) {
    const IntTag d;
    auto low = hn::Load(d, waves[0].lane), high = low;
    for (int k = 0; k < count; ++k) {
        for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
            const auto texel = hn::Load(d, waves[k].lane + i);
            low = hn::Min(low, texel);
            high = hn::Max(high, texel);
        }
    }
    least = hn::GetLane(hn::MinOfLanes(d, low));
    most = hn::GetLane(hn::MaxOfLanes(d, high));
}

/// False where the taps lie farther apart, or in several levels.
HWY_INLINE bool find_window(const WaveInt& level, const WaveInt* x, int columns, const WaveInt* y, int rows, TexelWindow& window) {
    find_range(x, columns, window.x, window.last_x);
    if (window.last_x - window.x >= kWindow) return false;
    find_range(y, rows, window.y, window.last_y);
    if (window.last_y - window.y >= kWindow) return false;
    int32_t finest, coarsest;
    find_range(&level, 1, finest, coarsest);
    return finest == coarsest;
}

/// Makes sure that the window's texels may be read, and gives the indices of its 4x4; beyond its last column and row those repeat.
template <StorageClass storage>
HWY_INLINE IntVec ensure_window(Texture& texture, const TexelWindow& window, const WaveInt& level) {
    const IntTag d;
    const LevelTable& table = texture.levels();
    const auto lane = hn::Iota(d, 0);
    const auto x = hn::Min(hn::Add(hn::Set(d, window.x), hn::And(lane, hn::Set(d, kWindow - 1))), hn::Set(d, window.last_x));
    const auto y = hn::Min(hn::Add(hn::Set(d, window.y), hn::ShiftRight<2>(lane)), hn::Set(d, window.last_y));
    const auto of_level = hn::Load(d, level.lane);
    const auto row = row_offset_v<storage>(y, look_up_level(d, table.row_stride, of_level));
    const auto index = hn::Add(hn::Add(look_up_level(d, table.offset, of_level), column_offset_v<storage>(x)), row);
    const uint32_t ready = texture.ready_levels();
    if ((ready >> level[0] & 1) == 0) {
        WaveInt indices[1];
        for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) hn::Store(index, d, indices[0].lane + i);
        ensure_blocks(texture, indices);
    }
    return index;
}

/// Where taps at (x, y) are in the window, for TableLookupLanes.
HWY_INLINE auto in_window(const TexelWindow& window, IntVec x, IntVec y) {
    const IntTag d;
    const auto column = hn::Sub(x, hn::Set(d, window.x)), row = hn::Sub(y, hn::Set(d, window.y));
    return hn::IndicesFromVec(FloatTag(), hn::Add(column, hn::ShiftLeft<2>(row)));
}

/// Ensures and reads the taps of a wave that fit into a window; false where they do not.
template <StorageClass storage, int W>
HWY_INLINE bool fetch_window(Texture& texture, const TapWave<W>& taps, TexelWave<W * W>& out) {
    TexelWindow window;
    if (!find_window(*taps.level, taps.x, W, taps.y, W, window)) return false;
    const FloatTag d;
    const IntTag di;
    const TexelReader<storage, false> reader(texture);
    FloatVec texel[4];
    reader.read(ensure_window<storage>(texture, window, *taps.level), texel);
    for (int c = 0; c < 4; ++c) texel[c] = reader.value(c, texel[c]);
    for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
        for (int tap = 0; tap < W * W; ++tap) {
            const auto at = in_window(window, hn::Load(di, taps.x[tap % W].lane + i), hn::Load(di, taps.y[tap / W].lane + i));
            for (int c = 0; c < 4; ++c) hn::Store(hn::TableLookupLanes(texel[c], at), d, out.channel[c][tap].lane + i);
        }
    }
    return true;
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::texunit
HWY_AFTER_NAMESPACE();

#endif  // RAWTEXEL_TEXUNIT_TEXEL_WINDOW_INL_H_
