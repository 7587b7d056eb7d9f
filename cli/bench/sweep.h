// What a sweep runs: every combination of the values chosen for its axes that the program takes, as far as the budget goes.
#pragma once

#include "cli/bench/configuration.h"
#include "cli/command_line.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace rawtexel::cli {

/// The values of each axis; empty where the user chose none.
struct SweepAxes {
    std::vector<std::optional<texunit::Kernel>> filters;
    std::vector<std::optional<texunit::MipMode>> mips;
    struct Probes {
        std::optional<int> count;  ///< unset: what the scene says
        float variance = 0;
        bool operator==(const Probes&) const = default;
    };
    std::vector<Probes> probes;
    std::vector<std::optional<float>> hybrid_biases;
    std::vector<texunit::Estimator> estimators;
    std::vector<shading::FilterOrder> orders;
    std::vector<int> spps;
};

/// Puts lists in the place of those options of `render` that are axes; `line` has them already.
void declare_axes(CommandLine& line, SweepAxes& axes);

/// How much a sweep does, in shaded texels (shaded_texels) of frames; so it follows from extents and settings, never from a clock.
struct SweepBudget {
    double frame = 0;    ///< of one frame of a configuration
    double repeats = 0;  ///< of all timed frames of a configuration
    int least_repeats = 0, most_repeats = 0;
    double truth = 0;  ///< of a truth that has no goal of its own
    bool quick = false;
};
SweepBudget full_budget();
SweepBudget quick_budget(size_t scenes);
/// The largest frames that a quick sweep takes: of a truth of the fewest samples under a kernel of 16 taps.
double quick_pixels(const SweepBudget& budget);

/// A combination that is not run, with every number of samples that it was to have.
struct LeftOut {
    std::string options;  ///< those of its configuration but --spp
    std::vector<int> spps;
    std::string reason;
    bool late = false;  ///< for want of time alone
};

struct Sweep {
    std::vector<Configuration> configurations;  ///< kernel by kernel; ascending samples within a series
    std::vector<LeftOut> left_out;
    void leave_out(const Configuration& configuration, const std::string& reason, bool late = false);
};

/// `base`: what all configurations share; its ellipse (--ewa) is a value of the minification axis. `refusal`: why a scene cannot be
/// looked up so, empty where it can.
Sweep plan_sweep(const SweepAxes& axes, const RenderRequest& base, const SweepBudget& budget,
                 const std::function<std::string(const RenderRequest&)>& refusal);

/// Timed frames of a configuration of so many pixels.
int repeats_of(const Configuration& configuration, double pixels, const SweepBudget& budget);
/// Samples per pixel of a truth without a goal: a power of two, from the least that has a standard error on.
int truth_samples(const std::optional<texunit::Kernel>& filter, double pixels, const SweepBudget& budget);

}  // namespace rawtexel::cli
