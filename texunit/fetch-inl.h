// The second stage of a lookup: raw texels as linear RGBA. First *ensure* that the blocks are there (scalar and rare), then *gather* (plain
// loads from one base pointer by 32-bit index), then unpack fields to numbers.
#include "texunit/packed_texels-inl.h"
#include "texunit/select-inl.h"
#include "texunit/texture.h"

#include <hwy/highway.h>

// Included once per instruction set (highway's guard for -inl.h files).
#if defined(RAWTEXEL_TEXUNIT_FETCH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_TEXUNIT_FETCH_INL_H_
#undef RAWTEXEL_TEXUNIT_FETCH_INL_H_
#else
#define RAWTEXEL_TEXUNIT_FETCH_INL_H_
#endif

HWY_BEFORE_NAMESPACE();
namespace rawtexel::texunit {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// The texels of n taps, linear RGBA: channel[c][tap]. Tap (i, j) of a kernel of W taps an axis is tap j*W + i.
template <int n>
struct TexelWave {
    WaveFloat channel[4][n];
};

/// Where the channels of texels go: tap t of channel c to [c][t].
using ChannelPointers = std::array<WaveFloat*, 4>;
template <int n>
HWY_INLINE ChannelPointers channels_of(TexelWave<n>& texels) {
    return {texels.channel[0], texels.channel[1], texels.channel[2], texels.channel[3]};
}
/// Of one texel a lane.
HWY_INLINE ChannelPointers channels_of(WaveColor& colour) {
    return {&colour.channel[0], &colour.channel[1], &colour.channel[2], &colour.channel[3]};
}

/// Index of the first texel of lanes i .. 's slice and level (texunit/level_table.h). `slice` null: slice 0.
HWY_INLINE hn::Vec<IntTag> slice_offset(const LevelTable& table, hn::Vec<IntTag> level, const WaveInt* slice, size_t i) {
    const IntTag d;
    const auto offset = look_up_level(d, table.offset, level);
    if (slice == nullptr) return offset;
    return hn::Add(offset, hn::Mul(hn::Load(d, slice->lane + i), look_up_level(d, table.slice_stride, level)));
}

/// Index of every tap's texel.
template <StorageClass storage, int W>
HWY_INLINE void tap_indices(const LevelTable& table, const TapWave<W>& taps, WaveInt (&index)[W * W]) {
    const IntTag d;
    for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
        const auto level = hn::Load(d, taps.level->lane + i);
        const auto offset = slice_offset(table, level, taps.slice, i);
        const auto row_stride = look_up_level(d, table.row_stride, level);
        hn::Vec<IntTag> columns[W];
        for (int k = 0; k < W; ++k) columns[k] = hn::Add(offset, column_offset_v<storage>(hn::Load(d, taps.x[k].lane + i)));
        for (int j = 0; j < W; ++j) {
            const auto row = row_offset_v<storage>(hn::Load(d, taps.y[j].lane + i), row_stride);
            for (int k = 0; k < W; ++k) hn::Store(hn::Add(columns[k], row), d, index[j * W + k].lane + i);
        }
    }
}

/// Index of one texel a lane. `slice` null: slice 0.
template <StorageClass storage>
HWY_INLINE void texel_indices(const LevelTable& table, const WaveInt& levels, const WaveInt* slice, const WaveInt& x, const WaveInt& y,
                              WaveInt& index) {
    const IntTag d;
    for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
        const auto level = hn::Load(d, levels.lane + i);
        const auto column = hn::Add(slice_offset(table, level, slice, i), column_offset_v<storage>(hn::Load(d, x.lane + i)));
        const auto row = row_offset_v<storage>(hn::Load(d, y.lane + i), look_up_level(d, table.row_stride, level));
        hn::Store(hn::Add(column, row), d, index.lane + i);
    }
}

/// Blocks of 16 texels in groups of 64, as BlockStates keeps them: bits 4-9 of a texel's index are the block's bit, the rest is the group.
inline constexpr int kLog2TexelsPerBlock = 4;
inline constexpr int kLog2TexelsPerGroup = 10;
static_assert(1 << kLog2TexelsPerBlock == kTexelsPerBlock && 1 << kLog2TexelsPerGroup == kTexelsPerBlock * BlockStates::kGroup);

