// A sweep, run: for each scene and kernel the truth, and every configuration measured against it.
#pragma once

#include "cli/bench/measurement.h"
#include "cli/bench/sweep.h"
#include "cli/bench/sweep_file.h"
#include "cli/command.h"
#include "cli/progress.h"
#include "shading/executor.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace rawtexel::cli {

struct BenchPlan {
    std::vector<std::string> scenes;
    std::string folder;
    RenderRequest base;  ///< what all configurations share
    SweepAxes axes;
    SweepBudget budget;
    std::optional<double> truth_error;  ///< the goal of the truths; unset: as many samples as the budget has
    GivenOptions options;               ///< of `render`, that all configurations share, for their commands
    std::optional<double> seconds;      ///< after so many of the program's run no more begins
    double start = 0;                   ///< of the run, on ProgressReport::steady_seconds
};

struct SceneResults {
    std::string scene;
    std::string camera;  ///< the options that choose it
    std::vector<Truth> truths;
    std::vector<Measurement> measurements;  ///< in the order of the sweep
    std::vector<LeftOut> left_out;

    const Truth& truth_of(const Measurement& measurement) const;
};

/// Runs what `file` has not got, and adds to it. `opened`: told of every file that the scenes name. Errors as in `render`, and UsageError
/// where no configuration is left.
std::vector<SceneResults> run_bench(const BenchPlan& plan, SweepFile& file, const Invocation& invocation, shading::Executor& executor,
                                    ProgressReport& progress, const std::function<void(const std::string&)>& opened);

}  // namespace rawtexel::cli
