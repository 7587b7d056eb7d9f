#include "texunit/kernel_value.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rawtexel::texunit {
namespace {

/// Mitchell and Netravali 1988, equation 8, at distance `x`.
double mitchell(double b, double c, double x) {
    if (x >= 2) return 0;
    if (x >= 1) return ((-b - 6 * c) * x * x * x + (6 * b + 30 * c) * x * x - (12 * b + 48 * c) * x + 8 * b + 24 * c) / 6;
    return ((12 - 9 * b - 6 * c) * x * x * x + (12 * b + 6 * c - 18) * x * x + 6 - 2 * b) / 6;
}

double quadratic(double x) {
    if (x >= 1.5) return 0;
    return x < 0.5 ? 0.75 - x * x : 0.5 * (1.5 - x) * (1.5 - x);
}

double lanczos(double lobes, double x) {
    if (x == 0) return 1;
    if (x >= lobes || x == std::floor(x)) return 0;
    const double angle = std::numbers::pi * x;
    return std::sin(angle) * std::sin(angle / lobes) * lobes / (angle * angle);
}

/// Mass of the normal distribution below `x` deviations, cut at 4 of them.
double cut_normal(double x) {
    return 0.5 + 0.5 * std::erf(std::clamp(x, -4.0, 4.0) / std::numbers::sqrt2) / std::erf(4 / std::numbers::sqrt2);
}

/// The kernel at a texel whose centre lies `offset` after the coordinate, not normalised.
double kernel_value(const Kernel& kernel, double offset) {
    const double x = std::abs(offset), b = double(kernel.b), c = double(kernel.c);
    switch (kernel.kind) {
        case KernelKind::Nearest: return offset > -0.5 && offset <= 0.5 ? 1 : 0;
        case KernelKind::Bilinear: return std::max(1 - x, 0.0);
        case KernelKind::Quadratic: return quadratic(x);
        case KernelKind::BSpline: return mitchell(1, 0, x);
        case KernelKind::Mitchell: return mitchell(b, c, x);
        case KernelKind::CatmullRom: return mitchell(0, 0.5, x);
        case KernelKind::Lanczos2: return lanczos(2, x);
        case KernelKind::Lanczos3: return lanczos(3, x);
        case KernelKind::Gaussian: return cut_normal((offset + 0.5) / b) - cut_normal((offset - 0.5) / b);
        case KernelKind::GaussianPoint: return x <= 4 * b ? std::exp(-0.5 * x * x / (b * b)) : 0;
    }
    return 0;
}

}  // namespace

std::vector<WeightedTexel> axis_weights(const Kernel& kernel, double x) {
    const auto nearest = int64_t(std::floor(x));
    const int reach = axis_taps(kernel) / 2 + 1;
    std::vector<WeightedTexel> taps;
    double sum = 0;
    for (int64_t texel = nearest - reach; texel <= nearest + reach; ++texel) {
        const double weight = kernel_value(kernel, double(texel) + 0.5 - x);
        if (weight == 0) continue;
        taps.push_back({texel, weight});
        sum += weight;
    }
    // Narrow point-sampled Gaussians may reach no texel; the nearest one always counts.
    if (taps.empty()) return {{nearest, 1.0}};
    for (WeightedTexel& tap : taps) tap.weight /= sum;
    return taps;
}

}  // namespace rawtexel::texunit
