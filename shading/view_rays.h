// The camera seen from the pixels: which way each sample point looks.
#pragma once

#include "shading/scene.h"

#include <glm/glm.hpp>

namespace rawtexel::shading {

/// The ray through sample point (x, y), in pixels from the frame's upper left corner, runs along corner + x*right + y*down (not unit).
struct ViewRays {
    glm::vec3 corner{0.0f}, right{0.0f}, down{0.0f};
    glm::vec3 eye{0.0f};
    glm::vec3 forward{0.0f, 0.0f, -1.0f};  ///< unit, the view axis
};

/// Rays of a frame of `width` x `height` pixels, consistent with clip_from_world. All parallel for an orthographic camera.
ViewRays make_view_rays(const Camera& camera, int width, int height);

}  // namespace rawtexel::shading
