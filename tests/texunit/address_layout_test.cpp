#include "texunit/address_layout.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace rawtexel::texunit {
namespace {

class AddressLayouts : public testing::TestWithParam<AddressLayout> {};

TEST_P(AddressLayouts, GiveEveryElementItsOwnBytes) {
    for (const auto& [columns, rows] : {std::pair{1, 1}, {5, 3}, {64, 64}, {100, 7}, {3, 130}, {257, 129}}) {
        for (const int bytes : {1, 2, 4, 8, 16}) {
            const SliceAddresses addresses(GetParam(), columns, rows, bytes);
            std::set<uint64_t> offsets;
            for (int y = 0; y < rows; ++y) {
                for (int x = 0; x < columns; ++x) {
                    const uint64_t offset = addresses.offset(x, y);
                    EXPECT_TRUE(offsets.insert(offset).second) << columns << 'x' << rows << ' ' << x << ',' << y;
                    EXPECT_EQ(offset % uint64_t(bytes), 0u);
                    EXPECT_LE(offset + uint64_t(bytes), addresses.bytes());
                }
            }
            EXPECT_EQ(addresses.bytes() % 128, 0u);
        }
    }
}

TEST_P(AddressLayouts, AreReadBackAsTheyArePrinted) { EXPECT_EQ(parse_address_layout(to_string(GetParam())), GetParam()); }

INSTANTIATE_TEST_SUITE_P(All, AddressLayouts, testing::ValuesIn(kAddressLayouts), [](const auto& tested) {
    std::string name(to_string(tested.param));
    std::erase(name, '-');
    return name;
});

TEST(AddressLayout, KnowsNoOtherNames) {
    EXPECT_FALSE(parse_address_layout("tiled"));
    EXPECT_FALSE(parse_address_layout(""));
}

TEST(AddressLayout, LinearGoesRowByRow) {
    const SliceAddresses addresses(AddressLayout::Linear, 10, 4, 4);
    EXPECT_EQ(addresses.offset(3, 2), (2 * 10 + 3) * 4u);
    EXPECT_EQ(addresses.bytes(), 256u) << "160 bytes, in lines of 128";
}

TEST(AddressLayout, MortonInterleavesTheBitsThatBothExtentsHave) {
    const SliceAddresses square(AddressLayout::Morton, 8, 8, 1);
    EXPECT_EQ(square.offset(5, 3), 0b011011u) << "x = 101, y = 011";
    const SliceAddresses wide(AddressLayout::Morton, 32, 4, 1);
    EXPECT_EQ(wide.offset(0b10110, 0b01), 0b1010110u) << "x's three upper bits stand above";
    const SliceAddresses high(AddressLayout::Morton, 2, 16, 2);
    EXPECT_EQ(high.offset(1, 0b1011), 2 * 0b10111u);
}

TEST(AddressLayout, TilesHaveTheExtentsOfTheStandardShapes) {
    // Vulkan "Standard Sparse Image Block Shapes (Single Sample)", 2-D: 256x256, 256x128, 128x128, 128x64, 64x64 for 8 to 128 bits.
    const std::pair<int, std::pair<int, int>> shapes[] = {
        {1, {256, 256}}, {2, {256, 128}}, {4, {128, 128}}, {8, {128, 64}}, {16, {64, 64}}};
    for (const auto& [bytes, extent] : shapes) {
        const SliceAddresses addresses(AddressLayout::Tiled64K, 512, 512, bytes);
        EXPECT_EQ(addresses.offset(extent.first, 0), 65536u) << bytes;
        EXPECT_EQ(addresses.offset(0, extent.second), 65536u * uint64_t(512 / extent.first)) << bytes;
        EXPECT_LT(addresses.offset(extent.first - 1, extent.second - 1), 65536u) << bytes;
    }
    const SliceAddresses page(AddressLayout::Tiled4K, 64, 64, 4);
    EXPECT_EQ(page.offset(32, 0), 4096u);
    EXPECT_EQ(page.offset(31, 31), 4092u);
}

}  // namespace
}  // namespace rawtexel::texunit
