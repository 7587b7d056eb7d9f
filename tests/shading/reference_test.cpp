// The truth: where it stops, and what it converges to.
#include "shading/reference.h"

#include "tests/shading/scene_parts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace rawtexel::shading {
namespace {

using namespace test;

class ReferenceTest : public testing::Test {
  protected:
    ReferenceTest() {
        options_.width = options_.height = 48;
        options_.camera = square_camera();
        Material material = unlit(glm::vec4(1));
        scene_.textures.push_back(make_noise_texture(64, 64, 3));
        material.maps[kBaseColor].texture = 0;
        // Some five texels a pixel.
        add_object(scene_, make_quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, glm::vec2(4.1f, 3.7f)), material);
    }
    Reference render_to(double error, int most = 1 << 16) {
        return render_reference(scene_, {}, options_, {.error = error, .most_samples = most}, *executor_);
    }
    static double rms_difference(const Image& a, const Image& b) {
        double sum = 0;
        for (size_t i = 0; i < a.values.size(); ++i) sum += std::pow(double(a.values[i]) - double(b.values[i]), 2);
        return std::sqrt(sum / double(a.values.size()));
    }

    Scene scene_;
    RenderOptions options_;
    std::unique_ptr<Executor> executor_ = make_executor(ExecutorKind::Threads, 1);
};

TEST_F(ReferenceTest, StopsWhereItsStandardErrorIsBelowTheGoal) {
    const Reference coarse = render_to(0.01), fine = render_to(0.002);
    EXPECT_LT(coarse.standard_error, 0.01);
    EXPECT_LT(fine.standard_error, 0.002);
    EXPECT_GT(fine.samples, coarse.samples);
    EXPECT_EQ(coarse.samples % kReferenceBatch, 0);
    // What is promised is kept: the finer one stands in for the truth.
    EXPECT_LT(rms_difference(coarse.result.radiance, fine.result.radiance), 1.2 * std::hypot(coarse.standard_error, fine.standard_error));
}

TEST_F(ReferenceTest, StopsAtTheMostSamplesAndTellsItsError) {
    const Reference bounded = render_to(1e-6, 128);
    EXPECT_EQ(bounded.samples, 128);
    EXPECT_GT(bounded.standard_error, 1e-6);
}

/// Coverage of a BLEND surface is a coin for every pixel and sample: after N of them the error is half the root of 1/N.
TEST_F(ReferenceTest, TellsTheErrorThatIndependentSamplesHave) {
    scene_ = {};
    add_object(scene_, make_quad({-2, -2, 0}, {4, 0, 0}, {0, 4, 0}), unlit(glm::vec4(1, 1, 1, 0.5f), AlphaMode::Blend));
    options_.background = glm::vec3(0);
    const Reference reference = render_to(1e-6, 1024);
    EXPECT_EQ(reference.samples, 1024);
    EXPECT_NEAR(reference.standard_error, 0.5 / std::sqrt(1024.0), 0.02 * 0.5 / std::sqrt(1024.0));
    Image half(48, 48, 3);
    std::fill(half.values.begin(), half.values.end(), 0.5f);
    EXPECT_NEAR(rms_difference(reference.result.radiance, half), reference.standard_error, 0.06 * reference.standard_error);
}

TEST_F(ReferenceTest, ReadsLevelZeroWhateverTheOptionsSay) {
    options_.mip = texunit::MipMode::Linear;
    options_.filtering.estimator = texunit::Estimator::Reservoir;
    options_.footprint.lod_bias = 3;
    options_.fetches.count = true;
    const Reference truth = render_to(0.01);
    const texunit::FetchCounts counts = truth.result.fetches->total();
    EXPECT_EQ(counts.level_texels[0], counts.texels_requested);
    EXPECT_EQ(counts.texels_requested, counts.lookups * 4);
    options_ = {};
    options_.width = options_.height = 48;
    options_.camera = square_camera();
    EXPECT_EQ(render_to(0.01).result.radiance.values, truth.result.radiance.values);
}

}  // namespace
}  // namespace rawtexel::shading
