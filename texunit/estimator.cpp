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

bool is_bspline(const Kernel& kernel) { return kernel.kind == KernelKind::BSpline || kernel == Kernel::mitchell(1.0f, 0.0f); }

}  // namespace

std::span<const EstimatorInfo> all_estimators() { return kEstimators; }

std::string_view to_string(Estimator estimator) { return kEstimators[size_t(estimator)].name; }

std::optional<Estimator> parse_estimator(std::string_view text) {
    const auto found = std::ranges::find(kEstimators, text, &EstimatorInfo::name);
    if (found == std::end(kEstimators)) return std::nullopt;
    return found->estimator;
}

bool weighs_as_probability(const Kernel& kernel) {
    switch (kernel.kind) {
        case KernelKind::Mitchell: return is_bspline(kernel);
        case KernelKind::CatmullRom:
        case KernelKind::Lanczos2:
        case KernelKind::Lanczos3: return false;
        default: return true;
    }
}

std::string_view refusal(Estimator estimator, const Kernel& kernel) {
    if (estimator != Estimator::Jitter) return {};
    if (!weighs_as_probability(kernel)) return "its negative lobes are no density of offsets; reservoir draws it";
    if (kernel.kind == KernelKind::GaussianPoint)
        return "it is no density convolved with the texel's box; gaussian is, and reservoir draws both";
    return {};
}

}  // namespace rawtexel::texunit
