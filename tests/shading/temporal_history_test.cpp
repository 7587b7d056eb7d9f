#include "shading/temporal_history.h"

#include "scene_parts.h"
#include "shading/camera.h"
#include "shading/render.h"
#include "shading/temporal_flicker.h"
#include "tests/shading/executor_kinds.h"
#include "texunit/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iostream>

namespace rawtexel::shading {
namespace {

using namespace test;

constexpr TemporalOptions kNoClamp{.accumulation = Accumulation::Reproject, .weight = 0.1f, .clamp = false};
constexpr TemporalOptions kClamp{.accumulation = Accumulation::Reproject, .weight = 0.1f, .clamp = true};

Image filled(int width, int height, const std::function<float(int x, int y)>& value) {
    Image image(width, height, 3);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) std::fill_n(image.pixel(x, y), 3, value(x, y));
    return image;
}

Image constant(int width, int height, float value) {
    return filled(width, height, [&](int, int) { return value; });
}

double mean_square_around(const Image& image, double mean) {
    double sum = 0.0;
    for (const float value : image.values) sum += (double(value) - mean) * (double(value) - mean);
    return sum / double(image.values.size());
}

double rms_difference(const Image& a, const Image& b) {
    double sum = 0.0;
    for (size_t i = 0; i < a.values.size(); ++i) {
        const double difference = double(a.values[i]) - double(b.values[i]);
        sum += difference * difference;
    }
    return std::sqrt(sum / double(a.values.size()));
}

double decibels(double before, double after) { return 10.0 * std::log10(before / after); }

/// By how much a moving average of weight 0.1 over 80 frames is nearer to 0.5 than the last of them.
double gain_of_average(const std::function<Image(uint32_t frame)>& frames) {
    Image history;
    double before = 0.0;
    for (uint32_t frame = 0; frame < 80; ++frame) {
        const Image image = frames(frame);
        before = mean_square_around(image, 0.5);
        move_towards(image, 0.1f, history);
    }
    return decibels(before, mean_square_around(history, 0.5));
}

/// Of independent frames the average of weight a keeps a / (2 - a) of the variance, 1/19 for a = 0.1.
TEST(MovingAverage, GainsItsDecibelsOnWhiteNoise) {
    const double gain = gain_of_average([](uint32_t frame) {
        return filled(128, 128, [&](int x, int y) {
            return texunit::random_float({.x = uint32_t(x), .y = uint32_t(y), .sample = frame, .seed = 7});
        });
    });
    std::cout << "gain on white noise: " << gain << " dB\n";
    EXPECT_NEAR(gain, 10.0 * std::log10(19.0), 0.3);
}

/// Coverage of a BLEND surface is drawn anew for every pixel and sample.
TEST(MovingAverage, GainsItsDecibelsOnRenderedNoise) {
    const std::unique_ptr<Executor> executor = make_executor(ExecutorKind::Threads, 1);
    Scene scene;
    add_object(scene, make_quad({-2, -2, 0}, {4, 0, 0}, {0, 4, 0}), unlit({1.0f, 1.0f, 1.0f, 0.5f}, AlphaMode::Blend));
    RenderOptions options;
    options.width = options.height = 128;
    options.camera = square_camera();
    options.background = glm::vec3(0.0f);
    const double gain = gain_of_average([&](uint32_t frame) {
        options.first_sample = frame;
        return render(scene, Lighting{}, options, *executor).radiance;
    });
    std::cout << "gain on rendered noise: " << gain << " dB\n";
    EXPECT_NEAR(gain, 10.0 * std::log10(19.0), 0.3);
}

TEST(MovingAverage, KeepsConstantsAndTakesFramesOfWeightOneAsTheyAre) {
    Image history;
    for (int frame = 0; frame < 50; ++frame) move_towards(constant(4, 4, 0.3f), 0.07f, history);
    EXPECT_EQ(history.values, constant(4, 4, 0.3f).values);
    move_towards(constant(4, 4, 0.75f), 1.0f, history);
    EXPECT_EQ(history.values, constant(4, 4, 0.75f).values);
}

class ReprojectionTest : public testing::Test {
  protected:
    static constexpr int kWidth = 96, kHeight = 64;

