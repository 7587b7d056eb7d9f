// Lights, and what shade_surface makes of all of them together.
#include "shading/lighting.h"

#include "shading/display.h"
#include "tests/shading/surfaces.h"
#include "texunit/simd.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>

namespace rawtexel::shading {
namespace {

using namespace test;

Light point_light(const glm::vec3& position, float range = 0.0f) {
    Light light;
    light.type = Light::Type::Point;
    light.position = position;
    light.color = {1.0f, 0.5f, 0.25f};
    light.intensity = 10.0f;
    light.range = range;
    return light;
}

Light spot_light(const glm::vec3& position, const glm::vec3& direction, float inner, float outer) {
    Light light = point_light(position);
    light.type = Light::Type::Spot;
    light.direction = glm::normalize(direction);
    light.inner_cone = inner;
    light.outer_cone = outer;
    return light;
}

reference::Surface matte() {
    reference::Surface s;
    s.base = glm::dvec3(0.5);
    return s;
}

TEST(Lights, PointAndSpotLightsAgreeWithTheDoubleReference) {
    std::mt19937 random(4);
    std::uniform_real_distribution<float> angle(0.05f, 1.5f), range(0.0f, 8.0f);
    for (int i = 0; i < 4000; ++i) {
        SurfaceWave wave;
        const reference::Surface s = put_surface(random_surface(random), wave, 0);
        const glm::vec3 position(random_direction(random) * 3.0);
        Light light = point_light(position, i % 3 == 0 ? range(random) : 0.0f);
        if (i % 2 == 0) {
            const float outer = angle(random);
            light = spot_light(position, glm::vec3(glm::normalize(s.position - glm::dvec3(position) + 0.5 * random_direction(random))),
                               outer * 0.5f, outer);
        }
        Lighting lighting;
        lighting.lights = {light};
        WaveVector radiance;
        shade_surface(lighting, wave, 1u, radiance);
        const glm::dvec3 expected = reference::punctual_radiance(s, light) + s.emission, found = lane_of(radiance, 0);
        for (int c = 0; c < 3; ++c)
            ASSERT_NEAR(found[c], expected[c], 2e-4 * std::max(expected[c], 0.05)) << "light " << i << " channel " << c;
    }
}

TEST(Lights, PointLightsFallOffWithTheSquareOfTheDistance) {
    Lighting lighting;
    lighting.lights = {point_light({0, 0, 1})};
    const double near = shaded(lighting, matte()).x;
    lighting.lights = {point_light({0, 0, 4})};
    EXPECT_NEAR(shaded(lighting, matte()).x * 16.0 / near, 1.0, 1e-6);
}

TEST(Lights, RangeEndsALight) {
    Lighting lighting;
    lighting.lights = {point_light({0, 0, 2}, 2.0f)};
    EXPECT_EQ(shaded(lighting, matte()).x, 0.0);
    lighting.lights = {point_light({0, 0, 2}, 2.001f)};
    EXPECT_GT(shaded(lighting, matte()).x, 0.0);
    // Half way: 1 - (1/2)^4.
    lighting.lights = {point_light({0, 0, 2}, 4.0f)};
    const double windowed = shaded(lighting, matte()).x;
    lighting.lights = {point_light({0, 0, 2})};
    EXPECT_NEAR(windowed / shaded(lighting, matte()).x, 15.0 / 16.0, 1e-6);
}

TEST(Lights, SpotsAreFullInsideTheInnerConeAndDarkOutsideTheOuter) {
    const float inner = 0.3f, outer = 0.6f;
    const auto lit_at = [&](float degrees_off_axis) {
        Lighting lighting;
        lighting.lights = {spot_light({0, 0, 2}, {std::sin(degrees_off_axis), 0.0f, -std::cos(degrees_off_axis)}, inner, outer)};
        return shaded(lighting, matte()).x;
    };
    const double full = lit_at(0.0f);
    EXPECT_NEAR(lit_at(inner - 0.01f), full, 1e-6 * full);
    EXPECT_EQ(lit_at(outer + 0.01f), 0.0);
    // Between the cones: the square of the cosine's linear ramp.
    const double ramp = (std::cos(0.45) - std::cos(0.6)) / (std::cos(0.3) - std::cos(0.6));
    EXPECT_NEAR(lit_at(0.45f) / full, ramp * ramp, 1e-5);
}

TEST(Lights, APointOnTheLightItselfIsFinite) {
    Lighting lighting;
    lighting.lights = {point_light({0, 0, 0})};
    EXPECT_TRUE(std::isfinite(shaded(lighting, matte()).x));
}

TEST(Lights, AmbientIsBaseTimesOcclusionAndEmissionIsAdded) {
    Lighting lighting;
    lighting.ambient = 0.25f;
    reference::Surface s;
    s.base = {0.8, 0.4, 0.2};
    s.occlusion = 0.5;
    s.emission = {1.0, 2.0, 3.0};
    s.metallic = 1.0;  // ambient knows no metals: the peers' convention
    const glm::dvec3 radiance = shaded(lighting, s);
    EXPECT_NEAR(radiance.x, 1.1, 1e-6);
    EXPECT_NEAR(radiance.y, 2.05, 1e-6);
    EXPECT_NEAR(radiance.z, 3.025, 1e-6);
}

TEST(Lights, OcclusionDimsEnvironmentButNotLights) {
    Lighting lighting;
    lighting.lights = {point_light({0, 0, 1})};
    reference::Surface open = matte(), closed = matte();
    closed.occlusion = 0.0;
    EXPECT_EQ(shaded(lighting, open), shaded(lighting, closed));
    SerialExecutor executor;
    lighting.lights.clear();
    lighting.environment = std::make_shared<const Environment>(sky_latlong(32, 16), executor);
    EXPECT_EQ(shaded(lighting, closed), glm::dvec3(0.0));
    closed.occlusion = 0.5;
    EXPECT_NEAR(shaded(lighting, closed).y / shaded(lighting, open).y, 0.5, 1e-6);
}

/// A shadow map that lets no light through anywhere.
std::shared_ptr<const ShadowMap> total_eclipse(const glm::vec3& direction) {
    ShadowMap map = make_shadow_frame(direction, glm::vec3(0.0f), 10.0f, 64);
    std::fill(map.depth.begin(), map.depth.end(), 1.0f);
    return std::make_shared<const ShadowMap>(map);
}

TEST(Lights, OnlyTheFirstDirectionalLightIsShadowed) {
    Light sun;
    sun.direction = {0, 0, -1};
    Lighting lighting;
    lighting.shadow = total_eclipse(sun.direction);
    lighting.lights = {sun};
    EXPECT_EQ(shaded(lighting, matte()), glm::dvec3(0.0));
    lighting.lights = {point_light({0, 0, 1}), sun, sun};
    const glm::dvec3 with_map = shaded(lighting, matte());
    lighting.shadow = nullptr;
    lighting.lights = {point_light({0, 0, 1}), sun};
    EXPECT_EQ(with_map, shaded(lighting, matte()));
}

/// Every kind of light at once.
Lighting everything() {
    SerialExecutor executor;
    Lighting lighting;
    Light sun;
    sun.direction = glm::normalize(glm::vec3(-0.3f, -1.0f, 0.2f));
    sun.intensity = 3.0f;
    lighting.lights = {sun, point_light({1, 2, 0}, 6.0f), spot_light({-1, 1, 1}, {1, -1, -1}, 0.2f, 0.9f)};
    lighting.ambient = 0.1f;
    lighting.environment = std::make_shared<const Environment>(sky_latlong(64, 32), executor);
    ShadowMap map = make_shadow_frame(sun.direction, glm::vec3(0.0f), 3.0f, 128);
    std::mt19937 random(5);
    for (float& depth : map.depth) depth = float(random() % 1000) / 1000.0f;
    lighting.shadow = std::make_shared<const ShadowMap>(map);
    return lighting;
}

TEST(ShadeSurface, GivesTheSameBitsOnEveryInstructionSet) {
    Lighting lighting = everything();
    std::mt19937 random(6);
    for (int i = 0; i < 300; ++i) {
        lighting.reflections = i % 3 == 0 ? EnvironmentReflections::SplitSum : EnvironmentReflections::Prefiltered;
        const SurfaceWave wave = random_wave(random);
        WaveVector expected;
        for (const texunit::Simd simd : texunit::available_simd()) {
            ASSERT_TRUE(texunit::choose_simd(simd));
            WaveVector radiance;
            shade_surface(lighting, wave, texunit::kWaveFull, radiance);
            if (simd == texunit::available_simd().front()) expected = radiance;
            for (int lane = 0; lane < texunit::kWaveLanes; ++lane)
                ASSERT_EQ(lane_of(radiance, lane), lane_of(expected, lane)) << to_string(simd) << " wave " << i << " lane " << lane;
        }
    }
    texunit::choose_simd(texunit::Simd::Auto);
}

TEST(ShadeSurface, ALaneDependsOnNothingButItself) {
    const Lighting lighting = everything();
    std::mt19937 random(7);
    for (int i = 0; i < 100; ++i) {
        SurfaceWave wave = random_wave(random);
        WaveVector all, one;
        shade_surface(lighting, wave, texunit::kWaveFull, all);
        const int lane = int(random() % texunit::kWaveLanes);
        // Rubbish in the other lanes.
        for (int other = 0; other < texunit::kWaveLanes; ++other)
            if (other != lane) {
                reference::Surface rubbish;
                rubbish.base = rubbish.normal = rubbish.view = rubbish.position = glm::dvec3(std::nan(""), 1e30, -1e30);
                rubbish.roughness = std::nan("");
                put_surface(rubbish, wave, other);
            }
        shade_surface(lighting, wave, 1u << lane, one);
        ASSERT_EQ(lane_of(one, lane), lane_of(all, lane)) << "wave " << i << " lane " << lane;
    }
}

TEST(ShadeSurface, NoSurfaceMakesItReadOutsideItsTables) {
    const Lighting lighting = everything();
    const double wild[] = {std::nan(""), HUGE_VAL, -HUGE_VAL, 1e38, -1e38, 1e-40, 0.0, 5.0, -5.0};
    std::mt19937 random(8);
    for (int i = 0; i < 2000; ++i) {
        SurfaceWave wave = random_wave(random);
        for (int lane = 0; lane < texunit::kWaveLanes; ++lane) {
            reference::Surface s = random_surface(random);
            const double value = wild[random() % std::size(wild)];
            switch (random() % 5) {
                case 0: s.position = glm::dvec3(value); break;
                case 1: s.normal = glm::dvec3(value); break;
                case 2: s.view = glm::dvec3(0.0, value, 0.0); break;
                case 3: s.roughness = value; break;
                default: s.normal.x = value; break;
            }
            put_surface(s, wave, lane);
        }
        WaveVector radiance;
        shade_surface(lighting, wave, texunit::kWaveFull, radiance);  // the sanitizers watch
    }
}

}  // namespace
}  // namespace rawtexel::shading
