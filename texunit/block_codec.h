// Block decoding: one 4x4 block of BC1-BC7 to sixteen texels of its storage class.
#pragma once

#include "texunit/format.h"

#include <cstddef>

namespace rawtexel::texunit {

/// Decodes one block of a block-compressed `format` (8 or 16 bytes) into 16 texels of layout(format, rounding), row by row.
/// Any bit pattern decodes. BC6H and BC7 are bit exact (D3D11.3 19.5.14 and 19.5.15; reserved modes give zero, BC6H with alpha 1); BC1-BC5
/// keep the exact rational interpolation as integer numerators (see TexelLayout), unless `rounding` says otherwise for BC1-BC3.
void decode_block(Format format, const std::byte* block, std::byte* texels, BcRounding rounding = BcRounding::Exact);

/// The same for many blocks of one format: decodes one block. Null for formats that are not block-compressed.
using BlockDecoder = void (*)(const std::byte* block, std::byte* texels);
BlockDecoder block_decoder(Format format, BcRounding rounding = BcRounding::Exact);

}  // namespace rawtexel::texunit
