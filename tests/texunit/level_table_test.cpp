#include "texunit/level_table.h"

#include <gtest/gtest.h>

#include <set>
#include <vector>

namespace rawtexel::texunit {
namespace {

constexpr StorageClass kStorageClasses[] = {StorageClass::Packed32, StorageClass::Packed64, StorageClass::Half4, StorageClass::Float4};

Shape pyramid(int width, int height, int depth = 1, int layers = 1) {
    return {.width = width, .height = height, .depth = depth, .layers = layers, .levels = full_level_count(width, height, depth)};
}

class LevelTableTest : public testing::TestWithParam<StorageClass> {};
INSTANTIATE_TEST_SUITE_P(Classes, LevelTableTest, testing::ValuesIn(kStorageClasses));

TEST_P(LevelTableTest, GivesEveryTexelAnIndexOfItsOwnAndEveryBlockItsPlaceBack) {
    for (const Shape& shape :
         {pyramid(1, 1), pyramid(3, 5), pyramid(70, 33), pyramid(1, 200), pyramid(129, 1), pyramid(20, 24, 6), pyramid(37, 9, 1, 6)}) {
        LevelTable table;
        ASSERT_TRUE(lay_out_levels(shape, GetParam(), table));
        std::vector<bool> taken(table.texels);
        for (int level = 0; level < shape.levels; ++level) {
            const int slices = shape.layers * level_extent(shape.depth, level);
            for (int slice = 0; slice < slices; ++slice) {
                for (int y = 0; y < level_extent(shape.height, level); ++y) {
                    for (int x = 0; x < level_extent(shape.width, level); ++x) {
                        const int32_t index = texel_index(table, GetParam(), level, slice, x, y);
                        ASSERT_GE(index, 0);
                        ASSERT_LT(uint64_t(index), table.texels);
                        ASSERT_FALSE(taken[size_t(index)]) << "level " << level << " slice " << slice << " texel " << x << ',' << y;
                        taken[size_t(index)] = true;
                        ASSERT_EQ(index % kTexelsPerBlock, 4 * (y % 4) + x % 4);
                        ASSERT_EQ(locate_block(table, GetParam(), index / kTexelsPerBlock), (BlockPosition{level, slice, x / 4, y / 4}));
                    }
                }
            }
        }
    }
}

TEST_P(LevelTableTest, KeepsTheTexelsOfA4KiBPageTogether) {
    const PageShape page = page_shape(GetParam());
    EXPECT_EQ((1 << page.log2_texels()) * bytes_per_texel(GetParam()), 4096);
    LevelTable table;
    ASSERT_TRUE(lay_out_levels(pyramid(256, 256), GetParam(), table));
    std::set<int32_t> pages;
    for (int y = 0; y < 1 << page.log2_height; ++y) {
        for (int x = 0; x < 1 << page.log2_width; ++x) {
            const int32_t index = texel_index(table, GetParam(), 0, 0, (3 << page.log2_width) + x, (2 << page.log2_height) + y);
            pages.insert(index >> page.log2_texels());
        }
    }
    EXPECT_EQ(pages.size(), 1u);
    for (int level = 0; level < table.levels; ++level) EXPECT_EQ(table.offset[size_t(level)] % (1 << page.log2_texels()), 0);
}

TEST(LevelTable, OrdersTheBlocksOfAPageByMortonCode) {
    LevelTable table;
    ASSERT_TRUE(lay_out_levels(pyramid(64, 64), StorageClass::Packed32, table));
    const auto block = [&](int x, int y) { return texel_index(table, StorageClass::Packed32, 0, 0, 4 * x, 4 * y) / kTexelsPerBlock; };
    EXPECT_EQ(block(0, 0), 0);
    EXPECT_EQ(block(1, 0), 1);
    EXPECT_EQ(block(0, 1), 2);
    EXPECT_EQ(block(1, 1), 3);
    EXPECT_EQ(block(2, 0), 4);
    EXPECT_EQ(block(0, 2), 8);
    EXPECT_EQ(block(7, 7), 63);
    EXPECT_EQ(block(8, 0), 64) << "the next page to the right";
    EXPECT_EQ(block(0, 8), 128) << "the next row of pages";
}

TEST_P(LevelTableTest, HoldsTheLargestTextureAndRefusesWhatAGatherCannotReach) {
    LevelTable table;
    EXPECT_TRUE(lay_out_levels(pyramid(kMaxExtent, kMaxExtent), GetParam(), table));
    EXPECT_GE(table.texels, uint64_t{kMaxExtent} * kMaxExtent * 4 / 3);
    EXPECT_LT(table.texels * uint64_t(bytes_per_texel(GetParam())) / 4, uint64_t{1} << 31);
    EXPECT_FALSE(lay_out_levels(pyramid(kMaxExtent, kMaxExtent, kMaxExtent), GetParam(), table));
    EXPECT_FALSE(lay_out_levels(pyramid(kMaxExtent, kMaxExtent, 1, 1 << 30), GetParam(), table));
}

}  // namespace
}  // namespace rawtexel::texunit
