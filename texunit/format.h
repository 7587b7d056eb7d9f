// Texel formats: what a texel or a block holds in a file, and how it is stored once decoded.
#pragma once

#include "texunit/bc_rounding.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace rawtexel::texunit {

/// Channel counts x encodings that a texture unit samples, and the block-compressed formats of D3D11 and Vulkan.
/// Missing channels read as 0, missing alpha as 1.
enum class Format : uint8_t {
    R8Unorm,
    RG8Unorm,
    RGBA8Unorm,
    R8Snorm,
    RG8Snorm,
    RGBA8Snorm,
    R8Srgb,
    RG8Srgb,
    RGBA8Srgb,  // alpha is linear
    R16Unorm,
    RG16Unorm,
    RGBA16Unorm,
    R16Half,
    RG16Half,
    RGBA16Half,
    R32Float,
    RG32Float,
    RGBA32Float,
    BC1RgbUnorm,
    BC1RgbSrgb,
    BC1RgbaUnorm,
    BC1RgbaSrgb,
    BC2Unorm,
    BC2Srgb,
    BC3Unorm,
    BC3Srgb,
    BC4Unorm,
    BC4Snorm,
    BC5Unorm,
    BC5Snorm,
    BC6HUfloat,
    BC6HSfloat,
    BC7Unorm,
    BC7Srgb,
};
inline constexpr int kFormatCount = int(Format::BC7Srgb) + 1;

/// How a decoded 4x4 block lies in memory. One block is one allocation unit of 16 texels, rows of four.
enum class StorageClass : uint8_t {
    Packed32,  ///< up to four unsigned fields in one 32-bit word: unorm8, snorm8, srgb8, BC1, BC2, BC7 (64-byte block)
    Packed64,  ///< four 16-bit fields: unorm16, and the interpolation numerators of BC3, BC4, BC5 (128-byte block)
    Half4,     ///< four IEEE binary16 (128-byte block)
    Float4,    ///< four IEEE binary32 (256-byte block)
};
inline constexpr int kStorageClassCount = 4;

/// Bytes of one decoded texel: 4, 8, 8, 16.
constexpr int bytes_per_texel(StorageClass storage) {
    return storage == StorageClass::Packed32 ? 4 : storage == StorageClass::Float4 ? 16 : 8;
}

struct FormatInfo {
    Format format;
    std::string_view name;         ///< the spelling of `rawtexel list formats`, such as "bc7-srgb"
    std::string_view description;  ///< one line for people
    int channels;                  ///< 1, 2, 3 (BC1 without alpha, BC6H) or 4
    int block_extent;              ///< texels along x and y of the file's unit: 1 or 4
    int bytes_per_block;           ///< of the file's unit
    bool srgb;
    bool block_compressed;
};

const FormatInfo& info(Format format);
std::span<const FormatInfo> all_formats();

/// The same format read as linear data (`srgb` false) or as sRGB-encoded colour; formats without such a pair come back unchanged.
Format with_srgb(Format format, bool srgb);

/// Bytes of one level or layer of `width` x `height` texels as a file stores it (blocks rounded up). No overflow up to 2^20 texels an axis.
uint64_t stored_bytes(Format format, int width, int height);

/// What the fields of most textures are, which can be unpacked faster than the layout alone tells.
enum class PackedFields : uint8_t {
    Any,
    Unorm8,  ///< four bytes, each a quotient
    Srgb8,   ///< three bytes of sRGB codes, and one that is a quotient
};

/// How the fields of a decoded texel become numbers. For the packed classes channel c of a word is
/// field = (word >> shift[c]) & mask[c]  (sign-extended from the mask's width when `is_signed`), then
/// value = table[c] ? table[c][field] : max(field*scale_hi[c] + field*scale_lo[c], -1) + bias[c].
/// scale_hi has so few bits that field*scale_hi is exact; the two rounded operations together give the correctly rounded quotient
/// field / denominator[c] for every field that a decoder produces.
/// Half4 and Float4 hold the four values themselves, missing channels written out as 0 and missing alpha as 1, and ignore the rest.
///
/// Fields: 8- and 16-bit formats hold their codes, channel c at bit 8*c or 16*c. BC1 and BC2 hold R/186 at bit 0, G/378 at bit 8,
/// B/186 at bit 17 (thirds and halves of 5- and 6-bit endpoints) and A/1 or A/15 at bit 25. BC3 holds the same colours and A/8925 in
/// 16-bit fields; BC4 and BC5 hold n/8925 (fifths and sevenths of 8-bit endpoints: 255*35) or, signed, n/4445 (127*35).
/// With their colours rounded, BC1 and BC2 hold 8-bit codes, and BC3 the same in 16-bit fields beside A/8925.
struct TexelLayout {
    StorageClass storage;
    bool is_signed;
    PackedFields fields;                      ///< of Packed32
    uint8_t shift[4];                         ///< bits, 0..63
    uint32_t mask[4];                         ///< 0 for a channel that is not stored
    float scale_hi[4], scale_lo[4], bias[4];  ///< bias is 1 for the missing alpha, else 0
    const float* table[4];                    ///< linear values by field, mask[c] + 1 of them, for sRGB; null where the scale holds
    int denominator[4];                       ///< the field that means 1.0; 0 for a channel that is not stored
};

/// How blocks of `format` are stored once decoded. The storage class is the same whatever the rounding.
const TexelLayout& layout(Format format, BcRounding rounding = BcRounding::Exact);

/// Whether `rounding` can change what texels of `format` are: BC1, BC2 and BC3.
bool has_bc_rounding(Format format);

}  // namespace rawtexel::texunit