/// Bitwise or of all lanes.
template <class V>
HWY_INLINE uint32_t or_of_lanes(V v) {
    const hn::DFromV<V> d;
    alignas(64) int32_t lanes[hn::MaxLanes(d)];
    hn::Store(v, d, lanes);
    uint32_t all = 0;
    for (size_t i = 0; i < hn::Lanes(d); ++i) all |= uint32_t(lanes[i]);
    return all;
}

/// Lanes whose texel lies in block group `group`.
HWY_INLINE WaveMask lanes_in_group(const WaveInt& index, int32_t group) {
    const IntTag d;
    WaveMask lanes = 0;
    for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
        lanes |= wave_mask(d, hn::Eq(hn::ShiftRight<kLog2TexelsPerGroup>(hn::Load(d, index.lane + i)), hn::Set(d, group)), i);
    }
    return lanes;
}

/// The blocks of `group` that the taps from `first` on touch, as bits.
template <int n>
HWY_INLINE uint64_t blocks_touched(const WaveInt (&index)[n], int first, int32_t group) {
    const IntTag d;
    const auto one = hn::Set(d, 1), half = hn::Set(d, 32);
    auto low = hn::Zero(d), high = hn::Zero(d);
    for (int tap = first; tap < n; ++tap) {
        for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
            const auto texel = hn::Load(d, index[tap].lane + i);
            const auto here = hn::Eq(hn::ShiftRight<kLog2TexelsPerGroup>(texel), hn::Set(d, group));
            const auto block = hn::And(hn::ShiftRight<kLog2TexelsPerBlock>(texel), hn::Set(d, BlockStates::kGroup - 1));
            const auto bit = hn::IfThenElseZero(here, hn::Shl(one, hn::And(block, hn::Set(d, 31))));
            low = hn::Or(low, hn::IfThenElseZero(block < half, bit));
            high = hn::Or(high, hn::IfThenZeroElse(block < half, bit));
        }
    }
    return uint64_t{or_of_lanes(high)} << 32 | or_of_lanes(low);
}

/// Whether a tap from `first` on touches one of the blocks `missing` of `group`: the question that is asked most, and without a reduction.
template <int n>
HWY_INLINE bool touches_blocks(const WaveInt (&index)[n], int first, int32_t group, uint64_t missing) {
    const IntTag d;
    const auto low = hn::Set(d, int32_t(uint32_t(missing))), high = hn::Set(d, int32_t(missing >> 32)), half = hn::Set(d, 32);
    auto touched = hn::Zero(d);
    for (int tap = first; tap < n; ++tap) {
        for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
            const auto texel = hn::Load(d, index[tap].lane + i);
            const auto here = hn::Eq(hn::ShiftRight<kLog2TexelsPerGroup>(texel), hn::Set(d, group));
            const auto block = hn::ShiftRight<kLog2TexelsPerBlock>(texel);
            const auto word = hn::IfThenElse(hn::Eq(hn::And(block, half), half), high, low);
            touched = hn::Or(touched, hn::IfThenElseZero(here, hn::Shr(word, hn::And(block, hn::Set(d, 31)))));
        }
    }
    return !hn::AllTrue(d, hn::Eq(hn::And(touched, hn::Set(d, 1)), hn::Zero(d)));
}

/// Has those blocks made that the taps touch and that are not ready. Groups are few: a coherent wave touches one to four.
template <int n>
HWY_NOINLINE void ensure_blocks(Texture& texture, const WaveInt (&index)[n]) {
    WaveMask pending[n];
    for (WaveMask& lanes : pending) lanes = kWaveFull;
    for (int tap = 0; tap < n; ++tap) {
        while (pending[tap] != 0) {
            const int32_t group = index[tap].lane[hwy::Num0BitsBelowLS1Bit_Nonzero32(pending[tap])] >> kLog2TexelsPerGroup;
            uint64_t missing = ~texture.ready_blocks(group);
            if (missing != 0 && touches_blocks(index, tap, group, missing)) {
                texture.make_blocks(group, missing & blocks_touched(index, tap, group));
            }
            for (int k = tap; k < n; ++k) pending[k] &= ~lanes_in_group(index[k], group);
        }
    }
}

/// Bits of the levels that lanes read.
HWY_INLINE uint32_t levels_read(const WaveInt& level) {
    const IntTag d;
    auto bits = hn::Zero(d);
    for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) bits = hn::Or(bits, hn::Shl(hn::Set(d, 1), hn::Load(d, level.lane + i)));
    return or_of_lanes(bits);
}