    Image frame_of(const Scene& scene, const Camera& camera, uint32_t first_sample, int spp = 1, const Lighting& lighting = {}) const {
        RenderOptions options;
        options.width = kWidth;
        options.height = kHeight;
        options.camera = camera;
        options.first_sample = first_sample;
        options.spp = spp;
        options.background = glm::vec3(0.2f, 0.3f, 0.4f);
        return render(scene, lighting, options, *executor_).radiance;
    }
    Image depth_of(const Scene& scene, const Camera& camera) const { return center_depth(scene, camera, kWidth, kHeight, *executor_); }

    std::unique_ptr<Executor> executor_ = make_executor(ExecutorKind::Threads, 2);
};

TEST_F(ReprojectionTest, OfACameraAtRestWithoutClampIsTheMovingAverageBitForBit) {
    const Scene scene = make_busy_scene();
    const Lighting lighting = busy_lighting(scene, *executor_);
    Camera turned = busy_camera();
    turned.world_from_camera = look_at_camera(scene.bounds(), {0.37f, 0.61f, 4.9f}, {0.1f, -0.33f, 0.7f}).world_from_camera;
    for (const Camera& camera : {busy_camera(), turned, square_camera()}) {
        ReprojectedHistory reprojected(kNoClamp, kWidth, kHeight);
        Image average;
        for (uint32_t i = 0; i < 12; ++i) {
            const Image frame = frame_of(scene, camera, i, 1, lighting);
            move_towards(frame, kNoClamp.weight, average);
            ASSERT_EQ(reprojected.add(frame, camera, depth_of(scene, camera), *executor_).values, average.values) << "frame " << i;
            EXPECT_EQ(reprojected.disoccluded(), 0u);
        }
    }
}

/// A floor of fine noise to the horizon, looked up without mip maps: one sample a pixel is nothing but noise.
Scene noisy_floor() {
    Scene scene;
    scene.textures = {make_noise_texture(64, 64, 1)};
    Material material = unlit(glm::vec4(1.0f));
    material.maps[kBaseColor].texture = 0;
    material.maps[kBaseColor].sampler.mip = texunit::MipMode::None;
    add_object(scene, make_quad({-30, 0, 30}, {60, 0, 0}, {0, 0, -60}, {12, 12}), material);
    return scene;
}

Camera over_floor(float moved) { return look_at_camera({{-3, 0, -3}, {3, 0, 3}}, {0.1f + moved, 1.3f, 4.0f}, {moved, 0.0f, 0.0f}); }

TEST_F(ReprojectionTest, OfAMovingCameraIsCloserToTheTruthThanTheMovingAverage) {
    const Scene scene = noisy_floor();
    ReprojectedHistory open(kNoClamp, kWidth, kHeight), clamped(kClamp, kWidth, kHeight);
    Image average, frame;
    constexpr int kFrames = 24;
    constexpr float kStep = 0.05f;
    for (int i = 0; i < kFrames; ++i) {
        const Camera camera = over_floor(kStep * float(i));
        frame = frame_of(scene, camera, uint32_t(i));
        move_towards(frame, 0.1f, average);
        open.add(frame, camera, depth_of(scene, camera), *executor_);
        clamped.add(frame, camera, depth_of(scene, camera), *executor_);
    }
    const Camera last = over_floor(kStep * float(kFrames - 1));
    const Image truth = frame_of(scene, last, 0, 256), depth = depth_of(scene, last);
    const double one = rms_difference(frame, truth), ema = rms_difference(average, truth);
    const double unclamped = rms_difference(open.add(frame, last, depth, *executor_), truth);
    const double within = rms_difference(clamped.add(frame, last, depth, *executor_), truth);
    std::cout << "RMSE to the converged frame: one frame " << one << ", moving average " << ema << ", reprojected " << unclamped
              << ", with clamp " << within << "\n";
    EXPECT_LT(unclamped, 0.8 * ema);
    EXPECT_LT(within, 0.8 * ema);
    EXPECT_LT(unclamped, 0.7 * one);
}

/// A card stands before a wall; the camera goes sideways, and what the card hid is new.
TEST_F(ReprojectionTest, TakesTheFrameItselfWhereNothingWasSeenBefore) {
    Scene scene;
    add_object(scene, make_quad({-20, -20, -6}, {40, 0, 0}, {0, 40, 0}), unlit(glm::vec4(1.0f)));
    add_object(scene, make_quad({-0.5f, -0.5f, 0}, {1, 0, 0}, {0, 1, 0}), unlit(glm::vec4(1.0f)));
    const auto camera_at = [&](float x) {
        Camera camera = look_at_camera(scene.bounds(), {x, 0, 3}, {x, 0, 0});
        camera.znear = 0.1f;
        return camera;
    };
    ReprojectedHistory history(kNoClamp, kWidth, kHeight);
    history.add(constant(kWidth, kHeight, 1.0f), camera_at(0.0f), depth_of(scene, camera_at(0.0f)), *executor_);
    const Image depth = depth_of(scene, camera_at(0.3f));
    const Image after = history.add(constant(kWidth, kHeight, 0.0f), camera_at(0.3f), depth, *executor_);
    const FrameProjection now(camera_at(0.3f), kWidth, kHeight), before(camera_at(0.0f), kWidth, kHeight);
    int revealed = 0, entered = 0;
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            const glm::dvec3 world = now.world({x + 0.5, y + 0.5}, double(*depth.pixel(x, y)));
            const glm::dvec2 then = before.project(world).pixel;
            const bool wall = world.z < -1.0;
            // Where the line of sight of then passes the card's plane.
            const glm::dvec2 crossing = glm::dvec2(world) * (3.0 / (3.0 - world.z));
            const double from_card = std::max(std::abs(crossing.x), std::abs(crossing.y)) - 0.5;
            const float value = after.pixel(x, y)[0];
            constexpr double kPixel = 0.06;  // more than one at the card
            if (then.x > kWidth + 1) {
                ++entered;
                ASSERT_EQ(value, 0.0f) << x << "," << y << " came into view";
            } else if (wall && from_card < -kPixel) {
                ++revealed;
                ASSERT_EQ(value, 0.0f) << x << "," << y << " was hidden";
            } else if (then.x < kWidth - 1 && (!wall || from_card > kPixel)) {
                ASSERT_EQ(value, 0.9f) << x << "," << y << " was seen";
            }
        }
    EXPECT_GT(revealed, 20);
    EXPECT_GT(entered, 20);
    EXPECT_GE(history.disoccluded(), uint64_t(revealed + entered));
}

