// The numbers of a sweep: bench.json and bench.csv.
#pragma once

#include "cli/bench/findings.h"

#include <nlohmann/json_fwd.hpp>

#include <span>
#include <string>

namespace rawtexel::cli {

/// What is said of a scene's results beyond them.
struct SceneAnalysis {
    std::vector<Series> series;
    Fronts fronts;
    std::vector<Finding> findings;
};
SceneAnalysis analyse(const SceneResults& results);

/// `analyses`: of each of `scenes`. The same command gives the same but for times and what follows from them.
nlohmann::ordered_json bench_json(std::span<const SceneResults> scenes, std::span<const SceneAnalysis> analyses,
                                  const std::string& command);

/// RFC 4180: a line for each configuration, its numbers spelled as in the JSON.
std::string bench_csv(const nlohmann::ordered_json& bench);

}  // namespace rawtexel::cli
