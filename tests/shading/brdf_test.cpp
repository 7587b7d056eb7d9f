// The surface model against its double-precision reading, and the energy it keeps.
#include "tests/reference/shading/brdf.h"

#include "shading/environment.h"
#include "shading/ggx_albedo.h"
#include "tests/shading/surfaces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace rawtexel::shading {
namespace {

using namespace test;

std::string described(const reference::Surface& s) {
    std::ostringstream out;
    out << " base " << s.base.x << ' ' << s.base.y << ' ' << s.base.z << " metallic " << s.metallic << " roughness " << s.roughness
        << " n.v " << glm::dot(s.normal, s.view);
    return out.str();
}

Lighting one_light(const glm::dvec3& to_light) {
    Lighting lighting;
    Light light;
    light.direction = -glm::vec3(to_light);
    lighting.lights.push_back(light);
    return lighting;
}

/// A uniform environment of radiance 1.
std::shared_ptr<const Environment> furnace() {
    static const auto environment = [] {
        Image white(64, 32, 3);
        std::fill(white.values.begin(), white.values.end(), 1.0f);
        SerialExecutor executor;
        return std::make_shared<const Environment>(white, executor);
    }();
    return environment;
}

TEST(Brdf, AgreesWithTheDoubleReferenceForRandomSurfacesAndLights) {
    std::mt19937 random(1);
    double worst = 0.0;
    for (int i = 0; i < 20000; ++i) {
        SurfaceWave wave;
        const reference::Surface s = put_surface(random_surface(random), wave, 0);
        const Lighting lighting = one_light(random_direction(random));
        WaveVector radiance;
        shade_surface(lighting, wave, 1u, radiance);
        const glm::dvec3 expected = reference::punctual_radiance(s, lighting.lights[0]) + s.emission;
        const glm::dvec3 found = lane_of(radiance, 0);
        // Unit vectors are rounded to some 1e-7: that much of n.l at grazing light, and of the angle within a lobe alpha wide.
        const double n_dot_l = glm::dot(s.normal, -glm::dvec3(lighting.lights[0].direction));
        for (int c = 0; c < 3; ++c) {
            const double error =
                std::fabs(found[c] - expected[c]) / std::max(expected[c], 1e-3) * std::min(1.0, std::fabs(n_dot_l) * 100.0);
            worst = std::max(worst, error);
            ASSERT_LT(error, 2e-5 + 3e-6 / std::max(s.roughness * s.roughness, 1e-3))
                << "channel " << c << ": found " << found[c] << ", expected " << expected[c] << " at n.l " << n_dot_l << described(s);
        }
    }
    RecordProperty("worst_relative_error", std::to_string(worst));
}

TEST(Brdf, HighlightOfASmoothSurfaceKeepsItsPeak) {
    // At n.h = 1 the distribution is 1/(pi alpha^2): the textbook form loses it to cancellation in float.
    reference::Surface s;
    s.base = glm::dvec3(1.0);
    s.metallic = 1.0;
    s.roughness = 0.0;
    s.normal = glm::normalize(glm::dvec3(0.3, 0.8, 0.5));
    s.view = s.normal;
    const double expected = 1e6 / (4.0 * 3.14159265358979);
    EXPECT_NEAR(shaded(one_light(s.normal), s).x / expected, 1.0, 1e-4);
}

TEST(Brdf, SwappingLightAndViewGivesTheSameValue) {
    std::mt19937 random(2);
    for (int i = 0; i < 2000; ++i) {
        reference::Surface s = random_surface(random);
        s.emission = glm::dvec3(0.0);
        glm::dvec3 light = random_direction(random);
        if (glm::dot(light, s.normal) < 0.05 || glm::dot(s.view, s.normal) < 0.05) continue;
        const glm::dvec3 forth = shaded(one_light(light), s) / glm::dot(light, s.normal);
        std::swap(light, s.view);
        const glm::dvec3 back = shaded(one_light(light), s) / glm::dot(light, s.normal);
        for (int c = 0; c < 3; ++c) ASSERT_NEAR(forth[c], back[c], 2e-5 * std::max(1.0, forth[c])) << described(s);
    }
}

TEST(Brdf, LightFromBehindAddsNothing) {
    reference::Surface s;
    s.roughness = 0.3;
    EXPECT_EQ(shaded(one_light({0.0, 0.0, -1.0}), s), glm::dvec3(0.0));
    EXPECT_EQ(shaded(one_light(glm::normalize(glm::dvec3(1.0, 0.0, -1e-4))), s), glm::dvec3(0.0));
}

TEST(Brdf, ViewFromBehindIsFinite) {
    std::mt19937 random(3);
    for (int i = 0; i < 1000; ++i) {
        reference::Surface s = random_surface(random);
        s.view = random_direction(random);
        Lighting lighting = one_light(i % 2 == 0 ? random_direction(random) : -s.view);
        lighting.environment = furnace();
        const glm::dvec3 radiance = shaded(lighting, s);
        for (int c = 0; c < 3; ++c) ASSERT_TRUE(std::isfinite(radiance[c]) && radiance[c] >= 0.0) << radiance[c];
    }
}

TEST(GgxAlbedo, TableAgreesWithTheIntegral) {
    double worst = 0.0;
    for (double roughness = 0.05; roughness <= 1.0; roughness += 0.0475)
        for (double n_dot_v : {0.03, 0.07, 0.15, 0.31, 0.52, 0.77, 0.93, 1.0}) {
            const glm::vec2 found = ggx_albedo(float(n_dot_v), float(roughness));
            const GgxReflection expected = integrate_ggx_reflection(n_dot_v, roughness * roughness);
            const double error = std::max(std::fabs(found.x - expected.scale), std::fabs(found.y - expected.bias));
            worst = std::max(worst, error);
            EXPECT_LT(error, 4e-3) << "n.v " << n_dot_v << " roughness " << roughness << ": " << found.x << ' ' << found.y << ", integral "
                                   << expected.scale << ' ' << expected.bias;
        }
    RecordProperty("worst_error", std::to_string(worst));
}

TEST(GgxAlbedo, IntegralAgreesWithAnIndependentQuadrature) {
    for (const double roughness : {0.1, 0.3, 0.6, 1.0})
        for (const double n_dot_v : {0.1, 0.5, 1.0}) {
            reference::Surface s;
            s.base = glm::dvec3(1.0, 0.5, 0.0);
            s.metallic = 1.0;
            s.roughness = roughness;
            const GgxReflection terms = integrate_ggx_reflection(n_dot_v, roughness * roughness);
            const glm::dvec3 expected = reference::directional_albedo(s, n_dot_v);
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(s.base[c] * terms.scale + terms.bias, expected[c], 1.5e-3)
                    << "roughness " << roughness << " n.v " << n_dot_v << " F0 " << s.base[c];
        }
}

TEST(GgxReflection, LeansToTheMeanDirectionOfRoughSurfaces) {
    // The axis and length of the mean are those of light drawn from the model itself.
    for (const double roughness : {0.5, 0.7, 1.0})
        for (const double n_dot_v : {0.2, 0.5, 0.8}) {
            reference::Surface s;
            s.metallic = 1.0;
            s.roughness = roughness;
            s.view = {std::sqrt(1.0 - n_dot_v * n_dot_v), 0.0, n_dot_v};
            glm::dvec3 mean(0.0);
            double weight = 0.0;
            constexpr int kSteps = 600;
            for (int i = 0; i < kSteps; ++i)
                for (int j = 0; j < kSteps; ++j) {
                    const double z = (i + 0.5) / kSteps, azimuth = 2.0 * 3.14159265358979 * (j + 0.5) / kSteps,
                                 radius = std::sqrt(1.0 - z * z);
                    const glm::dvec3 light(radius * std::cos(azimuth), radius * std::sin(azimuth), z);
                    const double share = reference::brdf_cosine(s, light).x;
                    mean += light * share;
                    weight += share;
                }
            const GgxReflection found = integrate_ggx_reflection(n_dot_v, roughness * roughness);
            EXPECT_NEAR(found.mean_outwards, -mean.x / weight, 2e-3) << "roughness " << roughness << " n.v " << n_dot_v;
            EXPECT_NEAR(found.mean_up, mean.z / weight, 2e-3) << "roughness " << roughness << " n.v " << n_dot_v;
        }
}

/// What a surface in the furnace reflects, against the integral of its BRDF.
void expect_furnace(const reference::Surface& material, double n_dot_v, double tolerance) {
    Lighting lighting;
    lighting.environment = furnace();
    reference::Surface s = material;
    s.normal = {0.0, 1.0, 0.0};
    s.view = {std::sqrt(1.0 - n_dot_v * n_dot_v), n_dot_v, 0.0};
    const double expected = reference::directional_albedo(material, n_dot_v).x;
    for (const EnvironmentReflections way : {EnvironmentReflections::Prefiltered, EnvironmentReflections::SplitSum}) {
        lighting.reflections = way;
        EXPECT_NEAR(shaded(lighting, s).x / expected, 1.0, tolerance)
            << to_string(way) << " roughness " << s.roughness << " metallic " << s.metallic << " n.v " << n_dot_v;
    }
}

TEST(WhiteFurnace, MirrorsOfFullReflectanceLoseWhatSingleScatteringLoses) {
    for (const double roughness : {0.1, 0.2, 0.4, 0.6, 0.8, 1.0})
        for (const double n_dot_v : {0.1, 0.25, 0.5, 0.75, 1.0}) {
            reference::Surface s;
            s.metallic = 1.0;
            s.roughness = roughness;
            expect_furnace(s, n_dot_v, 0.01);
        }
}

TEST(WhiteFurnace, WhiteDiffuseSurfacesLoseWhatTheModelLoses) {
    for (const double roughness : {0.1, 0.5, 1.0})
        for (const double n_dot_v : {0.1, 0.3, 0.6, 1.0}) {
            reference::Surface s;
            s.roughness = roughness;
            expect_furnace(s, n_dot_v, 0.01);
        }
}

TEST(WhiteFurnace, DiffuseShareAgreesWithTheIntegral) {
    // (1 - F0)(1 - mean Schlick weight): the same for every roughness, so black metals of the same F0 tell specular and diffuse apart.
    for (const double n_dot_v : {0.02, 0.2, 0.5, 1.0}) {
        double x = 0.0;
        for (int k = 4; k >= 0; --k) x = x * n_dot_v + double(kDiffuseFresnel[k]);
        double integral = 0.0;
        constexpr int kSteps = 500;
        for (int i = 0; i < kSteps; ++i)
            for (int j = 0; j < kSteps; ++j) {
                const double n_dot_l = (i + 0.5) / kSteps, azimuth = 3.14159265358979 * (j + 0.5) / kSteps;
                const double v_dot_l = n_dot_v * n_dot_l + std::sqrt((1 - n_dot_v * n_dot_v) * (1 - n_dot_l * n_dot_l)) * std::cos(azimuth);
                integral += 2.0 * n_dot_l * std::pow(1.0 - std::sqrt(std::max(0.0, 0.5 + 0.5 * v_dot_l)), 5.0) / (kSteps * kSteps);
            }
        EXPECT_NEAR(x, integral, 2e-5) << "n.v " << n_dot_v;
    }
}

}  // namespace
}  // namespace rawtexel::shading
