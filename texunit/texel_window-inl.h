// Where all taps of a wave fall on a few texels, as under magnification, those are read and unpacked once, and taps picked among them.
#include "texunit/texel_reader-inl.h"

#include <hwy/highway.h>

#include <type_traits>

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

/// Texels that a vector register holds of one channel, and the most registers that a window takes.
inline constexpr int kRegisterTexels = 16;
inline constexpr int kMostWindowRegisters = 4;

/// Up to 64 texels of one level that hold all taps of a wave, as under magnification: rows of 4, 8 or 16.
struct TexelWindow {
    int32_t x, y;  ///< of its first texel
    int32_t last_x, last_y;
    int log2_columns;
    int registers;     ///< 1, 2 or 4
    bool whole_level;  ///< all blocks of the level are ready
};

/// The least and the largest of some waves, lane by lane.
struct LaneRange {
    IntVec low, high;
};
HWY_INLINE LaneRange range_of(const WaveInt* waves, int count) {
    const IntTag d;
    LaneRange range{hn::Load(d, waves[0].lane), hn::Load(d, waves[0].lane)};
    for (int k = 0; k < count; ++k) {
        for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
            const auto texel = hn::Load(d, waves[k].lane + i);
            range = {hn::Min(range.low, texel), hn::Max(range.high, texel)};
        }
    }
    return range;
}

/// Finds the first and last texels of the window: the four extremes over all lanes at once.
HWY_INLINE void find_extremes(const LaneRange& x, const LaneRange& y, TexelWindow& window) {
    const IntTag d;
#if HWY_TARGET == HWY_AVX3
    const hn::RepartitionToWide<IntTag> wide;
    // Blocks of four lanes: the largest of -low and of high, of x and of y.
    const auto both = [&](const LaneRange& range) HWY_ATTR {
        const auto low = hn::Neg(range.low);
        return hn::Max(hn::InterleaveLower(d, low, range.high), hn::InterleaveUpper(d, low, range.high));
    };
    const auto of_x = hn::BitCast(wide, both(x)), of_y = hn::BitCast(wide, both(y));
    const auto four = hn::Max(hn::BitCast(d, hn::InterleaveLower(wide, of_x, of_y)), hn::BitCast(d, hn::InterleaveUpper(wide, of_x, of_y)));
    const hn::Half<IntTag> half;
    const hn::Half<decltype(half)> quarter;
    const auto two = hn::Max(hn::LowerHalf(half, four), hn::UpperHalf(half, four));
    alignas(16) int32_t most[4];
    hn::Store(hn::Max(hn::LowerHalf(quarter, two), hn::UpperHalf(quarter, two)), quarter, most);
    window.x = -most[0];
    window.last_x = most[1];
    window.y = -most[2];
    window.last_y = most[3];
#else
    window.x = hn::GetLane(hn::MinOfLanes(d, x.low));
    window.last_x = hn::GetLane(hn::MaxOfLanes(d, x.high));
    window.y = hn::GetLane(hn::MinOfLanes(d, y.low));
    window.last_y = hn::GetLane(hn::MaxOfLanes(d, y.high));
#endif
}

HWY_INLINE bool is_same(const WaveInt& wave) {
    const IntTag d;
    const auto first = hn::Set(d, wave[0]);
    auto same = hn::FirstN(d, hn::Lanes(d));
    for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) same = hn::And(same, hn::Eq(hn::Load(d, wave.lane + i), first));
    return hn::AllTrue(d, same);
}

/// Finds the window of the taps; false where more than `most_registers` would have to hold it, or where they lie in several levels. Where
/// blocks of the level are missing, windows are of 4x4 texels at most, so that they make no block that lies between their taps' blocks.
HWY_INLINE bool find_window(const Texture& texture, const WaveInt& level, const WaveInt* x, int columns, const WaveInt* y, int rows,
                            int most_registers, TexelWindow& window) {
    window.whole_level = (texture.ready_levels() >> level[0] & 1) != 0;
    find_extremes(range_of(x, columns), range_of(y, rows), window);
    const int width = window.last_x - window.x + 1;
    if (width > (window.whole_level ? kRegisterTexels : 4)) return false;
    window.log2_columns = width <= 4 ? 2 : width <= 8 ? 3 : 4;
    const int height = window.last_y - window.y + 1;
    if (height > (window.whole_level ? most_registers * kRegisterTexels >> window.log2_columns : 4)) return false;
    const int texels = height << window.log2_columns;
    window.registers = texels <= kRegisterTexels ? 1 : texels <= 2 * kRegisterTexels ? 2 : 4;
    return is_same(level);
}

