// Where a texel lies: levels, pages and blocks of a texture's address space. The texel (x, y) of slice s in level l has the index
//
//   offset[l] + s*slice_stride[l] + column_offset(x) + row_offset(y, row_stride[l])
//
// so a kernel W texels wide and H high computes W columns and H rows, and adds. Inside a 4 KiB page the 4x4 blocks follow each other in
// Morton order; inside a block texels go row by row; pages go row by row within a level. index / 16 is the number of the block.
#pragma once

#include "texunit/format.h"
#include "texunit/texel_source.h"

#include <array>
#include <cstdint>

namespace rawtexel::texunit {

/// What select and gather need to know of every level, as arrays for vector look-ups. Entries past `levels` are 1 or 0.
struct LevelTable {
    alignas(64) std::array<int32_t, 16> width{}, height{}, depth{};  ///< texels
    alignas(64) std::array<int32_t, 16> offset{};                    ///< texels from the base of the storage
    alignas(64) std::array<int32_t, 16> row_stride{};                ///< texels of one row of pages
    alignas(64) std::array<int32_t, 16> slice_stride{};              ///< texels of one array layer or depth slice
    int32_t levels = 1;
    uint64_t texels = 0;  ///< of the whole storage, padding to whole pages included
};

/// Lays out a pyramid of `shape`. False when the storage would have 2^31 or more 32-bit words, the reach of a gather's index.
bool lay_out_levels(const Shape& shape, StorageClass storage, LevelTable& table);

inline constexpr int kTexelsPerBlock = 16;

/// Extent of a 4 KiB page in texels, as powers of two: 32x32 of 4 bytes, 32x16 of 8 bytes, 16x16 of 16 bytes.
struct PageShape {
    int log2_width, log2_height;
    constexpr int log2_texels() const { return log2_width + log2_height; }
};
constexpr PageShape page_shape(StorageClass storage) {
    switch (storage) {
        case StorageClass::Packed32: return {5, 5};
        case StorageClass::Packed64:
        case StorageClass::Half4: return {5, 4};
        default: return {4, 4};
    }
}

/// The part of a texel's index that its column decides. Bits 0-1 of x are the place in the block; bits 2-4 go to the even places of
/// the Morton code of the block, which starts at bit 4.
constexpr int32_t column_offset(StorageClass storage, int32_t x) {
    const PageShape page = page_shape(storage);
    const int32_t in_page = x & ((1 << page.log2_width) - 1);
    return (in_page & 3) | (in_page & 4) << 2 | (in_page & 8) << 3 | (in_page & 16) << 4 | (x >> page.log2_width) << page.log2_texels();
}

/// The part of a texel's index that its row decides.
constexpr int32_t row_offset(StorageClass storage, int32_t y, int32_t row_stride) {
    const PageShape page = page_shape(storage);
    const int32_t in_page = y & ((1 << page.log2_height) - 1);
    return (in_page & 3) << 2 | (in_page & 4) << 3 | (in_page & 8) << 4 | (in_page & 16) << 5 | (y >> page.log2_height) * row_stride;
}

constexpr int32_t texel_index(const LevelTable& table, StorageClass storage, int level, int slice, int x, int y) {
    const auto l = size_t(level);
    return table.offset[l] + slice * table.slice_stride[l] + column_offset(storage, x) + row_offset(storage, y, table.row_stride[l]);
}

/// A 4x4 block by its place in the image: texels (4*x .. 4*x + 3, 4*y .. 4*y + 3).
struct BlockPosition {
    int level, slice, x, y;
    bool operator==(const BlockPosition&) const = default;
};

/// The inverse of texel_index for block number `block` (texel index / 16). Numbers of padding give positions outside their level.
BlockPosition locate_block(const LevelTable& table, StorageClass storage, int32_t block);

}  // namespace rawtexel::texunit
