// What becomes of measured numbers: medians, fitted slopes and floors, fronts.
#pragma once

#include <optional>
#include <span>
#include <vector>

namespace rawtexel::cli {

/// Of at least one value; the mean of the middle two of an even number.
double median(std::vector<double> values);

struct Sample {
    double x = 0, y = 0;
};

/// y = factor * x^slope by least squares of the logarithms.
struct PowerFit {
    double slope = 0, factor = 0;
    double at(double x) const;
};
/// Over the points whose x and y are finite and above 0; nullopt where fewer than two different x are left.
std::optional<PowerFit> fit_power(std::span<const Sample> points);

/// y = floor + noise / x, neither below 0, by least squares of relative errors: what squared errors (y) of means over x samples do, the
/// floor being what samples do not lower.
struct FloorFit {
    double floor = 0, noise = 0;
};
/// Of the same points as fit_power.
std::optional<FloorFit> fit_floor(std::span<const Sample> points);

/// Whether no other point is at least as small in both coordinates and smaller in one. Points that are not finite are never on the front.
std::vector<bool> pareto_front(std::span<const Sample> points);

}  // namespace rawtexel::cli
