// Cameras that move from frame to frame.
#pragma once

#include "shading/camera_animation.h"
#include "shading/scene.h"

#include <glm/glm.hpp>

#include <functional>
#include <optional>
#include <vector>

namespace rawtexel::shading {

/// The camera along the way, t from 0 to 1.
struct CameraPath {
    std::function<Camera(double t)> at;
    bool closed = false;  ///< t = 1 is where t = 0 is: the last frame lies one step before it

    /// Of frame `frame` of `frames`, evenly along the way. One frame is at its beginning.
    Camera frame(int frame, int frames) const;
};

/// Where paths begin, and whether the near plane follows the camera's distance from the scene (near_plane) as it moves.
struct PathStart {
    Camera camera;
    glm::vec3 target{0.0f};
    std::optional<Bounds> near_from;  ///< unset: the camera's planes stay
};

/// Stays.
CameraPath still_path(const Camera& camera);
/// Once around the upright axis through the target, to the camera's right (counter-clockwise seen from above); the camera is turned with
/// it.
CameraPath orbit_path(const PathStart& start);
/// Straight towards the target, half of the way.
CameraPath dolly_path(const PathStart& start);

/// A pose to pass through: from an eye to a target with +Y up, or a rigid transform.
struct CameraKey {
    std::optional<glm::dvec3> eye, target;  ///< both or neither; apart
    glm::dmat4 world_from_camera{1.0};      ///< where there is no eye
    double vertical_fov = 0.785398163;      ///< radians
};
/// Through all keys (at least one) in even steps. Between two keys with targets eye and target run straight, else eyes run straight and
/// the camera turns evenly; fields of view change evenly. All cameras are perspective.
CameraPath keyed_path(std::vector<CameraKey> keys, const Bounds& bounds);

/// `camera` moved by its animation from the first time to the last.
CameraPath animated_path(const Camera& camera, CameraAnimation animation);

}  // namespace rawtexel::shading
