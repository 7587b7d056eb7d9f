// What holds for every noise: its numbers are uniform, unrelated between roles, and the same wherever and by whatever they are computed.
#include "texunit/noise.h"

#include "tests/stress/worst_case.h"
#include "tests/texunit/every_simd.h"
#include "tests/texunit/uniformity.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace rawtexel::texunit {
namespace {

/// About 1e-6 over all the statistics of this file, some 500.
constexpr double kLimit = 6.0;

RandomAddress random_address(std::mt19937& random) {
    return {.x = uint32_t(random()) & 0x3FFF,
            .y = uint32_t(random()) & 0x3FFF,
            .sample = uint32_t(random()) >> (random() % 32),
            .surface = random() % 2 == 0 ? 0 : uint32_t(random()),
            .dimension = Dimension(random() % 16),
            .seed = uint32_t(random())};
}

/// The first and the second numbers of pairs.
struct Pairs {
    WaveFloat a, b;
    Pairs(Noise noise, const RandomAddress& first, Dimension second) { noise_pair_wave(noise, first, second, a, b); }
};
WaveFloat singles(Noise noise, const RandomAddress& first) {
    WaveFloat numbers;
    noise_wave(noise, first, numbers);
    return numbers;
}
bool same_bits(const WaveFloat& a, const WaveFloat& b) { return std::equal(a.lane, a.lane + kWaveLanes, b.lane); }

TEST(Noise, NamesReadBack) {
    ASSERT_EQ(all_noises().size(), 5u);
    for (const NoiseInfo& known : all_noises()) {
        EXPECT_EQ(to_string(known.noise), known.name);
        EXPECT_EQ(parse_noise(known.name), known.noise);
        EXPECT_FALSE(known.description.empty());
    }
    for (const char* wrong : {"", "White", "pink", "r2 ", "stb"}) EXPECT_EQ(parse_noise(wrong), std::nullopt) << wrong;
}

TEST(Noise, IsWhatItIsOnEveryInstructionSet) {
    for (const NoiseInfo& known : all_noises()) {
        std::mt19937 random(1);
        for (int n = 0; n < 200; ++n) {
            const RandomAddress first = random_address(random);
            const auto second = Dimension(random() % 16);
            choose_simd(Simd::Scalar);
            const WaveFloat single = singles(known.noise, first);
            const Pairs pairs(known.noise, first, second);
            on_every_simd([&] {
                EXPECT_TRUE(same_bits(singles(known.noise, first), single)) << known.name << " on " << to_string(chosen_simd());
                const Pairs others(known.noise, first, second);
                EXPECT_TRUE(same_bits(others.a, pairs.a)) << known.name << " on " << to_string(chosen_simd());
                EXPECT_TRUE(same_bits(others.b, pairs.b)) << known.name << " on " << to_string(chosen_simd());
            });
        }
    }
}

TEST(Noise, WhiteIsTheHashOfTheAddress) {
    std::mt19937 random(2);
    for (int n = 0; n < 100; ++n) {
        const RandomAddress first = random_address(random);
        const Pairs pairs(Noise::White, first, Dimension::Light);
        for (uint32_t lane = 0; lane < kWaveLanes; ++lane) {
            RandomAddress address = first;
            address.x += lane % 8, address.y += lane / 8;
            EXPECT_EQ(pairs.a[int(lane)], random_float(address));
            address.dimension = Dimension::Light;
            EXPECT_EQ(pairs.b[int(lane)], random_float(address));
        }
    }
}

TEST(Noise, FirstOfAPairIsTheSingleNumber) {
    std::mt19937 random(3);
    for (const NoiseInfo& known : all_noises()) {
        for (int n = 0; n < 100; ++n) {
            const RandomAddress first = random_address(random);
            EXPECT_TRUE(same_bits(Pairs(known.noise, first, Dimension::TapY).a, singles(known.noise, first))) << known.name;
        }
    }
}

TEST(Noise, BelongsToThePixelWhateverTheWave) {
    std::mt19937 random(4);
    for (const NoiseInfo& known : all_noises()) {
        for (int n = 0; n < 50; ++n) {
            const RandomAddress first = random_address(random);
            RandomAddress moved = first;
            moved.x += 3, moved.y += 2;
            const Pairs here(known.noise, first, Dimension::TapY), there(known.noise, moved, Dimension::TapY);
            for (int y = 0; y < 2; ++y) {
                for (int x = 0; x < 5; ++x) {
                    EXPECT_EQ(there.a[8 * y + x], here.a[8 * (y + 2) + x + 3]) << known.name;
                    EXPECT_EQ(there.b[8 * y + x], here.b[8 * (y + 2) + x + 3]) << known.name;
                }
            }
        }
    }
}

TEST(Noise, IsAMultipleOf2ToMinus24BelowOne) {
    float greatest = 0;
    std::mt19937 random(5);
    for (const NoiseInfo& known : all_noises()) {
        float most = 0, least = 1;
        uint32_t lowest_bits = 0;
        for (int n = 0; n < 20000; ++n) {
            const Pairs pairs(known.noise, random_address(random), Dimension::TapY);
            for (const WaveFloat& numbers : {pairs.a, pairs.b}) {
                for (const float number : numbers.lane) {
                    const float steps = number * 0x1p24f;
                    ASSERT_TRUE(number >= 0 && number < 1 && steps == float(uint32_t(steps))) << known.name << ": " << number;
                    most = std::max(most, number), least = std::min(least, number);
                    lowest_bits += uint32_t(steps) & 1;
                }
            }
        }
        // 1 280 000 numbers: the whole range is used, to the last bit.
        greatest = std::max(greatest, most);
        EXPECT_LT(least, 2e-5f) << known.name;
        EXPECT_GT(most, 1 - 2e-5f) << known.name;
        EXPECT_NEAR(lowest_bits, 640000, 6 * 566) << known.name;
    }
    tell_tested(all_noises().size() * 1280000, "random numbers");
    tell_worst_case("largest_number_below_one_by", 1.0 - double(greatest));
}

/// Counts of numbers by their upper bits and by their lowest 8, and of pairs of numbers.
struct Counts {
    std::vector<uint64_t> high = std::vector<uint64_t>(256), low = high, cells = std::vector<uint64_t>(32 * 32);