/// Near its horizon a floor's depth changes by much more than the tolerance from one row of pixels to the next.
TEST_F(ReprojectionTest, FindsFloorsSeenAtALowAngle) {
    const Scene scene = noisy_floor();
    const auto camera_at = [](float moved) { return look_at_camera({{-3, 0, -3}, {3, 0, 3}}, {moved, 0.2f + moved, 8}, {moved, 0.1f, 0}); };
    const Image depth = depth_of(scene, camera_at(0.02f));
    ReprojectedHistory history(kNoClamp, kWidth, kHeight);
    history.add(constant(kWidth, kHeight, 1.0f), camera_at(0.0f), depth_of(scene, camera_at(0.0f)), *executor_);
    const Image after = history.add(constant(kWidth, kHeight, 0.0f), camera_at(0.02f), depth, *executor_);
    int floor = 0, lost = 0;
    for (int y = 0; y < kHeight; ++y)
        for (int x = 8; x < kWidth - 8; ++x) {
            if (std::isinf(*depth.pixel(x, y))) continue;
            ++floor;
            lost += after.pixel(x, y)[0] != 0.9f;
        }
    EXPECT_GT(floor, 600);
    EXPECT_EQ(lost, 0);
}

/// A background is infinitely far: turning the camera moves it, moving the camera does not.
TEST_F(ReprojectionTest, FollowsWhatIsInfinitelyFar) {
    const Scene empty;
    const Camera before = look_at_camera({}, {0, 0, 0}, {0, 0, -1}, 60.0f);
    const FrameProjection projection(before, kWidth, kHeight);
    const auto sky = [&](const Camera& camera) {
        const FrameProjection view(camera, kWidth, kHeight);
        return filled(kWidth, kHeight, [&](int x, int y) {
            const glm::dvec3 way = glm::normalize(view.direction({x + 0.5, y + 0.5}));
            return float(way.x + 2.0 * way.y);
        });
    };
    for (const Camera& after :
         {look_at_camera({}, {0, 0, 0}, {0.1f, 0.07f, -1}, 60.0f), look_at_camera({}, {3, 1, 0}, {3, 1, -1}, 60.0f)}) {
        ReprojectedHistory history(kNoClamp, kWidth, kHeight);
        history.add(sky(before), before, depth_of(empty, before), *executor_);
        const Image shown = sky(after);
        const Image found = history.add(shown, after, depth_of(empty, after), *executor_);
        const FrameProjection now(after, kWidth, kHeight);
        double worst = 0.0;
        int followed = 0;
        for (int y = 1; y < kHeight - 1; ++y)
            for (int x = 1; x < kWidth - 1; ++x) {
                const glm::dvec3 way = now.direction({x + 0.5, y + 0.5});
                const glm::dvec2 then = projection.project_direction(way).pixel;
                if (then.x < 1.0 || then.y < 1.0 || then.x > kWidth - 1 || then.y > kHeight - 1) continue;
                ++followed;
                worst = std::max(worst, std::abs(double(found.pixel(x, y)[0]) - double(shown.pixel(x, y)[0])));
            }
        EXPECT_GT(followed, kWidth * kHeight / 2);
        EXPECT_LT(worst, 2e-4);
    }
}

