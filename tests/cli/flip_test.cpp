#include "cli/metrics/flip.h"
#include "cli/reports/colour_map.h"
#include "tests/reference/cli/flip_reference.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace rawtexel::cli {
namespace {

struct Rgb {
    float r, g, b;
};

struct Picture {
    int width, height;
    std::vector<float> values;
};

Picture flat(int width, int height, Rgb colour) {
    Picture picture{width, height, {}};
    for (int i = 0; i < width * height; ++i) picture.values.insert(picture.values.end(), {colour.r, colour.g, colour.b});
    return picture;
}

Picture noise(int width, int height, uint32_t seed, float scale) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> uniform(0.0f, scale);
    Picture picture{width, height, {}};
    for (int i = 0; i < width * height * 3; ++i) picture.values.push_back(uniform(random));
    return picture;
}

/// Smooth colours, a hard edge, a thin line and a lone pixel.
Picture scene(int width, int height, double shift) {
    Picture picture{width, height, {}};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const double u = (x + shift) / width, v = double(y) / height;
            double grey = x + 0.5 + shift < width * 0.4 ? 0.2 : 0.7;
            if (y == height / 2) grey = 0.95;
            if (x == width / 4 && y == height / 4) grey = 1.0;
            picture.values.push_back(float(grey * (0.5 + 0.5 * std::sin(6 * u))));
            picture.values.push_back(float(grey * (0.5 + 0.5 * std::cos(5 * v))));
            picture.values.push_back(float(std::min(grey * u, 1.0)));
        }
    return picture;
}

FlipImages pair(const Picture& test, const Picture& reference) { return {test.values, reference.values, test.width, test.height}; }

double mean_ldr(const Picture& test, const Picture& reference) {
    return pooled_flip(ldr_flip(pair(test, reference), kDefaultPixelsPerDegree)).mean;
}

double worst_difference(const std::vector<float>& map, const std::vector<double>& expected) {
    EXPECT_EQ(map.size(), expected.size());
    double worst = 0;
    for (size_t i = 0; i < map.size(); ++i) worst = std::max(worst, std::abs(double(map[i]) - expected[i]));
    return worst;
}

// The map is in floats: half a unit of the last place of 1 is 6e-8.
constexpr double kBound = 1e-7;

TEST(Flip, LdrAgreesWithTheEquationsWrittenOut) {
    double worst = 0;
    for (const auto& [width, height] : {std::pair{1, 1}, {3, 2}, {40, 7}, {23, 70}}) {
        for (const double density : {kMinPixelsPerDegree, 20.0, kDefaultPixelsPerDegree}) {
            const Picture a = scene(width, height, 0), b = scene(width, height, 1.3), c = noise(width, height, 7, 1.0f);
            for (const auto& [test, reference] : {std::pair{&a, &b}, {&c, &a}}) {
                const std::vector<double> expected = reference::ldr_flip(test->values, reference->values, width, height, density);
                const double difference = worst_difference(ldr_flip(pair(*test, *reference), density), expected);
                EXPECT_LE(difference, kBound) << width << "x" << height << " at " << density << " pixels per degree";
                worst = std::max(worst, difference);
            }
        }
    }
    RecordProperty("worst", std::to_string(worst * 1e9) + "e-9");
}

TEST(Flip, HdrAgreesWithTheEquationsWrittenOut) {
    Picture reference = scene(30, 20, 0), test = scene(30, 20, 0.7);
    for (size_t i = 0; i < reference.values.size(); ++i) {
        const float scale = std::exp2(float(i % 90) * 0.07f);
        reference.values[i] *= scale;
        test.values[i] *= scale;
    }
    const FlipExposures exposures = flip_exposures(reference.values);
    const reference::Exposures expected = reference::exposures(reference.values);
    EXPECT_NEAR(exposures.start, expected.start, 1e-12);
    EXPECT_NEAR(exposures.stop, expected.stop, 1e-12);
    ASSERT_EQ(exposures.count, expected.count);
    EXPECT_GE(exposures.count, 4);
    const std::vector<float> map = hdr_flip(pair(test, reference), exposures, kDefaultPixelsPerDegree);
    EXPECT_LE(worst_difference(map, reference::hdr_flip(test.values, reference.values, 30, 20, kDefaultPixelsPerDegree)), kBound);
}

TEST(Flip, OfEqualImagesIsZeroAndOfDifferentOnesIsNot) {
    Picture image = noise(50, 30, 3, 1.0f);
    for (const float error : ldr_flip(pair(image, image), kDefaultPixelsPerDegree)) ASSERT_EQ(error, 0.0f);
    const FlipExposures exposures = flip_exposures(image.values);
    for (const float error : hdr_flip(pair(image, image), exposures, kDefaultPixelsPerDegree)) ASSERT_EQ(error, 0.0f);
    Picture other = image;
    other.values[300] += other.values[300] > 0.5f ? -0.4f : 0.4f;
    EXPECT_GT(mean_ldr(other, image), 0.0);
}

