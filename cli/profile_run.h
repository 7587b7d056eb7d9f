// The frames of a profile: one looked at closely, the same under the other fetch models, and others with settings beside it.
#pragma once

#include "cli/command.h"
#include "cli/progress.h"
#include "cli/run_record.h"
#include "shading/executor.h"
#include "texunit/fetch_trace.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace rawtexel::cli {

/// What is to be counted, and how textures are looked up.
struct ProfileSetting {
    std::string options;  ///< as the user wrote them; empty for the profile's own
    RenderRequest request;
};

/// A counted frame; its fetches refer to its scene.
struct ProfiledFrame {
    std::string options;
    std::unique_ptr<shading::Scene> scene;
    RunRecord record;
};

struct ProfileRuns {
    ProfiledFrame frame;
    /// Records of the frame under every fetch model, in their order; that of the frame's own is empty. Without layers of pixels.
    std::vector<std::pair<shading::FetchModel, RunRecord>> models;
    std::vector<ProfiledFrame> compared;
};

struct ProfilePlan {
    std::string scene;
    std::vector<ProfileSetting> settings;                 ///< the profile's own first
    texunit::FetchTraceWriter* trace = nullptr;           ///< of the profile's own frame
    std::function<void(const std::string& path)> opened;  ///< told of every file that the scene names
};

/// Every setting starts from a scene loaded anew, so that what was decoded is its own. Errors as in `render`.
ProfileRuns run_profile(const ProfilePlan& plan, const Invocation& invocation, shading::Executor& executor, ProgressReport& progress);

}  // namespace rawtexel::cli
