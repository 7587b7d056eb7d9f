// Textures looked up at a point of the pixel of their own: the unified scheme.
#include "shading/camera.h"
#include "shading/render.h"
#include "tests/shading/agreement.h"
#include "tests/shading/frame_bits.h"
#include "tests/shading/scene_parts.h"

#include <gtest/gtest.h>

#include <cmath>

namespace rawtexel::shading {
namespace {

using namespace test;

class TextureJitterTest : public testing::Test {
  protected:
    TextureJitterTest() {
        options_.width = options_.height = 32;
        options_.mip = texunit::MipMode::None;
        options_.filter = texunit::Kernel::Bilinear;
    }
    Image radiance(const RenderOptions& options) { return render(scene_, Lighting{}, options, *executor_).radiance; }
    Image radiance(TextureJitter jitter, uint32_t seed) {
        RenderOptions options = options_;
        options.filtering.texture_jitter = jitter;
        options.seed = seed;
        return radiance(options);
    }

    Scene scene_;
    RenderOptions options_;
    std::unique_ptr<Executor> executor_ = make_executor(ExecutorKind::Threads, 1);
};

/// A floor that fills the frame, seen at a grazing angle: its far rows pass several texels a pixel, its near ones less than one.
class GrazedFloor : public TextureJitterTest {
  protected:
    GrazedFloor() {
        scene_.textures = {make_noise_texture(32, 32, 7)};
        Material material = unlit(glm::vec4(1.0f));
        material.maps[kBaseColor].texture = 0;
        add_object(scene_, make_quad({-20, 0, 20}, {40, 0, 0}, {0, 0, -160}, {3, 12}), material);
        options_.camera = look_at_camera({{-20, 0, -140}, {20, 0, 20}}, {0.0f, 1.0f, 8.0f}, {0.0f, 0.0f, 3.5f}, 20.0f);
    }
    /// All points of the pixels alike, coverage and textures together.
    Image truth() {
        RenderOptions options = options_;
        options.spp = 16384;
        return radiance(options);
    }
    Agreement compare(TextureJitter jitter, const Image& expected, uint32_t frames = 600) {
        return agreement_of(expected, frames, [&](uint32_t seed) { return radiance(jitter, seed); });
    }
};

TEST_F(GrazedFloor, InPerspectiveLooksUpTheWholePixelFilter) {
    for (const PixelFilter filter : {PixelFilter::Box, PixelFilter::Tent, PixelFilter::Gaussian}) {
        options_.pixel_filter = filter;
        expect_agreement(compare(TextureJitter::Perspective, truth()), std::string(to_string(filter)).c_str());
    }
}

TEST_F(GrazedFloor, ByAffineStepsIsOffWherePerspectiveBends) {
    options_.pixel_filter = PixelFilter::Gaussian;
    const Agreement affine = compare(TextureJitter::Affine, truth(), 2400);
    EXPECT_GT(affine.per_value(), 1.5);
}

TEST_F(GrazedFloor, TakesNoNumbersWithoutJitter) {
    EXPECT_EQ(radiance(TextureJitter::None, 1).values, radiance(TextureJitter::None, 0).values);
    EXPECT_GT(largest_difference(radiance(TextureJitter::Affine, 0), radiance(TextureJitter::None, 0)), 0.1);
}

/// What is discarded is what would have been seen: alpha and colour come from one point.
TEST_F(TextureJitterTest, MaskedTexelsAreNeverSeen) {
    options_.camera = square_camera();
    options_.filter = texunit::Kernel::Nearest;
    options_.spp = 8;
    options_.background = glm::vec3(0.0f, 0.0f, 1.0f);
    scene_.textures = {make_texture(24, 24, [](int x, int y) { return (x + y) % 2 ? glm::vec4(1, 0, 0, 1) : glm::vec4(0, 1, 0, 0); })};
    Material material = unlit(glm::vec4(1.0f), AlphaMode::Mask);
    material.maps[kBaseColor].texture = 0;
    add_object(scene_, make_quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, {2, 2}), material);
    for (const TextureJitter jitter : {TextureJitter::Perspective, TextureJitter::Affine}) {
        const Image image = radiance(jitter, 1);
        double red = 0, green = 0;
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x) red += image.pixel(x, y)[0], green += image.pixel(x, y)[1];
        EXPECT_EQ(green, 0) << to_string(jitter);
        EXPECT_NEAR(red / (image.width * image.height), 0.5, 0.05) << to_string(jitter);
    }
}

TEST_F(TextureJitterTest, HasTheSameBitsForAnyTilesThreadsAndCrops) {
    const Scene scene = make_busy_scene();
    const Lighting lighting = busy_lighting(scene, *executor_);
    options_.width = 165, options_.height = 101;
    options_.camera = busy_camera();
    options_.spp = 2;
    for (const TextureJitter jitter : {TextureJitter::Perspective, TextureJitter::Affine}) {
        options_.filtering.texture_jitter = jitter;
        options_.filtering.noise = texunit::Noise::Stbn;
        expect_bits_of_tiles_threads_and_crops(scene, lighting, options_, std::string(to_string(jitter)));
    }
}

}  // namespace
}  // namespace rawtexel::shading
