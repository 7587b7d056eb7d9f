// The sun's shadow: where its edge lies, what it must not darken, and the two forms of its filter.
#include "shading/shadow_map.h"

#include "shading/lighting.h"
#include "tests/reference/shading/environment.h"
#include "tests/shading/surfaces.h"
#include "texunit/simd.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace rawtexel::shading {
namespace {

using namespace test;

/// Distance along the unit vector `light` at which a ray from `origin` first meets something; infinity: never.
using Caster = std::function<double(const glm::dvec3& origin, const glm::dvec3& light)>;

/// Fills a map by casting one ray through every texel's centre.
void draw(ShadowMap& map, const Caster& cast) {
    const glm::dmat4 world_from_map = glm::inverse(glm::dmat4(map.map_from_world));
    for (int y = 0; y < map.size; ++y)
        for (int x = 0; x < map.size; ++x) {
            const glm::dvec3 near(world_from_map * glm::dvec4(x + 0.5, y + 0.5, 1.0, 1.0)),
                far(world_from_map * glm::dvec4(x + 0.5, y + 0.5, 0.0, 1.0));
            const double length = glm::length(far - near), hit = cast(near, (far - near) / length);
            map.depth[size_t(y) * size_t(map.size) + size_t(x)] = hit <= length ? float(1.0 - hit / length) : 0.0f;
        }
}

double cast_plane(const glm::dvec3& origin, const glm::dvec3& light, const glm::dvec3& normal, double offset) {
    const double t = (offset - glm::dot(normal, origin)) / glm::dot(normal, light);
    return t >= 0.0 ? t : HUGE_VAL;
}

/// Distance to the box [low, high].
double cast_box(const glm::dvec3& origin, const glm::dvec3& light, const glm::dvec3& low, const glm::dvec3& high) {
    double enter = -HUGE_VAL, leave = HUGE_VAL;
    for (int k = 0; k < 3; ++k) {
        const double a = (low[k] - origin[k]) / light[k], b = (high[k] - origin[k]) / light[k];
        enter = std::max(enter, std::min(a, b));
        leave = std::min(leave, std::max(a, b));
    }
    return enter <= leave && enter >= 0.0 ? enter : HUGE_VAL;
}

double cast_sphere(const glm::dvec3& origin, const glm::dvec3& light, double radius) {
    const double b = glm::dot(origin, light), c = glm::dot(origin, origin) - radius * radius, root = b * b - c;
    return root >= 0.0 ? -b - std::sqrt(root) : HUGE_VAL;
}

float visibility(const ShadowMap& map, const glm::dvec3& position, const glm::dvec3& normal) {
    return shadow_visibility(map, glm::vec3(position), glm::vec3(normal));
}

TEST(ShadowFrame, HoldsTheSphereWithRoomForTheFilter) {
    std::mt19937 random(1);
    for (int i = 0; i < 200; ++i) {
        const glm::vec3 direction =
            i < 6 ? glm::vec3(i % 3 == 0, i % 3 == 1, i % 3 == 2) * (i < 3 ? 1.0f : -1.0f) : glm::vec3(random_direction(random));
        const glm::vec3 center(random_direction(random) * 5.0);
        const ShadowMap map = make_shadow_frame(direction, center, 2.0f, 256);
        for (int k = 0; k < 50; ++k) {
            const glm::vec4 at = map.map_from_world * glm::vec4(center + 2.0f * glm::vec3(random_direction(random)), 1.0f);
            ASSERT_TRUE(at.x >= 2.5f && at.x <= 253.5f && at.y >= 2.5f && at.y <= 253.5f && at.z >= 0.0f && at.z <= 1.0f)
                << at.x << ' ' << at.y << ' ' << at.z;
        }
        // Nearer to the light is greater; a metre is 1/texel_world texels or 1/depth_world of depth.
        const glm::dmat3 linear(map.map_from_world);
        EXPECT_NEAR((linear * glm::dvec3(direction)).z * double(map.depth_world), -1.0, 1e-5);
        const glm::dvec3 across = reference::tangent_of(glm::dvec3(direction));
        EXPECT_NEAR(glm::length(glm::dvec2(linear * across)) * double(map.texel_world), 1.0, 1e-5);
    }
}

TEST(ShadowFrame, KeepsTheWindingOfTriangles) {
    // A triangle counter-clockwise as the light sees it turns from right to up; the map's rows run down.
    const glm::vec3 direction = glm::normalize(glm::vec3(0.3f, -1.0f, 0.4f));
    const glm::dmat3 linear(make_shadow_frame(direction, glm::vec3(0.0f), 1.0f, 64).map_from_world);
    const glm::dvec3 a = reference::tangent_of(-glm::dvec3(direction)), b = glm::cross(-glm::dvec3(direction), a);
    const glm::dvec3 right = linear * a, up = linear * b;
    EXPECT_LT(right.x * up.y - right.y * up.x, 0.0);
}

TEST(ShadowFrame, TakesARadiusOfZero) {
    const ShadowMap map = make_shadow_frame({0, -1, 0}, {1, 2, 3}, 0.0f, 64);
    EXPECT_GT(map.texel_world, 0.0f);
    EXPECT_EQ(shadow_visibility(map, {1, 2, 3}, {0, 1, 0}), 1.0f);
}

const glm::dvec3 kBoxLow(-0.5, 0.0, -0.4), kBoxHigh(0.5, 0.8, 0.4);

/// The map of a box that stands on the ground y = 0.
ShadowMap box_on_ground(const glm::dvec3& light, int size) {
    ShadowMap map = make_shadow_frame(glm::vec3(light), glm::vec3(0.0f, 0.3f, 0.0f), 1.7f, size);
    draw(map, [](const glm::dvec3& origin, const glm::dvec3& along) {
        return std::min(cast_box(origin, along, kBoxLow, kBoxHigh), cast_plane(origin, along, {0, 1, 0}, 0.0));
    });
    return map;
}

/// Area of the shadow on the ground outside the box's footprint, relative to the true area.
double shadow_area_error(const glm::dvec3& light, int size) {
    const ShadowMap map = box_on_ground(light, size);
    // The shadow is the box's outline slid along the light by its height: two parallelograms.
    const glm::dvec3 extent = kBoxHigh - kBoxLow;
    const double expected = (std::fabs(light.x) * extent.z + std::fabs(light.z) * extent.x) * extent.y / -light.y;
    // What the filter makes darker or lighter than it is, on a grid of points.
    constexpr int kPoints = 1200;
    constexpr double kHalf = 1.6;
    double excess = 0.0;
    for (int j = 0; j < kPoints; ++j)
        for (int i = 0; i < kPoints; ++i) {
            const double x = kHalf * (2.0 * (i + 0.5) / kPoints - 1.0), z = kHalf * (2.0 * (j + 0.5) / kPoints - 1.0);
            if (x > kBoxLow.x && x < kBoxHigh.x && z > kBoxLow.z && z < kBoxHigh.z) continue;
            const bool hidden = cast_box(glm::dvec3(x, 1e-9, z) - light * 10.0, light, kBoxLow, kBoxHigh) < HUGE_VAL;
            excess += (hidden ? 0.0 : 1.0) - double(visibility(map, {x, 0.0, z}, {0, 1, 0}));
        }
    return excess * std::pow(2.0 * kHalf / kPoints, 2.0) / expected;
}

TEST(Shadow, OfABoxOnAPlaneHasTheAnalyticArea) {
    // Aligned with the box's sides, diagonal, low.
    for (const glm::dvec3& light :
         {glm::dvec3(0.6, -0.8, 0.0), glm::dvec3(0.5, -0.7, 0.3), glm::dvec3(-0.2, -0.6, 0.75), glm::dvec3(0.3, -0.9, -0.3)}) {
        const double error = shadow_area_error(glm::normalize(light), 2048);
        std::printf("  light (%g, %g, %g): area off by %+.3f %%\n", light.x, light.y, light.z, 100.0 * error);
        EXPECT_NEAR(error, 0.0, 0.005);
    }
}

TEST(Shadow, BeginsWhereItsCasterStands) {
    // Just behind a box that stands on the ground the ground is dark: no gap of light, whatever the bias.
    const glm::dvec3 light = glm::normalize(glm::dvec3(0.6, -0.8, 0.0));
    const ShadowMap map = box_on_ground(light, 1024);
    for (double behind = 0.25; behind < 20.0; behind += 0.25)
        EXPECT_LT(visibility(map, {kBoxHigh.x + behind * map.texel_world, 0.0, 0.013}, {0, 1, 0}), 0.02f)
            << behind << " texels behind the box";
}

TEST(Shadow, DoesNotFallOnALitPlaneOfAnySlope) {
    std::mt19937 random(2);
    for (int i = 0; i < 60; ++i) {
        const glm::dvec3 light = random_direction(random);
        glm::dvec3 normal = random_direction(random);
        // From facing the light to all but edge on.
        const double cosine = i % 3 == 0 ? 0.02 : i % 3 == 1 ? 0.2 : 0.9;
        const glm::dvec3 across = glm::normalize(normal - light * glm::dot(light, normal));
        normal = glm::normalize(-light * cosine + across * std::sqrt(1.0 - cosine * cosine));
        ShadowMap map = make_shadow_frame(glm::vec3(light), glm::vec3(0.0f), 1.0f, 256);
        draw(map, [&](const glm::dvec3& origin, const glm::dvec3& along) { return cast_plane(origin, along, normal, 0.0); });
        for (int k = 0; k < 400; ++k) {
            const glm::dvec3 in_plane = glm::normalize(glm::cross(normal, random_direction(random))) * (0.9 * std::sqrt(k / 400.0));
            ASSERT_EQ(visibility(map, in_plane, normal), 1.0f) << "cosine " << cosine << " point " << k;
        }
    }
}

TEST(Shadow, DoesNotFallOnTheLitSideOfASphere) {
    std::mt19937 random(3);
    const glm::dvec3 light = glm::normalize(glm::dvec3(0.3, -1.0, 0.2));
    ShadowMap map = make_shadow_frame(glm::vec3(light), glm::vec3(0.0f), 1.0f, 512);
    draw(map, [&](const glm::dvec3& origin, const glm::dvec3& along) { return cast_sphere(origin, along, 1.0); });
    for (int k = 0; k < 20000; ++k) {
        const glm::dvec3 n = random_direction(random);
        const double cosine = -glm::dot(n, light);
        if (cosine > 0.02) {
            ASSERT_EQ(visibility(map, n, n), 1.0f) << "cosine " << cosine;
        } else if (cosine < 0.0) {
            ASSERT_EQ(visibility(map, n, n), 0.0f) << "cosine " << cosine;
        }
    }
}

TEST(Shadow, DoesNotDarkenTheInsideOfABowl) {
    // Concave: the surface rises above its tangent plane all around. The bias has to cover that.
    std::mt19937 random(4);
    const glm::dvec3 light(0.0, -1.0, 0.0);
    ShadowMap map = make_shadow_frame(glm::vec3(light), glm::vec3(0.0f), 1.0f, 1024);
    draw(map, [&](const glm::dvec3& origin, const glm::dvec3& along) {
        const double b = glm::dot(origin, along), c = glm::dot(origin, origin) - 1.0, root = b * b - c;
        return root >= 0.0 ? -b + std::sqrt(root) : HUGE_VAL;
    });
    for (int k = 0; k < 20000; ++k) {
        const glm::dvec3 n = random_direction(random);
        if (n.y <= 0.35) continue;
        ASSERT_GT(visibility(map, -n, n), 0.97f) << "cosine " << n.y;
    }
}

TEST(Shadow, OutsideTheMapEverythingIsLit) {
    ShadowMap map = make_shadow_frame({0, -1, 0}, glm::vec3(0.0f), 1.0f, 64);
    std::fill(map.depth.begin(), map.depth.end(), 1.0f);
    const float width = 64.0f * map.texel_world;
    EXPECT_EQ(shadow_visibility(map, {0, 0, 0}, {0, 1, 0}), 0.0f);
    for (const glm::vec3& far : {glm::vec3(width, 0, 0), glm::vec3(0, 0, -width), glm::vec3(1e9f, 0, 1e9f), glm::vec3(-1e30f, 0, 0)})
        EXPECT_EQ(shadow_visibility(map, far, {0, 1, 0}), 1.0f);
    // Half of the filter outside: half lit.
    EXPECT_NEAR(shadow_visibility(map, {0.5f * width, 0, 0}, {0, 1, 0}), 0.5f, 0.01f);
}

TEST(Shadow, NothingStoredHidesNothingEvenBelowTheFarPlane) {
    const ShadowMap map = make_shadow_frame({0, -1, 0}, glm::vec3(0.0f), 1.0f, 64);
    EXPECT_EQ(shadow_visibility(map, {0, -50, 0}, {0, 1, 0}), 1.0f);
}

TEST(Shadow, EdgeIsATentThreeTexelsWide) {
    // A straight edge between texel columns: visibility is the tent's integral, 0 and 1 two texels away, one half on it.
    ShadowMap map = make_shadow_frame({0, -1, 0}, glm::vec3(0.0f), 1.0f, 64);
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 32; ++x) map.depth[size_t(y * 64 + x)] = 1.0f;
    const glm::dmat4 world_from_map = glm::inverse(glm::dmat4(map.map_from_world));
    const auto lit_at = [&](double x) {
        return double(visibility(map, glm::dvec3(world_from_map * glm::dvec4(x, 32.3, 0.2, 1.0)), {0, 1, 0}));
    };
    EXPECT_NEAR(lit_at(30.0), 0.0, 1e-5);
    EXPECT_NEAR(lit_at(32.0), 0.5, 1e-5);
    EXPECT_NEAR(lit_at(34.0), 1.0, 1e-5);
    double last = 0.0;
    for (double x = 29.0; x < 35.0; x += 0.01) {
        const double lit = lit_at(x);
        ASSERT_GE(lit, last - 1e-5) << x;
        ASSERT_LE(lit - last, 0.01 * (2.0 / 3.0) + 1e-4) << "the tent's peak bounds the slope, at " << x;
        last = lit;
    }
}

