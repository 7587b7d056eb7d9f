// The page of a profile: pictures and heat maps under a slider, every number, histograms, residency.
#pragma once

#include "cli/profile_run.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace rawtexel::cli {

/// `profile`: that of profile_json. Pictures are encoded by the executor's threads.
std::string profile_page(const ProfileRuns& runs, nlohmann::ordered_json profile, shading::Executor& executor);

/// Codes of an image as `render` writes it to 8-bit formats, for the tone options of `request`.
std::vector<uint8_t> display_codes(const shading::Image& radiance, const ToneOptions& tone);

}  // namespace rawtexel::cli
