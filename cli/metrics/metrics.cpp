#include "cli/metrics/metrics.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace rawtexel::cli {
namespace {

// relMSE's guard against division by dark reference values.
constexpr double kRelativeFloor = 0.01;
constexpr size_t kLeaf = 256;  // values summed one after the other

struct ErrorSums {
    double square = 0, relative = 0, absolute = 0, max = 0;
};

ErrorSums sum_leaf(std::span<const float> test, std::span<const float> reference) {
    ErrorSums sums;
    for (size_t i = 0; i < test.size(); ++i) {
        const double r = double(reference[i]), difference = double(test[i]) - r, square = difference * difference;
        sums.square += square;
        sums.relative += square / (r * r + kRelativeFloor);
        sums.absolute += std::abs(difference);
        sums.max = std::max(sums.max, std::abs(difference));
    }
    return sums;
}

// A tree of sums: the rounding error grows with the logarithm of the number of values.
ErrorSums sum_tree(std::span<const float> test, std::span<const float> reference) {
    if (test.size() <= kLeaf) return sum_leaf(test, reference);
    const size_t half = (test.size() / 2 + kLeaf - 1) / kLeaf * kLeaf;
    const ErrorSums a = sum_tree(test.first(half), reference.first(half));
    const ErrorSums b = sum_tree(test.subspan(half), reference.subspan(half));
    return {a.square + b.square, a.relative + b.relative, a.absolute + b.absolute, std::max(a.max, b.max)};
}

bool all_finite(std::span<const float> values) {
    return std::ranges::all_of(values, [](float value) { return std::isfinite(value); });
}

}  // namespace

ImageError image_error(std::span<const float> test, std::span<const float> reference) {
    assert(test.size() == reference.size());
    if (!all_finite(test) || !all_finite(reference)) {
        const double nan = std::numeric_limits<double>::quiet_NaN();
        return {nan, nan, nan, nan, nan, nan};
    }
    const ErrorSums sums = sum_tree(test, reference);
    const double count = std::max(double(test.size()), 1.0);
    ImageError error;
    error.mse = sums.square / count;
    error.rmse = std::sqrt(error.mse);
    error.rel_mse = sums.relative / count;
    error.psnr = error.mse > 0 ? 0.0 - 10.0 * std::log10(error.mse) : std::numeric_limits<double>::infinity();
    error.max = sums.max;
    error.mean = sums.absolute / count;
    return error;
}

}  // namespace rawtexel::cli
