#include "tests/reference/texunit/kernel_reference.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rawtexel::texunit::reference {
namespace {

double quadratic(double x) {
    if (x < 0.5) return 0.75 - x * x;
    return x < 1.5 ? 0.5 * (1.5 - x) * (1.5 - x) : 0;
}

/// Mitchell and Netravali 1988, equation 8, as printed.
double mitchell(double b, double c, double x) {
    if (x < 1) return ((12 - 9 * b - 6 * c) * x * x * x + (-18 + 12 * b + 6 * c) * x * x + (6 - 2 * b)) / 6;
    if (x >= 2) return 0;
    return ((-b - 6 * c) * x * x * x + (6 * b + 30 * c) * x * x + (-12 * b - 48 * c) * x + (8 * b + 24 * c)) / 6;
}

double sinc(double x) { return x == 0 ? 1 : std::sin(std::numbers::pi * x) / (std::numbers::pi * x); }
double lanczos(double a, double x) {
    if (x >= a) return 0;
    // sin(pi*n) is 0; in floating point it is not.
    return x != 0 && x == std::floor(x) ? 0 : sinc(x) * sinc(x / a);
}

/// Distribution function of the normal of deviation `sigma`, cut at 4 sigma and renormalised.
double cut_normal(double sigma, double x) {
    const double t = std::clamp(x / sigma, -4.0, 4.0);
    return 0.5 + 0.5 * std::erf(t / std::numbers::sqrt2) / std::erf(4 / std::numbers::sqrt2);
}

/// Not normalised; `distance` from the coordinate to the texel's centre, signed.
double kernel_value(const Kernel& kernel, double distance, double cut_shift) {
    const double x = std::abs(distance);
    const double sigma = double(kernel.b);
    switch (kernel.kind) {
        case KernelKind::Nearest: return 0;
        case KernelKind::Bilinear: return std::max(0.0, 1 - x);
        case KernelKind::Quadratic: return quadratic(x);
        case KernelKind::BSpline: return mitchell(1, 0, x);
        case KernelKind::CatmullRom: return mitchell(0, 0.5, x);
        case KernelKind::Mitchell: return mitchell(double(kernel.b), double(kernel.c), x);
        case KernelKind::Lanczos2: return lanczos(2, x);
        case KernelKind::Lanczos3: return lanczos(3, x);
        case KernelKind::Gaussian: return cut_normal(sigma, distance + 0.5) - cut_normal(sigma, distance - 0.5);
        case KernelKind::GaussianPoint: return x <= 4 * sigma + cut_shift ? std::exp(-x * x / (2 * sigma * sigma)) : 0;
    }
    return 0;
}

}  // namespace

std::vector<KernelTap> kernel_taps(const Kernel& kernel, double x, double cut_shift) {
    const auto nearest = (long long)(std::floor(x));
    const bool gaussian = kernel.kind == KernelKind::Gaussian || kernel.kind == KernelKind::GaussianPoint;
    const int reach = gaussian ? int(4 * kernel.b) + 3 : 4;
    std::vector<KernelTap> taps;
    double sum = 0;
    for (long long n = nearest - reach; n <= nearest + reach; ++n) {
        const double weight = kernel_value(kernel, double(n) + 0.5 - x, cut_shift);
        if (weight == 0) continue;
        taps.push_back({n, weight});
        sum += weight;
    }
    if (taps.empty()) return {{nearest, 1.0}};
    for (KernelTap& tap : taps) tap.weight /= sum;
    return taps;
}

}  // namespace rawtexel::texunit::reference
