// A slow renderer of unlit, opaque scenes: one sample point at a time, every triangle tried, everything in double.
#pragma once

#include "shading/scene.h"

#include <glm/glm.hpp>

namespace rawtexel::shading::reference {

/// What the sample point (x, y), in pixels from the frame's upper left corner, sees: base colour factor times texture times vertex colour
/// of the nearest front face along its ray, or `background`. Kernel, mip mode and wraps are those of the map's sampler.
glm::dvec3 unlit_radiance(const Scene& scene, const Camera& camera, int width, int height, double x, double y,
                          const glm::dvec3& background);

}  // namespace rawtexel::shading::reference
