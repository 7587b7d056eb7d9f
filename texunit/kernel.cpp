#include "texunit/kernel.h"

#include <array>
#include <charconv>
#include <cmath>

namespace rawtexel::texunit {
namespace {

constexpr std::array kKernels = {
    KernelInfo{KernelKind::Nearest, "nearest", "", "the one texel that the coordinate lies in"},
    KernelInfo{KernelKind::Bilinear, "bilinear", "", "2 texels an axis, weighed by a tent that reaches one texel to either side"},
    KernelInfo{KernelKind::Quadratic, "quadratic", "", "3 texels an axis: the uniform quadratic B-spline"},
    KernelInfo{KernelKind::BSpline, "bspline", "", "4 texels an axis: the uniform cubic B-spline, the smoothest of them"},
    KernelInfo{KernelKind::Mitchell, "mitchell", "B,C", "4 texels an axis: the cubic of Mitchell and Netravali, B = C = 1/3 by default"},
    KernelInfo{KernelKind::CatmullRom, "catmull-rom", "", "4 texels an axis: the cubic that goes through the texels, mitchell:0,0.5"},
    KernelInfo{KernelKind::Lanczos2, "lanczos2", "", "4 texels an axis: a sinc windowed by a wider one, normalised along each axis"},
    KernelInfo{KernelKind::Lanczos3, "lanczos3", "", "6 texels an axis: the same with one lobe more"},
    KernelInfo{KernelKind::Gaussian, "gaussian", "SIGMA",
               "the normal distribution cut at 4 sigma and integrated over each texel, SIGMA = 0.5 texels by default"},
    KernelInfo{KernelKind::GaussianPoint, "gaussian-point", "SIGMA",
               "the normal density at the centres of the texels within 4 sigma, normalised along each axis, SIGMA = 0.5 by default"}};

constexpr bool kernels_are_in_order() {
    for (size_t i = 0; i < kKernels.size(); ++i) {
        if (size_t(kKernels[i].kind) != i) return false;
    }
    return kKernels.size() == size_t(KernelKind::GaussianPoint) + 1;
}
static_assert(kernels_are_in_order());

bool is_gaussian(KernelKind kind) { return kind == KernelKind::Gaussian || kind == KernelKind::GaussianPoint; }

Kernel with_default_parameters(KernelKind kind) {
    if (kind == KernelKind::Mitchell) return Kernel::mitchell();
    if (kind == KernelKind::Gaussian) return Kernel::gaussian();
    if (kind == KernelKind::GaussianPoint) return Kernel::gaussian_point();
    return {kind};
}

/// The shortest decimal that reads back as `value`.
std::string print(float value) {
    std::array<char, 32> text;
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value);
    return {text.data(), end.ptr};
}

/// Reads the whole of `text` as a number with |number| <= `most`.
std::optional<float> parse_number(std::string_view text, float most) {
    float value;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !(std::fabs(value) <= most)) return std::nullopt;
    return value;
}

std::optional<Kernel> parse_parameters(Kernel kernel, std::string_view text) {
    if (is_gaussian(kernel.kind)) {
        const auto sigma = parse_number(text, kMostSigma);
        if (!sigma || *sigma < kLeastSigma) return std::nullopt;
        kernel.b = *sigma;
        return kernel;
    }
    const size_t comma = text.find(',');
    if (kernel.kind != KernelKind::Mitchell || comma == std::string_view::npos) return std::nullopt;
    const auto b = parse_number(text.substr(0, comma), kMostMitchell), c = parse_number(text.substr(comma + 1), kMostMitchell);
    if (!b || !c) return std::nullopt;
    return Kernel::mitchell(*b, *c);
}

}  // namespace

int axis_taps(const Kernel& kernel) {
    switch (kernel.kind) {
        case KernelKind::Nearest: return 1;
        case KernelKind::Bilinear: return 2;
        case KernelKind::Quadratic: return 3;
        case KernelKind::BSpline:
        case KernelKind::Mitchell:
        case KernelKind::CatmullRom:
        case KernelKind::Lanczos2: return 4;
        case KernelKind::Lanczos3: return 6;
        // Texels whose box meets an interval of 8 sigma, or whose centre lies in it.
        case KernelKind::Gaussian: return int(std::ceil(8.0f * kernel.b)) + 1;
        case KernelKind::GaussianPoint: return int(std::floor(8.0f * kernel.b)) + 1;
    }
    return 1;
}

std::span<const KernelInfo> all_kernels() { return kKernels; }

std::string to_string(const Kernel& kernel) {
    std::string text(kKernels[size_t(kernel.kind)].name);
    if (kernel == with_default_parameters(kernel.kind)) return text;
    text += ':' + print(kernel.b);
    if (kernel.kind == KernelKind::Mitchell) text += ',' + print(kernel.c);
    return text;
}

std::optional<Kernel> parse_kernel(std::string_view text) {
    const size_t colon = text.find(':');
    for (const KernelInfo& known : kKernels) {
        if (known.name != text.substr(0, colon)) continue;
        const Kernel kernel = with_default_parameters(known.kind);
        if (colon == std::string_view::npos) return kernel;
        return parse_parameters(kernel, text.substr(colon + 1));
    }
    return std::nullopt;
}

}  // namespace rawtexel::texunit
