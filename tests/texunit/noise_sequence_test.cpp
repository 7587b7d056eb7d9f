// The samples of a pixel by sobol and r2: nets, low discrepancy, and randomisation as good as the slow, exact one.
#include "texunit/noise_sequence.h"

#include "texunit/noise.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace rawtexel::texunit {
namespace {

struct Point {
    double x, y;
};

/// Samples begin, begin + 1, … of a wave's pixels: points[lane][n].
std::vector<std::vector<Point>> samples_of(Noise noise, RandomAddress first, Dimension second, uint32_t begin, uint32_t count) {
    std::vector<std::vector<Point>> points(kWaveLanes);
    for (uint32_t n = 0; n < count; ++n) {
        first.sample = begin + n;
        WaveFloat a, b;
        noise_pair_wave(noise, first, second, a, b);
        for (int lane = 0; lane < kWaveLanes; ++lane) points[size_t(lane)].push_back({double(a[lane]), double(b[lane])});
    }
    return points;
}

/// Whether each of the 2^bits boxes of 2^-wide x 2^-(bits - wide) holds one point.
bool fills_boxes(const std::vector<Point>& points, int bits, int wide) {
    std::vector<bool> filled(points.size());
    for (const Point& point : points)
        filled[(size_t(std::ldexp(point.x, wide)) << (bits - wide)) + size_t(std::ldexp(point.y, bits - wide))] = true;
    return std::count(filled.begin(), filled.end(), true) == ptrdiff_t(filled.size());
}

TEST(Sobol, AlignedBlocksOfSamplesAreNets) {
    int cases = 0;
    for (const RandomAddress& first : {RandomAddress{.dimension = Dimension::TapX},
                                       RandomAddress{.x = 1000, .y = 4, .surface = 9, .dimension = Dimension::NegativeX, .seed = 3}}) {
        for (int bits = 0; bits <= 9; ++bits) {
            for (const uint32_t block : {0u, 1u, 6u, 0x80000000u >> bits, 0xFFFFFFFFu >> bits}) {
                const auto pixels = samples_of(Noise::Sobol, first, Dimension::TapY, block << bits, 1u << bits);
                for (const std::vector<Point>& points : pixels) {
                    for (int wide = 0; wide <= bits; ++wide, ++cases)
                        ASSERT_TRUE(fills_boxes(points, bits, wide))
                            << "2^" << bits << " samples from block " << block << ", 2^" << wide << " columns";
                }
            }
        }
    }
    std::printf("%d sets of boxes, each with one point\n", cases);
}

/// Sobol's second dimension by its direction numbers: each is the one before, and that shifted by a bit.
uint32_t second_dimension(uint32_t index) {
    uint32_t number = 0, direction = 0x80000000u;
    for (; index != 0; index >>= 1, direction ^= direction >> 1) number ^= (index & 1) != 0 ? direction : 0;
    return number;
}

TEST(Sobol, IsTheSequenceShuffledAndScrambled) {
    const auto scrambled = [](uint32_t number, uint32_t key) { return reverse_bits(scramble_reversed(reverse_bits(number), key)); };
    for (const uint32_t sample : {0u, 1u, 63u, 0x80000000u, 0xFFFFFFFFu}) {
        const RandomAddress first{.x = 48, .y = 20, .sample = sample, .surface = 3, .dimension = Dimension::TapX, .seed = 8};
        WaveFloat a, b;
        noise_pair_wave(Noise::Sobol, first, Dimension::TapY, a, b);
        for (uint32_t lane = 0; lane < kWaveLanes; ++lane) {
            RandomAddress pixel = first;
            pixel.x += lane % kWaveWidth, pixel.y += lane / kWaveWidth, pixel.sample = 0;
            const uint32_t key = random_bits(pixel), key_a = mix_bits(~key), key_b = mix_bits(~key_a);
            const uint32_t index = scrambled(sample, key);
            EXPECT_EQ(a[int(lane)], unit_float(scrambled(reverse_bits(index), key_a))) << sample;
            EXPECT_EQ(b[int(lane)], unit_float(scrambled(second_dimension(index), key_b))) << sample;
        }
    }
}

TEST(Sobol, ScramblesEveryBitByTheBitsAboveIt) {
    std::mt19937 random(1);
    constexpr int kTrials = 20000;
    double worst = 0;
    for (int changed = 0; changed < 24; ++changed) {
        int flips[24] = {};
        for (int n = 0; n < kTrials; ++n) {
            const auto number = uint32_t(random()), seed = mix_bits(uint32_t(random()));
            const uint32_t change = scramble_reversed(number, seed) ^ scramble_reversed(number ^ 1u << changed, seed);
            for (int bit = 0; bit < 24; ++bit) flips[bit] += int(change >> bit & 1);
        }
        // The bits are reversed: those above have lower numbers.
        for (int bit = 0; bit < changed; ++bit) EXPECT_EQ(flips[bit], 0) << changed << " changes " << bit;
        EXPECT_EQ(flips[changed], kTrials);
        for (int bit = changed + 1; bit < 24; ++bit) worst = std::max(worst, std::abs(double(flips[bit]) / kTrials - 0.5));
    }
    std::printf("a bit flips with a probability at most %.3f from 1/2\n", worst);
    // 276 frequencies: 0.02 is 5.7 standard deviations. Burley's constants are off by 0.25.
    EXPECT_LT(worst, 0.02);
}

/// Owen's scrambling as he wrote it (1995): at each node of the tree of a number's leading bits the next bit flips or not, at random.
uint32_t owen_scrambled(uint32_t number, uint32_t seed) {
    uint32_t scrambled = 0;
    for (int bit = 31; bit >= 0; --bit) {
        const uint32_t node = bit == 31 ? 1 : 1u << (31 - bit) | number >> (bit + 1);
        scrambled |= ((number >> bit & 1) ^ (mix_bits(mix_bits(node) ^ seed) & 1)) << bit;
    }
    return scrambled;
}

double integrand(const Point& at) { return std::exp(at.x) * std::cos(2 * at.y) + at.x * at.y; }

/// Mean squared difference of two halves: twice the variance of a mean of `count` samples.
template <class Mean>
double variance_of(int trials, const Mean& mean) {
    double sum = 0;
    for (int i = 0; i < trials; ++i) sum += std::pow(mean(2 * i) - mean(2 * i + 1), 2) / 2;
    return sum / trials;
}

TEST(Sobol, HasTheVarianceOfOwensScrambling) {
    for (const int bits : {2, 4, 6}) {
        const int count = 1 << bits;
        std::vector<double> means;
        for (uint32_t wave = 0; wave < 256; ++wave) {
            const auto pixels =
                samples_of(Noise::Sobol, {.x = 8 * wave, .dimension = Dimension::TapX}, Dimension::TapY, 0, uint32_t(count));
            for (const std::vector<Point>& points : pixels) {
                double sum = 0;
                for (const Point& point : points) sum += integrand(point);
                means.push_back(sum / count);
            }
        }
        const auto exact_mean = [&](int trial) {
            const uint32_t seed = mix_bits(uint32_t(trial) + 77);
            double sum = 0;
            for (uint32_t n = 0; n < uint32_t(count); ++n) {
                const uint32_t first = reverse_bits(n), second = second_dimension(n);
                sum += integrand({owen_scrambled(first, seed) * 0x1p-32, owen_scrambled(second, mix_bits(~seed)) * 0x1p-32});
            }
            return sum / count;
        };
        const int trials = int(means.size()) / 2;
        const double found = variance_of(trials, [&](int trial) { return means[size_t(trial)]; });
        const double exact = variance_of(trials, exact_mean);
        std::printf("%d samples: variance %.3e, by exact scrambling %.3e\n", count, found, exact);
        EXPECT_NEAR(found / exact, 1, 0.15) << count << " samples";
    }
}

double distance_from_integer(uint32_t number) { return std::min(number, 0u - number) * 0x1p-32; }

TEST(KroneckerSteps, AreBadlyApproximableAloneAndInPairs) {
    double least_alone = 1, least_pair = 1;
    for (size_t i = 0; i < kKroneckerSteps.size(); ++i) {
        const uint32_t step = kKroneckerSteps[i];
        double alone = 1;
        for (uint32_t q = 1; q <= 4096; ++q) alone = std::min(alone, q * distance_from_integer(q * step));
        // Those of R2 are chosen as a pair, whose merit is better.
        const bool of_r2 = i == size_t(Dimension::PixelX) || i == size_t(Dimension::PixelY);
        EXPECT_GE(alone, of_r2 ? 0.016 : 0.19) << "dimension " << i;
        least_alone = std::min(least_alone, alone);
        for (size_t other = 0; other < i; ++other) {
            for (int j = 1; j <= 32; ++j) {
                for (int k = -32; k <= 32; ++k) {
                    if (k == 0) continue;
                    const double merit = j * std::abs(k) * distance_from_integer(uint32_t(j) * step + uint32_t(k) * kKroneckerSteps[other]);
                    EXPECT_GE(merit, 0.0028) << "dimensions " << i << " and " << other << ": " << j << ", " << k;
                    least_pair = std::min(least_pair, merit);
                }
            }
        }
    }
    std::printf("merit alone %.3f, of pairs %.4f\n", least_alone, least_pair);
}

TEST(KroneckerSteps, OfThePixelAreRobertsR2AndOfTheLevelIsTheGoldenRatio) {
    const double g = 1.32471795724474602596, golden = (std::sqrt(5.0) - 1) / 2;
    // Rounded to odd numbers, so that 2^32 samples are all different.
    EXPECT_NEAR(kKroneckerSteps[size_t(Dimension::PixelX)], 0x1p32 / g, 1);
    EXPECT_NEAR(kKroneckerSteps[size_t(Dimension::PixelY)], 0x1p32 / (g * g), 1);
    EXPECT_NEAR(kKroneckerSteps[size_t(Dimension::Level)], 0x1p32 * golden, 1);
    for (const uint32_t step : kKroneckerSteps) EXPECT_EQ(step % 2, 1u);
}

/// Least |j|*|k|*|l|*|m|*|j*PixelX + k*PixelY + l*TapX + m*TapY| over coefficients up to `most` that are not all 0, zeros counting as 1.
double merit_with_pixels(int most) {
    const auto at = [](Dimension dimension, int times) { return uint32_t(times) * kKroneckerSteps[size_t(dimension)]; };
    double least = 1;
    for (int j = 0; j <= most; ++j) {
        for (int k = -most; k <= most; ++k) {
            for (int l = -most; l <= most; ++l) {
                for (int m = -most; m <= most; ++m) {
                    if (j == 0 && k == 0 && l == 0 && m == 0) continue;
                    const double size =
                        double(std::max(1, j)) * std::max(1, std::abs(k)) * std::max(1, std::abs(l)) * std::max(1, std::abs(m));
                    const uint32_t sum =
                        at(Dimension::PixelX, j) + at(Dimension::PixelY, k) + at(Dimension::TapX, l) + at(Dimension::TapY, m);
                    least = std::min(least, size * distance_from_integer(sum));
                }
            }
        }
    }
    return least;
}

TEST(KroneckerSteps, OfATapAreUnrelatedToTheSubPixelOffsets) {
    const double merit = merit_with_pixels(10);
    std::printf("merit of a tap's two and a pixel's two %.5f\n", merit);
    EXPECT_GE(merit, 0.0015);
}

/// The largest difference between the area of a box [0, x) x [0, y) and its share of the points, over corners at the points' coordinates.
double star_discrepancy(const std::vector<Point>& points) {
    std::vector<double> xs{1}, ys{1};
    for (const Point& point : points) xs.push_back(point.x), ys.push_back(point.y);
    double worst = 0;
    for (const double x : xs) {
        std::vector<double> inside;
        for (const Point& point : points) {
            if (point.x <= x) inside.push_back(point.y);
        }
        for (const double y : ys) {
            const auto closed = std::count_if(inside.begin(), inside.end(), [=](double other) { return other <= y; });
            worst = std::max(worst, std::abs(double(closed) / double(points.size()) - x * y));
        }
    }
    return worst;
}

TEST(R2, HasLessDiscrepancyThanWhiteFromAnySampleOn) {
    constexpr uint32_t kCount = 256;
    const auto mean_discrepancy = [](Noise noise, uint32_t begin, uint32_t surface) {
        const auto pixels = samples_of(noise, {.surface = surface, .dimension = Dimension::TapX}, Dimension::TapY, begin, kCount);
        double sum = 0;
        for (size_t lane = 0; lane < 8; ++lane) sum += star_discrepancy(pixels[lane]) / 8;
        return sum;
    };
    const double white = mean_discrepancy(Noise::White, 0, 0);
    for (const uint32_t begin : {0u, 1u << 20, 0x80000000u}) {
        for (const uint32_t surface : {0u, 5u}) {
            const double found = mean_discrepancy(Noise::R2, begin, surface);
            std::printf("from sample %u, surface %u: star discrepancy %.4f, of white %.4f\n", begin, surface, found, white);
            EXPECT_LT(found, 0.35 * white) << "from sample " << begin << ", surface " << surface;
        }
    }
}

TEST(R2, DividesTheLineByTheGoldenRatio) {
    // Gaps between the first n numbers have at most three lengths, the longest at most 1/golden^2 times the shortest.
    const double golden = (std::sqrt(5.0) - 1) / 2;
    for (const uint32_t begin : {0u, 12345u, 0xFFFFFF00u}) {
        for (const uint32_t count : {2u, 5u, 64u, 200u}) {
            const auto pixels = samples_of(Noise::R2, {.dimension = Dimension::Level}, Dimension::Probe, begin, count);
            for (const std::vector<Point>& points : pixels) {
                std::vector<double> at;
                for (const Point& point : points) at.push_back(point.x);
                std::sort(at.begin(), at.end());
                double least = at.front() + 1 - at.back(), most = least;
                for (size_t i = 1; i < at.size(); ++i) least = std::min(least, at[i] - at[i - 1]), most = std::max(most, at[i] - at[i - 1]);
                EXPECT_LE(most, least / (golden * golden) + 1e-6) << count << " samples from " << begin;
            }
        }
    }
}

}  // namespace
}  // namespace rawtexel::texunit
