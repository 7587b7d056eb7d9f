#include "texunit/estimator.h"

#include <algorithm>

namespace rawtexel::texunit {
namespace {

constexpr EstimatorInfo kEstimators[] = {
    {Estimator::All, "all", "every tap, weighed"},
    {Estimator::Reservoir, "reservoir", "one tap drawn from the weights, two where a kernel has negative lobes"},
    {Estimator::Jitter, "jitter", "the coordinate moved at random, then the nearest texel"},
    {Estimator::AbsWeight, "abs-weight", "one tap drawn by the magnitude of its weight: for comparison, noisy even on a constant"},
};

/// Whether Mitchell's kernel is a density convolved with the texel's box: its offsets' density is nonnegative where it is least.
bool is_box_convolved(double b, double c) { return c <= 0 && b + 2 * c >= 0 && 3 * b + 2 * c <= 6; }

}  // namespace

std::span<const EstimatorInfo> all_estimators() { return kEstimators; }

std::string_view to_string(Estimator estimator) { return kEstimators[size_t(estimator)].name; }

std::optional<Estimator> parse_estimator(std::string_view text) {
    const auto found = std::ranges::find(kEstimators, text, &EstimatorInfo::name);
    if (found == std::end(kEstimators)) return std::nullopt;
    return found->estimator;
}

// Between 1 and 2 it is s^2*((B/6 + C)*s - C), s = 2 - |x|; within 1 a cubic in |x| whose
// least value lies at an end or where its derivative is 0.
bool is_nonnegative_cubic(double b, double c) {
    if (c > 0 || b < 0 || b > 3) return false;
    const double square = 2 * b + c - 3, cube = 2 - 1.5 * b - c;
    const double lowest = -2 * square / (3 * cube);
    if (!(lowest > 0 && lowest < 1)) return true;
    return 1 - b / 3 + square * lowest * lowest / 3 >= 0;
}

std::string_view refusal(Estimator estimator, const Kernel& kernel) {
    if (estimator != Estimator::Jitter) return {};
    if (!weighs_as_probability(kernel)) return "its negative lobes are no density of offsets; reservoir draws it";
    const bool is_cubic = kernel.kind == KernelKind::Mitchell;
    if (kernel.kind == KernelKind::GaussianPoint || (is_cubic && !is_box_convolved(double(kernel.b), double(kernel.c))))
        return "it is no density convolved with the texel's box; gaussian is, and reservoir draws both";
    return {};
}

}  // namespace rawtexel::texunit
