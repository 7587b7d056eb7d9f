// Configurations that differ in their samples alone, and what samples bring them.
#pragma once

#include "cli/bench/bench_run.h"
#include "cli/bench/statistics.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rawtexel::cli {

/// What the error does in the end, by the share of the last squared error that is the fitted floor, and by the last step, the slope of
/// the logarithms between the last two errors. Floor: share and step are at least the first two constants. Falls: they are at most the
/// others, the one or the other. Flattens: between. Truth: the last error is within the truth's own. Unknown: fewer than
/// kFloorPoints errors that are clear of it.
enum class Trend { Falls, Flattens, Floor, Truth, Unknown };
std::string_view to_string(Trend trend);  // falls flattens floor truth unknown
inline constexpr double kFloorShare = 0.7, kFloorStep = -0.2, kFallShare = 0.3, kFallStep = -0.35;
/// The floor is fitted to the last of the errors: rare bright samples, which few samples miss, make the first ones no guide.
inline constexpr size_t kFloorPoints = 3;

struct Series {
    std::string filter, minification, estimator, order;
    std::optional<float> hybrid_bias;
    bool one_tap = false, ellipse = false;
    std::vector<size_t> points;  ///< measurements of the scene, ascending samples
    /// Of the errors that are clear of the truth's, over samples.
    std::optional<PowerFit> slope;
    /// What is left of the error when samples are many: the root of the fitted floor of the squared errors, without that of the truth.
    /// Unset where the last error is within the truth's.
    std::optional<double> bias;
    Trend trend = Trend::Unknown;

    /// "bilinear · mip linear · reservoir · after", or without the kernel.
    std::string name(bool with_filter = true) const;
};
std::vector<Series> series_of(const SceneResults& results);

/// "N^−0.52", N being the samples.
std::string print(const PowerFit& slope);

/// On which front each measurement is among those held against the same truth, its kernel's: error against the median time, and against
/// texel reads a pixel.
struct Fronts {
    std::vector<bool> time, fetches;
};
Fronts fronts_of(const SceneResults& results);

/// Texel reads a pixel at which a series reaches an error: between its points by the straight line of both logarithms. nullopt where it
/// does not.
std::optional<double> fetches_at(const Series& series, const SceneResults& results, double rmse);

}  // namespace rawtexel::cli
