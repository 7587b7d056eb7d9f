// The built-in sky: what a picture of it should show.
#include "shading/environment.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace rawtexel::shading {
namespace {

/// Texel of the image that looks along `direction`.
glm::vec3 texel_towards(const Image& image, const glm::vec3& direction) {
    const double u = 0.5 + std::atan2(double(direction.x), -double(direction.z)) / (2.0 * std::numbers::pi),
                 v = std::acos(double(direction.y)) / std::numbers::pi;
    const float* p = image.pixel(std::min(int(u * image.width), image.width - 1), std::min(int(v * image.height), image.height - 1));
    return {p[0], p[1], p[2]};
}

float luminance(const glm::vec3& c) { return 0.2126f * c.r + 0.7152f * c.g + 0.0722f * c.b; }

TEST(Sky, IsFiniteLightEverywhere) {
    const Image sky = sky_latlong();
    EXPECT_EQ(sky.width, 512);
    EXPECT_EQ(sky.height, 256);
    ASSERT_EQ(sky.channels, 3);
    for (const float value : sky.values) ASSERT_TRUE(value > 0.0f && value < 20.0f) << value;
}

TEST(Sky, IsBrightestAroundTheSun) {
    const Image sky = sky_latlong();
    const glm::vec3 to_sun = -sky_sun().direction;
    EXPECT_NEAR(glm::length(to_sun), 1.0f, 1e-6f);
    EXPECT_GT(to_sun.y, 0.3f);
    float brightest = 0.0f;
    for (int y = 0; y < sky.height; ++y)
        for (int x = 0; x < sky.width; ++x)
            brightest = std::max(brightest, luminance({sky.pixel(x, y)[0], sky.pixel(x, y)[1], sky.pixel(x, y)[2]}));
    EXPECT_GT(luminance(texel_towards(sky, to_sun)), 0.97f * brightest);
}

TEST(Sky, IsBlueAbovePaleAtTheHorizonAndDarkerBelow) {
    const Image sky = sky_latlong();
    const glm::vec3 zenith = texel_towards(sky, {0, 1, 0}), horizon = texel_towards(sky, glm::normalize(glm::vec3(1.0f, 0.05f, 0.0f)));
    const glm::vec3 ground = texel_towards(sky, {0, -1, 0});
    EXPECT_GT(zenith.b, 1.8f * zenith.r);
    EXPECT_LT(horizon.b, 1.8f * horizon.r);
    EXPECT_GT(luminance(horizon), luminance(zenith));
    EXPECT_LT(luminance(ground), luminance(zenith));
}

TEST(Sky, DoesNotDependOnItsExtents) {
    const Image fine = sky_latlong(1024, 512), coarse = sky_latlong(256, 128);
    for (const glm::vec3& d : {glm::vec3(0.0f, 0.9f, 0.436f), glm::vec3(0.6f, 0.64f, -0.48f), glm::vec3(-0.8f, -0.36f, 0.48f)})
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(texel_towards(fine, d)[c], texel_towards(coarse, d)[c], 0.03f);
}

}  // namespace
}  // namespace rawtexel::shading
