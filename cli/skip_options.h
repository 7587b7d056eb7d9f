// The options that say which work a frame leaves out because it changes nothing.
#pragma once

#include "cli/command_line.h"
#include "shading/skips.h"

#include <string_view>

namespace rawtexel::cli {

struct SkipRequest {
    shading::Skips skips;
    std::string_view option;  ///< that chose; empty: none did
};

void declare_skip_options(CommandLine& line, SkipRequest& request);

/// `text`: names of shading::kSkips with commas between, or "all". Those named are on and no others, or off and no others.
/// Throws UsageError on unknown and repeated names.
shading::Skips parse_skips(std::string_view option, std::string_view text, bool on);

}  // namespace rawtexel::cli