TEST(Flip, IsSymmetricToTheBit) {
    const Picture a = scene(70, 66, 0), b = noise(70, 66, 4, 1.0f);
    EXPECT_EQ(ldr_flip(pair(a, b), kDefaultPixelsPerDegree), ldr_flip(pair(b, a), kDefaultPixelsPerDegree));
    const FlipExposures exposures = flip_exposures(a.values);
    EXPECT_EQ(hdr_flip(pair(a, b), exposures, 30.0), hdr_flip(pair(b, a), exposures, 30.0));
}

// Flat images have no features: what is left is the distance of two colours, by hand from the equations.
TEST(Flip, OfFlatImagesIsTheErrorOfTheirColours) {
    const Rgb black{0, 0, 0}, white{1, 1, 1}, green{0, 1, 0}, blue{0, 0, 1};
    const auto mean = [](Rgb a, Rgb b) { return mean_ldr(flat(12, 9, a), flat(12, 9, b)); };
    EXPECT_NEAR(mean(green, blue), 1.0, 1e-7);
    // L*a*b* of green is (87.7347, -86.1827, 83.1793), of blue (32.2970, 79.1875, -107.8602). HyAB of black and white is 100, of green and
    // blue as Hunt sees them 203.3; to the power of 0.7.
    const double most = std::pow(203.297, 0.7), knee = 0.4 * most;
    EXPECT_NEAR(mean(black, white), 0.95 + 0.05 * (std::pow(100.0, 0.7) - knee) / (most - knee), 1e-6);
    EXPECT_GT(mean(white, blue), mean(white, Rgb{0.9f, 0.9f, 1.0f}));
    // Two greys whose lightness differs by 10: L* 50 and 60 have the codes 0.4663 and 0.5669.
    EXPECT_NEAR(mean({0.466327f, 0.466327f, 0.466327f}, {0.566866f, 0.566866f, 0.566866f}), 0.95 * std::pow(10.0, 0.7) / knee, 1e-5);
}

TEST(Flip, OfAnyColoursStaysWithinOne) {
    float largest = 0;
    for (int a = 0; a < 8; ++a)
        for (int b = 0; b < 8; ++b) {
            const Rgb first{float(a & 1), float(a >> 1 & 1), float(a >> 2)}, second{float(b & 1), float(b >> 1 & 1), float(b >> 2)};
            Picture left = flat(24, 4, first), right = flat(24, 4, second);
            std::copy_n(flat(12, 4, second).values.begin(), 36, left.values.begin());
            for (const float error : ldr_flip(pair(left, right), kDefaultPixelsPerDegree)) {
                ASSERT_GE(error, 0.0f);
                largest = std::max(largest, error);
            }
        }
    EXPECT_LE(largest, 1.0f);
    EXPECT_GT(largest, 0.9f);
}

TEST(Flip, SeesHueWhereLightnessIsTheSame) {
    // Equal relative luminance: 0.5 of grey, and what red and green of the same luminance make.
    const double grey = mean_ldr(flat(20, 20, {0.5f, 0.5f, 0.5f}), flat(20, 20, {0.55f, 0.48f, 0.5f}));
    EXPECT_GT(grey, 0.05);
    EXPECT_LT(grey, 0.5);
}

TEST(Flip, SeesLessOfFineNoiseFromAfar) {
    const Picture grey = flat(64, 64, {0.5f, 0.5f, 0.5f});
    Picture checker = grey;
    for (int i = 0; i < 64 * 64; ++i)
        for (int c = 0; c < 3; ++c) checker.values[size_t(3 * i + c)] += (i + i / 64) % 2 ? 0.1f : -0.1f;
    const double near = pooled_flip(ldr_flip(pair(checker, grey), 10.0)).mean, far = pooled_flip(ldr_flip(pair(checker, grey), 90.0)).mean;
    EXPECT_GT(near, 2 * far) << near << " against " << far;
}

TEST(Flip, GivesTheSameBitsInAnyOrderOfWork) {
    const Picture a = scene(33, 300, 0), b = scene(33, 300, 2);
    const auto backwards = [](int64_t count, const std::function<void(int64_t)>& body) {
        for (int64_t i = count; i-- > 0;) body(i);
    };
    EXPECT_EQ(ldr_flip(pair(a, b), 40.0), ldr_flip(pair(a, b), 40.0, backwards));
    // A strip's edge shows in no pixel: rows of the whole are those of a part that holds their surroundings.
    Picture top_a{33, 100, {a.values.begin(), a.values.begin() + 33 * 100 * 3}},
        top_b{33, 100, {b.values.begin(), b.values.begin() + 33 * 100 * 3}};
    const std::vector<float> whole = ldr_flip(pair(a, b), 40.0), part = ldr_flip(pair(top_a, top_b), 40.0);
    for (size_t i = 0; i < 33 * 90; ++i) ASSERT_EQ(whole[i], part[i]) << i;
}

