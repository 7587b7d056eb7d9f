// The quality of addressed random numbers: uniform, every input bit matters, no relation between pixels, samples, surfaces and roles.
#include "texunit/random.h"

#include "tests/stress/worst_case.h"
#include "tests/texunit/uniformity.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <random>
#include <vector>

namespace rawtexel::texunit {
namespace {

constexpr Dimension kDimensions[] = {Dimension::PixelX,   Dimension::PixelY, Dimension::TapX,  Dimension::TapY,
                                     Dimension::TapZ,     Dimension::Level,  Dimension::Probe, Dimension::Sign,
                                     Dimension::Coverage, Dimension::Layer,  Dimension::Light, Dimension::Plane};

/// About 1e-6 two-sided over all the statistics of this file: 5.5 standard deviations. Too uniform is wrong as well.
constexpr double kLimit = 5.5;

using Walk = std::function<RandomAddress(uint32_t n)>;
struct NamedWalk {
    const char* name;
    Walk address;
};

/// One word runs, the others stand: the ways in which a renderer asks.
const NamedWalk kWalks[] = {
    {"pixels of a row", [](uint32_t n) { return RandomAddress{.x = n}; }},
    {"pixels of a column", [](uint32_t n) { return RandomAddress{.y = n}; }},
    {"pixels of a tile", [](uint32_t n) { return RandomAddress{.x = n % 512, .y = n / 512}; }},
    {"samples of a pixel", [](uint32_t n) { return RandomAddress{.x = 3, .y = 4, .sample = n}; }},
    {"surfaces of a pixel", [](uint32_t n) { return RandomAddress{.x = 3, .y = 4, .surface = n}; }},
    {"seeds", [](uint32_t n) { return RandomAddress{.seed = n}; }},
    {"everything",
     [](uint32_t n) {
         return RandomAddress{.x = n % 16, .y = n / 16 % 16, .sample = n / 256 % 16, .surface = n / 4096 % 16, .seed = n / 65536};
     }},
};
constexpr uint32_t kCount = 1 << 18;

TEST(Random, IsUniformAlongEveryWordOfTheAddress) {
    double worst = 0;
    uint64_t numbers = 0;
    for (const NamedWalk& walk : kWalks) {
        for (const Dimension dimension : kDimensions) {
            std::vector<uint64_t> high(256), low(256);
            for (uint32_t n = 0; n < kCount; ++n) {
                RandomAddress address = walk.address(n);
                address.dimension = dimension;
                const uint32_t bits = random_bits(address);
                ++high[bits >> 24];
                ++low[bits & 255];
            }
            worst = std::max({worst, std::abs(unevenness(high)), std::abs(unevenness(low))});
            EXPECT_LT(std::abs(unevenness(high)), kLimit) << "high bits, " << walk.name << ", dimension " << int(dimension);
            EXPECT_LT(std::abs(unevenness(low)), kLimit) << "low bits, " << walk.name << ", dimension " << int(dimension);
            numbers += kCount;
        }
    }
    tell_tested(numbers, "random numbers");
    tell_worst_case("largest_deviate", worst);
}

/// Pairs of numbers from neighbouring addresses fill the square evenly.
void expect_independent(const char* name, const Walk& first, const Walk& second) {
    std::vector<uint64_t> cells(32 * 32);
    for (uint32_t n = 0; n < kCount; ++n) ++cells[random_bits(first(n)) >> 27 << 5 | random_bits(second(n)) >> 27];
    EXPECT_LT(std::abs(unevenness(cells)), kLimit) << name;
}

TEST(Random, IsIndependentBetweenNeighbouringAddresses) {
    for (const NamedWalk& walk : kWalks) {
        const auto with = [&](const std::function<void(RandomAddress&)>& change) -> Walk {
            return [&walk, change](uint32_t n) {
                RandomAddress address = walk.address(n);
                change(address);
                return address;
            };
        };
        for (const uint32_t step : {1u, 2u, 64u}) {
            expect_independent(walk.name, walk.address, with([=](RandomAddress& a) { a.x += step; }));
            expect_independent(walk.name, walk.address, with([=](RandomAddress& a) { a.y += step; }));
            expect_independent(walk.name, walk.address, with([=](RandomAddress& a) { a.sample += step; }));
            expect_independent(walk.name, walk.address, with([=](RandomAddress& a) { a.surface += step; }));
            expect_independent(walk.name, walk.address, with([=](RandomAddress& a) { a.seed += step; }));
        }
    }
}

TEST(Random, IsIndependentBetweenAllPairsOfRoles) {
    const Walk& samples = kWalks[6].address;
    for (const Dimension first : kDimensions) {
        for (const Dimension second : kDimensions) {
            if (first >= second) continue;
            const auto with = [&](Dimension dimension) -> Walk {
                return [&samples, dimension](uint32_t n) {
                    RandomAddress address = samples(n);
                    address.dimension = dimension;
                    return address;
                };
            };
            expect_independent("roles", with(first), with(second));
        }
    }
}

TEST(Random, ChangesHalfOfItsBitsWhenOneInputBitChanges) {
    std::mt19937 draw(1);
    constexpr int kTrials = 4096;
    uint32_t RandomAddress::*const words[] = {&RandomAddress::x, &RandomAddress::y, &RandomAddress::sample, &RandomAddress::surface,
                                              &RandomAddress::seed};
    for (uint32_t RandomAddress::*const word : words) {
        for (int in = 0; in < 32; ++in) {
            int flips[32] = {};
            for (int n = 0; n < kTrials; ++n) {
                const auto any = [&] { return uint32_t(draw()); };
                RandomAddress address{any(), any(), any(), any(), Dimension::TapX, any()};
                uint32_t change = random_bits(address);
                address.*word ^= 1u << in;
                change ^= random_bits(address);
                for (int out = 0; out < 32; ++out) flips[out] += change >> out & 1;
            }
            // 5 160 frequencies are compared with 1/2: 6 standard deviations.
            for (int out = 0; out < 32; ++out) {
                ASSERT_NEAR(flips[out], kTrials / 2, 6 * std::sqrt(kTrials) / 2) << "bit " << in << " to " << out;
            }
        }
    }
}

TEST(Random, FloatsStayBelowOne) {
    EXPECT_EQ(unit_float(0), 0.0f);
    EXPECT_EQ(unit_float(0xFFFFFFFFu), 1 - 0x1p-24f);
    double sum = 0;
    for (uint32_t n = 0; n < kCount; ++n) sum += random_float({.x = n, .dimension = Dimension::Light});
    EXPECT_NEAR(sum / kCount, 0.5, 5 / std::sqrt(12.0 * kCount));
}

TEST(Random, IsFixedForAllTime) {
    // Images are reproduced by their seed: these numbers may never change.
    EXPECT_EQ(random_bits(RandomAddress{}), 2656661683u);
    const RandomAddress somewhere{.x = 1919, .y = 1079, .sample = 63, .surface = 123456, .dimension = Dimension::Coverage, .seed = 7};
    EXPECT_EQ(random_bits(somewhere), 507926182u);
}

}  // namespace
}  // namespace rawtexel::texunit
