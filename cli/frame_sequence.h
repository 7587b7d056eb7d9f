// The frames of a sequence, rendered one after the other and accumulated.
#pragma once

#include "cli/sequence_options.h"
#include "shading/camera_path.h"
#include "shading/render.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace rawtexel::cli {

/// What a sequence was, for statistics.
struct SequenceRecord {
    int frames = 0;
    int flicker_frames = 0;             ///< that the flicker is of
    std::optional<double> flicker_rms;  ///< root mean square over pixels and channels; unset: too few frames
    /// Share of the pixels, over all frames but the first, that found no history; unset: nobody looked for any.
    std::optional<double> disoccluded;
    double accumulate_s = 0;  ///< wall seconds of all accumulations, depth of reprojection and flicker included
};

struct SequenceInputs {
    const shading::Scene& scene;
    const shading::Lighting& lighting;
    shading::RenderOptions options;  ///< of every frame; layers are those of the last one, fetches of the first one
    const shading::CameraPath& path;
    const SequenceOptions& sequence;
};

struct SequenceHooks {
    std::function<void(double share)> progress = [](double) {};
    std::function<void()> first_frame_done = [] {};
    /// Hears of every accumulated image.
    std::function<void(int frame, const shading::Image& image)> frame_done = [](int, const shading::Image&) {};
};

struct SequenceResult {
    /// Radiance and layers of the last frame, all else of the first one.
    shading::RenderResult result;
    shading::Image flicker;  ///< standard deviation over time of every value; empty: too few frames or not asked for
    SequenceRecord record;
    std::vector<double> frame_s;  ///< wall seconds of each frame, without its accumulation
};

/// Frame f has samples [f spp, (f + 1) spp). Reprojection needs what lies around a crop: frames are rendered whole then, and cut.
SequenceResult render_sequence(const SequenceInputs& inputs, shading::Executor& executor, const SequenceHooks& hooks = {});

}  // namespace rawtexel::cli
