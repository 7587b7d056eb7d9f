// What samples bring an image to, on `bumps`, whose shading is far from affine: the truth where raw texels of level 0 are shaded, something
// else where levels or filtered normals are. docs/filters.md has the same figures at full size.
#include "scenes/image_io.h"
#include "tests/cli/program_runner.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

namespace rawtexel::cli {
namespace {

using Words = std::vector<std::string>;
using shading::Image;

const Words kRawTexels{"--mip", "none", "--estimator", "reservoir"};

class Convergence : public testing::Test {
  protected:
    /// The floor where the sun is seen in it.
    Image floor(const Words& options) const {
        const std::string path = folder_ / "floor.exr";
        Words words{"render", "bumps", "-o", path, "--size", "160x90", "--crop", "88,68,24,16", "--pixel-jitter", "pixel"};
        words.insert(words.end(), options.begin(), options.end());
        const test::Outcome outcome = test::run(words);
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        return scenes::read_image(path, false);
    }
    Image floor_with(Words words, int spp, const Words& more = {}) const {
        words.insert(words.end(), {"--spp", std::to_string(spp)});
        words.insert(words.end(), more.begin(), more.end());
        return floor(words);
    }
    const Image& truth() {
        if (truth_.values.empty()) truth_ = floor_with(kRawTexels, 8192, {"--noise", "sobol", "--seed", "77"});
        return truth_;
    }
    double error(const Image& image) {
        double sum = 0;
        size_t count = 0;
        for (int y = 0; y < image.height; ++y) {
            for (int x = 0; x < image.width; ++x) {
                for (int c = 0; c < 3; ++c, ++count) {
                    const double difference = double(image.pixel(x, y)[c]) - double(truth().pixel(x, y)[c]);
                    sum += difference * difference;
                }
            }
        }
        return std::sqrt(sum / double(count));
    }

    test::TemporaryFolder folder_;
    Image truth_;
};

TEST_F(Convergence, OfOneRawTexelHasNoFloorWhateverTheNoise) {
    for (const char* noise : {"white", "sobol", "r2", "blue", "stbn"}) {
        const Words more{"--noise", noise};
        const double few = error(floor_with(kRawTexels, 64, more)), many = error(floor_with(kRawTexels, 1024, more));
        std::printf("%s: %.4f of 64 samples, %.4f of 1024\n", noise, few, many);
        // A quarter, but for the luck of 384 pixels and for what the truth itself is short of.
        EXPECT_GT(few / many, 3.0) << noise;
    }
}

TEST_F(Convergence, EndsAtAFloorWhereNormalsAreFilteredFirst) {
    const double few = error(floor_with({}, 64)), many = error(floor_with({}, 512));
    const double raw = error(floor_with(kRawTexels, 1024));
    std::printf("before: %.4f of 64 samples, %.4f of 512; after: %.4f\n", few, many, raw);
    EXPECT_NEAR(many / few, 1, 0.05);
    EXPECT_GT(many, 8 * raw);
}

TEST_F(Convergence, EndsAtAFloorThatFallsWithFinerLevels) {
    double last = 1e9;
    for (const char* bias : {"1", "2", "3", "4"}) {
        const Words levels{"--mip", "linear", "--estimator", "reservoir", "--hybrid-bias", bias};
        const double few = error(floor_with(levels, 128)), many = error(floor_with(levels, 512));
        std::printf("levels %s finer: %.4f of 128 samples, %.4f of 512\n", bias, few, many);
        EXPECT_LT(many, 0.9 * last) << bias;
        last = many;
    }
}

/// Signed distances mean something only when they are filtered first.
TEST(ConvergenceOfFont, IsWrongWhereRawDistancesAreShaded) {
    const test::TemporaryFolder folder;
    const auto font = [&](const Words& options) {
        const std::string path = folder / "font.exr";
        Words words{"render", "font", "-o", path, "--size", "192x108", "--crop", "48,20,96,60"};
        words.insert(words.end(), options.begin(), options.end());
        EXPECT_EQ(test::run(words).code, 0);
        return scenes::read_image(path, false);
    };
    const auto distance = [](const Image& a, const Image& b) {
        double sum = 0;
        for (size_t i = 0; i < a.values.size(); ++i) sum += std::pow(double(a.values[i]) - double(b.values[i]), 2);
        return std::sqrt(sum / double(a.values.size()));
    };
    const Image filtered = font({"--spp", "256"});
    const double before = distance(font({"--spp", "64"}), filtered),
                 after = distance(font({"--spp", "64", "--estimator", "reservoir"}), filtered);
    std::printf("edges: %.4f before, %.4f after\n", before, after);
    EXPECT_GT(after, 5 * before);
}

}  // namespace
}  // namespace rawtexel::cli
