// Cameras that move as a file says: key frames of the transforms that a camera hangs on (glTF 2.0, 3.11).
#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include <string>
#include <vector>

namespace rawtexel::shading {

enum class KeyInterpolation { Step, Linear, CubicSpline };

/// Values at times in seconds, which increase. A cubic spline has three values a key: tangent in, value, tangent out. Before the first
/// time and after the last one the value there stays.
struct KeyTrack {
    KeyInterpolation interpolation = KeyInterpolation::Linear;
    std::vector<float> times;        ///< empty: nothing moves
    std::vector<glm::dvec4> values;  ///< xyz, or a quaternion's xyzw

    bool moves() const { return !times.empty(); }
};

/// The value at `time` (glTF 2.0, appendix C.2 to C.5); of rotations the unit quaternion, between keys spherically where linear. The track
/// moves (asserted). A spline of rotations that passes through zero is the identity there.
glm::dvec3 vector_at(const KeyTrack& track, double time);
glm::dquat rotation_at(const KeyTrack& track, double time);

/// A node's transform to its parent, some of whose parts move.
struct MovingTransform {
    glm::dmat4 matrix{1.0};  ///< where nothing moves
    glm::dvec3 translation{0.0}, scale{1.0};
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};
    KeyTrack translations, rotations, scales;

    bool moves() const { return translations.moves() || rotations.moves() || scales.moves(); }
};

struct CameraAnimation {
    std::string name;                          ///< for messages
    std::vector<MovingTransform> nodes;        ///< from the root to the camera's node
    double first_time = 0.0, last_time = 0.0;  ///< seconds, over all tracks
};

/// The camera's pose at `time`, in seconds: it looks along -Z of the last node, +Y as nearly up as that allows.
glm::mat4 world_from_camera_at(const CameraAnimation& animation, double time);

/// Rotation and position of a transform that may scale and shear, its -Z kept.
glm::mat4 rigid_pose(const glm::dmat4& world);

}  // namespace rawtexel::shading