/// Makes sure that every texel of `index` may be read.
template <int n>
HWY_INLINE void ensure(Texture& texture, const WaveInt& level, const WaveInt (&index)[n]) {
    const uint32_t ready = texture.ready_levels();
    if (ready == texture.all_levels() || (levels_read(level) & ~ready) == 0) return;
    ensure_blocks(texture, index);
}

/// 32-bit word `word` of texels that are `words` words long.
template <int words, int word>
HWY_INLINE void gather_words(const std::byte* texels, const WaveInt& index, Wave<uint32_t>& out) {
    const IntTag di;
    const hn::RebindToUnsigned<IntTag> d;
    const auto* const base = reinterpret_cast<const uint32_t*>(texels) + word;
    for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(di)) {
        const auto at = hn::ShiftLeft<hwy::CeilLog2(words)>(hn::Load(di, index.lane + i));
        hn::Store(gather_from(base, at), d, out.lane + i);
    }
}

/// One channel of a packed class, its field already at bit `shift` of the words.
template <int n>
HWY_INLINE void unpack_field(const TexelLayout& layout, int c, int shift, const Wave<uint32_t> (&words)[n], WaveFloat* out) {
    const FloatTag d;
    const IntTag di;
    const hn::RebindToUnsigned<IntTag> du;
    const auto mask = hn::Set(du, layout.mask[c]);
    const auto field_at = [&](int tap, size_t i) HWY_ATTR {
        return hn::BitCast(di, hn::And(hn::ShiftRightSame(hn::Load(du, words[tap].lane + i), shift), mask));
    };
    if (layout.table[c] != nullptr) {
        for (int tap = 0; tap < n; ++tap) {
            for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
                hn::Store(gather_from(layout.table[c], field_at(tap, i)), d, out[tap].lane + i);
            }
        }
        return;
    }
    // field*hi is exact, so the sum rounds once, to the correctly rounded quotient, whether or not the multiply-add is fused.
    const auto hi = hn::Set(d, layout.scale_hi[c]), lo = hn::Set(d, layout.scale_lo[c]);
    const auto value = [&](hn::Vec<IntTag> field) HWY_ATTR {
        const auto number = hn::ConvertTo(d, field);
        return hn::MulAdd(number, hi, hn::Mul(number, lo));
    };
    if (!layout.is_signed) {
        for (int tap = 0; tap < n; ++tap) {
            for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) hn::Store(value(field_at(tap, i)), d, out[tap].lane + i);
        }
        return;
    }
    // Flipping the sign bit and subtracting it extends the sign. Two codes mean -1 (D3D11.3 3.2.3.4).
    const auto sign = hn::Set(di, int32_t((layout.mask[c] + 1) >> 1));
    const auto least = hn::Set(d, -1.0f);
    for (int tap = 0; tap < n; ++tap) {
        for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
            hn::Store(hn::Max(value(hn::Sub(hn::Xor(field_at(tap, i), sign), sign)), least), d, out[tap].lane + i);
        }
    }
}

/// A channel that is not stored.
template <int n>
HWY_INLINE void fill_channel(float value, WaveFloat* out) {
    const FloatTag d;
    for (int tap = 0; tap < n; ++tap) {
        for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) hn::Store(hn::Set(d, value), d, out[tap].lane + i);
    }
}

/// binary16 in the low 16 bits of each lane to float, exactly; infinities and NaNs keep their meaning (texunit/half.h).
template <class V>
HWY_INLINE hn::Vec<FloatTag> half_to_float_v(V half) {
    const FloatTag d;
    const hn::DFromV<V> du;
    const V magnitude = hn::And(half, hn::Set(du, 0x7FFFu));
    const V sign = hn::ShiftLeft<16>(hn::And(half, hn::Set(du, 0x8000u)));
    const auto scaled = hn::Mul(hn::BitCast(d, hn::ShiftLeft<13>(magnitude)), hn::Set(d, 0x1p112f));
    const auto special = hn::IfThenElseZero(magnitude > hn::Set(du, 0x7BFFu), hn::Set(du, 0x7F800000u));
    return hn::BitCast(d, hn::Or3(hn::BitCast(du, scaled), special, sign));
}

template <int n>
HWY_INLINE void unpack_halves(const Wave<uint32_t> (&words)[n], WaveFloat* low, WaveFloat* high) {
    const FloatTag d;
    const hn::RebindToUnsigned<IntTag> du;
    for (int tap = 0; tap < n; ++tap) {
        for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
            const auto word = hn::Load(du, words[tap].lane + i);
            hn::Store(half_to_float_v(hn::And(word, hn::Set(du, 0xFFFFu))), d, low[tap].lane + i);
            hn::Store(half_to_float_v(hn::ShiftRight<16>(word)), d, high[tap].lane + i);
        }
    }
}

