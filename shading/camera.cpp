#include "shading/camera.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace rawtexel::shading {
namespace {

constexpr float kDefaultFov = 0.785398163f;  // 45 degrees

/// A point or an empty scene is looked at as if it had the extent of a metre.
float framed_radius(const Bounds& bounds) { return bounds.radius() > 0.0f ? bounds.radius() : 1.0f; }

/// Distance at which the sphere touches the sides of the narrower field of view.
float fitting_distance(const Bounds& bounds, float aspect, float vertical_fov) {
    const float half_vertical = 0.5f * vertical_fov;
    const float half_horizontal = std::atan(aspect * std::tan(half_vertical));
    return framed_radius(bounds) / std::sin(std::min(half_vertical, half_horizontal));
}

/// Rigid camera-to-world transform with axes right, up, backward.
glm::mat4 pose(const glm::vec3& right, const glm::vec3& up, const glm::vec3& backward, const glm::vec3& eye) {
    return {glm::vec4(right, 0.0f), glm::vec4(up, 0.0f), glm::vec4(backward, 0.0f), glm::vec4(eye, 1.0f)};
}

}  // namespace

float near_plane(const Bounds& bounds, const glm::vec3& eye) {
    // Reversed float depth is as fine at any distance for any near plane, so nothing is lost by a close one.
    const float radius = framed_radius(bounds);
    const float gap = glm::length(eye - bounds.center()) - radius;
    return std::max(0.5f * gap, 1e-4f * radius);
}

glm::mat4 clip_from_world(const Camera& camera, float aspect) {
    glm::mat4 clip_from_camera(0.0f);
    const float near = camera.znear, far = camera.zfar;
    if (camera.type == Camera::Type::Perspective) {
        // w = -z; depth near/distance without a far plane, n(f - d)/(d(f - n)) with one.
        const float y_scale = 1.0f / std::tan(0.5f * camera.vertical_fov);
        const float slope = far > 0.0f ? near / (far - near) : 0.0f;
        clip_from_camera[0][0] = y_scale / aspect;
        clip_from_camera[1][1] = y_scale;
        clip_from_camera[2][2] = slope;
        clip_from_camera[2][3] = -1.0f;
        clip_from_camera[3][2] = far > 0.0f ? slope * far : near;
    } else {
        // Depth (f - d)/(f - n).
        assert(far > near);
        clip_from_camera[0][0] = 1.0f / camera.xmag;
        clip_from_camera[1][1] = 1.0f / camera.ymag;
        clip_from_camera[2][2] = 1.0f / (far - near);
        clip_from_camera[3][2] = far / (far - near);
        clip_from_camera[3][3] = 1.0f;
    }
    return clip_from_camera * glm::inverse(camera.world_from_camera);
}

Camera look_at_camera(const Bounds& bounds, const glm::vec3& eye, const glm::vec3& target, float vertical_fov) {
    const glm::vec3 away = eye - target;
    const glm::vec3 backward = glm::length(away) > 0.0f ? glm::normalize(away) : glm::vec3(0.0f, 0.0f, 1.0f);
    // Looking straight up or down, the image's top is -Z or +Z as if the head were tilted from looking along -Z.
    const bool vertical = std::abs(backward.y) > 0.99999f;
    const glm::vec3 above = vertical ? glm::vec3(0.0f, 0.0f, backward.y > 0.0f ? -1.0f : 1.0f) : glm::vec3(0.0f, 1.0f, 0.0f);
    const glm::vec3 right = glm::normalize(glm::cross(above, backward));
    Camera camera;
    camera.world_from_camera = pose(right, glm::cross(backward, right), backward, eye);
    camera.vertical_fov = glm::radians(vertical_fov);
    camera.znear = near_plane(bounds, eye);
    return camera;
}

Camera default_camera(const Bounds& bounds, float aspect) {
    const float distance = fitting_distance(bounds, aspect, kDefaultFov);
    const glm::vec3 backward = glm::normalize(glm::vec3(1.0f, 0.6f, 1.0f));
    return look_at_camera(bounds, bounds.center() + distance * backward, bounds.center(), glm::degrees(kDefaultFov));
}

Camera orbit_camera(const Bounds& bounds, float aspect, float yaw, float pitch, float zoom) {
    const float distance = fitting_distance(bounds, aspect, kDefaultFov) / zoom;
    const float sin_yaw = std::sin(glm::radians(yaw)), cos_yaw = std::cos(glm::radians(yaw));
    const float sin_pitch = std::sin(glm::radians(pitch)), cos_pitch = std::cos(glm::radians(pitch));
    // The axes come from the angles, so that the poles are no special case.
    const glm::vec3 backward(sin_yaw * cos_pitch, sin_pitch, cos_yaw * cos_pitch);
    const glm::vec3 up(-sin_yaw * sin_pitch, cos_pitch, -cos_yaw * sin_pitch);
    const glm::vec3 eye = bounds.center() + distance * backward;
    Camera camera;
    camera.world_from_camera = pose(glm::vec3(cos_yaw, 0.0f, -sin_yaw), up, backward, eye);
    camera.vertical_fov = kDefaultFov;
    camera.znear = near_plane(bounds, eye);
    return camera;
}

}  // namespace rawtexel::shading
