#include "cli/bench/series.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace rawtexel::cli {
namespace {

bool belongs(const Series& series, const Measurement& one) {
    return series.filter == one.filter && series.minification == one.minification && series.estimator == one.estimator &&
           series.order == one.order;
}

void fit(Series& series, const SceneResults& results) {
    std::vector<Sample> errors, squares;
    for (const size_t i : series.points) {
        const Measurement& one = results.measurements[i];
        const Truth& truth = results.truth_of(one);
        if (!is_clear(one, truth)) continue;
        errors.push_back({double(one.spp), one.error.rmse});
        // The truth's own error adds its square.
        squares.push_back({double(one.spp), one.error.mse - truth.standard_error * truth.standard_error});
    }
    series.slope = fit_power(errors);
    const size_t kept = std::min(squares.size(), kFloorPoints);
    const std::optional<FloorFit> floor = fit_floor(std::span(squares).last(kept));
    if (floor) series.bias = std::sqrt(floor->floor);
    if (series.points.size() < 2) return;
    const Measurement& last = results.measurements[series.points.back()];
    if (!is_clear(last, results.truth_of(last))) {
        // Whatever the floor is, it lies below what the truth can tell.
        series.bias.reset();
        // What is not finite is no truth.
        series.trend = std::isfinite(last.error.rmse) ? Trend::Truth : Trend::Unknown;
        return;
    }
    if (!floor || kept < kFloorPoints) return;
    const double share = floor->floor / squares.back().y;
    const double step = fit_power(std::span(errors).last(2))->slope;
    if (share >= kFloorShare && step >= kFloorStep)
        series.trend = Trend::Floor;
    else
        series.trend = share <= kFallShare || step <= kFallStep ? Trend::Falls : Trend::Flattens;
}

}  // namespace

std::string_view to_string(Trend trend) {
    switch (trend) {
        case Trend::Falls: return "falls";
        case Trend::Flattens: return "flattens";
        case Trend::Floor: return "floor";
        case Trend::Truth: return "truth";
        case Trend::Unknown: break;
    }
    return "unknown";
}

std::string Series::name(bool with_filter) const {
    const std::string rest = minification + " · " + estimator + " · " + order;
    return with_filter && !ellipse ? filter + " · " + rest : rest;
}

std::vector<Series> series_of(const SceneResults& results) {
    std::vector<Series> list;
    for (size_t i = 0; i < results.measurements.size(); ++i) {
        const Measurement& one = results.measurements[i];
        auto found = std::ranges::find_if(list, [&](const Series& series) { return belongs(series, one); });
        if (found == list.end()) {
            list.push_back({.filter = one.filter,
                            .minification = one.minification,
                            .estimator = one.estimator,
                            .order = one.order,
                            .hybrid_bias = one.hybrid_bias,
                            .one_tap = one.one_tap,
                            .ellipse = one.ellipse,
                            .points = {},
                            .slope = {},
                            .bias = {}});
            found = list.end() - 1;
        }
        found->points.push_back(i);
    }
    for (Series& series : list) fit(series, results);
    return list;
}

std::string print(const PowerFit& slope) {
    std::array<char, 32> text;
    std::snprintf(text.data(), text.size(), "%.2f", std::abs(slope.slope));
    return std::string("N^") + (slope.slope < 0 ? "−" : "") + text.data();
}

Fronts fronts_of(const SceneResults& results) {
    Fronts fronts{std::vector<bool>(results.measurements.size()), std::vector<bool>(results.measurements.size())};
    for (const Truth& truth : results.truths) {
        std::vector<size_t> held;
        std::vector<Sample> times, fetches;
        for (size_t i = 0; i < results.measurements.size(); ++i) {
            const Measurement& one = results.measurements[i];
            if (&results.truth_of(one) != &truth) continue;
            held.push_back(i);
            times.push_back({one.frame_median(), one.error.rmse});
            fetches.push_back({one.texels_per_pixel(), one.error.rmse});
        }
        const std::vector<bool> in_time = pareto_front(times), in_fetches = pareto_front(fetches);
        for (size_t k = 0; k < held.size(); ++k) fronts.time[held[k]] = in_time[k], fronts.fetches[held[k]] = in_fetches[k];
    }
    return fronts;
}

std::optional<double> fetches_at(const Series& series, const SceneResults& results, double rmse) {
    for (size_t i = 0; i < series.points.size(); ++i) {
        const Measurement& one = results.measurements[series.points[i]];
        if (!(one.error.rmse <= rmse)) continue;
        const double fetches = one.texels_per_pixel();
        if (i == 0 || one.error.rmse == rmse) return fetches;
        const Measurement& before = results.measurements[series.points[i - 1]];
        // Of an error of nothing the logarithm is none: the point itself is the first that is there.
        if (!(one.error.rmse > 0) || !std::isfinite(before.error.rmse)) return fetches;
        const double share = std::log(before.error.rmse / rmse) / std::log(before.error.rmse / one.error.rmse);
        return before.texels_per_pixel() * std::pow(fetches / before.texels_per_pixel(), share);
    }
    return std::nullopt;
}

}  // namespace rawtexel::cli