/// Texels whose fields are known, unpacked in registers.
template <PackedFields fields, int n>
HWY_INLINE void gather_known(const TexelLayout& layout, const std::byte* texels, const WaveInt (&index)[n], const ChannelPointers& out) {
    const FloatTag d;
    const PackedDecoder<fields> decoder(layout);
    const auto* const base = reinterpret_cast<const uint32_t*>(texels);
    for (int tap = 0; tap < n; ++tap) {
        for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
            FloatVec value[4];
            decoder.values(gather_from(base, hn::Load(IntTag(), index[tap].lane + i)), value);
            for (int c = 0; c < 4; ++c) hn::Store(value[c], d, out[c][tap].lane + i);
        }
    }
}

template <int n>
HWY_INLINE void gather_packed32(const TexelLayout& layout, const std::byte* texels, const WaveInt (&index)[n], const ChannelPointers& out) {
    if (layout.fields != PackedFields::Any) {
        with_fields(layout.fields, [&](auto constant) HWY_ATTR { gather_known<decltype(constant)::value>(layout, texels, index, out); });
        return;
    }
    Wave<uint32_t> words[n];
    for (int tap = 0; tap < n; ++tap) gather_words<1, 0>(texels, index[tap], words[tap]);
    for (int c = 0; c < 4; ++c) {
        if (layout.mask[c] != 0) {
            unpack_field(layout, c, layout.shift[c], words, out[c]);
        } else {
            fill_channel<n>(layout.bias[c], out[c]);
        }
    }
}

template <int n>
HWY_INLINE void gather_packed64(const TexelLayout& layout, const std::byte* texels, const WaveInt (&index)[n], const ChannelPointers& out) {
    Wave<uint32_t> low[n], high[n];
    for (int tap = 0; tap < n; ++tap) {
        gather_words<2, 0>(texels, index[tap], low[tap]);
        gather_words<2, 1>(texels, index[tap], high[tap]);
    }
    for (int c = 0; c < 4; ++c) {
        if (layout.mask[c] == 0) {
            fill_channel<n>(layout.bias[c], out[c]);
        } else if (layout.shift[c] < 32) {
            unpack_field(layout, c, layout.shift[c], low, out[c]);
        } else {
            unpack_field(layout, c, layout.shift[c] - 32, high, out[c]);
        }
    }
}

template <int n>
HWY_INLINE void gather_half4(const std::byte* texels, const WaveInt (&index)[n], const ChannelPointers& out) {
    Wave<uint32_t> low[n], high[n];
    for (int tap = 0; tap < n; ++tap) {
        gather_words<2, 0>(texels, index[tap], low[tap]);
        gather_words<2, 1>(texels, index[tap], high[tap]);
    }
    unpack_halves(low, out[0], out[1]);
    unpack_halves(high, out[2], out[3]);
}

template <int n>
HWY_INLINE void gather_float4(const std::byte* texels, const WaveInt (&index)[n], const ChannelPointers& out) {
    const FloatTag d;
    const IntTag di;
    const auto* const base = reinterpret_cast<const float*>(texels);
    for (int tap = 0; tap < n; ++tap) {
        for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
            const auto at = hn::ShiftLeft<2>(hn::Load(di, index[tap].lane + i));
            for (int c = 0; c < 4; ++c) hn::Store(gather_from(base + c, at), d, out[c][tap].lane + i);
        }
    }
}

/// Gathers texels that are there.
template <StorageClass storage, int n>
HWY_INLINE void gather(const Texture& texture, const WaveInt (&index)[n], const ChannelPointers& out) {
    if constexpr (storage == StorageClass::Packed32) gather_packed32(texture.texel_layout(), texture.texels(), index, out);
    if constexpr (storage == StorageClass::Packed64) gather_packed64(texture.texel_layout(), texture.texels(), index, out);
    if constexpr (storage == StorageClass::Half4) gather_half4(texture.texels(), index, out);
    if constexpr (storage == StorageClass::Float4) gather_float4(texture.texels(), index, out);
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::texunit
HWY_AFTER_NAMESPACE();

#endif  // RAWTEXEL_TEXUNIT_FETCH_INL_H_
