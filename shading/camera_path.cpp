#include "shading/camera_path.h"

#include "shading/camera.h"

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cassert>
#include <numbers>
#include <utility>

namespace rawtexel::shading {
namespace {

void move_near_plane(const PathStart& start, Camera& camera) {
    if (start.near_from) camera.znear = near_plane(*start.near_from, glm::vec3(camera.world_from_camera[3]));
}

glm::dmat4 pose_of(const CameraKey& key, const Bounds& bounds) {
    if (!key.eye) return key.world_from_camera;
    return glm::dmat4(look_at_camera(bounds, glm::vec3(*key.eye), glm::vec3(*key.target)).world_from_camera);
}

/// Eyes run straight, the camera turns the shorter way around.
glm::mat4 mixed_pose(const glm::dmat4& a, const glm::dmat4& b, double part) {
    const glm::dquat turn = glm::normalize(glm::slerp(glm::quat_cast(glm::dmat3(a)), glm::quat_cast(glm::dmat3(b)), part));
    glm::dmat4 pose = glm::mat4_cast(turn);
    pose[3] = glm::mix(a[3], b[3], part);
    return glm::mat4(pose);
}

Camera mixed_camera(const CameraKey& a, const CameraKey& b, double part, const Bounds& bounds) {
    const auto fov = float(glm::mix(a.vertical_fov, b.vertical_fov, part));
    Camera camera;
    if (a.eye && b.eye) {
        camera = look_at_camera(bounds, glm::vec3(glm::mix(*a.eye, *b.eye, part)), glm::vec3(glm::mix(*a.target, *b.target, part)));
    } else {
        camera.world_from_camera = mixed_pose(pose_of(a, bounds), pose_of(b, bounds), part);
        camera.znear = near_plane(bounds, glm::vec3(camera.world_from_camera[3]));
    }
    camera.vertical_fov = fov;
    return camera;
}

}  // namespace

Camera CameraPath::frame(int frame, int frames) const {
    assert(frame >= 0 && frame < frames);
    const int steps = closed ? frames : frames - 1;
    return at(steps > 0 ? double(frame) / steps : 0.0);
}

CameraPath still_path(const Camera& camera) {
    return {[camera](double) { return camera; }, true};
}

CameraPath orbit_path(const PathStart& start) {
    const auto at = [start](double t) {
        Camera camera = start.camera;
        if (t == 0.0) return camera;
        const glm::dvec3 target(start.target);
        glm::dmat4 turn = glm::translate(glm::dmat4(1.0), target);
        turn = glm::rotate(turn, 2.0 * std::numbers::pi * t, glm::dvec3(0.0, 1.0, 0.0));
        turn = glm::translate(turn, -target);
        camera.world_from_camera = glm::mat4(turn * glm::dmat4(camera.world_from_camera));
        move_near_plane(start, camera);
        return camera;
    };
    return {at, true};
}

CameraPath dolly_path(const PathStart& start) {
    const auto at = [start](double t) {
        Camera camera = start.camera;
        if (t == 0.0) return camera;
        const glm::dvec3 eye(camera.world_from_camera[3]);
        camera.world_from_camera[3] = glm::vec4(glm::mix(eye, glm::dvec3(start.target), 0.5 * t), 1.0f);
        move_near_plane(start, camera);
        return camera;
    };
    return {at, false};
}

CameraPath keyed_path(std::vector<CameraKey> keys, const Bounds& bounds) {
    assert(!keys.empty());
    const auto at = [keys = std::move(keys), bounds](double t) {
        const double place = t * double(keys.size() - 1);
        const size_t left = std::min(size_t(place), keys.size() - 1), right = std::min(left + 1, keys.size() - 1);
        return mixed_camera(keys[left], keys[right], place - double(left), bounds);
    };
    return {at, false};
}

CameraPath animated_path(const Camera& camera, CameraAnimation animation) {
    const auto at = [camera, animation = std::move(animation)](double t) {
        Camera moved = camera;
        moved.world_from_camera = world_from_camera_at(animation, glm::mix(animation.first_time, animation.last_time, t));
        return moved;
    };
    return {at, false};
}

}  // namespace rawtexel::shading
