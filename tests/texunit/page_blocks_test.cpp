#include "texunit/page_blocks.h"

#include "texunit/level_table.h"

#include <gtest/gtest.h>

namespace rawtexel::texunit {
namespace {

TEST(PageBlocks, AreNumberedAsTheLevelTableNumbersThem) {
    LevelTable table;
    ASSERT_TRUE(lay_out_levels({.width = 32, .height = 32}, StorageClass::Packed32, table));
    for (int first = 0; first < 8; ++first) {
        for (int last = first; last < 8; ++last) {
            for (int y = 0; y < 8; ++y) {
                for (int x = 0; x < 8; ++x) {
                    const int block = texel_index(table, StorageClass::Packed32, 0, 0, 4 * x, 4 * y) / kTexelsPerBlock;
                    EXPECT_EQ(kPageBlocks.columns_between(first, last) >> block & 1, uint64_t(x >= first && x <= last)) << x << ',' << y;
                    EXPECT_EQ(kPageBlocks.rows_between(first, last) >> block & 1, uint64_t(y >= first && y <= last)) << x << ',' << y;
                }
            }
        }
    }
}

}  // namespace
}  // namespace rawtexel::texunit
