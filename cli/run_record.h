// What one run of a render was and did: where statistics and metadata come from.
#pragma once

#include "cli/frame_sequence.h"
#include "cli/render_options.h"
#include "shading/render.h"
#include "shading/scene.h"
#include "texunit/texture.h"

#include <optional>
#include <string>
#include <vector>

namespace rawtexel::cli {

struct RunTimes {
    std::vector<double> frame_s;  ///< wall seconds of each repeat or frame, geometry to resolved image
    double load_s = 0;            ///< scene, environment, shadow map
    double write_s = 0, total_s = 0;
};

struct RunRecord {
    std::string scene;    ///< as given
    std::string command;  ///< the whole command, quoted for a shell
    std::string view;     ///< the options that choose the same camera
    RenderRequest request;
    shading::RenderResult result;            ///< of the first frame; of a sequence image and layers of the last
    std::vector<texunit::TextureWork> work;  ///< per scene texture, after the first frame
    RunTimes times;
    std::optional<SequenceRecord> sequence;  ///< of a sequence
    std::optional<double> standard_error;    ///< of the truth
};

/// What was done in every texture of the scene so far.
std::vector<texunit::TextureWork> texture_work(const shading::Scene& scene);

/// Words joined so that a POSIX shell reads them back.
std::string shell_quoted(const std::vector<std::string>& words);

}  // namespace rawtexel::cli
