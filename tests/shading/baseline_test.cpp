// What others do, in whole frames: each against the formula it stands for.
#include "shading/baseline.h"

#include "shading/render.h"
#include "shading/slope_moments.h"
#include "tests/shading/frame_bits.h"
#include "tests/shading/scene_parts.h"
#include "tests/shading/surfaces.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

namespace rawtexel::shading {
namespace {

using namespace test;
using texunit::Kernel;
using texunit::MipMode;

constexpr int kExtent = 32;  // pixels

/// A quad that fills 32x32 pixels, under a light.
class BaselineTest : public testing::Test {
  protected:
    BaselineTest() {
        options_.width = options_.height = kExtent;
        options_.camera = square_camera();
        Light& light = lighting_.lights.emplace_back();
        light.direction = -glm::normalize(glm::vec3(0.3f, 0.2f, 1.0f));
        light.intensity = 3.0f;
    }

    void add_quad(const Material& material, float repeats) {
        Mesh quad = make_quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, glm::vec2(repeats));
        quad.normals.assign(quad.positions.size(), glm::vec3(0, 0, 1));
        quad.tangents.assign(quad.positions.size(), glm::vec4(1, 0, 0, 1));
        add_object(scene_, std::move(quad), material);
    }
    int add(SceneTexture texture) {
        scene_.textures.push_back(std::move(texture));
        return int(scene_.textures.size()) - 1;
    }
    /// Colours alone, so that shading is affine. `texels` of the texture to a pixel.
    void add_colors(float texels) {
        Material material = unlit(glm::vec4(1));
        material.maps[kBaseColor].texture = add(make_noise_texture(64, 64, 5));
        add_quad(material, texels * kExtent / 64);
    }
    /// Metal with a checkerboard of two opposite slopes, of which every pixel sees as many of either.
    void add_bumps(const glm::vec2& slope, float roughness, float scale = 1) {
        Material material;
        material.metallic = 1;
        material.roughness = roughness;
        material.normal_scale = scale;
        material.maps[kNormal].texture = add(make_texture(2, 2, [&](int x, int y) {
            const glm::vec3 n = glm::normalize(glm::vec3((x + y) % 2 == 0 ? slope : -slope, 1));
            return glm::vec4(0.5f * n + 0.5f, 1);
        }));
        add_quad(material, 2 * kExtent);
    }

    RenderResult result(Baseline baseline, uint32_t seed = 0) {
        options_.filtering.baseline = baseline;
        options_.seed = seed;
        EXPECT_EQ(refusal(scene_, options_), "");
        return render(scene_, lighting_, options_, *executor_);
    }
    Image radiance(Baseline baseline, uint32_t seed = 0) { return std::move(result(baseline, seed).radiance); }

    /// What flat metal of that roughness reflects, in double.
    double flat(double roughness) const {
        reference::Surface s;
        s.metallic = 1;
        s.roughness = roughness;
        return reference::punctual_radiance(s, lighting_.lights[0]).x;
    }

