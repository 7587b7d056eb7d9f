// The plots of a sweep.
#pragma once

#include "cli/bench/series.h"
#include "cli/reports/plot.h"

#include <string>
#include <vector>

namespace rawtexel::cli {

struct BenchPlot {
    std::string kind;    ///< error-time error-samples error-fetches time-samples bias-hybrid
    std::string filter;  ///< empty: of all kernels, the minification of each that is nearest to the truth in the end
    std::string file;    ///< its place in the sweep's folder
    Plot plot;
};

/// Of every kernel error against time, samples and fetches, time against samples, and where there are finer levels bias against how much
/// finer; of several kernels error against time and fetches beside each other. Rings are the kernel's front; hollow points have an error
/// that may be the truth's own. `first`: the number of the scene's first measurement among those of all scenes, for the points' keys;
/// `word` of the scene (scene_word), for the files.
std::vector<BenchPlot> bench_plots(const SceneResults& results, const std::vector<Series>& series, const Fronts& fronts, size_t first,
                                   const std::string& word);

}  // namespace rawtexel::cli