TEST(FlipExposures, ShowTheBrightestAndTheMedianAtTheTarget) {
    Picture image = flat(9, 1, {1, 1, 1});
    for (int i = 0; i < 9; ++i)
        for (int c = 0; c < 3; ++c) image.values[size_t(3 * i + c)] = std::exp2(float(i));
    const FlipExposures exposures = flip_exposures(image.values);
    EXPECT_NEAR(exposures.stop - exposures.start, 4.0, 1e-9);
    EXPECT_EQ(exposures.count, 4);
    Picture brighter = image;
    brighter.values[24] *= 1.2f;
    brighter.values[25] *= 1.2f;
    brighter.values[26] *= 1.2f;
    EXPECT_EQ(flip_exposures(brighter.values).count, 5);  // 4.26 stops
    EXPECT_EQ(exposures.at(0), exposures.start);
    EXPECT_NEAR(exposures.at(3), exposures.stop, 1e-12);
    const double brightest = 256.0 * std::exp2(exposures.start);
    EXPECT_NEAR((0.9036 * brightest * brightest + 0.018 * brightest) / (0.8748 * brightest * brightest + 0.354 * brightest + 0.14), 0.85,
                1e-9);
}

TEST(FlipExposures, OfBlackAndMostlyBlackImagesAreFinite) {
    const FlipExposures black = flip_exposures(flat(5, 5, {0, 0, 0}).values);
    EXPECT_EQ(black.start, 0.0);
    EXPECT_EQ(black.stop, 0.0);
    EXPECT_EQ(black.count, 2);
    Picture mostly = flat(5, 5, {0, 0, 0});
    mostly.values[0] = mostly.values[1] = mostly.values[2] = 8.0f;
    const FlipExposures one = flip_exposures(mostly.values);
    EXPECT_EQ(one.start, one.stop);
    EXPECT_TRUE(std::isfinite(one.start));
    for (const float error : hdr_flip(pair(mostly, flat(5, 5, {0, 0, 0})), black, kDefaultPixelsPerDegree))
        ASSERT_TRUE(std::isfinite(error));
}

TEST(FlipFigures, AreThoseOfTheDefinition) {
    std::mt19937 random(11);
    std::uniform_real_distribution<float> uniform(0.0f, 1.0f);
    for (const size_t count : {1u, 2u, 5u, 400u}) {
        std::vector<float> map;
        for (size_t i = 0; i < count; ++i) map.push_back(uniform(random) * uniform(random));
        const std::vector<double> errors(map.begin(), map.end());
        const FlipFigures figures = pooled_flip(map);
        EXPECT_EQ(figures.weighted_q1, reference::weighted_percentile(errors, 0.25)) << count;
        EXPECT_EQ(figures.weighted_median, reference::weighted_percentile(errors, 0.5)) << count;
        EXPECT_EQ(figures.weighted_q3, reference::weighted_percentile(errors, 0.75)) << count;
        EXPECT_EQ(figures.min, *std::ranges::min_element(errors));
        EXPECT_EQ(figures.max, *std::ranges::max_element(errors));
    }
    const FlipFigures none = pooled_flip(std::vector<float>(7, 0.0f));
    EXPECT_EQ(none.mean + none.weighted_q3 + none.max, 0.0);
}

TEST(ColourMap, IsMagma) {
    EXPECT_EQ(magma(0.0), (Rgb8{0, 0, 4}));
    EXPECT_EQ(magma(128.0 / 255.0), (Rgb8{183, 55, 121}));
    EXPECT_EQ(magma(1.0), (Rgb8{252, 253, 191}));
    EXPECT_EQ(magma(-3.0), magma(0.0));
    EXPECT_EQ(magma(7.0), magma(1.0));
    EXPECT_EQ(magma(std::nan("")), kNotANumber);
    EXPECT_EQ(magma_codes(std::vector<float>{2.0f, 6.0f}, 2.0, 6.0), (std::vector<uint8_t>{0, 0, 4, 252, 253, 191}));
    EXPECT_EQ(magma_codes(std::vector<float>{2.0f}, 2.0, 2.0), (std::vector<uint8_t>{0, 0, 4}));
}

}  // namespace
}  // namespace rawtexel::cli
