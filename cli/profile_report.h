// The numbers of a profile: profile.json and textures.csv.
#pragma once

#include "cli/profile_run.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace rawtexel::cli {

/// The statistics of `render --stats` of the profile's own frame, and beside them `histograms`, `models` (the sums of every fetch model)
/// and `compare_with` (the numbers of every other setting). The same command gives the same but for times; so peak_rss is left out.
nlohmann::ordered_json profile_json(const ProfileRuns& runs);

/// RFC 4180: a line for each level of each texture, one for all levels of each (level "all"), and one for all textures.
std::string textures_csv(const nlohmann::ordered_json& profile);

}  // namespace rawtexel::cli
