// What one texel, or one block, of a container is, and how it becomes one of texunit's formats.
#pragma once

#include "texunit/block_codec.h"
#include "texunit/format.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace rawtexel::texunit {

/// The unit that a container stores: a 4x4 block, or a texel that is either `format`'s own or expanded to it.
struct FileTexel {
    Format format = Format::RGBA8Unorm;  ///< what it is read as
    int extent = 1;                      ///< texels along x and y: 1, or 4 for blocks
    int file_bytes = 0;                  ///< of one texel or block in the file
    BlockDecoder decode = nullptr;       ///< for blocks: to 16 texels of layout(format, rounding)
    BcRounding rounding = BcRounding::Exact;
    /// For texels that are not `format`'s own: writes info(format).bytes_per_block bytes. Null where the file's bytes are those.
    void (*expand)(const FileTexel& texel, const std::byte* in, std::byte* out) = nullptr;
    std::array<uint32_t, 4> mask{};  ///< of red, green, blue, alpha in a word of file_bytes, for texels made by field_texel
};

/// A format of texunit as it is.
FileTexel plain_texel(Format format);

/// Unsigned codes in bit fields of a word of 1 to 4 bytes. A mask is contiguous, inside the word, at most 16 bits wide, or 0 for a
/// missing channel; not all are 0. Channels of 1, 2, 4 and 8 bits become 8-bit codes exactly; where a channel has another width all
/// become 16-bit codes rounded to nearest. Masks may be equal (luminance).
FileTexel field_texel(const std::array<uint32_t, 4>& mask, int file_bytes);
bool valid_field_masks(const std::array<uint32_t, 4>& mask, int file_bytes);

FileTexel srgb_texel(FileTexel texel);  ///< the same codes, sRGB-encoded

/// The same blocks with colours of BC1, BC2 and BC3 rounded; other texels come back unchanged.
FileTexel rounded_texel(FileTexel texel, BcRounding rounding);

FileTexel snorm16_texel(int channels);                    ///< 1 to 4; read as floats
FileTexel three_channel_texel(Format format_with_alpha);  ///< red, green, blue of a four-channel format, in the file without alpha
FileTexel r11g11b10_float_texel();                        ///< read as halves
FileTexel rgb9e5_texel();                                 ///< shared exponent, read as halves
FileTexel rxgb_block();  ///< BC3 with red and alpha exchanged, alpha unused; read as 16-bit codes rounded to nearest

}  // namespace rawtexel::texunit
