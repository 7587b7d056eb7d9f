// Filtering before and after shading, in whole frames.
#include "shading/filtering_options.h"

#include "shading/render.h"
#include "tests/shading/agreement.h"
#include "tests/shading/frame_bits.h"
#include "tests/shading/scene_parts.h"
#include "texunit/random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <vector>

namespace rawtexel::shading {
namespace {

using namespace test;
using texunit::Estimator;
using texunit::Kernel;

/// A quad that fills 32x32 pixels, with maps of its own and a light upon it.
class FilteringTest : public testing::Test {
  protected:
    FilteringTest() {
        options_.width = options_.height = 32;
        options_.camera = square_camera();
        lighting_.ambient = 0.1f;
        Light& light = lighting_.lights.emplace_back();
        light.direction = glm::normalize(glm::vec3(0.4f, 0.3f, -1.0f));
        light.intensity = 3.0f;
    }

    int add_texture(int width, int height, uint32_t seed) {
        scene_.textures.push_back(make_noise_texture(width, height, seed));
        return int(scene_.textures.size()) - 1;
    }
    /// Base colour, metallic-roughness and normal maps of the given extents; `extent` texels meet 32 pixels.
    Material lit_material(int base, int rough, int normal) {
        Material material;
        material.maps[kBaseColor].texture = add_texture(base, base, 1);
        material.maps[kMetallicRoughness].texture = add_texture(rough, rough, 2);
        material.maps[kNormal].texture = add_texture(normal, normal, 3);
        return material;
    }
    void add_quad(const Material& material, float z = 0) {
        Mesh quad = make_quad({-1, -1, z}, {2, 0, 0}, {0, 2, 0}, glm::vec2(1.37f, 1.21f));
        quad.normals.assign(quad.positions.size(), glm::vec3(0, 0, 1));
        quad.tangents.assign(quad.positions.size(), glm::vec4(1, 0, 0, 1));
        add_object(scene_, std::move(quad), material);
    }

    Image radiance(const FilteringOptions& filtering, uint32_t seed = 0) {
        options_.filtering = filtering;
        options_.seed = seed;
        EXPECT_EQ(refusal(scene_, options_), "");
        return render(scene_, lighting_, options_, *executor_).radiance;
    }

    static FilteringOptions drawn(Estimator estimator, int taps = 1) { return {.estimator = estimator, .taps = taps}; }
    static FilteringOptions listed() { return {.order = FilterOrder::After}; }

    /// Many one-sample frames, each with its own numbers at the same place: their mean against `expected`, pixel by pixel.
    Agreement compare(const FilteringOptions& filtering, const Image& expected, uint32_t frames) {
        return agreement_of(expected, frames, [&](uint32_t seed) { return radiance(filtering, seed); });
    }

