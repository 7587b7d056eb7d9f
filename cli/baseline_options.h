// The option that renders as others do, to compare with.
#pragma once

#include "cli/command_line.h"
#include "cli/lookup_options.h"

namespace rawtexel::cli {

/// --baseline.
void declare_baseline_option(CommandLine& line, shading::FilteringOptions& filtering);

/// Refuses options that contradict the baseline: it says itself how maps are looked up and when they are shaded. Throws UsageError.
void check_baseline(const LookupOptions& lookup);

}  // namespace rawtexel::cli
