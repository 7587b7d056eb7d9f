// The options that say how maps are estimated, and whether before or after shading.
#pragma once

#include "cli/command_line.h"
#include "shading/filtering_options.h"
#include "texunit/kernel.h"

#include <optional>
#include <string>

namespace rawtexel::cli {

/// --estimator, --taps, --order, --random, --noise, --blend, --shadow-taps, --texture-jitter and --signed-numbers.
void declare_filtering_options(CommandLine& line, shading::FilteringOptions& filtering);

// What single ones take, for commands that declare them otherwise. Throw UsageError.
texunit::Estimator read_estimator(const std::string& text);
texunit::Noise read_noise(const std::string& text);
int read_taps(const std::string& text);
bool read_common_numbers(const std::string& text);

/// Refuses options that contradict each other: draws asked for where none are made, and an order that is none. `filter`: the kernel asked
/// for, nullopt for what the scene says. Throws UsageError.
void check_filtering(const shading::FilteringOptions& filtering, const std::optional<texunit::Kernel>& filter);

}  // namespace rawtexel::cli
