// Texels of StorageClass::Packed32: from their words to the four channels, all at once and in registers.
#include "texunit/gather-inl.h"
#include "texunit/math-inl.h"
#include "texunit/srgb.h"
#include "texunit/texture.h"

#include <hwy/highway.h>

#include <type_traits>

// Included once per instruction set (highway's guard for -inl.h files).
#if defined(RAWTEXEL_TEXUNIT_PACKED_TEXELS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_TEXUNIT_PACKED_TEXELS_INL_H_
#undef RAWTEXEL_TEXUNIT_PACKED_TEXELS_INL_H_
#else
#define RAWTEXEL_TEXUNIT_PACKED_TEXELS_INL_H_
#endif

HWY_BEFORE_NAMESPACE();
namespace rawtexel::texunit {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using WordVec = hn::Vec<hn::RebindToUnsigned<IntTag>>;

/// Channel c of words whose fields are bytes, as a number.
template <int c>
HWY_INLINE FloatVec byte_number(WordVec word) {
    const IntTag di;
    const hn::RebindToUnsigned<IntTag> du;
    const auto shifted = c == 0 ? word : hn::ShiftRight<8 * c>(word);
    return hn::ConvertTo(FloatTag(), hn::BitCast(di, c == 3 ? shifted : hn::And(shifted, hn::Set(du, 0xFF))));
}

#if HWY_TARGET == HWY_AVX3
/// Entries of a table of 256 16-bit values that registers hold, by the 16-bit lanes of `index`, whose bits 6 and 7 are in the masks.
HWY_INLINE __m512i look_up_halves(const uint16_t* table, __m512i index, __mmask32 bit6, __mmask32 bit7) {
    const auto quarter = [&](int k) HWY_ATTR {
        return _mm512_permutex2var_epi16(_mm512_load_si512(table + 64 * k), index, _mm512_load_si512(table + 64 * k + 32));
    };
    const __m512i lower = _mm512_mask_mov_epi16(quarter(0), bit6, quarter(1)), upper = _mm512_mask_mov_epi16(quarter(2), bit6, quarter(3));
    return _mm512_mask_mov_epi16(lower, bit7, upper);
}
#endif

/// Linear red, green and blue of words whose first three bytes are sRGB codes (texunit/srgb.h).
HWY_INLINE void decode_srgb8(const Srgb8Tables& table, WordVec word, FloatVec& red, FloatVec& green, FloatVec& blue) {
#if HWY_TARGET == HWY_AVX3
    // Lookups of 16 bits in registers, which serve two channels at once: gathers from the table of floats take three times as long.
    const __m512i even = _mm512_and_si512(word.raw, _mm512_set1_epi16(0xFF)), odd = _mm512_srli_epi16(word.raw, 8);
    const auto bit = [](__m512i code, int place) HWY_ATTR { return _mm512_test_epi16_mask(code, _mm512_set1_epi16(short(1 << place))); };
    const __mmask32 even6 = bit(even, 6), even7 = bit(even, 7), odd6 = bit(odd, 6), odd7 = bit(odd, 7);
    const __m512i even_low = look_up_halves(table.low, even, even6, even7), even_high = look_up_halves(table.high, even, even6, even7);
    const __m512i odd_low = look_up_halves(table.low, odd, odd6, odd7), odd_high = look_up_halves(table.high, odd, odd6, odd7);
    constexpr __mmask32 kUpper = 0xAAAAAAAA;
    const auto together = [](__m512i low, __m512i high) HWY_ATTR {
        return FloatVec{_mm512_castsi512_ps(_mm512_mask_mov_epi16(low, kUpper, _mm512_slli_epi32(high, 16)))};
    };
    red = together(even_low, even_high);
    green = together(odd_low, odd_high);
    blue = FloatVec{_mm512_castsi512_ps(_mm512_mask_mov_epi16(_mm512_srli_epi32(even_low, 16), kUpper, even_high))};
#else
    const IntTag di;
    const hn::RebindToUnsigned<IntTag> du;
    const auto code = [&](WordVec shifted) HWY_ATTR { return hn::BitCast(di, hn::And(shifted, hn::Set(du, 0xFF))); };
    red = gather_from(table.whole, code(word));
    green = gather_from(table.whole, code(hn::ShiftRight<8>(word)));
    blue = gather_from(table.whole, code(hn::ShiftRight<16>(word)));
#endif
}

/// The stored number of channel c, of whatever fields, at bit `shift` of the words: a numerator, or what the format's table says.
HWY_INLINE FloatVec field_number(const TexelLayout& layout, int c, int shift, WordVec word) {
    const FloatTag d;
    const IntTag di;
    const hn::RebindToUnsigned<IntTag> du;
    const auto field = hn::BitCast(di, hn::And(hn::ShiftRightSame(word, shift), hn::Set(du, layout.mask[c])));
    if (layout.table[c] != nullptr) return gather_from(layout.table[c], field);
    if (!layout.is_signed) return hn::ConvertTo(d, field);
    // Flipping the sign bit and subtracting it extends the sign; two codes mean -1 (D3D11.3 3.2.3.4).
    const auto sign = hn::Set(di, int32_t((layout.mask[c] + 1) >> 1));
    const auto value = hn::Sub(hn::Xor(field, sign), sign);
    return hn::ConvertTo(d, hn::Max(value, hn::Set(di, -layout.denominator[c])));
}

/// Unpacks texels of one layout, whose fields are known where they are not Any.
template <PackedFields fields>
class PackedDecoder {
  public:
    explicit PackedDecoder(const TexelLayout& layout) : layout_(layout), srgb8_(srgb8_tables()) {}

