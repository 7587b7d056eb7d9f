#include "shading/view_rays.h"

#include <cmath>

namespace rawtexel::shading {

ViewRays make_view_rays(const Camera& camera, int width, int height) {
    const glm::mat3 axes(camera.world_from_camera);
    ViewRays rays;
    rays.eye = glm::vec3(camera.world_from_camera[3]);
    rays.forward = -glm::normalize(axes[2]);
    rays.corner = rays.forward;
    if (camera.type == Camera::Type::Orthographic) return rays;
    const float half_height = std::tan(0.5f * camera.vertical_fov);
    const float half_width = half_height * float(width) / float(height);
    rays.corner = axes * glm::vec3(-half_width, half_height, -1.0f);
    rays.right = axes[0] * (2.0f * half_width / float(width));
    rays.down = axes[1] * (-2.0f * half_height / float(height));
    return rays;
}

}  // namespace rawtexel::shading
