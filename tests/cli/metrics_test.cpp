#include "cli/metrics/metrics.h"
#include "tests/reference/cli/image_error_reference.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace rawtexel::cli {
namespace {

std::vector<float> random_values(size_t count, uint32_t seed, float scale) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> uniform(0.0f, scale);
    std::vector<float> values(count);
    for (float& value : values) value = uniform(random);
    return values;
}

void expect_close(double value, double expected, const char* name, size_t count) {
    EXPECT_NEAR(value, expected, 1e-13 * std::abs(expected)) << name << " of " << count << " values";
}

TEST(Metrics, AgreeWithTheReferenceForEveryLength) {
    for (const size_t count : {1u, 2u, 3u, 255u, 256u, 257u, 511u, 513u, 1000u, 100001u}) {
        for (const float scale : {1.0f, 1e4f}) {
            const std::vector<float> test = random_values(count, 1, scale), truth = random_values(count, 2, scale);
            const ImageError error = image_error(test, truth), expected = reference::image_error(test, truth);
            expect_close(error.mse, expected.mse, "mse", count);
            expect_close(error.rmse, expected.rmse, "rmse", count);
            expect_close(error.rel_mse, expected.rel_mse, "relMSE", count);
            expect_close(error.psnr, expected.psnr, "psnr", count);
            expect_close(error.max, expected.max, "max", count);
            expect_close(error.mean, expected.mean, "mean", count);
        }
    }
}

TEST(Metrics, OfKnownImages) {
    const std::vector<float> black(300, 0.0f), grey(300, 0.1f);
    const ImageError error = image_error(grey, black);
    EXPECT_NEAR(error.mse, 0.01, 1e-9);
    EXPECT_NEAR(error.rmse, 0.1, 1e-8);
    EXPECT_NEAR(error.psnr, 20.0, 1e-6);
    EXPECT_NEAR(error.rel_mse, 1.0, 1e-7);  // 0.01 over the floor of 0.01
    EXPECT_NEAR(error.max, 0.1, 1e-8);
}

TEST(Metrics, EqualImagesHaveNoErrorAndInfinitePsnr) {
    const std::vector<float> values = random_values(1000, 3, 2.0f);
    const ImageError error = image_error(values, values);
    EXPECT_EQ(error.mse, 0.0);
    EXPECT_EQ(error.max, 0.0);
    EXPECT_EQ(error.psnr, std::numeric_limits<double>::infinity());
}

TEST(Metrics, OneValueThatIsNoNumberSpoilsEveryFigure) {
    std::vector<float> values = random_values(1000, 4, 1.0f);
    const std::vector<float> truth = values;
    for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        values[700] = bad;
        for (const ImageError& error : {image_error(values, truth), image_error(truth, values)})
            for (const double figure : {error.mse, error.rmse, error.rel_mse, error.psnr, error.max, error.mean})
                EXPECT_TRUE(std::isnan(figure));
    }
}

}  // namespace
}  // namespace rawtexel::cli
