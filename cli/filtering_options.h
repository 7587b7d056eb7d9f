// The options that say how maps are estimated, and whether before or after shading.
#pragma once

#include "cli/command_line.h"
#include "shading/filtering_options.h"
#include "texunit/kernel.h"

#include <optional>

namespace rawtexel::cli {

/// --estimator, --taps, --order, --random, --noise, --blend, --shadow-taps, --texture-jitter and --signed-numbers.
void declare_filtering_options(CommandLine& line, shading::FilteringOptions& filtering);

/// Refuses options that contradict each other: draws asked for where none are made, and an order that is none. `filter`: the kernel asked
/// for, nullopt for what the scene says. Throws UsageError.
void check_filtering(const shading::FilteringOptions& filtering, const std::optional<texunit::Kernel>& filter);

}  // namespace rawtexel::cli
