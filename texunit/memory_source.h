// Texels from memory: generated textures and tests.
#pragma once

#include "texunit/texel_source.h"

#include <memory>
#include <span>
#include <vector>

namespace rawtexel::texunit {

/// Level 0 of an uncompressed 2-D image, tightly packed rows of `format`'s texels (info(format).bytes_per_block each).
/// Asserts that the sizes agree.
std::unique_ptr<TexelSource> make_memory_source(Format format, int width, int height, std::vector<std::byte> texels);

/// Converts one uncompressed texel of a file (`format`, info(format).bytes_per_block bytes) to its decoded storage class.
void store_texel(Format format, const std::byte* file_texel, std::byte* decoded);

/// Fills one decoded 4x4 block from uncompressed rows; texels outside repeat the last column and row.
void store_block(Format format, const std::byte* rows, int width, int height, size_t row_stride, int block_x, int block_y,
                 std::byte* decoded);

}  // namespace rawtexel::texunit