/// Of a window of 4x4 texels, which lies in the blocks of its corners and no others: makes those blocks that are not ready.
HWY_NOINLINE inline void ensure_corners(Texture& texture, IntVec index) {
    const IntTag d;
    WaveInt indices[1];
    for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) hn::Store(index, d, indices[0].lane + i);
    bool ready = true;
    for (const size_t corner : {0, 3, 12, 15}) {
        const int32_t texel = indices[0].lane[corner];
        const int block = texel >> kLog2TexelsPerBlock & (BlockStates::kGroup - 1);
        ready = ready && (texture.ready_blocks(texel >> kLog2TexelsPerGroup) >> block & 1) != 0;
    }
    if (!ready) ensure_blocks(texture, indices);
}

/// Makes sure that the window's texels may be read, and gives their indices, register by register; beyond its last column and row those
/// repeat.
template <StorageClass storage, int registers>
HWY_INLINE void ensure_window(Texture& texture, const TexelWindow& window, const WaveInt& level, IntVec (&index)[registers]) {
    const IntTag d;
    const LevelTable& table = texture.levels();
    const auto of_level = hn::Load(d, level.lane);
    const auto offset = look_up_level(d, table.offset, of_level), row_stride = look_up_level(d, table.row_stride, of_level);
    for (int r = 0; r < registers; ++r) {
        const auto place = hn::Iota(d, r * kRegisterTexels);
        const auto column = hn::And(place, hn::Set(d, (1 << window.log2_columns) - 1)),
                   row = hn::ShiftRightSame(place, window.log2_columns);
        const auto x = hn::Min(hn::Add(hn::Set(d, window.x), column), hn::Set(d, window.last_x));
        const auto y = hn::Min(hn::Add(hn::Set(d, window.y), row), hn::Set(d, window.last_y));
        index[r] = hn::Add(hn::Add(offset, column_offset_v<storage>(x)), row_offset_v<storage>(y, row_stride));
    }
    if (!window.whole_level) ensure_corners(texture, index[0]);
}

/// Where taps at (x, y) are in the window.
HWY_INLINE IntVec in_window(const TexelWindow& window, IntVec x, IntVec y) {
    const IntTag d;
    const auto column = hn::Sub(x, hn::Set(d, window.x)), row = hn::Sub(y, hn::Set(d, window.y));
    return hn::Add(column, hn::ShiftLeftSame(row, window.log2_columns));
}

#if HWY_TARGET == HWY_AVX3
/// One channel's values at `at`, of a window's registers.
template <int registers>
HWY_INLINE FloatVec pick(const FloatVec (&texel)[registers], IntVec at) {
    if constexpr (registers == 1) {
        return hn::TableLookupLanes(texel[0], hn::IndicesFromVec(FloatTag(), at));
    } else {
        const auto of_two = [&](int r) HWY_ATTR __attribute__((always_inline)) {
            return FloatVec{_mm512_permutex2var_ps(texel[r].raw, at.raw, texel[r + 1].raw)};
        };
        if constexpr (registers == 2) return of_two(0);
        if constexpr (registers == 4) {
            const auto upper = hn::TestBit(at, hn::Set(IntTag(), 2 * kRegisterTexels));
            return hn::IfThenElse(hn::RebindMask(FloatTag(), upper), of_two(2), of_two(0));
        }
    }
}
#else
/// Other sets have no windows (has_windows).
template <int registers>
FloatVec pick(const FloatVec (&texel)[registers], IntVec at) = delete;
#endif

/// Calls `act` with the number of a window's registers as a constant of the type std::integral_constant.
template <class Act>
HWY_INLINE void with_registers(const TexelWindow& window, const Act& act) {
    if (window.registers == 1) {
        act(std::integral_constant<int, 1>());
    } else if (window.registers == 2) {
        act(std::integral_constant<int, 2>());
    } else {
        act(std::integral_constant<int, 4>());
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::texunit
HWY_AFTER_NAMESPACE();

#endif  // RAWTEXEL_TEXUNIT_TEXEL_WINDOW_INL_H_
