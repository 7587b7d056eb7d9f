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

/// Whether Mitchell's cubic of these parameters is nowhere negative.
bool is_nonnegative_cubic(double b, double c);

/// Whether all weights of the kernel are probabilities. Others need two draws, one for either sign.
inline bool weighs_as_probability(const Kernel& kernel) {
    switch (kernel.kind) {
        case KernelKind::Mitchell: return is_nonnegative_cubic(double(kernel.b), double(kernel.c));
        case KernelKind::CatmullRom:
        case KernelKind::Lanczos2:
        case KernelKind::Lanczos3: return false;
        default: return true;
    }
}

/// Why the estimator cannot draw the kernel, as a clause for people; empty where it can. Only `jitter` refuses: it reaches the kernels k
/// that are a probability density q convolved with the texel's box: nearest, bilinear, quadratic, bspline, gaussian, and those mitchell:B,C
/// with C <= 0 <= B + 2*C and 3*B + 2*C <= 6. For k'(x) = q(x + 1/2) - q(x - 1/2) leaves one q, the sum of k'(x - 1/2 - j) over j >= 0.
/// Of Mitchell's cubics it is s*((B/2 + 3*C)*s - 2*C) at s = 3/2 - |x| where |x| > 1/2, and B/2 + C + (6 - 5*B - 6*C)*(1/4 - x^2) within:
/// nonnegative exactly where they are at s -> 0, at |x| = 1/2 and at x = 0. Besides bspline (1,0) that takes in Hermite's smooth steps
/// (0,0). gaussian-point ends in steps at 4 sigma, whose offsets have no density.
std::string_view refusal(Estimator estimator, const Kernel& kernel);

}  // namespace rawtexel::texunit
