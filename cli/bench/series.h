// Configurations that differ in their samples alone, and what samples bring them.
#pragma once

#include "cli/bench/bench_run.h"
#include "cli/bench/statistics.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rawtexel::cli {

/// Falls: at most kFallShare of the last squared error does not fall with samples. Floor: at least kFloorShare of it does not. Flattens:
/// between the two. Truth: the last error is within the truth's own. Unknown: fewer than two numbers of samples.
enum class Trend { Falls, Flattens, Floor, Truth, Unknown };
std::string_view to_string(Trend trend);  // falls flattens floor truth unknown
inline constexpr double kFallShare = 0.3, kFloorShare = 0.7;

struct Series {
    std::string filter, minification, estimator, order;
    std::optional<float> hybrid_bias;
    bool one_tap = false, ellipse = false;
    std::vector<size_t> points;  ///< measurements of the scene, ascending samples
    /// Of the errors that are clear of the truth's, over samples.
    std::optional<PowerFit> slope;
    /// What is left of the error when samples are many: the root of the fitted floor of the squared errors, without that of the truth.
    std::optional<double> bias;
    Trend trend = Trend::Unknown;

    /// "bilinear · linear · reservoir · after", or without the kernel.
    std::string name(bool with_filter = true) const;
};
std::vector<Series> series_of(const SceneResults& results);

/// On which front each measurement of a scene is: error against the median time, and against texel reads a pixel.
struct Fronts {
    std::vector<bool> time, fetches;
};
Fronts fronts_of(const SceneResults& results);

/// Texel reads a pixel at which a series reaches an error: between its points by the straight line of both logarithms. nullopt where it
/// does not.
std::optional<double> fetches_at(const Series& series, const SceneResults& results, double rmse);

}  // namespace rawtexel::cli