    void add(float a, float b) {
        for (const float number : {a, b}) {
            const auto steps = uint32_t(number * 0x1p24f);
            ++high[steps >> 16];
            ++low[steps & 255];
        }
        ++cells[uint32_t(a * 32) * 32 + uint32_t(b * 32)];
    }
    void expect_even(std::string_view noise, const char* what) {
        EXPECT_LT(unevenness(high), kLimit) << noise << ": upper bits, " << what;
        EXPECT_LT(unevenness(low), kLimit) << noise << ": lower bits, " << what;
        EXPECT_LT(unevenness(cells), kLimit) << noise << ": pairs, " << what;
    }
};

TEST(Noise, IsUniformOverTheSamplesOfAPixel) {
    for (const NoiseInfo& known : all_noises()) {
        for (const uint32_t surface : {0u, 77u}) {
            Counts counts[3];
            for (uint32_t sample = 0; sample < 1 << 16; ++sample) {
                const Pairs pairs(known.noise, {16, 20, sample, surface, Dimension::TapX}, Dimension::TapY);
                for (int i = 0; i < 3; ++i) counts[i].add(pairs.a[11 * i], pairs.b[11 * i]);
            }
            for (Counts& of : counts) of.expect_even(known.name, "over samples");
        }
    }
}

TEST(Noise, IsUniformOverPixels) {
    for (const NoiseInfo& known : all_noises()) {
        for (const Dimension dimension : {Dimension::TapX, Dimension::Level}) {
            Counts counts;
            // As many pixels as the smaller mask has: what repeats is less even than chance.
            for (uint32_t sample = 0; sample < 16; ++sample) {
                for (uint32_t wave = 0; wave < 8 * 16; ++wave) {
                    const RandomAddress first{wave % 8 * 8, wave / 8 * 4, 9 * sample, 0, dimension};
                    const Pairs pairs(known.noise, first, Dimension::TapY);
                    for (int lane = 0; lane < kWaveLanes; ++lane) counts.add(pairs.a[lane], pairs.b[lane]);
                }
            }
            counts.expect_even(known.name, "over pixels");
        }
    }
}

/// Waves, samples and seeds whose numbers are compared. There are no more pixels than the smaller mask has.
struct Walk {
    uint32_t columns, rows, samples, seeds;
};
constexpr Walk kOverSamples{1, 1, 4096, 1}, kOverPixels{8, 16, 1, 32};

/// The numbers of two addresses that share pixel and sample.
void expect_unrelated(const NoiseInfo& known, const RandomAddress& a, const RandomAddress& b, const Walk& walk) {
    Counts counts;
    const auto add = [&](const RandomAddress& at) {
        const auto of = [&](const RandomAddress& word) {
            return singles(known.noise, {at.x, at.y, at.sample, word.surface, word.dimension, word.seed + at.seed});
        };
        const WaveFloat first = of(a), second = of(b);
        for (int lane = 0; lane < kWaveLanes; ++lane) counts.add(first[lane], second[lane]);
    };
    for (uint32_t seed = 0; seed < walk.seeds; ++seed) {
        for (uint32_t sample = 0; sample < walk.samples; ++sample) {
            for (uint32_t wave = 0; wave < walk.columns * walk.rows; ++wave)
                add({.x = wave % walk.columns * 8, .y = wave / walk.columns * 4, .sample = sample, .seed = seed});
        }
    }
    EXPECT_LT(unevenness(counts.cells), kLimit)
        << known.name << ": roles " << int(a.dimension) << " and " << int(b.dimension) << ", surfaces " << a.surface << " and " << b.surface
        << ", seeds " << a.seed << " and " << b.seed << ", over " << walk.samples << " samples and " << walk.seeds << " seeds";
}

TEST(Noise, IsUnrelatedBetweenRolesSurfacesAndSeeds) {
    const Dimension roles[] = {Dimension::TapX, Dimension::TapZ,     Dimension::Level,     Dimension::Probe,
                               Dimension::Sign, Dimension::Coverage, Dimension::NegativeX, Dimension(16)};
    for (const NoiseInfo& known : all_noises()) {
        for (const Dimension first : roles) {
            for (const Walk& walk : {kOverSamples, kOverPixels}) {
                for (const Dimension second : roles) {
                    if (first < second) expect_unrelated(known, {.dimension = first}, {.dimension = second}, walk);
                }
                expect_unrelated(known, {.dimension = first}, {.surface = 1, .dimension = first}, walk);
                expect_unrelated(known, {.surface = 1, .dimension = first}, {.surface = 2, .dimension = first}, walk);
            }
            expect_unrelated(known, {.dimension = first}, {.dimension = first, .seed = 1000}, kOverPixels);
        }
    }
}

}  // namespace
}  // namespace rawtexel::texunit