    Scene scene_;
    Lighting lighting_;
    RenderOptions options_;
    std::unique_ptr<Executor> executor_ = make_executor(ExecutorKind::Threads, 1);
};

void expect_all(const Image& image, double expected, double tolerance) {
    double worst = 0;
    for (const float value : image.values) worst = std::max(worst, std::abs(double(value) / expected - 1));
    std::printf("expected %.6g, at most %.2g off\n", expected, worst);
    EXPECT_LT(worst, tolerance) << "found " << image.values[0] << ", expected " << expected;
}

// --- gloss

TEST_F(BaselineTest, ToksvigTakesGlossFromTheLengthOfTheNormal) {
    const float slope = 0.4f, roughness = 0.45f;
    add_bumps({slope, 0}, roughness);
    const double length = 1 / std::hypot(1.0, double(slope)), alpha2 = std::pow(double(roughness), 4), s = 2 / alpha2 - 2;
    const double power = s * length / (length + s * (1 - length));
    expect_all(radiance(Baseline::Toksvig), flat(std::pow(2 / (power + 2), 0.25)), 1e-3);
    expect_all(radiance(Baseline::None), flat(double(roughness)), 1e-3);
}

TEST_F(BaselineTest, CleanAddsTheVarianceOfSlopes) {
    const float slope = 0.4f, roughness = 0.45f, scale = 0.75f;
    add_bumps({slope, 0.1f}, roughness, scale);
    const double variance = std::pow(double(scale), 2) * (double(slope) * double(slope) + 0.01) / 2;  // per axis
    expect_all(radiance(Baseline::Clean), flat(std::pow(std::pow(double(roughness), 4) + 2 * variance, 0.25)), 1e-3);
}

/// GGX with two alphas along an axis and across it (Heitz 2014 section 5.4), metal of base 1, seen along its normal.
double textbook_lobe(const glm::dvec3& light, double along, double across, double angle) {
    const glm::dvec3 view(0, 0, 1), half = glm::normalize(view + light);
    const glm::dvec2 axis(std::cos(angle), std::sin(angle));
    const auto turned = [&](const glm::dvec3& v) { return glm::dvec3(axis.x * v.x + axis.y * v.y, -axis.y * v.x + axis.x * v.y, v.z); };
    const auto smith = [&](const glm::dvec3& v) { return std::sqrt(std::pow(along * v.x, 2) + std::pow(across * v.y, 2) + v.z * v.z); };
    const glm::dvec3 h = turned(half), l = turned(light);
    const double lobe = std::pow(h.x / along, 2) + std::pow(h.y / across, 2) + h.z * h.z;
    const double distribution = 1 / (std::numbers::pi * along * across * lobe * lobe);
    return distribution * 0.5 / (l.z * smith(view) + smith(l)) * l.z;
}

TEST_F(BaselineTest, LeanStretchesTheLobeAlongTheSlopes) {
    const float roughness = 0.45f;
    const double alpha2 = std::pow(double(roughness), 4);
    for (const glm::vec2& slope : {glm::vec2(0.4f, 0), glm::vec2(0, 0.3f), glm::vec2(0.3f, 0.2f), glm::vec2(-0.1f, 0.35f)}) {
        scene_ = {};
        add_bumps(slope, roughness);
        const double variance = double(slope.x) * double(slope.x) + double(slope.y) * double(slope.y);
        // The quad's v runs down the picture and its bitangent up: the map's frame is that of the picture.
        const double angle = std::atan2(double(slope.y), double(slope.x));
        const double expected =
            textbook_lobe(-glm::dvec3(lighting_.lights[0].direction), std::sqrt(alpha2 + 2 * variance), std::sqrt(alpha2), angle);
        expect_all(radiance(Baseline::Lean), expected * 3, 1e-3);
    }
}

TEST_F(BaselineTest, NothingIsAddedToAFlatMap) {
    add_bumps({0, 0}, 0.3f);
    const Image before = radiance(Baseline::None);
    for (const Baseline baseline : {Baseline::Toksvig, Baseline::Clean, Baseline::Lean}) {
        const Image corrected = radiance(baseline);
        for (size_t i = 0; i < before.values.size(); ++i)
            ASSERT_NEAR(corrected.values[i], before.values[i], 1e-4 * before.values[i]) << to_string(baseline);
    }
}

TEST(StretchedLobe, WithEqualAxesIsTheRoundOne) {
    std::mt19937 random(6);
    double worst = 0;
    for (int i = 0; i < 200; ++i) {
        SurfaceWave wave = random_wave(random);
        Lighting lighting;
        lighting.lights.emplace_back().direction = glm::vec3(random_direction(random));
        WaveVector round, stretched;
        shade_surface(lighting, wave, texunit::kWaveFull, round);
        wave.stretched = true;
        for (int lane = 0; lane < texunit::kWaveLanes; ++lane) {
            const glm::dvec3 n = lane_of(wave.normal, lane);
            const glm::dvec3 u = glm::normalize(glm::cross(n, random_direction(random))), w = glm::cross(n, u);
            const double alpha = std::max(std::pow(double(wave.roughness[lane]), 2), 1e-3);
            set_lane(wave.axis[0], lane, alpha * u);
            set_lane(wave.axis[1], lane, alpha * w);
        }
        shade_surface(lighting, wave, texunit::kWaveFull, stretched);
        for (int lane = 0; lane < texunit::kWaveLanes; ++lane) {
            const double expected = double(round.x[lane]), alpha = std::max(std::pow(double(wave.roughness[lane]), 2), 1e-3);
            const double error = std::abs(double(stretched.x[lane]) - expected) / std::max(expected, 1e-2) * alpha;
            worst = std::max(worst, error);
        }
    }
    std::printf("relative difference times alpha: at most %.2g\n", worst);
    EXPECT_LT(worst, 3e-5);
}

TEST(SlopeMoments, OfHugeMapsAreBeyondWhatIsAllowed) {
    EXPECT_GT(slope_moment_bytes({.width = 16384, .height = 16384}, false), kMostMomentBytes);
    EXPECT_LT(slope_moment_bytes({.width = 8192, .height = 8192}, true), kMostMomentBytes);
}

TEST(SlopeMoments, AreMeansOfSlopesAndOfTheirProducts) {
    const SceneTexture map = make_texture(2, 1, [](int x, int) {
        const glm::vec3 n = glm::normalize(x == 0 ? glm::vec3(0.5f, 0.25f, 1) : glm::vec3(-0.1f, 0.3f, 1));
        return glm::vec4(0.5f * n + 0.5f, 1);
    });
    const SlopeMoments moments = make_slope_moments(*map.texture, true);
    const std::array<float, 4> powers = moments.powers->texel(1, 0, 0, 0), product = moments.product->texel(1, 0, 0, 0);
    const double expected[] = {0.2, 0.275, (0.25 + 0.01) / 2, (0.0625 + 0.09) / 2};
    for (size_t c = 0; c < 4; ++c) EXPECT_NEAR(powers[c], expected[c], 1e-5) << c;
    EXPECT_NEAR(product[0], (0.125 - 0.03) / 2, 1e-5);
}

// --- levels

TEST_F(BaselineTest, DrawnLevelsAverageToTrilinear) {
    constexpr uint32_t kFrames = 400;
    for (const float texels : {0.7f, 1.3f, 2.9f, 40.0f, 100.0f}) {
        scene_ = {};
        add_colors(texels);
        const Image expected = radiance(Baseline::None);
        std::vector<double> sum(expected.values.size()), squares(sum.size());
        for (uint32_t seed = 1; seed <= kFrames; ++seed) {
            const Image frame = radiance(Baseline::OiioStochastic, seed);
            for (size_t i = 0; i < sum.size(); ++i)
                sum[i] += double(frame.values[i]), squares[i] += double(frame.values[i]) * double(frame.values[i]);
        }
        double chi_square = 0, largest = 0;
        size_t values = 0;
        for (size_t i = 0; i < sum.size(); ++i) {
            const double mean = sum[i] / kFrames, variance = std::max(squares[i] / kFrames - mean * mean, 0.0) / (kFrames - 1);
            if (variance < 1e-12) {
                EXPECT_NEAR(mean, expected.values[i], 1e-5);
                continue;
            }
            const double z = (mean - double(expected.values[i])) / std::sqrt(variance);
            chi_square += z * z, ++values;
            largest = std::max(largest, std::abs(z));
        }
        std::printf("%g texels a pixel: chi^2/dof %.3f, largest |z| %.2f\n", double(texels), values ? chi_square / double(values) : 0,
                    largest);
        // At most 3072 values a case, 5 cases: |z| above 6.6 once in a million. Channels of a pixel draw together: a third is independent.
        EXPECT_LT(largest, 7);
        if (values > 0) {
            EXPECT_NEAR(chi_square / double(values), 1, 4.9 * std::sqrt(2.0 / (double(values) / 3)) + 0.02);
        }
    }
}

TEST_F(BaselineTest, DrawnLevelsAskForHalfTheTexelsOfTrilinear) {
    // No sample lies on a line of texels' centres, where taps weigh nothing.
    add_colors(1.37f);
    options_.fetches.count = true;
    const uint64_t trilinear = result(Baseline::None).fetches->total().texels_requested;
    EXPECT_EQ(trilinear, 8u * kExtent * kExtent);
    EXPECT_EQ(2 * result(Baseline::OiioStochastic).fetches->total().texels_requested, trilinear);
}

TEST_F(BaselineTest, MoonrayIsClosestWhereMinifiedAndBilinearWhereMagnified) {
    options_.fetches.count = true;
    for (const float texels : {0.61f, 2.2f}) {
        scene_ = {};
        add_colors(texels);
        RenderResult found = result(Baseline::Moonray);
        const bool magnified = texels < 1;
        EXPECT_EQ(found.fetches->total().texels_requested, (magnified ? 4u : 1u) * kExtent * kExtent);
        options_.filter = magnified ? Kernel::Bilinear : Kernel::Nearest;
        options_.mip = MipMode::Nearest;
        EXPECT_EQ(found.radiance.values, radiance(Baseline::None).values);
        options_.filter = std::nullopt;
        options_.mip = std::nullopt;
    }
}

// --- dithers

TEST_F(BaselineTest, DithersShadeTheTexelThatTheirOffsetsSay) {
    options_.fetches.count = true;
    for (const Baseline baseline : {Baseline::UeDither, Baseline::StartrekDither}) {
        scene_ = {};
        add_colors(0.37f);
        const RenderResult found = result(baseline);
        EXPECT_EQ(found.fetches->total().texels_requested, uint64_t{kExtent} * kExtent);
        int judged = 0;
        for (int y = 0; y < kExtent; ++y) {
            for (int x = 0; x < kExtent; ++x) {
                const auto texel = [&](int pixel, int axis) {
                    const int ue[2][4] = {{1, 2, 3, 0}, {0, 3, 2, 1}}, thresholds[] = {8, 4, 6, 2, 7, 3, 5, 1};
                    const int other = axis == 0 ? y : x;
                    const double offset = baseline == Baseline::UeDither ? ue[axis][2 * (y & 1) + (x & 1)] / 4.0
                                                                         : 1 - thresholds[4 * (other & 1) + (pixel & 3)] / 9.0;
                    return (pixel + 0.5) * double(0.37f) - 0.5 + offset;
                };
                const double tx = texel(x, 0), ty = texel(y, 1);
                const auto near_edge = [](double t) { return std::abs(t - std::round(t)) < 1e-3; };
                if (near_edge(tx) || near_edge(ty)) continue;
                const auto value = scene_.textures[0].texture->texel(0, 0, int(std::floor(tx)) & 63, int(std::floor(ty)) & 63);
                for (int c = 0; c < 3; ++c) ASSERT_EQ(found.radiance.pixel(x, y)[c], value[size_t(c)]) << x << ' ' << y;
                ++judged;
            }
        }
        EXPECT_GT(judged, 900);
    }
}

// --- policies

TEST_F(BaselineTest, PoliciesTakeTheirPlace) {
    add_colors(0.37f);
    const Image before = radiance(Baseline::None);
    scene_.materials[0].policy.order = FilterOrder::Before;
    for (const Baseline baseline : {Baseline::UeDither, Baseline::OiioStochastic, Baseline::Moonray})
        EXPECT_EQ(radiance(baseline).values, before.values) << to_string(baseline);
}

TEST_F(BaselineTest, DithersAndPoliciesDoNotMixInAMaterial) {
    add_bumps({0.2f, 0}, 0.5f);
    scene_.materials[0].maps[kBaseColor].texture = add(make_noise_texture(8, 8, 1));
    options_.filtering.baseline = Baseline::UeDither;
    EXPECT_EQ(refusal(scene_, options_), "");
    scene_.textures[0].policy.order = FilterOrder::Before;
    EXPECT_NE(refusal(scene_, options_).find("ue-dither"), std::string::npos);
    options_.filtering.baseline = Baseline::Lean;
    EXPECT_EQ(refusal(scene_, options_), "");
}

// --- all

TEST(BaselineBits, DoNotDependOnTilesThreadsAndCrops) {
    const Scene scene = make_busy_scene();
    const std::unique_ptr<Executor> one = make_executor(ExecutorKind::Threads, 1);
    const Lighting lighting = busy_lighting(scene, *one);
    std::vector<Image> wholes;
    for (const BaselineInfo& info : all_baselines()) {
        RenderOptions options;
        options.width = 165;
        options.height = 101;
        options.camera = busy_camera();
        options.filtering.baseline = info.baseline;
        EXPECT_EQ(refusal(scene, options), "");
        const Image whole = expect_bits_of_tiles_threads_and_crops(scene, lighting, options, std::string(info.name));
        for (const float value : whole.values) ASSERT_TRUE(std::isfinite(value)) << info.name;
        for (const Image& other : wholes) EXPECT_NE(other.values, whole.values) << info.name;
        wholes.push_back(whole);
        EXPECT_EQ(parse_baseline(info.name), info.baseline);
        EXPECT_EQ(to_string(info.baseline), info.name);
    }
}

}  // namespace
}  // namespace rawtexel::shading
