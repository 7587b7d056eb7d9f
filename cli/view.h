// Which camera a frame is seen through.
#pragma once

#include "cli/render_options.h"
#include "shading/camera.h"
#include "shading/scene.h"

#include <cstddef>
#include <optional>
#include <string>

namespace rawtexel::cli {

struct View {
    shading::Camera camera;
    glm::vec3 target{0.0f};              ///< what it looks at, or passes at the height of the scene's centre
    std::optional<size_t> scene_camera;  ///< the camera is this one of the scene's, its planes too
    /// The options that choose the same camera again, such as "--eye 1,2,3 --target 0,0,0 --fov 45".
    std::string options;
};

/// --camera, else --orbit, else the scene's first camera, else the default view; --eye, --target and --fov then replace their part of it.
/// `aspect` = width / height. Throws UsageError: no such camera (with the names there are), eye and target in one point.
View choose_view(const shading::Scene& scene, const ViewOptions& options, float aspect);

}  // namespace rawtexel::cli
