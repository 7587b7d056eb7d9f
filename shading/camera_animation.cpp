#include "shading/camera_animation.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace rawtexel::shading {
namespace {

/// Where a time lies between two keys.
struct Between {
    size_t left = 0, right = 0;  ///< keys
    double part = 0.0;           ///< of the way, 0..1
    double duration = 0.0;       ///< from left to right, seconds
};

Between find_keys(const KeyTrack& track, double time) {
    assert(track.moves());
    const auto after = std::upper_bound(track.times.begin(), track.times.end(), time, [](double t, float key) { return t < double(key); });
    if (after == track.times.begin()) return {};
    const auto left = size_t(after - track.times.begin()) - 1;
    if (after == track.times.end()) return {left, left, 0.0, 0.0};
    const double start = track.times[left], duration = double(*after) - start;
    return {left, left + 1, (time - start) / duration, duration};
}

/// glTF 2.0, appendix C.5, "Cubic Spline Interpolation".
glm::dvec4 spline(const KeyTrack& track, const Between& at) {
    const glm::dvec4& left = track.values[3 * at.left + 1];
    if (at.left == at.right) return left;
    const glm::dvec4 out = at.duration * track.values[3 * at.left + 2], in = at.duration * track.values[3 * at.right];
    const double t = at.part, t2 = t * t, t3 = t2 * t;
    return (2.0 * t3 - 3.0 * t2 + 1.0) * left + (t3 - 2.0 * t2 + t) * out + (3.0 * t2 - 2.0 * t3) * track.values[3 * at.right + 1] +
           (t3 - t2) * in;
}

glm::dquat unit_quaternion(const glm::dvec4& xyzw) {
    const double length = glm::length(xyzw);
    if (!(length > 0.0)) return {1.0, 0.0, 0.0, 0.0};
    return {xyzw.w / length, xyzw.x / length, xyzw.y / length, xyzw.z / length};  // w first
}

glm::dmat4 matrix_at(const MovingTransform& node, double time) {
    if (!node.moves()) return node.matrix;
    const glm::dvec3 translation = node.translations.moves() ? vector_at(node.translations, time) : node.translation;
    const glm::dquat rotation = node.rotations.moves() ? rotation_at(node.rotations, time) : node.rotation;
    const glm::dvec3 scale = node.scales.moves() ? vector_at(node.scales, time) : node.scale;
    return glm::scale(glm::translate(glm::dmat4(1.0), translation) * glm::mat4_cast(rotation), scale);
}

glm::dvec3 unit_or(const glm::dvec3& v, const glm::dvec3& otherwise) {
    const double length = glm::length(v);
    return length > 0.0 ? v / length : otherwise;
}

}  // namespace

glm::dvec3 vector_at(const KeyTrack& track, double time) {
    const Between at = find_keys(track, time);
    if (track.interpolation == KeyInterpolation::CubicSpline) return spline(track, at);
    const glm::dvec3 left(track.values[at.left]);
    if (track.interpolation == KeyInterpolation::Step || at.left == at.right) return left;
    return left + at.part * (glm::dvec3(track.values[at.right]) - left);
}

glm::dquat rotation_at(const KeyTrack& track, double time) {
    const Between at = find_keys(track, time);
    if (track.interpolation == KeyInterpolation::CubicSpline) return unit_quaternion(spline(track, at));
    const glm::dquat left = unit_quaternion(track.values[at.left]);
    if (track.interpolation == KeyInterpolation::Step || at.left == at.right) return left;
    return glm::normalize(glm::slerp(left, unit_quaternion(track.values[at.right]), at.part));
}

glm::mat4 world_from_camera_at(const CameraAnimation& animation, double time) {
    glm::dmat4 world(1.0);
    for (const MovingTransform& node : animation.nodes) world *= matrix_at(node, time);
    return rigid_pose(world);
}

glm::mat4 rigid_pose(const glm::dmat4& world) {
    const glm::dvec3 z = unit_or(glm::dvec3(world[2]), {0.0, 0.0, 1.0});
    const glm::dvec3 y = glm::dvec3(world[1]);
    const glm::dvec3 any_side = std::abs(z.x) < 0.5 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
    const glm::dvec3 x = unit_or(glm::cross(y, z), unit_or(any_side - z * glm::dot(any_side, z), any_side));
    return glm::mat4(glm::dmat4(glm::dvec4(x, 0.0), glm::dvec4(glm::cross(z, x), 0.0), glm::dvec4(z, 0.0), world[3]));
}

}  // namespace rawtexel::shading