TEST_F(ReprojectionTest, KeepsHistoriesWithinWhatTheNeighboursShow) {
    const Scene scene = noisy_floor();
    const Camera camera = over_floor(0.0f);
    const Image depth = depth_of(scene, camera);
    ReprojectedHistory history(kClamp, kWidth, kHeight);
    history.add(constant(kWidth, kHeight, 5.0f), camera, depth, *executor_);
    const Image step = filled(kWidth, kHeight, [](int x, int) { return x < 40 ? 0.25f : 1.0f; });
    const Image after = history.add(step, camera, depth, *executor_);
    for (int x = 0; x < kWidth; ++x) {
        // The neighbours of column 39 reach to 1; both ends have their slack.
        const float limit = (x < 39 ? 0.25f : 1.0f) * (1.0f + kClampSlack), value = x < 40 ? 0.25f : 1.0f;
        EXPECT_NEAR(after.pixel(x, 7)[1], limit + 0.1f * (value - limit), 1e-6f) << "column " << x;
    }
}

/// Rounding must not clip: what is constant over neighbours but differs in its last bits from frame to frame stays the moving average.
TEST_F(ReprojectionTest, LeavesRoundingUnclipped) {
    const Scene scene = noisy_floor();
    const Camera camera = over_floor(0.0f);
    const Image depth = depth_of(scene, camera);
    ReprojectedHistory history(kClamp, kWidth, kHeight);
    Image average, found;
    for (int i = 0; i < 10; ++i) {
        const Image frame = constant(kWidth, kHeight, i % 2 == 0 ? 0.7f : std::nextafter(0.7f, 1.0f));
        move_towards(frame, kClamp.weight, average);
        found = history.add(frame, camera, depth, *executor_);
    }
    EXPECT_EQ(found.values, average.values);
}

TEST_F(ReprojectionTest, IsTheSameForAnyExecutor) {
    const Scene scene = make_busy_scene();
    std::vector<Image> found;
    for (const ExecutorKind kind : executor_kinds())
        for (const int threads : {1, 3}) {
            const std::unique_ptr<Executor> executor = make_executor(kind, threads);
            ReprojectedHistory history(kClamp, kWidth, kHeight);
            for (int i = 0; i < 3; ++i) {
                const Camera camera = look_at_camera({{-2, -1, -2}, {2, 1, 2}}, {0.3f + 0.1f * float(i), 0.6f, 5}, {0, -0.1f, 0});
                history.add(frame_of(scene, camera, uint32_t(i)), camera, center_depth(scene, camera, kWidth, kHeight, *executor),
                            *executor);
            }
            found.push_back(history.add(frame_of(scene, busy_camera(), 3), busy_camera(), depth_of(scene, busy_camera()), *executor));
            EXPECT_EQ(found.back().values, found.front().values) << threads << " threads";
        }
}

TEST(TemporalFlicker, IsTheStandardDeviationOverTime) {
    TemporalFlicker flicker;
    flicker.add(filled(3, 2, [](int x, int) { return float(x); }));
    EXPECT_EQ(flicker.rms(), 0.0);
    // Column x alternates between x and 3x: a deviation of x.
    flicker.add(filled(3, 2, [](int x, int) { return 3.0f * float(x); }));
    const Image deviation = flicker.deviation();
    for (int x = 0; x < 3; ++x) EXPECT_NEAR(deviation.pixel(x, 1)[2], float(x), 1e-6f);
    EXPECT_NEAR(flicker.rms(), std::sqrt((0.0 + 1.0 + 4.0) / 3.0), 1e-12);
    EXPECT_EQ(flicker.frames(), 2);
}

}  // namespace
}  // namespace rawtexel::shading
