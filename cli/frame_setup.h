// From what a user asked for to what loading a scene and rendering a frame take.
#pragma once

#include "cli/command.h"
#include "cli/progress.h"
#include "cli/render_options.h"
#include "scenes/load.h"
#include "shading/render.h"

namespace rawtexel::cli {

/// Throws UsageError where this machine does not have it.
void choose_instruction_set(texunit::Simd simd);

/// Warnings go to the invocation, past the progress. Both outlive the options.
scenes::LoadOptions load_options(const RenderRequest& request, const Invocation& invocation, ProgressReport& progress);

/// The scene of a request: loaded, its policies put onto it. `name`: a file or a built-in scene.
shading::Scene load_scene(const std::string& name, const RenderRequest& request, const scenes::LoadOptions& options);

/// Everything of a frame that the shared options say.
shading::RenderOptions frame_options(const RenderRequest& request, const shading::Camera& camera);

/// Throws UsageError where the scene's maps cannot be looked up as asked.
void check_lookups(const shading::Scene& scene, const shading::RenderOptions& options);

}  // namespace rawtexel::cli
