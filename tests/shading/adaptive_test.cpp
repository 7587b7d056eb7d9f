#include "scene_parts.h"
#include "shading/adaptive_blocks.h"
#include "shading/render.h"
#include "tests/shading/executor_kinds.h"
#include "tests/shading/frame_bits.h"
#include "texunit/simd.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <map>

namespace rawtexel::shading {
namespace {

using namespace test;

constexpr int kWidth = 165, kHeight = 101, kMost = 128;

/// The busy scene, whose surfaces are opaque, MASK and BLEND.
class AdaptiveTest : public testing::Test {
  protected:
    static RenderOptions options(int spp, double error = 0) {
        RenderOptions options;
        options.width = kWidth;
        options.height = kHeight;
        options.camera = busy_camera();
        options.spp = spp;
        options.image_spp = kMost;
        options.adaptive_error = error;
        options.pixel_jitter = PixelJitter::Pixel;
        options.filter = texunit::Kernel::BSpline;
        options.filtering.estimator = texunit::Estimator::Reservoir;
        return options;
    }
    RenderResult render_with(const RenderOptions& options, int threads = 2) const {
        const std::unique_ptr<Executor> executor = make_executor(ExecutorKind::Threads, threads);
        return render(scene_, lighting_, options, *executor);
    }

    std::unique_ptr<Executor> one_ = make_executor(ExecutorKind::Threads, 1);
    Scene scene_ = make_busy_scene();
    Lighting lighting_ = busy_lighting(scene_, *one_);
};

/// Compares every pixel of `image` with that of the plain frame of as many samples.
void expect_values_of(const std::map<int, const Image*>& plain, const Image& counts, const Image& image, const std::string& what) {
    int wrong = 0;
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            const float* const expected = plain.at(int(*counts.pixel(x, y)))->pixel(x, y);
            wrong += std::memcmp(expected, image.pixel(x, y), size_t(image.channels) * sizeof(float)) != 0;
        }
    }
    EXPECT_EQ(wrong, 0) << what << ": pixels of " << image.width * image.height;
}

TEST_F(AdaptiveTest, BlocksHoldTheBitsOfAFrameOfTheirSamples) {
    for (const FetchModel model : {FetchModel::Visible, FetchModel::Forward, FetchModel::Quad}) {
        const auto with_layers = [&](RenderOptions options) {
            options.aovs = {Aov::Depth, Aov::Normal, Aov::Albedo, Aov::Uv, Aov::Lod, Aov::Material, Aov::Texels, Aov::Spp};
            options.coverage = true;
            options.fetches.count = options.fetches.pixel_layers = true;
            options.fetches.model = model;
            return options;
        };
        const RenderResult adaptive = render_with(with_layers(options(kMost, 0.02)));
        std::map<int, RenderResult> plain;
        for (int spp = kFirstAdaptiveDecision; spp <= kMost; spp *= 2) plain.emplace(spp, render_with(with_layers(options(spp))));
        std::map<int, int> pixels;
        for (const float count : adaptive.sample_counts.values) ++pixels[int(count)];
        EXPECT_EQ(pixels.size(), plain.size()) << "some blocks should stop at every decision";

        const auto images = [&](const auto& image_of) {
            std::map<int, const Image*> by_spp;
            for (const auto& [spp, result] : plain) by_spp[spp] = &image_of(result);
            return by_spp;
        };
        const Image& counts = adaptive.sample_counts;
        expect_values_of(images([](const RenderResult& r) -> const Image& { return r.radiance; }), counts, adaptive.radiance, "radiance");
        expect_values_of(images([](const RenderResult& r) -> const Image& { return r.coverage; }), counts, adaptive.coverage, "coverage");
        for (size_t i = 0; i < adaptive.layers.size(); ++i) {
            expect_values_of(images([&](const RenderResult& r) -> const Image& { return r.layers[i].image; }), counts,
                             adaptive.layers[i].image, adaptive.layers[i].name);
        }
        const auto texels = [](const RenderResult& r) -> const Image& { return r.fetches->pixel(PixelCount::TexelsRequested); };
        expect_values_of(images(texels), counts, texels(adaptive), "texels requested");
        EXPECT_TRUE(same_bits(adaptive.layers.back().image, counts));
        EXPECT_EQ(mean_samples(adaptive), [&] {
            double sum = 0;
            for (const auto& [count, number] : pixels) sum += double(count) * number;
            return sum / (kWidth * kHeight);
        }());
        EXPECT_FALSE(mean_samples(plain.at(kMost)));
    }
}

