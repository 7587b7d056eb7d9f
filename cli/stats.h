// The numbers of a run as JSON.
#pragma once

#include "cli/run_record.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace rawtexel::cli {

/// Keys that were not counted are left out, never 0.
nlohmann::ordered_json stats_object(const RunRecord& record, const shading::Scene& scene);
/// The same as text.
std::string stats_json(const RunRecord& record, const shading::Scene& scene);

}  // namespace rawtexel::cli
