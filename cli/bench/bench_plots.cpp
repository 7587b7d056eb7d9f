#include "cli/bench/bench_plots.h"

#include "cli/bench/file_names.h"
#include "cli/comparison_report.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rawtexel::cli {
namespace {

constexpr const char* kErrorLabel = "RMSE (linear radiance)";
constexpr const char* kTimeLabel = "time of a frame, median (ms)";
constexpr const char* kSamplesLabel = "samples per pixel";
constexpr const char* kFetchesLabel = "texel reads per pixel";

/// Warm colours filter before shading, cold ones after.
int color_of(const Series& series) {
    const bool before = series.order == "before";
    if (series.estimator == "all") return before ? 1 : 0;
    if (series.estimator == "reservoir") return before ? 3 : 2;
    if (series.estimator == "jitter") return before ? 5 : 6;
    return 4;
}

std::string note_of(const Measurement& one) {
    const double ms = one.frame_median() * 1e3;
    return one.filter + ", " + one.minification + ", " + one.estimator + ", " + one.order + ", " + std::to_string(one.spp) +
           (one.spp == 1 ? " sample" : " samples") + ": RMSE " +
           (std::isfinite(one.error.rmse) ? print_figure(one.error.rmse) : "no number") + ", " + print_figure(ms) + " ms, " +
           print_figure(one.texels_per_pixel()) + " texels a pixel";
}

class Plotter {
  public:
    Plotter(const SceneResults& results, const std::vector<Series>& series, const Fronts& fronts, size_t first, std::string word)
        : results_(results), series_(series), fronts_(fronts), first_(first), word_(std::move(word)) {}

    std::vector<BenchPlot> all() {
        std::vector<std::string> filters;
        for (const Series& one : series_)
            if (std::ranges::find(filters, one.filter) == filters.end()) filters.push_back(one.filter);
        for (const std::string& filter : filters) {
            const std::vector<const Series*> shown = of_kernel(filter);
            const std::string about = results_.scene + ", " + filter + ": ";
            add("error-samples", filter, errors(about + "error against samples", {kSamplesLabel, true}, shown, samples, nullptr, true));
            add("error-time", filter, errors(about + "error against time", {kTimeLabel, true}, shown, milliseconds, &fronts_.time));
            add("error-fetches", filter, errors(about + "error against fetches", {kFetchesLabel, true}, shown, fetches, &fronts_.fetches));
            add("time-samples", filter, times(about + "time against samples", shown));
            Plot bias = biases(about + "bias against finer levels", filter);
            if (!bias.series.empty()) add("bias-hybrid", filter, std::move(bias));
        }
        if (filters.size() > 1) {
            const std::vector<const Series*> best = nearest_of_each();
            const std::string about = results_.scene + ", every kernel against its own truth: ";
            add("error-time", "", errors(about + "error against time", {kTimeLabel, true}, best, milliseconds, &fronts_.time));
            add("error-fetches", "", errors(about + "error against fetches", {kFetchesLabel, true}, best, fetches, &fronts_.fetches));
        }
        return std::move(plots_);
    }

  private:
    using Measure = double (*)(const Measurement&);
    static double samples(const Measurement& one) { return one.spp; }
    static double milliseconds(const Measurement& one) { return one.frame_median() * 1e3; }
    static double fetches(const Measurement& one) { return one.texels_per_pixel(); }

    void add(const char* kind, const std::string& filter, Plot plot) {
        const std::string file = "plots/" + word_ + "_" + (filter.empty() ? "kernels" : file_word(filter)) + "_" + kind + ".svg";
        plots_.push_back({kind, filter, file, std::move(plot)});
    }

    const Measurement& at(size_t point) const { return results_.measurements[point]; }

    /// Finer levels have a plot of their own, unless there is nothing else.
    std::vector<const Series*> of_kernel(const std::string& filter) const {
        std::vector<const Series*> plain, all;
        for (const Series& one : series_) {
            if (one.filter != filter) continue;
            all.push_back(&one);
            if (!one.hybrid_bias) plain.push_back(&one);
        }
        return plain.empty() ? all : plain;
    }

    std::vector<const Series*> nearest_of_each() const {
        std::vector<const Series*> best;
        for (const Series& one : series_) {
            if (one.hybrid_bias) continue;
            const double error = at(one.points.back()).error.rmse;
            const auto same = std::ranges::find_if(best, [&](const Series* other) {
                return other->filter == one.filter && other->estimator == one.estimator && other->order == one.order;
            });
            if (same == best.end())
                best.push_back(&one);
            else if (error < at((*same)->points.back()).error.rmse)
                *same = &one;
        }
        return best;
    }

    /// The same dash for the same minification, or in plots of all kernels for the same kernel.
    int dash_of(const Series& series, const std::vector<const Series*>& shown) const {
        const bool kernels = std::ranges::any_of(shown, [&](const Series* one) { return one->filter != shown.front()->filter; });
        const auto key = [&](const Series& one) { return kernels ? one.filter : one.minification; };
        std::vector<std::string> keys;
        for (const Series* one : shown)
            if (std::ranges::find(keys, key(*one)) == keys.end()) keys.push_back(key(*one));
        return int(std::ranges::find(keys, key(series)) - keys.begin());
    }

