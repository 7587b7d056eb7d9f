// The page of a sweep: sentences, plots, pictures under a slider, every number.
#pragma once

#include "cli/bench/bench_plots.h"
#include "cli/bench/bench_report.h"
#include "shading/executor.h"

#include <nlohmann/json_fwd.hpp>

#include <span>
#include <string>
#include <vector>

namespace rawtexel::cli {

/// `bench`: that of bench_json. `plots`: of each scene. Pictures are read from `folder`; where they are too many for one page, those of the
/// fronts and those with the most samples of each series are there.
std::string bench_page(const std::string& folder, std::span<const SceneResults> scenes, std::span<const SceneAnalysis> analyses,
                       std::span<const std::vector<BenchPlot>> plots, nlohmann::ordered_json bench, const ToneOptions& tone,
                       shading::Executor& executor);

}  // namespace rawtexel::cli
