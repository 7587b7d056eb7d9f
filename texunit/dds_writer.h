// Textures as DDS files, with their whole pyramid.
#pragma once

#include "texunit/texture.h"

#include <cstddef>
#include <vector>

namespace rawtexel::texunit {

/// What the texels of `format` are written as: themselves where DDS has such texels, else the smallest uncompressed format that holds
/// every value of theirs (BC6H: halves; signed BC4 and BC5: floats; 8-bit sRGB of one or two channels: of four). BC1, BC2, BC3 and BC7
/// become 8-bit codes, unsigned BC4 and BC5 16-bit ones, each rounded to nearest: of them only BC7 stays as it was.
Format dds_format(Format format);

/// A DDS file (DX10 header) of every level of the pyramid, those made here included, of all layers, faces and depth slices. Decodes
/// everything. Throws TextureError when a block is damaged.
std::vector<std::byte> encode_dds(Texture& texture);

}  // namespace rawtexel::texunit