    PlotSeries curve(const Series& one, const std::vector<const Series*>& shown, Measure x, Measure y,
                     const std::vector<bool>* front) const {
        const bool kernels = std::ranges::any_of(shown, [&](const Series* other) { return other->filter != shown.front()->filter; });
        PlotSeries curve{.name = one.name(kernels), .points = {}, .markers = true, .color = color_of(one), .dash = dash_of(one, shown)};
        for (const size_t i : one.points) {
            const Measurement& point = at(i);
            curve.points.push_back(
                {x(point), y(point), front && (*front)[i], !is_clear(point, results_.truth_of(point)), note_of(point), int(first_ + i)});
        }
        return curve;
    }

    static double rmse(const Measurement& one) { return one.error.rmse; }

    Plot errors(const std::string& title, const PlotAxis& x, const std::vector<const Series*>& shown, Measure measure,
                const std::vector<bool>* front, bool slopes = false) const {
        Plot plot{.title = title, .x = x, .y = {kErrorLabel, true}, .series = {}};
        double least = std::numeric_limits<double>::infinity(), most = 0;
        for (const Series* one : shown) {
            plot.series.push_back(curve(*one, shown, measure, rmse, front));
            for (const PlotPoint& point : plot.series.back().points) {
                least = std::min(least, point.x);
                most = std::max(most, point.x);
            }
            if (!slopes || !one->slope) continue;
            plot.series.back().name += "  " + print(*one->slope);
            PlotSeries fitted{.name = "", .points = {}, .thin = true, .color = plot.series.back().color};
            for (const size_t i : {one->points.front(), one->points.back()})
                fitted.points.push_back({.x = double(at(i).spp), .y = one->slope->at(at(i).spp)});
            plot.series.push_back(std::move(fitted));
        }
        // Errors below are the truth's own, or may be.
        const bool one_truth = std::ranges::all_of(shown, [&](const Series* one) { return one->filter == shown.front()->filter; });
        const double limit = kClearMultiple * results_.truth_of(at(shown.front()->points.front())).standard_error;
        if (one_truth && limit > 0 && least < most)
            plot.series.push_back({.name = "3 × the truth's standard error",
                                   .points = {{.x = least, .y = limit}, {.x = most, .y = limit}},
                                   .color = kGrey,
                                   .dash = 2});
        return plot;
    }

    Plot times(const std::string& title, const std::vector<const Series*>& shown) const {
        Plot plot{.title = title, .x = {kSamplesLabel, true}, .y = {kTimeLabel, true}, .series = {}};
        for (const Series* one : shown) plot.series.push_back(curve(*one, shown, samples, milliseconds, nullptr));
        return plot;
    }

    /// Of the levels themselves (no bias, 0) and those that are finer, each with what samples do not lower.
    Plot biases(const std::string& title, const std::string& filter) const {
        Plot plot{.title = title,
                  .x = {"how much finer the levels read are, --hybrid-bias (levels)", false},
                  .y = {"bias: RMSE that samples do not lower", false},
                  .series = {}};
        for (const Series& one : series_) {
            if (one.filter != filter || !one.hybrid_bias || !one.bias) continue;
            const std::string levels = one.minification.substr(0, one.minification.rfind(", hybrid"));
            const std::string name = levels + " · " + one.estimator + " · " + one.order;
            auto found = std::ranges::find(plot.series, name, &PlotSeries::name);
            if (found == plot.series.end()) {
                plot.series.push_back({.name = name, .points = {}, .markers = true, .color = color_of(one)});
                found = plot.series.end() - 1;
                for (const Series& plain : series_)
                    if (plain.filter == filter && plain.minification == levels && plain.estimator == one.estimator &&
                        plain.order == one.order && plain.bias)
                        found->points.push_back(bias_point(0, plain));
            }
            found->points.push_back(bias_point(double(*one.hybrid_bias), one));
        }
        for (PlotSeries& series : plot.series) std::ranges::sort(series.points, {}, &PlotPoint::x);
        return plot;
    }
    PlotPoint bias_point(double levels, const Series& series) const {
        return {.x = levels,
                .y = *series.bias,
                .note = series.name() + ": bias " + print_figure(*series.bias),
                .key = int(first_ + series.points.back())};
    }

    const SceneResults& results_;
    const std::vector<Series>& series_;
    const Fronts& fronts_;
    size_t first_;
    std::string word_;
    std::vector<BenchPlot> plots_;
};

}  // namespace

std::vector<BenchPlot> bench_plots(const SceneResults& results, const std::vector<Series>& series, const Fronts& fronts, size_t first,
                                   const std::string& word) {
    if (results.measurements.empty()) return {};
    return Plotter(results, series, fronts, first, word).all();
}

}  // namespace rawtexel::cli