TEST(Shadow, VectorFormHasTheBitsOfTheScalarForm) {
    std::mt19937 random(5);
    const glm::vec3 direction = glm::normalize(glm::vec3(0.4f, -1.0f, 0.3f));
    ShadowMap map = make_shadow_frame(direction, glm::vec3(0.0f), 1.0f, 64);
    for (float& depth : map.depth) depth = float(random() % 4096) / 4096.0f;
    Lighting lighting;
    lighting.shadow = std::make_shared<const ShadowMap>(map);
    Light sun;
    sun.direction = direction;
    lighting.lights = {sun};
    Lighting open = lighting;
    open.shadow = nullptr;
    for (const texunit::Simd simd : texunit::available_simd()) {
        ASSERT_TRUE(texunit::choose_simd(simd));
        for (int i = 0; i < 500; ++i) {
            const SurfaceWave wave = random_wave(random);
            WaveVector shadowed, lit;
            shade_surface(lighting, wave, texunit::kWaveFull, shadowed);
            shade_surface(open, wave, texunit::kWaveFull, lit);
            for (int lane = 0; lane < texunit::kWaveLanes; ++lane) {
                const float share =
                    shadow_visibility(map, glm::vec3(lane_of(wave.position, lane)), glm::vec3(lane_of(wave.geometric_normal, lane)));
                const double emitted = wave.emission.y[lane];
                const double expected = emitted + (lit.y[lane] - emitted) * share;
                ASSERT_NEAR(shadowed.y[lane], expected, 1e-6 * std::max(1.0, double(lit.y[lane]))) << to_string(simd) << " share " << share;
                if (share > 0.0f && share < 1.0f) continue;
                ASSERT_EQ(shadowed.y[lane], share == 0.0f ? wave.emission.y[lane] : lit.y[lane]);
            }
        }
    }
    texunit::choose_simd(texunit::Simd::Auto);
}

}  // namespace
}  // namespace rawtexel::shading