/// From samples rendered one by one, in two passes and long double.
TEST_F(AdaptiveTest, StopsWhereTheStandardErrorOfTheBlockIsBelowTheGoal) {
    constexpr double kError = 0.02;
    const RenderResult adaptive = render_with(options(kMost, kError));
    std::vector<Image> samples;
    for (int n = 0; n < kMost; ++n) {
        RenderOptions one = options(1);
        one.first_sample = uint32_t(n);
        samples.push_back(render_with(one).radiance);
    }
    const auto standard_error = [&](int x0, int y0, int count) {
        const int x1 = std::min(x0 + kAdaptiveBlock, kWidth), y1 = std::min(y0 + kAdaptiveBlock, kHeight);
        long double sum = 0;
        for (int y = y0; y < y1; ++y) {
            for (int x = x0; x < x1; ++x) {
                for (int c = 0; c < 3; ++c) {
                    long double mean = 0, squares = 0;
                    for (int n = 0; n < count; ++n) mean += (long double)(samples[size_t(n)].pixel(x, y)[c]) / count;
                    for (int n = 0; n < count; ++n) squares += std::pow((long double)(samples[size_t(n)].pixel(x, y)[c]) - mean, 2.0L);
                    sum += squares / (count - 1) / count;
                }
            }
        }
        return double(std::sqrt(sum / (3.0L * (x1 - x0) * (y1 - y0))));
    };
    double closest = 1;
    for (int y = 0; y < kHeight; y += kAdaptiveBlock) {
        for (int x = 0; x < kWidth; x += kAdaptiveBlock) {
            int stop = kFirstAdaptiveDecision;
            for (; stop < kMost; stop *= 2) {
                const double error = standard_error(x, y, stop);
                closest = std::min(closest, std::abs(error / kError - 1));
                if (error < kError) break;
            }
            EXPECT_EQ(int(*adaptive.sample_counts.pixel(x, y)), stop) << "block at " << x << ", " << y;
        }
    }
    EXPECT_GT(closest, 1e-9) << "a block so near the goal that rounding decides";
}

TEST_F(AdaptiveTest, GivesTheSameBitsForAnyThreadsTilesAndCrops) {
    RenderOptions whole = options(64, 0.02);
    whole.aovs = {Aov::Depth, Aov::Spp};
    const RenderResult expected = render_with(whole, 1);
    for (const int tile_size : {32, 64, 128}) {
        RenderOptions tiled = whole;
        tiled.tile_size = tile_size;
        const RenderResult result = render_with(tiled, 3);
        EXPECT_TRUE(same_bits(result.radiance, expected.radiance)) << tile_size;
        for (size_t i = 0; i < 2; ++i) EXPECT_TRUE(same_bits(result.layers[i].image, expected.layers[i].image)) << tile_size;
        EXPECT_EQ(result.samples_shaded, expected.samples_shaded) << tile_size;
        for (const Crop& crop : {Crop{16, 32, 48, 16}, Crop{144, 64, 21, 37}, Crop{0, 96, 165, 5}}) {
            tiled.crop = crop;
            ASSERT_TRUE(holds_whole_blocks(crop, kWidth, kHeight));
            const RenderResult part = render_with(tiled);
            for (int y = 0; y < crop.height; ++y)
                EXPECT_TRUE(std::equal(part.radiance.pixel(0, y), part.radiance.pixel(0, y) + 3 * crop.width,
                                       expected.radiance.pixel(crop.x, crop.y + y)))
                    << tile_size << ", row " << y;
        }
    }
    EXPECT_FALSE(holds_whole_blocks({8, 0, 16, 16}, kWidth, kHeight));
    EXPECT_FALSE(holds_whole_blocks({0, 0, 164, 16}, kWidth, kHeight));
}

TEST_F(AdaptiveTest, AGoalOutOfReachTakesAllSamplesAndOneAboveEverythingSixteen) {
    const RenderResult all = render_with(options(32, 1e-9)), few = render_with(options(32, 1e9));
    // Pixels that never change have no error at all.
    EXPECT_TRUE(same_bits(few.radiance, render_with(options(16)).radiance));
    for (size_t pixel = 0; pixel < all.sample_counts.values.size(); ++pixel) {
        EXPECT_EQ(few.sample_counts.values[pixel], 16.0f);
        ASSERT_TRUE(all.sample_counts.values[pixel] == 32.0f || all.sample_counts.values[pixel] == 16.0f);
    }
    EXPECT_GT(*mean_samples(all), 16.5);
}

/// Over many seeds, the mean of what has stopped early stays near that of all samples: how near is printed, for docs/performance.md.
TEST_F(AdaptiveTest, BiasIsSmallBesideTheGoal) {
    constexpr double kError = 0.03;
    constexpr int kSeeds = 24, kSamples = 64;
    const Crop crop{48, 16, 64, 64};
    double mean = 0, difference = 0, squares = 0, samples = 0;
    std::vector<double> by_value(size_t(3 * crop.width * crop.height));
    for (int seed = 0; seed < kSeeds; ++seed) {
        RenderOptions all = options(kSamples);
        all.seed = uint32_t(seed);
        all.crop = crop;
        RenderOptions few = all;
        few.adaptive_error = kError;
        const RenderResult stopped = render_with(few), whole = render_with(all);
        samples += *mean_samples(stopped) / kSeeds;
        for (size_t i = 0; i < by_value.size(); ++i) {
            mean += double(whole.radiance.values[i]);
            by_value[i] += double(stopped.radiance.values[i]) - double(whole.radiance.values[i]);
        }
    }
    for (const double sum : by_value) difference += sum, squares += sum / kSeeds * (sum / kSeeds);
    const double values = double(by_value.size()), bias = difference / values / kSeeds;
    std::printf("adaptive %g: %.1f of %d samples, bias of the image's mean %+.2e of a mean of %.3f, of single values at most %.4f rms\n",
                kError, samples, kSamples, bias, mean / values / kSeeds, std::sqrt(squares / values));
    EXPECT_LT(samples, 0.8 * kSamples);
    EXPECT_LT(std::abs(bias), 0.02 * kError);
    EXPECT_LT(std::sqrt(squares / values), 0.5 * kError);
}

}  // namespace
}  // namespace rawtexel::shading
