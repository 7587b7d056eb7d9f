#include "shading/camera.h"
#include "shading/view_rays.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace rawtexel::shading {
namespace {

constexpr Bounds kBox{{-1.0f, 0.0f, 2.0f}, {3.0f, 1.0f, 8.0f}};

glm::vec3 eye_of(const Camera& camera) { return glm::vec3(camera.world_from_camera[3]); }
glm::vec3 forward_of(const Camera& camera) { return -glm::vec3(camera.world_from_camera[2]); }

glm::vec4 projected(const Camera& camera, float aspect, const glm::vec3& world) {
    return clip_from_world(camera, aspect) * glm::vec4(world, 1.0f);
}

void expect_near(const glm::vec3& a, const glm::vec3& b, float tolerance) {
    EXPECT_LT(glm::length(a - b), tolerance) << a.x << " " << a.y << " " << a.z << " against " << b.x << " " << b.y << " " << b.z;
}

/// A point at `distance` along the view axis.
glm::vec3 ahead(const Camera& camera, float distance) { return eye_of(camera) + distance * forward_of(camera); }

TEST(Camera, ReversesDepthWithoutAFarPlane) {
    Camera camera;
    camera.znear = 0.5f;
    for (const float distance : {0.5f, 1.0f, 10.0f, 1e6f}) {
        const glm::vec4 clip = projected(camera, 1.5f, ahead(camera, distance));
        EXPECT_FLOAT_EQ(clip.z / clip.w, 0.5f / distance);
        EXPECT_FLOAT_EQ(clip.w, distance);
    }
}

TEST(Camera, PutsDepthZeroAtTheFarPlane) {
    Camera camera;
    camera.znear = 2.0f;
    camera.zfar = 50.0f;
    const auto depth = [&](float distance) {
        const glm::vec4 clip = projected(camera, 1.0f, ahead(camera, distance));
        return clip.z / clip.w;
    };
    EXPECT_NEAR(depth(2.0f), 1.0f, 1e-6f);
    EXPECT_NEAR(depth(50.0f), 0.0f, 1e-6f);
    EXPECT_GT(depth(10.0f), depth(11.0f));
    camera.type = Camera::Type::Orthographic;
    EXPECT_NEAR(depth(2.0f), 1.0f, 1e-6f);
    EXPECT_NEAR(depth(26.0f), 0.5f, 1e-6f);
    EXPECT_NEAR(depth(50.0f), 0.0f, 1e-6f);
}

TEST(Camera, SpansItsFieldOfView) {
    Camera camera;
    camera.vertical_fov = 1.0f;
    const glm::vec4 top = projected(camera, 2.0f, {0.0f, std::tan(0.5f) * 3.0f, -3.0f});
    EXPECT_NEAR(top.y / top.w, 1.0f, 1e-6f);
    const glm::vec4 right = projected(camera, 2.0f, {2.0f * std::tan(0.5f) * 3.0f, 0.0f, -3.0f});
    EXPECT_NEAR(right.x / right.w, 1.0f, 1e-6f);
    camera.type = Camera::Type::Orthographic;
    camera.xmag = 4.0f;
    camera.ymag = 2.0f;
    camera.zfar = 10.0f;
    const glm::vec4 corner = projected(camera, 1.0f, {4.0f, -2.0f, -3.0f});
    EXPECT_NEAR(corner.x, 1.0f, 1e-6f);
    EXPECT_NEAR(corner.y, -1.0f, 1e-6f);
}

/// The sphere about the box touches the cone of the narrower field of view.
TEST(Camera, ByDefaultJustFitsTheSphere) {
    for (const float aspect : {0.5f, 1.0f, 1.7778f}) {
        const Camera camera = default_camera(kBox, aspect);
        expect_near(forward_of(camera), glm::normalize(glm::vec3(-1.0f, -0.6f, -1.0f)), 1e-5f);
        EXPECT_FLOAT_EQ(camera.vertical_fov, std::numbers::pi_v<float> / 4.0f);
        const float distance = glm::length(eye_of(camera) - kBox.center());
        const float half_height = std::tan(camera.vertical_fov / 2), narrower = std::atan(std::min(1.0f, aspect) * half_height);
        EXPECT_NEAR(std::asin(kBox.radius() / distance), narrower, 1e-5f) << "aspect " << aspect;
        expect_near(eye_of(camera) + distance * forward_of(camera), kBox.center(), 1e-4f);
        EXPECT_LT(camera.znear, distance - kBox.radius());
    }
}

TEST(Camera, OrbitsByYawAndPitch) {
    const float distance = glm::length(eye_of(default_camera(kBox, 1.5f)) - kBox.center());
    for (const float yaw : {0.0f, 30.0f, 200.0f}) {
        for (const float pitch : {-90.0f, -20.0f, 0.0f, 45.0f, 90.0f}) {
            const Camera camera = orbit_camera(kBox, 1.5f, yaw, pitch, 2.0f);
            const float y = glm::radians(yaw), p = glm::radians(pitch);
            const glm::vec3 along(std::sin(y) * std::cos(p), std::sin(p), std::cos(y) * std::cos(p));
            expect_near(eye_of(camera), kBox.center() + 0.5f * distance * along, 1e-4f);
            expect_near(forward_of(camera), -along, 1e-6f);
            const glm::mat3 axes(camera.world_from_camera);
            EXPECT_NEAR(glm::determinant(axes), 1.0f, 1e-5f) << "yaw " << yaw << " pitch " << pitch;
            EXPECT_GE(axes[1].y, -1e-6f) << "upside down";
        }
    }
}

TEST(Camera, LooksAtTargetsEverywhere) {
    for (const glm::vec3& target : {glm::vec3(0, 0, -1), glm::vec3(0, 5, 0), glm::vec3(0, -5, 0), glm::vec3(3, 1, 2), glm::vec3(0)}) {
        const Camera camera = look_at_camera(kBox, glm::vec3(0.0f), target, 60.0f);
        const glm::mat3 axes(camera.world_from_camera);
        EXPECT_NEAR(glm::determinant(axes), 1.0f, 1e-5f);
        if (target != glm::vec3(0.0f)) expect_near(forward_of(camera), glm::normalize(target), 1e-5f);
        EXPECT_NEAR(glm::degrees(camera.vertical_fov), 60.0f, 1e-4f);
        EXPECT_GT(camera.znear, 0.0f);
    }
}

TEST(Camera, StandsAwayFromAnEmptyScene) {
    const Camera camera = default_camera(Bounds{}, 1.0f);
    EXPECT_GT(glm::length(eye_of(camera)), 1.0f);
    EXPECT_TRUE(std::isfinite(clip_from_world(camera, 1.0f)[0][0]));
}

/// The point a ray reaches projects to the sample point it came from.
TEST(ViewRays, AgreeWithTheProjection) {
    const int width = 64, height = 48;
    const Camera camera = look_at_camera(kBox, {5.0f, 3.0f, -2.0f}, {0.0f, 0.5f, 4.0f}, 50.0f);
    const ViewRays rays = make_view_rays(camera, width, height);
    for (const glm::vec2& at : {glm::vec2(0, 0), glm::vec2(64, 48), glm::vec2(10.25f, 40.5f)}) {
        const glm::vec3 world = rays.eye + 3.0f * (rays.corner + at.x * rays.right + at.y * rays.down);
        const glm::vec4 clip = projected(camera, float(width) / float(height), world);
        EXPECT_NEAR((clip.x / clip.w * 0.5f + 0.5f) * width, at.x, 1e-3f);
        EXPECT_NEAR((0.5f - clip.y / clip.w * 0.5f) * height, at.y, 1e-3f);
        EXPECT_NEAR(clip.w, 3.0f * glm::dot(rays.corner + at.x * rays.right + at.y * rays.down, rays.forward), 1e-4f);
    }
}

TEST(Scene, BoundsHoldAllInstancesAndNothingBroken) {
    Scene scene;
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 2, 3}, {std::nanf(""), 0, 0}};
    mesh.indices = {0, 1, 2, 0, 1, 1};
    scene.meshes = {mesh};
    glm::mat4 mirrored(1.0f);
    mirrored[0][0] = -2.0f;
    scene.instances = {{0, glm::mat4(1.0f)}, {0, mirrored}};
    EXPECT_EQ(scene.triangle_count(), 4u);
    EXPECT_EQ(scene.bounds().lower, glm::vec3(-2, 0, 0));
    EXPECT_EQ(scene.bounds().upper, glm::vec3(1, 2, 3));
    EXPECT_EQ(Scene{}.bounds().radius(), 0.0f);
}

}  // namespace
}  // namespace rawtexel::shading
