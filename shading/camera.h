// Cameras that a scene does not bring itself, and the projection that raster expects.
#pragma once

#include "shading/scene.h"

#include <glm/glm.hpp>

namespace rawtexel::shading {

/// Reversed-depth projection times view: z/w is 1 at znear and falls to 0 at zfar or infinity. `aspect` = width/height.
glm::mat4 clip_from_world(const Camera& camera, float aspect);

/// 45 degrees, looking along (-1, -0.6, -1) at the centre of the box, whose sphere just fits the narrower field of view.
Camera default_camera(const Bounds& bounds, float aspect);
/// Eye at centre + D/zoom * (sin yaw cos pitch, sin pitch, cos yaw cos pitch), D the just-fitting distance; degrees.
Camera orbit_camera(const Bounds& bounds, float aspect, float yaw, float pitch, float zoom = 1.0f);
/// `vertical_fov` in degrees; near plane chosen from the scene's bounds.
Camera look_at_camera(const Bounds& bounds, const glm::vec3& eye, const glm::vec3& target, float vertical_fov = 45.0f);

/// The near plane of these cameras: half-way to the scene's sphere, or a ten-thousandth of its radius from inside.
float near_plane(const Bounds& bounds, const glm::vec3& eye);

}  // namespace rawtexel::shading
