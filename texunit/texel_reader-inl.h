// Texels read a vector at a time, in the numbers they are stored as.
#include "texunit/fetch-inl.h"

#include <hwy/highway.h>

// Included once per instruction set (highway's guard for -inl.h files).
#if defined(RAWTEXEL_TEXUNIT_TEXEL_READER_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_TEXUNIT_TEXEL_READER_INL_H_
#undef RAWTEXEL_TEXUNIT_TEXEL_READER_INL_H_
#else
#define RAWTEXEL_TEXUNIT_TEXEL_READER_INL_H_
#endif

HWY_BEFORE_NAMESPACE();
namespace rawtexel::texunit {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Whether texels are fields of a word, which a layout turns into numbers.
constexpr bool is_packed(StorageClass storage) { return storage == StorageClass::Packed32 || storage == StorageClass::Packed64; }

/// Whether all four channels are stored as unsigned fields that mean their quotients.
HWY_INLINE bool is_plain(const TexelLayout& layout) {
    bool plain = !layout.is_signed;
    for (int c = 0; c < 4; ++c) plain = plain && layout.mask[c] != 0 && layout.table[c] == nullptr;
    return plain;
}

/// Reads texels as the numbers they are stored as: fields of the packed classes are scaled only once they are summed. `plain` packed
/// layouts are read without asking about each channel.
template <StorageClass storage, bool plain>
class TexelReader {
  public:
    using V = hn::Vec<FloatTag>;

    explicit TexelReader(const Texture& texture)
        : layout_(texture.texel_layout()), srgb8_(texture.texel_layout()), texels_(texture.texels()) {}

    HWY_INLINE void read(hn::Vec<IntTag> index, V (&texel)[4]) const {
        const hn::RebindToUnsigned<IntTag> du;
        if constexpr (storage == StorageClass::Float4) {
            const auto* const base = reinterpret_cast<const float*>(texels_);
            const auto at = hn::ShiftLeft<2>(index);
            for (int c = 0; c < 4; ++c) texel[c] = gather_from(base + c, at);
            return;
        }
        const auto* const base = reinterpret_cast<const uint32_t*>(texels_);
        if constexpr (storage == StorageClass::Packed32) {
            const auto word = gather_from(base, index);
            if (!plain && layout_.fields == PackedFields::Srgb8) return srgb8_.numbers(word, texel);
            for (int c = 0; c < 4; ++c) texel[c] = field(c, layout_.shift[c], word);
            return;
        }
        const auto at = hn::ShiftLeft<1>(index);
        const auto low = gather_from(base, at), high = gather_from(base + 1, at);
        if constexpr (storage == StorageClass::Half4) {
            const auto lower = [&](auto word) HWY_ATTR { return half_to_float_v(hn::And(word, hn::Set(du, 0xFFFFu))); };
            texel[0] = lower(low), texel[1] = half_to_float_v(hn::ShiftRight<16>(low));
            texel[2] = lower(high), texel[3] = half_to_float_v(hn::ShiftRight<16>(high));
        } else {
            for (int c = 0; c < 4; ++c) {
                texel[c] = layout_.shift[c] < 32 ? field(c, layout_.shift[c], low) : field(c, layout_.shift[c] - 32, high);
            }
        }
    }

    /// The value of a weighted sum of what was read.
    HWY_INLINE V value(int c, V sum) const {
        const FloatTag d;
        if constexpr (!is_packed(storage)) return sum;
        if (layout_.mask[c] == 0) return hn::Set(d, layout_.bias[c]);
        if (layout_.table[c] != nullptr) return sum;
        return hn::Add(hn::Mul(sum, hn::Set(d, layout_.scale_hi[c])), hn::Mul(sum, hn::Set(d, layout_.scale_lo[c])));
    }

  private:
    /// The field of channel c at bit `shift` of `word`, or its value where a table holds that.
    HWY_INLINE V field(int c, int shift, hn::Vec<hn::RebindToUnsigned<IntTag>> word) const {
        if constexpr (!plain) return layout_.mask[c] == 0 ? hn::Zero(FloatTag()) : field_number(layout_, c, shift, word);
        const hn::RebindToUnsigned<IntTag> du;
        const auto bits = hn::And(hn::ShiftRightSame(word, shift), hn::Set(du, layout_.mask[c]));
        return hn::ConvertTo(FloatTag(), hn::BitCast(IntTag(), bits));
    }

    const TexelLayout& layout_;
    const PackedDecoder<PackedFields::Srgb8> srgb8_;
    const std::byte* texels_;
};

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::texunit
HWY_AFTER_NAMESPACE();

#endif  // RAWTEXEL_TEXUNIT_TEXEL_READER_INL_H_
