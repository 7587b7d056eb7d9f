// What the textures of a run were asked for and what was done for it, as JSON.
#pragma once

#include "cli/run_record.h"

#include <nlohmann/json_fwd.hpp>

namespace rawtexel::cli {

/// The objects `fetches`, `texture` and `textures` of the statistics: what was counted, sums, and the distinct textures with their levels.
/// Added to `json`.
void add_texture_stats(const RunRecord& record, const shading::Scene& scene, nlohmann::ordered_json& json);

}  // namespace rawtexel::cli
