// Image-based light against brute force: the image itself, diffuse light, and lobes of every roughness.
#include "shading/environment.h"

#include "shading/environment_tables.h"
#include "shading/octahedral.h"
#include "shading/prefilter.h"
#include "tests/reference/shading/environment.h"
#include "tests/shading/environments.h"
#include "tests/shading/surfaces.h"
#include "texunit/simd.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

namespace rawtexel::shading {
namespace {

using namespace test;

Image uniform_image(int width, int height, const glm::vec3& radiance) {
    Image image(width, height, 3);
    for (int i = 0; i < width * height; ++i)
        for (int c = 0; c < 3; ++c) image.values[size_t(3 * i + c)] = radiance[c];
    return image;
}

TEST(EnvironmentRadiance, IsTheBilinearImage) {
    std::mt19937 random(1);
    double worst = 0.0;
    for (int i = 0; i < 20000; ++i) {
        glm::dvec3 d = random_direction(random);
        // The seam, the poles and the axes too.
        if (i % 10 == 0) d = glm::normalize(d * glm::dvec3(1e-4, 1.0, 1.0) + glm::dvec3(0, 0, 2));
        if (i % 10 == 1) d = glm::normalize(d * glm::dvec3(1e-3, 1.0, 1e-3));
        if (i % 10 == 2) d = glm::dvec3(i % 3 == 0, 0, i % 3 != 0) * (i % 4 < 2 ? 1.0 : -1.0);
        const glm::vec3 direction(d);
        const glm::dvec3 expected = reference::latlong_radiance(sky(), glm::normalize(glm::dvec3(direction)));
        const glm::vec3 found = sky_environment().radiance(direction);
        for (int c = 0; c < 3; ++c) {
            worst = std::max(worst, std::fabs(double(found[c]) - expected[c]));
            ASSERT_NEAR(found[c], expected[c], 5e-5) << "direction " << direction.x << ' ' << direction.y << ' ' << direction.z;
        }
    }
    RecordProperty("worst_error", std::to_string(worst));
}

TEST(EnvironmentRadiance, LooksWhereTheConventionSays) {
    // The image's centre is -Z, a quarter to the right +X, its top +Y.
    SerialExecutor executor;
    Image image(8, 4, 3);
    const auto mark = [&](int x, int y, float value) { image.pixel(x, y)[0] = value; };
    mark(3, 1, 1.0f), mark(4, 1, 1.0f), mark(3, 2, 1.0f), mark(4, 2, 1.0f);
    mark(5, 1, 2.0f), mark(6, 1, 2.0f), mark(5, 2, 2.0f), mark(6, 2, 2.0f);
    for (int x = 0; x < 8; ++x) mark(x, 0, 3.0f);
    const Environment environment(image, executor);
    EXPECT_NEAR(environment.radiance({0, 0, -1}).r, 1.0f, 1e-4f);
    EXPECT_NEAR(environment.radiance({1, 0, 0}).r, 2.0f, 1e-4f);
    EXPECT_NEAR(environment.radiance({0, 1, 0}).r, 3.0f, 1e-4f);
    EXPECT_NEAR(environment.radiance({0, 0, 1}).r, 0.0f, 1e-4f);
}

TEST(EnvironmentLight, OfAUniformSkyIsUniform) {
    SerialExecutor executor;
    const glm::vec3 radiance(0.5f, 1.0f, 100.0f);
    for (const glm::ivec2& extents : {glm::ivec2(1, 1), glm::ivec2(2, 1), glm::ivec2(7, 3), glm::ivec2(3, 11), glm::ivec2(500, 250)}) {
        const Environment environment(uniform_image(extents.x, extents.y, radiance), executor);
        double worst = 0.0;
        for (int k = 0; k < 500; ++k)
            for (const float roughness : {0.0f, 0.05f, 0.12f, 0.2f, 0.35f, 0.5f, 0.7f, 1.0f, 1.5f, 2.0f}) {
                const glm::dvec3 light = environment.specular(glm::vec3(reference::spiral_direction(k, 500)), roughness);
                for (int c = 0; c < 3; ++c) worst = std::max(worst, std::fabs(light[c] / double(radiance[c]) - 1.0));
            }
        EXPECT_LT(worst, 0.008) << extents.x << " x " << extents.y;
    }
}

TEST(EnvironmentLight, IsWithinOnePercentOfSampling65536DirectionsOfTheSky) {
    for (const double roughness : {0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.8, 1.0}) {
        Errors errors;
        for (int k = 0; k < 16; ++k) {
            const glm::dvec3 n = reference::spiral_direction(k, 16);
            const double alpha = std::max(roughness * roughness, 1e-3);
            errors.add(glm::dvec3(sky_environment().specular(glm::vec3(n), float(roughness))),
                       reference::sampled_lobe(sky(), n, alpha, 65536));
        }
        std::printf("  sky, roughness %.2f: worst %.2f %%, root mean square %.2f %%\n", roughness, 100 * errors.worst_relative,
                    100 * errors.rms());
        // Below a roughness of 0.1 the lobe is narrower than the image's texels, and just under the horizon its faint tail is all there is.
        EXPECT_LT(errors.worst_relative, roughness < 0.1 ? 0.015 : 0.01) << "roughness " << roughness;
    }
}

TEST(EnvironmentLight, OfASmallBrightSunIsWithinOnePercentInTheMean) {
    // 65 536 directions of a wide lobe meet a sun of 1.5 degrees 45 times and scatter by some per cent, so the reference visits the whole
    // image.
    SerialExecutor executor;
    const Image image = sharp_sun(512);
    const Environment environment(image, executor);
    const reference::ImageIntegral integral(image, 3);
    const glm::dvec3 sun = to_sharp_sun();
    for (const double roughness : {0.2, 0.3, 0.4, 0.5, 0.7, 0.9, 1.0}) {
        Errors errors;
        for (int k = 0; k < 18; ++k) {
            // A third of the directions close to the sun's.
            glm::dvec3 n = reference::spiral_direction(k, 18);
            if (k % 3 == 0) n = glm::normalize(sun + n * (0.01 * k));
            errors.add(glm::dvec3(environment.specular(glm::vec3(n), float(roughness))), integral.lobe(n, roughness * roughness));
        }
        std::printf("  sun, roughness %.2f: worst %.2f %%, root mean square %.2f %%\n", roughness, 100 * errors.worst_relative,
                    100 * errors.rms());
        EXPECT_LT(errors.rms(), 0.01) << "roughness " << roughness;
        EXPECT_LT(errors.worst_relative, 0.05) << "roughness " << roughness;
    }
}

TEST(EnvironmentLight, DiffuseIsTheCosineLobe) {
    for (int k = 0; k < 100; ++k) {
        const glm::vec3 n(reference::spiral_direction(k, 100));
        EXPECT_EQ(sky_environment().diffuse(n), sky_environment().specular(n, 1.0f));
    }
}

TEST(EnvironmentLight, HasNoSeams) {
    // Across the folds of the octahedral maps and the image's own seam, light changes no faster than beside them.
    const auto jump = [&](const glm::dvec3& at, const glm::dvec3& across, float roughness) {
        const glm::dvec3 left = sky_environment().specular(glm::vec3(glm::normalize(at - across * 1e-5)), roughness);
        const glm::dvec3 right = sky_environment().specular(glm::vec3(glm::normalize(at + across * 1e-5)), roughness);
        return glm::length(left - right) / glm::length(left);
    };
    for (int k = 0; k < 400; ++k) {
        const double angle = 2.0 * 3.14159265358979 * k / 400, c = std::cos(angle), s = std::sin(angle);
        for (const float roughness : {0.1f, 0.3f, 0.8f}) {
            EXPECT_LT(jump({c, 0, s}, {0, 1, 0}, roughness), 2e-3) << "horizon, angle " << angle;
            EXPECT_LT(jump({0, c, s}, {1, 0, 0}, roughness), 2e-3) << "x = 0, angle " << angle;
            EXPECT_LT(jump({c, s, 0}, {0, 0, 1}, roughness), 2e-3) << "z = 0, angle " << angle;
        }
    }
}

TEST(EnvironmentLight, ChangesSteadilyWithRoughness) {
    for (int k = 0; k < 20; ++k) {
        const glm::vec3 n(reference::spiral_direction(k, 20));
        glm::vec3 last = sky_environment().specular(n, 0.0f);
        for (float roughness = 0.002f; roughness <= kFlatRoughness; roughness += 0.002f) {
            const glm::vec3 light = sky_environment().specular(n, roughness);
            ASSERT_LT(glm::length(light - last), 0.02f * glm::length(last)) << "direction " << k << " roughness " << roughness;
            last = light;
        }
    }
}

TEST(Environment, ReadsWhatIsNoLightAsBlack) {
    SerialExecutor executor;
    Image image = uniform_image(16, 8, glm::vec3(1.0f));
    Image expected = image;
    const float wrong[] = {std::nanf(""), -1.0f, HUGE_VALF, -HUGE_VALF};
    for (int i = 0; i < 4; ++i) {
        image.pixel(3 * i, i)[i % 3] = wrong[i];
        expected.pixel(3 * i, i)[i % 3] = 0.0f;
    }
    const Environment a(image, executor), b(expected, executor);
    for (int k = 0; k < 200; ++k) {
        const glm::vec3 n(reference::spiral_direction(k, 200));
        EXPECT_EQ(a.radiance(n), b.radiance(n));
        EXPECT_EQ(a.specular(n, 0.4f), b.specular(n, 0.4f));
    }
}

TEST(Environment, IgnoresAFourthChannel) {
    SerialExecutor executor;
    Image image(16, 8, 4);
    for (size_t i = 0; i < image.values.size(); ++i) image.values[i] = i % 4 == 3 ? 77.0f : 2.0f;
    EXPECT_NEAR(Environment(image, executor).diffuse({0, 1, 0}).b, 2.0f, 0.01f);
}

TEST(Environment, HasTheSameBitsForAnyThreadsAndInstructionSet) {
    const std::unique_ptr<Executor> threads = make_executor(ExecutorKind::Threads, 3);
    SerialExecutor serial;
    const Image image = sky_latlong(32, 16);
    const Environment expected(image, serial);
    const auto same = [&](const Environment& other) {
        const auto& a = expected.tables().texels;
        const auto& b = other.tables().texels;
        return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0;
    };
    for (const texunit::Simd simd : texunit::available_simd()) {
        ASSERT_TRUE(texunit::choose_simd(simd));
        EXPECT_TRUE(same(Environment(image, *threads))) << to_string(simd);
        for (int k = 0; k < 300; ++k) {
            const glm::vec3 n(reference::spiral_direction(k, 300));
            texunit::choose_simd(texunit::Simd::Scalar);
            const glm::vec3 radiance = expected.radiance(n), specular = expected.specular(n, 0.013f * float(k % 77));
            texunit::choose_simd(simd);
            ASSERT_EQ(expected.radiance(n), radiance) << to_string(simd);
            ASSERT_EQ(expected.specular(n, 0.013f * float(k % 77)), specular) << to_string(simd);
        }
    }
    texunit::choose_simd(texunit::Simd::Auto);
}

TEST(LobeKernel, IntegratesToOne) {
    for (const double alpha : {0.01, 0.1, 0.5, 0.9, 0.999, 0.99999, 1.0, 3.0, HUGE_VAL}) {
        const LobeKernel kernel(alpha);
        double sum = 0.0;
        constexpr int kSteps = 200000;
        for (int i = 0; i < kSteps; ++i) {
            // c = 1 - t^4 gathers points at the lobe's peak.
            const double t = (i + 0.5) / kSteps, c = 1.0 - t * t * t * t;
            sum += kernel.density(c) * 2.0 * 3.14159265358979 * 4.0 * t * t * t / kSteps;
        }
        EXPECT_NEAR(sum, 1.0, 1e-6) << "alpha " << alpha;
    }
}

TEST(Octahedral, DirectionsSurviveARoundTrip) {
    std::mt19937 random(2);
    for (int i = 0; i < 10000; ++i) {
        const glm::dvec3 d = random_direction(random);
        EXPECT_LT(glm::length(direction_from_octahedral(octahedral_from_direction(d)) - d), 1e-12);
    }
}

TEST(Octahedral, WrappedTexelsAreNeighboursOnTheSphere) {
    constexpr int kExtent = 16;
    const auto direction = [&](double x, double y) { return direction_from_octahedral(glm::dvec2(x + 0.5, y + 0.5) / double(kExtent)); };
    for (int i = -1; i <= kExtent; ++i)
        for (const glm::ivec2& outside : {glm::ivec2(i, -1), glm::ivec2(i, kExtent), glm::ivec2(-1, i), glm::ivec2(kExtent, i)}) {
            const glm::ivec2 inside = octahedral_wrapped(outside.x, outside.y, kExtent);
            ASSERT_TRUE(inside.x >= 0 && inside.y >= 0 && inside.x < kExtent && inside.y < kExtent);
            const glm::ivec2 edge(std::clamp(outside.x, 0, kExtent - 1), std::clamp(outside.y, 0, kExtent - 1));
            EXPECT_LT(glm::length(direction(inside.x, inside.y) - direction(edge.x, edge.y)), 4.0 / kExtent)
                << outside.x << ' ' << outside.y;
        }
}

TEST(PackedRadiance, KeepsEveryMagnitudeWithinTwoToTheMinusFourteen) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> exponent(-30.0f, 30.0f);
    for (int i = 0; i < 100000; ++i) {
        const glm::vec3 rgb(std::exp2(exponent(random)), std::exp2(exponent(random)), std::exp2(exponent(random)));
        const glm::vec3 kept = unpack_radiance(pack_radiance(rgb));
        for (int c = 0; c < 3; ++c) ASSERT_LE(std::fabs(kept[c] / rgb[c] - 1.0f), std::exp2(-14.0f)) << rgb[c];
        ASSERT_EQ(pack_radiance(kept), pack_radiance(rgb));
    }
    EXPECT_EQ(unpack_radiance(pack_radiance({0.0f, -3.0f, std::nanf("")})), glm::vec3(0.0f));
    EXPECT_TRUE(std::isfinite(unpack_radiance(pack_radiance(glm::vec3(HUGE_VALF))).g));
}

}  // namespace
}  // namespace rawtexel::shading
