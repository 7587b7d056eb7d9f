// The masks of blue noise: how they are made, and what the file holds.
#include "tests/reference/texunit/void_and_cluster_reference.h"
#include "tests/stress_scale.h"
#include "texunit/noise/mask_file.h"
#include "texunit/noise_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace rawtexel::texunit {
namespace {

TEST(VoidAndCluster, RanksAsTheMethodWrittenOutDoes) {
    for (const noise::MaskShape shape : {noise::MaskShape{16, 8}, noise::MaskShape{32, 1}, noise::MaskShape{8, 16}}) {
        for (uint32_t seed = 0; seed < 2; ++seed) {
            const noise::VoidAndCluster method{.shape = shape, .seed = seed};
            const std::vector<uint32_t> first = noise::make_mask(method);
            EXPECT_EQ(first, reference::void_and_cluster(method)) << shape.extent << " x " << shape.depth;
            EXPECT_EQ(noise::make_companion(method, first), reference::void_and_cluster(method, first))
                << shape.extent << " x " << shape.depth;
        }
    }
}

void expect_permutation(std::span<const uint32_t> ranks, const char* name) {
    std::vector<int> seen(ranks.size());
    for (const uint32_t rank : ranks) {
        ASSERT_LT(rank, ranks.size()) << name;
        ++seen[rank];
    }
    EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), ptrdiff_t(ranks.size())) << name;
}

TEST(NoiseTable, HoldsEveryRankOnce) {
    for (const NoiseMask* mask : {&stbn_mask(), &blue_mask()}) {
        const char* const name = mask == &stbn_mask() ? "stbn" : "blue";
        EXPECT_EQ(mask->first.size(), size_t(1) << mask->rank_bits) << name;
        expect_permutation(mask->first, name);
        expect_permutation(mask->second, name);
    }
    EXPECT_EQ(stbn_mask().first.size(), 64u * 64 * 32);
    EXPECT_EQ(blue_mask().first.size(), 128u * 128);
}

/// Second numbers come in rounds, each of which has one first number of every stratum.
TEST(NoiseTable, SpreadsItsPairsEvenly) {
    constexpr size_t kStrata = noise::kCompanionStrata;
    for (const NoiseMask* mask : {&stbn_mask(), &blue_mask()}) {
        const size_t size = mask->first.size();
        std::vector<int> count(size);
        for (size_t i = 0; i < size; ++i) ++count[mask->second[i] / kStrata * kStrata + mask->first[i] / (size / kStrata)];
        EXPECT_EQ(std::count(count.begin(), count.end(), 1), ptrdiff_t(size)) << mask->rank_bits << " bits";
    }
}

/// A slice's numbers are nearly uniform by themselves: a frame's mean is right.
TEST(NoiseTable, GivesEverySliceItsShareOfEveryRank) {
    constexpr size_t kCells = 16, kSlice = size_t(kStbnExtent) * kStbnExtent;
    double worst = 0;
    for (const auto ranks : {stbn_mask().first, stbn_mask().second}) {
        for (size_t slice = 0; slice < kStbnDepth; ++slice) {
            std::vector<int> count(kCells);
            for (const uint32_t rank : ranks.subspan(slice * kSlice, kSlice)) ++count[rank * kCells / ranks.size()];
            for (const int found : count) worst = std::max(worst, std::abs(found * double(kCells) / kSlice - 1));
        }
    }
    // A standard deviation of random numbers would be 0.06, and the worst of these 1024 shares 0.2.
    std::printf("shares of a sixteenth are off by %.3f at most\n", worst);
    EXPECT_LT(worst, 0.1);
}

TEST(NoiseTable, IsWhatTheProgramMakes) {
    if (stress_scale() == 1) GTEST_SKIP() << "the masks are made anew under RAWTEXEL_STRESS only: some seconds";
    const std::vector<std::byte> made = noise::make_mask_file();
    const std::span<const std::byte> file = noise_mask_file();
    ASSERT_EQ(made.size(), file.size());
    EXPECT_TRUE(std::equal(made.begin(), made.end(), file.begin()));
}

}  // namespace
}  // namespace rawtexel::texunit
