// The light of a frame, from the scene and what the user asked for.
#pragma once

#include "cli/render_options.h"
#include "shading/executor.h"
#include "shading/lighting.h"
#include "shading/scene.h"

namespace rawtexel::cli {

/// Lights of the file or --light; environment as asked, or as the scene asks, or the sky where there is no light; with the sky and no other
/// light comes the built-in sun. Draws the shadow map and prefilters the environment. Throws scenes::InputError for an environment file.
shading::Lighting make_lighting(const shading::Scene& scene, const LightOptions& options, shading::Executor& executor);

}  // namespace rawtexel::cli
