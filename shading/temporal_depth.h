// Where the surfaces are that a camera sees, and where another camera sees them.
#pragma once

#include "shading/executor.h"
#include "shading/image.h"
#include "shading/scene.h"

#include <glm/glm.hpp>

namespace rawtexel::shading {

/// Distances along the view axis at the centres of all pixels, metres, infinite where no surface is; one channel. The centres are those of
/// every frame, however samples are jittered: a camera at rest always sees the same. MASK surfaces are there where their alpha reaches
/// the cutoff, BLEND surfaces where it exceeds a number of the pixel, the same in every frame. Throws texunit::TextureError.
Image center_depth(const Scene& scene, const Camera& camera, int width, int height, Executor& executor);

/// A camera of a frame in double precision.
class FrameProjection {
  public:
    FrameProjection(const Camera& camera, int width, int height);

    struct Point {
        glm::dvec2 pixel{0.0};  ///< from the frame's upper left corner
        double depth = 0.0;     ///< along the view axis, metres; what lies behind the camera has none above 0
    };

    /// The point of the world at `depth`, finite, before position (x, y) of the frame.
    glm::dvec3 world(const glm::dvec2& pixel, double depth) const;
    Point project(const glm::dvec3& world) const;

    /// The way in the world to what shows at infinity behind a position of the frame, and where it shows (depth 1 if before the camera).
    glm::dvec3 direction(const glm::dvec2& pixel) const;
    Point project_direction(const glm::dvec3& direction) const;

  private:
    glm::dvec3 camera_ray(const glm::dvec2& pixel) const;
    Point project_camera(const glm::dvec3& position) const;

    bool perspective_;
    glm::dvec2 half_pixels_;  ///< half of the frame's extents
    glm::dvec2 half_extent_;  ///< of the view: at distance 1 for a perspective camera
    glm::dmat4 world_from_camera_, camera_from_world_;
};

}  // namespace rawtexel::shading