    Scene scene_;
    Lighting lighting_;
    RenderOptions options_;
    std::unique_ptr<Executor> executor_ = make_executor(ExecutorKind::Threads, 1);
};

TEST_F(FilteringTest, OrderChangesNothingWhereShadingIsAffine) {
    Material material = unlit(glm::vec4(0.7f, 0.9f, 1.1f, 1));
    material.maps[kBaseColor].texture = add_texture(24, 20, 5);
    add_quad(material);
    for (const Kernel& kernel : {Kernel::Bilinear, Kernel::BSpline, Kernel::CatmullRom, Kernel::Lanczos3, Kernel::gaussian(0.8f)}) {
        options_.filter = kernel;
        const Image before = radiance({});
        // Negative lobes go below black before shading, where base colours end.
        const bool clamps = !texunit::weighs_as_probability(kernel);
        EXPECT_LT(largest_difference(before, radiance(listed())), clamps ? 0.3 : 2e-6) << to_string(kernel);
        if (!clamps) expect_agreement(compare(drawn(Estimator::Reservoir), before, 800), to_string(kernel).c_str());
    }
    options_.filter = Kernel::BSpline;
    expect_agreement(compare(drawn(Estimator::Jitter), radiance({}), 800), "jittered bspline");
    expect_agreement(compare(drawn(Estimator::Jitter, 3), radiance({}), 300), "jittered bspline, 3 taps");
}

TEST_F(FilteringTest, OneDrawConvergesToAllTapsOfMapsOfOneExtent) {
    add_quad(lit_material(20, 20, 20));
    for (const Kernel& kernel : {Kernel::Bilinear, Kernel::BSpline, Kernel::mitchell()}) {
        options_.filter = kernel;
        const Image all = radiance(listed());
        EXPECT_GT(largest_difference(all, radiance({})), 0.01) << "shading should not be affine";
        expect_agreement(compare(drawn(Estimator::Reservoir), all, 1500), to_string(kernel).c_str());
    }
}

TEST_F(FilteringTest, OneDrawConvergesToAllTapsOfMapsOfDifferentExtents) {
    add_quad(lit_material(20, 32, 12));
    for (const Kernel& kernel : {Kernel::Bilinear, Kernel::CatmullRom}) {
        options_.filter = kernel;
        expect_agreement(compare(drawn(Estimator::Reservoir), radiance(listed()), 1500), to_string(kernel).c_str());
    }
    // Minified: levels and probes are drawn as well.
    options_.filter = std::nullopt;
    options_.footprint.probes = 4;
    Scene small = scene_;
    scene_.meshes[0].uv[0] = make_quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, glm::vec2(4.3f, 2.2f)).uv[0];
    expect_agreement(compare(drawn(Estimator::Reservoir), radiance(listed()), 1500), "minified, 4 probes");
}

/// Ambient light is base colour times occlusion: of two maps that hold the same the mean of the product is not the product of the means.
TEST_F(FilteringTest, DrawsWithNumbersOfTheirOwnConvergeToFilteringFirstWhereShadingIsAProduct) {
    Material material;
    material.maps[kBaseColor].texture = add_texture(16, 16, 7);
    material.maps[kOcclusion].texture = add_texture(16, 16, 7);
    add_quad(material);
    lighting_.lights.clear();
    lighting_.ambient = 1;
    const Image before = radiance({});
    EXPECT_GT(largest_difference(before, radiance(listed())), 0.05);
    FilteringOptions per_map = drawn(Estimator::Reservoir);
    per_map.sharing = NumberSharing::PerMap;
    expect_agreement(compare(per_map, before, 800), "per-map");
    expect_agreement(compare(drawn(Estimator::Reservoir), radiance(listed()), 800), "shared");
}

TEST_F(FilteringTest, CommonNumbersForBothSignsChangeNoMean) {
    add_quad(lit_material(20, 20, 20));
    options_.filter = Kernel::CatmullRom;
    const Image all = radiance(listed());
    FilteringOptions common = drawn(Estimator::Reservoir);
    common.common_numbers = true;
    EXPECT_GT(largest_difference(radiance(common), radiance(drawn(Estimator::Reservoir))), 0.01);
    expect_agreement(compare(common, all, 1500), "common numbers");
}

TEST_F(FilteringTest, MaskAndBlendDecideWithTheTexelThatIsShaded) {
    for (const AlphaMode mode : {AlphaMode::Mask, AlphaMode::Blend}) {
        scene_ = {};
        Material front = lit_material(12, 12, 12);
        front.alpha_mode = mode;
        add_quad(front, 0.5f);
        add_quad(unlit(glm::vec4(0, 0.3f, 1.5f, 1)));
        options_.filter = Kernel::Bilinear;
        // Which surface is seen is drawn even where all taps are weighed, so both are averaged.
        constexpr uint32_t kFrames = 1200;
        Image expected(32, 32, 3);
        std::vector<double> mean(expected.values.size());
        for (uint32_t seed = 5001; seed <= 5000 + 4 * kFrames; ++seed) {
            const Image frame = radiance(listed(), seed);
            for (size_t i = 0; i < mean.size(); ++i) mean[i] += double(frame.values[i]) / (4 * kFrames);
        }
        for (size_t i = 0; i < mean.size(); ++i) expected.values[i] = float(mean[i]);
        const Agreement agreement = compare(drawn(Estimator::Reservoir), expected, kFrames);
        // The expectation has up to a quarter of the variance itself.
        std::printf("chi^2/dof %.3f, largest |z| %.2f\n", agreement.per_value(), agreement.largest);
        EXPECT_LT(agreement.largest, 6.4);
        EXPECT_GT(agreement.per_value(), 0.85);
        EXPECT_LT(agreement.per_value(), 1.4);
    }
}

/// The share of a pixel that a MASK surface covers is the filtered share of texels that pass, not the test of their mean.
TEST_F(FilteringTest, MaskAfterShadingCoversTheShareOfTexelsThatPass) {
    scene_.textures.push_back(make_texture(8, 8, [](int x, int y) { return glm::vec4(1, 1, 1, (x + y) % 2 == 0 ? 0.9f : 0.3f); }));
    Material front = unlit(glm::vec4(1), AlphaMode::Mask);
    front.maps[kBaseColor].texture = 0;
    add_quad(front, 0.5f);
    options_.background = glm::vec3(0);
    options_.filter = Kernel::BSpline;
    options_.spp = 1024;
    double sums[3] = {};
    int k = 0;
    for (const FilteringOptions& filtering : {drawn(Estimator::Reservoir), listed(), FilteringOptions{}}) {
        const Image image = radiance(filtering);
        sums[k++] = std::accumulate(image.values.begin(), image.values.end(), 0.0) / double(image.values.size());
    }
    // Half of the texels pass; the mean alpha 0.6 does almost everywhere.
    EXPECT_NEAR(sums[0], 0.5, 0.01);
    EXPECT_NEAR(sums[1], 0.5, 0.01);
    EXPECT_GT(sums[2], 0.9);
}

TEST_F(FilteringTest, TapsShareTheVariance) {
    add_quad(lit_material(16, 16, 16));
    options_.filter = Kernel::BSpline;
    const auto variance = [&](int taps) {
        const Image all = radiance(listed());
        double squares = 0;
        for (uint32_t seed = 1; seed <= 60; ++seed) {
            const Image frame = radiance(drawn(Estimator::Reservoir, taps), seed);
            for (size_t i = 0; i < all.values.size(); ++i) squares += std::pow(double(frame.values[i]) - double(all.values[i]), 2);
        }
        return squares;
    };
    const double one = variance(1), eight = variance(8);
    EXPECT_NEAR(one / eight, 8, 0.8);
}

TEST_F(FilteringTest, DemandsOneTexelPerMapAndDraw) {
    add_quad(lit_material(16, 16, 16));
    options_.fetches.count = true;
    const auto texels = [&](const FilteringOptions& filtering) {
        options_.filtering = filtering;
        const RenderResult result = render(scene_, lighting_, options_, *executor_);
        EXPECT_EQ(result.fetches->total().lookups, 3u * 32 * 32);
        return double(result.fetches->total().texels_requested) / (3 * 32 * 32);
    };
    options_.filter = Kernel::BSpline;
    EXPECT_EQ(texels(drawn(Estimator::Reservoir)), 1);
    EXPECT_EQ(texels(drawn(Estimator::Jitter)), 1);
    EXPECT_EQ(texels(drawn(Estimator::Reservoir, 5)), 5);
    EXPECT_EQ(texels({}), 16);
    EXPECT_EQ(texels(listed()), 16);
    FilteringOptions per_map = drawn(Estimator::Reservoir);
    per_map.sharing = NumberSharing::PerMap;
    EXPECT_EQ(texels(per_map), 1);
    options_.filter = Kernel::CatmullRom;
    EXPECT_EQ(texels(drawn(Estimator::Reservoir)), 2);
    EXPECT_EQ(texels(drawn(Estimator::AbsWeight)), 1);
}

/// A busy scene: the same bits whatever the tiles and threads, and a crop those of the whole.
TEST(FilteringBits, DoNotDependOnTilesThreadsAndCrops) {
    const Scene scene = make_busy_scene();
    const std::unique_ptr<Executor> one = make_executor(ExecutorKind::Threads, 1);
    const Lighting lighting = busy_lighting(scene, *one);
    for (const FilteringOptions& filtering :
         {FilteringOptions{.estimator = Estimator::Reservoir}, FilteringOptions{.order = FilterOrder::After},
          FilteringOptions{.estimator = Estimator::Jitter, .taps = 2, .sharing = NumberSharing::PerMap, .noise = texunit::Noise::Stbn}}) {
        RenderOptions options;
        options.width = 165;
        options.height = 101;
        options.camera = busy_camera();
        options.spp = 3;
        options.filtering = filtering;
        expect_bits_of_tiles_threads_and_crops(scene, lighting, options, std::string(to_string(filtering.estimator)));
    }
}

TEST(FilteringRefusals, NameTheMaterial) {
    Scene scene = make_busy_scene();
    RenderOptions options;
    options.filtering.estimator = Estimator::Jitter;
    EXPECT_EQ(refusal(scene, options), "");
    options.filter = Kernel::Lanczos3;
    EXPECT_NE(refusal(scene, options).find("jitter cannot draw lanczos3"), std::string::npos);
    options.filtering.estimator = Estimator::Reservoir;
    EXPECT_EQ(refusal(scene, options), "");
}

}  // namespace
}  // namespace rawtexel::shading
