#include "cli/bench/statistics.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>

namespace rawtexel::cli {
namespace {

std::vector<Sample> usable(std::span<const Sample> points) {
    std::vector<Sample> kept;
    for (const Sample& point : points)
        if (std::isfinite(point.x) && std::isfinite(point.y) && point.x > 0 && point.y > 0) kept.push_back(point);
    const bool differ = std::ranges::any_of(kept, [&](const Sample& point) { return point.x != kept.front().x; });
    return differ ? kept : std::vector<Sample>{};
}

}  // namespace

double median(std::vector<double> values) {
    assert(!values.empty());
    std::ranges::sort(values);
    const size_t half = values.size() / 2;
    return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

double PowerFit::at(double x) const { return factor * std::pow(x, slope); }

std::optional<PowerFit> fit_power(std::span<const Sample> points) {
    const std::vector<Sample> kept = usable(points);
    if (kept.empty()) return std::nullopt;
    double mean_x = 0, mean_y = 0;
    for (const Sample& point : kept) {
        mean_x += std::log(point.x) / double(kept.size());
        mean_y += std::log(point.y) / double(kept.size());
    }
    double xx = 0, xy = 0;
    for (const Sample& point : kept) {
        xx += (std::log(point.x) - mean_x) * (std::log(point.x) - mean_x);
        xy += (std::log(point.x) - mean_x) * (std::log(point.y) - mean_y);
    }
    const double slope = xy / xx;
    return PowerFit{slope, std::exp(mean_y - slope * mean_x)};
}

std::optional<FloorFit> fit_floor(std::span<const Sample> points) {
    const std::vector<Sample> kept = usable(points);
    if (kept.empty()) return std::nullopt;
    // Relative errors: both basis functions, 1 and 1/x, divided by y, and fitted to 1.
    double ff = 0, fn = 0, nn = 0, f = 0, n = 0;
    for (const Sample& point : kept) {
        const double one = 1 / point.y, share = one / point.x;
        ff += one * one;
        fn += one * share;
        nn += share * share;
        f += one;
        n += share;
    }
    const double determinant = ff * nn - fn * fn;
    const FloorFit both{(f * nn - n * fn) / determinant, (ff * n - fn * f) / determinant};
    if (both.floor >= 0 && both.noise >= 0) return both;
    // The least squares under the bounds lie on one of them.
    return both.floor < 0 ? FloorFit{0, n / nn} : FloorFit{f / ff, 0};
}

std::vector<bool> pareto_front(std::span<const Sample> points) {
    std::vector<size_t> order;
    for (size_t i = 0; i < points.size(); ++i)
        if (std::isfinite(points[i].x) && std::isfinite(points[i].y)) order.push_back(i);
    std::ranges::sort(
        order, [&](size_t a, size_t b) { return points[a].x != points[b].x ? points[a].x < points[b].x : points[a].y < points[b].y; });
    std::vector<bool> front(points.size(), false);
    // From small x to large: on the front is what has less y than all before, and its equals.
    double least = std::numeric_limits<double>::infinity(), at = 0;
    for (const size_t i : order) {
        const bool lower = points[i].y < least;
        front[i] = lower || (points[i].y == least && points[i].x == at);
        if (lower) least = points[i].y, at = points[i].x;
    }
    return front;
}

}  // namespace rawtexel::cli
