#include "shading/camera_path.h"

#include "shading/camera.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include <cmath>
#include <numbers>

namespace rawtexel::shading {
namespace {

constexpr Bounds kBounds{{-1, -1, -1}, {1, 1, 1}};
constexpr double kPi = std::numbers::pi;

glm::vec3 eye_of(const Camera& camera) { return glm::vec3(camera.world_from_camera[3]); }
glm::vec3 forward_of(const Camera& camera) { return -glm::vec3(camera.world_from_camera[2]); }

void expect_near(const glm::vec3& found, const glm::vec3& expected, const std::string& what = "") {
    EXPECT_LT(glm::length(found - expected), 1e-4f) << what << " found " << found.x << "," << found.y << "," << found.z << " expected "
                                                    << expected.x << "," << expected.y << "," << expected.z;
}

PathStart start_at(const glm::vec3& eye, const glm::vec3& target) { return {look_at_camera(kBounds, eye, target), target, kBounds}; }

TEST(OrbitPath, GoesOnceAroundTheTargetAtItsPitch) {
    const glm::vec3 target(0.5f, 0.25f, -0.5f), eye(0.5f, 2.25f, 3.5f);
    const PathStart start = start_at(eye, target);
    const CameraPath path = orbit_path(start);
    EXPECT_EQ(path.frame(0, 8).world_from_camera, start.camera.world_from_camera);
    // A quarter of the way: what was before the target is on its right.
    expect_near(eye_of(path.frame(2, 8)), {4.5f, 2.25f, -0.5f});
    expect_near(eye_of(path.frame(4, 8)), {0.5f, 2.25f, -4.5f});
    for (int frame = 0; frame < 8; ++frame) {
        const Camera camera = path.frame(frame, 8);
        expect_near(forward_of(camera), glm::normalize(target - eye_of(camera)), "looks at the target");
        EXPECT_NEAR(glm::length(eye_of(camera) - target), glm::length(eye - target), 1e-4f);
        EXPECT_NEAR(camera.world_from_camera[0].y, 0.0f, 1e-6f) << "stays upright";
        EXPECT_EQ(camera.znear, near_plane(kBounds, eye_of(camera)));
    }
}

TEST(DollyPath, EndsHalfWayToTheTarget) {
    const PathStart start = start_at({0, 2, 4}, {0, 0, 2});
    const CameraPath path = dolly_path(start);
    EXPECT_EQ(path.frame(0, 5).world_from_camera, start.camera.world_from_camera);
    expect_near(eye_of(path.frame(2, 5)), {0, 1.5f, 3.5f});
    expect_near(eye_of(path.frame(4, 5)), {0, 1, 3});
    expect_near(forward_of(path.frame(4, 5)), forward_of(start.camera));
    expect_near(eye_of(path.frame(0, 1)), {0, 2, 4}, "one frame");
}

TEST(DollyPath, KeepsThePlanesOfCamerasThatBringTheirs) {
    PathStart start = start_at({0, 0, 9}, {0, 0, 0});
    start.near_from.reset();
    start.camera.znear = 0.7f;
    EXPECT_EQ(dolly_path(start).frame(1, 2).znear, 0.7f);
}

TEST(KeyedPath, RunsStraightBetweenKeysWithTargets) {
    CameraKey a, b, c;
    a.eye = {0, 0, 4}, a.target = {0, 0, 0}, a.vertical_fov = 0.5;
    b.eye = {4, 0, 4}, b.target = {2, 0, 0}, b.vertical_fov = 1.0;
    c.eye = {4, 2, 4}, c.target = {2, 1, 0}, c.vertical_fov = 1.0;
    const CameraPath path = keyed_path({a, b, c}, kBounds);
    const Camera quarter = path.frame(1, 5), last = path.frame(4, 5);
    expect_near(eye_of(quarter), {2, 0, 4});
    expect_near(forward_of(quarter), glm::normalize(glm::vec3(1, 0, 0) - glm::vec3(2, 0, 4)));
    EXPECT_NEAR(quarter.vertical_fov, 0.75f, 1e-6f);
    expect_near(eye_of(last), {4, 2, 4});
    expect_near(forward_of(last), glm::normalize(glm::vec3(2, 1, 0) - glm::vec3(4, 2, 4)));
}

TEST(KeyedPath, TurnsEvenlyBetweenMatrices) {
    CameraKey a, b;
    b.world_from_camera = glm::rotate(glm::translate(glm::dmat4(1.0), glm::dvec3(2, 0, 0)), kPi / 2, glm::dvec3(0, 1, 0));
    const CameraPath path = keyed_path({a, b}, kBounds);
    const Camera third = path.at(1.0 / 3.0);
    expect_near(eye_of(third), {2.0f / 3.0f, 0, 0});
    expect_near(forward_of(third), {-0.5f, 0, -std::sqrt(0.75f)});
    // A key with a target and one without meet in their poses.
    CameraKey looks;
    looks.eye = {0, 0, 0}, looks.target = {0, 0, -5};
    expect_near(forward_of(keyed_path({looks, b}, kBounds).at(1.0 / 3.0)), {-0.5f, 0, -std::sqrt(0.75f)});
    expect_near(eye_of(keyed_path({b}, kBounds).frame(3, 4)), {2, 0, 0}, "one key");
}

KeyTrack track_of(KeyInterpolation interpolation, std::vector<float> times, std::vector<glm::dvec4> values) {
    return {interpolation, std::move(times), std::move(values)};
}

TEST(CameraAnimation, StepsAndLinesHoldTheirEnds) {
    const KeyTrack step = track_of(KeyInterpolation::Step, {1, 2, 4}, {{1, 0, 0, 0}, {2, 0, 0, 0}, {3, 0, 0, 0}});
    const KeyTrack linear = track_of(KeyInterpolation::Linear, {1, 2, 4}, {{1, 0, 0, 0}, {2, 0, 0, 0}, {3, 0, 0, 0}});
    for (const auto& [time, stepped, straight] : {std::tuple(0.0, 1.0, 1.0),
                                                  {1.0, 1.0, 1.0},
                                                  {1.5, 1.0, 1.5},
                                                  {2.0, 2.0, 2.0},
                                                  {3.0, 2.0, 2.5},
                                                  {4.0, 3.0, 3.0},
                                                  {9.0, 3.0, 3.0}}) {
        EXPECT_DOUBLE_EQ(vector_at(step, time).x, stepped) << time;
        EXPECT_DOUBLE_EQ(vector_at(linear, time).x, straight) << time;
    }
}

/// A cubic is its own Hermite spline, whatever the distance of the keys.
TEST(CameraAnimation, SplinesReproduceCubics) {
    const auto cubic = [](double t) { return 2.0 - t + 0.5 * t * t - 0.25 * t * t * t; };
    const auto slope = [](double t) { return -1.0 + t - 0.75 * t * t; };
    KeyTrack track{KeyInterpolation::CubicSpline, {0.5f, 1.0f, 3.0f}, {}};
    for (const double time : {0.5, 1.0, 3.0})
        for (const double value : {slope(time), cubic(time), slope(time)}) track.values.emplace_back(value, 0.0, 0.0, 0.0);
    for (const double time : {0.5, 0.6, 0.99, 1.0, 1.7, 2.9, 3.0}) EXPECT_NEAR(vector_at(track, time).x, cubic(time), 1e-12) << time;
    EXPECT_DOUBLE_EQ(vector_at(track, 0.0).x, cubic(0.5));
    EXPECT_DOUBLE_EQ(vector_at(track, 7.0).x, cubic(3.0));
}

TEST(CameraAnimation, RotationsTurnTheShorterWayAtAnEvenPace) {
    const double half = std::sqrt(0.5);
    for (const double sign : {1.0, -1.0}) {
        const KeyTrack track = track_of(KeyInterpolation::Linear, {0, 1}, {{0, 0, 0, 1}, {0, sign * half, 0, sign * half}});
        const glm::dvec3 turned = rotation_at(track, 1.0 / 3.0) * glm::dvec3(0, 0, -1);
        expect_near(glm::vec3(turned), {-0.5f, 0, -std::sqrt(0.75f)});
    }
    const KeyTrack spline = track_of(KeyInterpolation::CubicSpline, {0, 1},
                                     {{0, 0, 0, 0}, {0, 0, 0, 1}, {0, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, -1}, {0, 0, 0, 0}});
    EXPECT_EQ(rotation_at(spline, 0.5), glm::dquat(1.0, 0.0, 0.0, 0.0)) << "through zero";
}

TEST(CameraAnimation, MovesTheCameraThroughItsParents) {
    CameraAnimation animation;
    MovingTransform arm, mount;
    // The arm turns by a quarter about +Y and is scaled, which a camera's pose does not show; the mount is 2 m out.
    const double half = std::sqrt(0.5);
    arm.scale = glm::dvec3(1.5);
    arm.rotations = track_of(KeyInterpolation::Linear, {0, 4}, {{0, 0, 0, 1}, {0, half, 0, half}});
    mount.matrix = glm::translate(glm::dmat4(1.0), glm::dvec3(0, 0, 2));
    animation.nodes = {arm, mount};
    animation.first_time = 0.0;
    animation.last_time = 4.0;
    Camera camera;
    camera.znear = 0.3f;
    const CameraPath path = animated_path(camera, animation);
    expect_near(eye_of(path.frame(0, 3)), {0, 0, 3});
    expect_near(eye_of(path.frame(2, 3)), {3, 0, 0});
    expect_near(forward_of(path.frame(2, 3)), {-1, 0, 0});
    expect_near(eye_of(path.frame(1, 3)), {3.0f * float(half), 0, 3.0f * float(half)});
    EXPECT_EQ(path.frame(1, 3).znear, 0.3f);
    EXPECT_NEAR(glm::determinant(glm::mat3(path.frame(1, 3).world_from_camera)), 1.0f, 1e-6f);
}

}  // namespace
}  // namespace rawtexel::shading
