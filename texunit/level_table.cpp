#include "texunit/level_table.h"

#include <algorithm>
#include <cassert>

namespace rawtexel::texunit {
namespace {

/// Array layers, or depth slices of a 3-D texture: what is stored apart within a level.
uint64_t slices_of(const Shape& shape, int level) { return uint64_t(shape.layers) * uint64_t(level_extent(shape.depth, level)); }

}  // namespace

bool lay_out_levels(const Shape& shape, StorageClass storage, LevelTable& table) {
    assert(shape.levels >= 1 && shape.levels <= kMaxLevels);
    const PageShape page = page_shape(storage);
    const uint64_t reachable = (uint64_t{1} << 31) / uint64_t(bytes_per_texel(storage) / 4);
    table = {};
    table.width.fill(1);
    table.height.fill(1);
    table.depth.fill(1);
    table.levels = shape.levels;
    for (int level = 0; level < shape.levels; ++level) {
        const auto l = size_t(level);
        table.width[l] = level_extent(shape.width, level);
        table.height[l] = level_extent(shape.height, level);
        table.depth[l] = level_extent(shape.depth, level);
        const uint64_t pages_x = (uint64_t(table.width[l] - 1) >> page.log2_width) + 1;
        const uint64_t pages_y = (uint64_t(table.height[l] - 1) >> page.log2_height) + 1;
        const uint64_t slice_texels = pages_x * pages_y << page.log2_texels();
        if (slice_texels >= reachable || slices_of(shape, level) > (reachable - 1 - table.texels) / slice_texels) return false;
        table.offset[l] = int32_t(table.texels);
        table.row_stride[l] = int32_t(pages_x << page.log2_texels());
        table.slice_stride[l] = int32_t(slice_texels);
        table.texels += slice_texels * slices_of(shape, level);
    }
    return true;
}

BlockPosition locate_block(const LevelTable& table, StorageClass storage, int32_t block) {
    const PageShape page = page_shape(storage);
    const int32_t index = block * kTexelsPerBlock;
    const auto past = std::upper_bound(table.offset.begin(), table.offset.begin() + table.levels, index);
    const auto l = size_t(past - table.offset.begin()) - 1;

    const int32_t in_level = index - table.offset[l];
    const int32_t in_slice = in_level % table.slice_stride[l];
    const int32_t page_y = in_slice / table.row_stride[l];
    const int32_t page_x = in_slice % table.row_stride[l] >> page.log2_texels();

    // Even bits of the Morton code are the block's column, odd bits its row.
    const int32_t code = (in_slice & ((1 << page.log2_texels()) - 1)) / kTexelsPerBlock;
    const int32_t column = (code & 1) | (code >> 1 & 2) | (code >> 2 & 4);
    const int32_t row = (code >> 1 & 1) | (code >> 2 & 2) | (code >> 3 & 4);
    return {int(l), in_level / table.slice_stride[l], (page_x << (page.log2_width - 2)) + column, (page_y << (page.log2_height - 2)) + row};
}

}  // namespace rawtexel::texunit
