// The argument with which google/model-viewer's render-fidelity tools call a renderer.
#pragma once

#include "cli/render_options.h"

#include <string>
#include <string_view>

namespace rawtexel::cli {

struct Scenario {
    std::string name;   ///< for messages; may be empty
    std::string model;  ///< path of the glTF
    std::string output_file;
    std::string lighting;  ///< path of the lat-long image; empty: none is named
    ImageSize size;
    glm::vec3 target{0.0f};
    float theta = 0.0f;          ///< degrees around +Y, from +Z towards +X
    float phi = 90.0f;           ///< degrees from +Y
    float radius = 1.0f;         ///< metres from target to eye
    float vertical_fov = 45.0f;  ///< degrees
    bool render_skybox = false;
};

/// Reads {"scenario": {"lighting", "dimensions": {"width", "height"}, "target": {"x", "y", "z"}, "orbit": {"theta", "phi", "radius"},
/// "verticalFoV", "renderSkybox", "name", "model"}, "outputFile"}. Unknown keys are passed over. Throws UsageError naming the key.
Scenario parse_scenario(std::string_view json);

/// Fills in what the command line left open. Without a skybox white shows where nothing is, as those tools compare it.
void apply(const Scenario& scenario, RenderRequest& request);

}  // namespace rawtexel::cli
