#include "shading/accumulation.h"

#include "tests/stress/worst_case.h"
#include "tests/stress_scale.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <random>

namespace rawtexel::shading {
namespace {

constexpr size_t kWidth = 37;

std::vector<float> sample_values(uint64_t sample) {
    std::mt19937 random(uint32_t(sample * 2654435761u + 1));
    std::uniform_real_distribution<float> value(-1.0f, 3.0f);
    std::vector<float> values(kWidth);
    for (float& v : values) v = value(random);
    return values;
}

SampleTree tree_of(uint64_t first, uint64_t last) {
    SampleTree tree(kWidth);
    for (uint64_t sample = first; sample < last; ++sample) tree.add(sample, sample_values(sample));
    return tree;
}

std::vector<double> sum_of(const SampleTree& tree) {
    std::vector<double> sum(kWidth);
    tree.sum(0, sum);
    return sum;
}

/// The definition, by recursion: float up to 16 samples, double above.
double range_sum(uint64_t first, uint64_t count, size_t entry) {
    if (count == 1) return double(sample_values(first)[entry]);
    const double left = range_sum(first, count / 2, entry), right = range_sum(first + count / 2, count / 2, entry);
    return count <= 16 ? double(float(left) + float(right)) : left + right;
}

TEST(SampleTree, IsTheFixedTreeOverAlignedRanges) {
    for (const uint64_t count : {1u, 2u, 3u, 4u, 15u, 16u, 17u, 31u, 32u, 33u, 100u}) {
        const std::vector<double> sum = sum_of(tree_of(0, count));
        for (size_t entry = 0; entry < kWidth; entry += 9) {
            // The bits of the count are the ranges, the longest first; they are added from the last on.
            double expected = 0;
            uint64_t end = count;
            for (uint64_t size = 1; size <= count; size *= 2) {
                if ((count & size) == 0) continue;
                expected += range_sum(end - size, size, entry);
                end -= size;
            }
            ASSERT_EQ(sum[entry], expected) << "entry " << entry << " of " << count << " samples";
        }
    }
}

TEST(SampleTree, MergesPartsMadeApartToTheSameBits) {
    const uint64_t count = 333;
    const std::vector<double> whole = sum_of(tree_of(0, count));
    std::mt19937 random(7);
    for (int trial = 0; trial < 50; ++trial) {
        std::vector<uint64_t> cuts = {0, count};
        for (int i = 0; i < 5; ++i) cuts.push_back(random() % count);
        std::sort(cuts.begin(), cuts.end());
        std::vector<SampleTree> parts;
        for (size_t i = 0; i + 1 < cuts.size(); ++i) parts.push_back(tree_of(cuts[i], cuts[i + 1]));
        std::shuffle(parts.begin(), parts.end(), random);
        SampleTree merged(kWidth);
        for (const SampleTree& part : parts) merged.merge(part);
        ASSERT_EQ(merged.samples(), count);
        ASSERT_EQ(sum_of(merged), whole) << "trial " << trial;
    }
}

TEST(SampleTree, DoesNotDependOnTheOrderOfSamples) {
    const uint64_t count = 100;
    std::vector<uint64_t> order(count);
    for (uint64_t i = 0; i < count; ++i) order[i] = i;
    std::shuffle(order.begin(), order.end(), std::mt19937(3));
    SampleTree tree(kWidth);
    for (const uint64_t sample : order) tree.add(sample, sample_values(sample));
    EXPECT_EQ(sum_of(tree), sum_of(tree_of(0, count)));
}

TEST(SampleTree, GivesTheMeanOfAnyPart) {
    const SampleTree tree = tree_of(0, 48);
    std::vector<float> mean(kWidth - 5);
    tree.mean(5, mean);
    const std::vector<double> sum = sum_of(tree);
    for (size_t i = 0; i < mean.size(); ++i) ASSERT_EQ(mean[i], float(sum[i + 5] / 48.0)) << i;
}

TEST(SampleTree, ScaledSumsAreTheMeanToTheBit) {
    for (const uint64_t count : {1, 2, 3, 4, 8, 12, 16, 32}) {
        const SampleTree tree = tree_of(0, count);
        const auto scaled = tree.scaled_sums();
        // One sum of floats holds powers of two up to sixteen.
        ASSERT_EQ(scaled.has_value(), count <= 16 && (count & (count - 1)) == 0) << count;
        if (!scaled) continue;
        std::vector<float> mean(kWidth);
        tree.mean(0, mean);
        const std::vector<double> sum = sum_of(tree);
        ASSERT_EQ(scaled->sum.size(), size_t(kWidth));
        for (size_t i = 0; i < mean.size(); ++i) {
            ASSERT_EQ(mean[i], float(sum[i] / double(count))) << i;
            ASSERT_EQ(scaled->sum[i] * scaled->share, mean[i]) << i;
        }
    }
}

TEST(SampleTree, TakesWavesAsItAddsValues) {
    constexpr size_t kWaves = 3, kValues = kWaves * texunit::kWaveLanes;
    SampleTree added(kValues), taken(kValues);
    std::vector<texunit::WaveFloat> waves(kWaves);
    for (uint64_t round = 0; round < 2; ++round) {
        for (uint64_t sample = 0; sample < 37; ++sample) {
            std::vector<float> values;
            for (size_t part = 0; values.size() < kValues; ++part)
                std::ranges::copy(sample_values(100 * sample + part), std::back_inserter(values));
            values.resize(kValues);
            for (size_t i = 0; i < kValues; ++i) waves[i / texunit::kWaveLanes][int(i % texunit::kWaveLanes)] = values[i];
            added.add(sample, values);
            taken.take(sample, waves);
            ASSERT_EQ(waves.size(), kWaves);
        }
        std::vector<double> sum(kValues), expected(kValues);
        taken.sum(0, sum);
        added.sum(0, expected);
        ASSERT_EQ(sum, expected);
        ASSERT_EQ(taken.samples(), 37u);
        taken.clear();
        added.clear();
    }
}

TEST(SampleTree, HoldsEqualSamplesExactly) {
    SampleTree tree(1);
    const float value = 1.0f + 0x1p-20f;
    for (uint64_t sample = 0; sample < 100000; ++sample) tree.add(sample, std::vector<float>{value});
    float mean = 0;
    tree.mean(0, {&mean, 1});
    EXPECT_EQ(mean, value);
    tell_worst_case("mean_off_by", std::abs(double(mean) - double(value)));
}

TEST(SampleTree, StartsAgainAfterClear) {
    SampleTree tree = tree_of(0, 77);
    tree.clear();
    EXPECT_EQ(tree.samples(), 0u);
    EXPECT_EQ(sum_of(tree), std::vector<double>(kWidth, 0.0));
    for (uint64_t sample = 0; sample < 20; ++sample) tree.add(sample, sample_values(sample));
    EXPECT_EQ(sum_of(tree), sum_of(tree_of(0, 20)));
}

/// Radiance of all sizes: the tree's float sums of 16 and double sums above stay near a sum with twice the precision of a double.
TEST(SampleTree, HoldsUnequalSamplesToSingleRounding) {
    const uint64_t count = uint64_t(5'000'000) * uint64_t(stress_scale());
    SampleTree tree(3);
    std::array<long double, 3> sums{};
    std::minstd_rand random(7);
    for (uint64_t sample = 0; sample < count; ++sample) {
        // Dim, ordinary, and rare and bright.
        const float unit = float(random()) * 0x1p-31f;
        const std::array<float, 3> values{unit * 1e-6f, unit, sample % 1009 == 0 ? unit * 1e5f : unit};
        tree.add(sample, values);
        for (size_t i = 0; i < 3; ++i) sums[i] += (long double)(values[i]);
    }
    std::array<double, 3> sum{};
    tree.sum(0, sum);
    double worst = 0;
    for (size_t i = 0; i < 3; ++i) worst = std::max(worst, std::abs(double(((long double)(sum[i]) - sums[i]) / sums[i])));
    tell_tested(count, "summands");
    tell_worst_case("sum_off_by", worst);
    // Four roundings of floats are not all one way.
    EXPECT_LT(worst, 0x1p-24);
}

}  // namespace
}  // namespace rawtexel::shading
