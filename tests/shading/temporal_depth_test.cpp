#include "shading/temporal_depth.h"

#include "scene_parts.h"
#include "shading/camera.h"
#include "shading/render.h"
#include "tests/shading/executor_kinds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace rawtexel::shading {
namespace {

using namespace test;

Camera tilted_camera(Camera::Type type) {
    Camera camera = look_at_camera({{-2, -1, -2}, {2, 1, 2}}, {1.0f, 2.0f, 5.0f}, {0.2f, -0.1f, 0.3f}, 50.0f);
    camera.type = type;
    if (type == Camera::Type::Orthographic) {
        camera.xmag = 2.5f;
        camera.ymag = 1.5f;
        camera.zfar = 50.0f;
    }
    return camera;
}

TEST(FrameProjection, IsThatOfClipFromWorld) {
    for (const Camera::Type type : {Camera::Type::Perspective, Camera::Type::Orthographic}) {
        const Camera camera = tilted_camera(type);
        const FrameProjection projection(camera, 120, 72);
        const glm::dmat4 clip_from_world(shading::clip_from_world(camera, 120.0f / 72.0f));
        double worst = 0.0;
        for (const glm::dvec3& world : {glm::dvec3(0.0), {1, 1, 1}, {-1.5, 0.3, 0.2}, {0.1, -0.9, -3.0}}) {
            const glm::dvec4 clip = clip_from_world * glm::dvec4(world, 1.0);
            const glm::dvec2 expected((clip.x / clip.w + 1.0) * 60.0, (1.0 - clip.y / clip.w) * 36.0);
            const FrameProjection::Point found = projection.project(world);
            worst = std::max(worst, glm::length(found.pixel - expected));
            worst = std::max(worst, glm::length(projection.world(found.pixel, found.depth) - world));
        }
        EXPECT_LT(worst, 1e-4) << "pixels or metres";
    }
}

TEST(FrameProjection, SeesDirectionsWhereTheirPointsVanish) {
    const Camera camera = tilted_camera(Camera::Type::Perspective);
    const FrameProjection projection(camera, 120, 72);
    for (const glm::dvec2& pixel : {glm::dvec2(3.5, 7.25), {60, 36}, {119, 70}}) {
        const glm::dvec3 direction = projection.direction(pixel);
        const glm::dvec3 far = glm::dvec3(camera.world_from_camera[3]) + 1e9 * direction;
        EXPECT_LT(glm::length(projection.project(far).pixel - pixel), 1e-4);
        EXPECT_LT(glm::length(projection.project_direction(direction).pixel - pixel), 1e-4);
        EXPECT_EQ(projection.project_direction(-direction).depth, 0.0);
    }
}

/// Sample 0 lies at the centre of its pixel; without MASK and BLEND the depth layer holds the same.
TEST(CenterDepth, IsTheDepthOfCentralSamples) {
    const std::unique_ptr<Executor> executor = make_executor(ExecutorKind::Threads, 1);
    Scene scene = make_busy_scene();
    for (Material& material : scene.materials) material.alpha_mode = AlphaMode::Opaque;
    RenderOptions options;
    options.width = 101;
    options.height = 67;
    options.aovs = {Aov::Depth};
    Camera limited = tilted_camera(Camera::Type::Perspective);
    limited.zfar = 40.0f;
    for (const Camera& camera : {tilted_camera(Camera::Type::Perspective), limited, tilted_camera(Camera::Type::Orthographic)}) {
        options.camera = camera;
        const RenderResult frame = render(scene, Lighting{}, options, *executor);
        const Image depth = center_depth(scene, camera, options.width, options.height, *executor);
        double worst = 0.0;
        int surfaces = 0;
        for (size_t i = 0; i < depth.values.size(); ++i) {
            const double expected = double(frame.layers[0].image.values[i]);
            ASSERT_EQ(std::isinf(depth.values[i]), expected == 0.0) << "pixel " << i;
            if (expected == 0.0) continue;
            ++surfaces;
            worst = std::max(worst, std::abs(double(depth.values[i]) - expected) / expected);
        }
        EXPECT_GT(surfaces, 1000);
        EXPECT_LT(worst, 1e-4);
        for (const ExecutorKind kind : executor_kinds())
            EXPECT_EQ(center_depth(scene, camera, options.width, options.height, *make_executor(kind, 3)).values, depth.values);
    }
}

}  // namespace
}  // namespace rawtexel::shading