    /// The stored numbers of all channels, or of red, green and blue: numerators, or linear values of sRGB.
    template <int channels>
    HWY_INLINE void numbers(WordVec word, FloatVec (&number)[channels]) const {
        if constexpr (fields == PackedFields::Any) {
            for (int c = 0; c < channels; ++c) number[c] = field_number(layout_, c, layout_.shift[c], word);
            return;
        }
        if constexpr (fields == PackedFields::Srgb8) {
            decode_srgb8(srgb8_, word, number[0], number[1], number[2]);
        } else {
            number[0] = byte_number<0>(word), number[1] = byte_number<1>(word), number[2] = byte_number<2>(word);
        }
        if constexpr (channels == 4) number[3] = byte_number<3>(word);
    }

    /// From a number of channel c, or a mean of such, to its value.
    HWY_INLINE FloatVec value(int c, FloatVec number) const {
        const FloatTag d;
        if (fields == PackedFields::Srgb8 && c < 3) return number;
        if constexpr (fields == PackedFields::Any) {
            if (layout_.mask[c] == 0) return hn::Set(d, layout_.bias[c]);
            if (layout_.table[c] != nullptr) return number;
        }
        return fused_multiply_add(number, hn::Set(d, layout_.scale_hi[c]), hn::Mul(number, hn::Set(d, layout_.scale_lo[c])));
    }

    /// The values of all channels, or of red, green and blue.
    template <int channels>
    HWY_INLINE void values(WordVec word, FloatVec (&result)[channels]) const {
        numbers(word, result);
        for (int c = 0; c < channels; ++c) result[c] = value(c, result[c]);
    }

  private:
    const TexelLayout& layout_;
    const Srgb8Tables& srgb8_;
};

/// Calls `act` with the number of channels that a lookup reads, 3 or 4, as a constant of the type std::integral_constant.
template <class Act>
HWY_INLINE auto with_channels(bool reads_alpha, const Act& act) {
    if (reads_alpha) return act(std::integral_constant<int, 4>());
    return act(std::integral_constant<int, 3>());
}

/// Calls `act` with the fields as a constant of the type std::integral_constant.
template <class Act>
HWY_INLINE auto with_fields(PackedFields fields, const Act& act) {
    switch (fields) {
        case PackedFields::Unorm8: return act(std::integral_constant<PackedFields, PackedFields::Unorm8>());
        case PackedFields::Srgb8: return act(std::integral_constant<PackedFields, PackedFields::Srgb8>());
        default: return act(std::integral_constant<PackedFields, PackedFields::Any>());
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::texunit
HWY_AFTER_NAMESPACE();

#endif  // RAWTEXEL_TEXUNIT_PACKED_TEXELS_INL_H_
