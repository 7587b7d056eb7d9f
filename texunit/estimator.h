// Estimators: how a lookup turns its weighted taps into a value. Orthogonal to the kernel, which says what the weights are.
#pragma once

#include "texunit/kernel.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace rawtexel::texunit {

enum class Estimator : uint8_t {
    All,        ///< the weighted sum of every tap
    Reservoir,  ///< one tap drawn from the discrete weights, axis by axis; two where a kernel has negative lobes (positivization)
    Jitter,     ///< the coordinate moved by a continuous offset, then the nearest texel
    AbsWeight,  ///< one tap drawn by the magnitude of its weight and given its sign: for comparison, since a constant gets variance
};

struct EstimatorInfo {
    Estimator estimator;
    std::string_view name;
    std::string_view description;  ///< one line for people
};
std::span<const EstimatorInfo> all_estimators();

std::string_view to_string(Estimator estimator);  // all reservoir jitter abs-weight
std::optional<Estimator> parse_estimator(std::string_view text);

/// Whether all weights of the kernel are probabilities. Others need two draws, one for either sign.
bool weighs_as_probability(const Kernel& kernel);

/// Why the estimator cannot draw the kernel, as a clause for people; empty where it can. Only `jitter` refuses: it reaches the kernels that
/// are a probability density convolved with the texel's box, and knows the inverse distribution of nearest, bilinear, quadratic, bspline
/// and gaussian.
std::string_view refusal(Estimator estimator, const Kernel& kernel);

}  // namespace rawtexel::texunit
