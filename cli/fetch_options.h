// The options that say which fetches a render counts.
#pragma once

#include "cli/command_line.h"
#include "shading/fetch_options.h"

#include <optional>
#include <string_view>

namespace rawtexel::cli {

struct FetchRequest {
    bool count = false;
    std::optional<shading::FetchModel> model;  ///< unset: visible
    std::optional<texunit::CacheSpec> cache;

    bool counts() const { return count || model || cache; }
};

void declare_fetch_options(CommandLine& line, FetchRequest& fetches);

/// A SPEC as texunit::parse_cache_spec takes it; throws UsageError.
texunit::CacheSpec parse_cache(std::string_view text);

}  // namespace rawtexel::cli
