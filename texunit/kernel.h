// Reconstruction kernels: one definition each, from which the deterministic weights and every stochastic form follow.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace rawtexel::texunit {

enum class KernelKind : uint8_t {
    Nearest,
    Bilinear,
    Quadratic,   ///< uniform quadratic B-spline
    BSpline,     ///< uniform cubic B-spline
    Mitchell,    ///< Mitchell and Netravali 1988, |B| and |C| up to 10
    CatmullRom,  ///< Mitchell with B = 0, C = 1/2
    Lanczos2,
    Lanczos3,       ///< both normalised along each axis
    Gaussian,       ///< the normal distribution cut at 4 sigma, convolved with the texel's box
    GaussianPoint,  ///< the normal density at texel centres within 4 sigma, normalised along each axis
};

/// A kernel with its parameters. Separable: a tap's weight is the product of its weights along the axes, and those of an axis sum to 1.
struct Kernel {
    KernelKind kind = KernelKind::Bilinear;
    float b = 0.0f, c = 0.0f;  ///< Mitchell: B and C. Gaussians: b = sigma in texels, kLeastSigma..kMostSigma. Else 0

    bool operator==(const Kernel&) const = default;

    static const Kernel Nearest, Bilinear, Quadratic, BSpline, CatmullRom, Lanczos2, Lanczos3;
    static constexpr Kernel mitchell(float b = 1.0f / 3.0f, float c = 1.0f / 3.0f) { return {KernelKind::Mitchell, b, c}; }
    static constexpr Kernel gaussian(float sigma = 0.5f) { return {KernelKind::Gaussian, sigma, 0.0f}; }
    static constexpr Kernel gaussian_point(float sigma = 0.5f) { return {KernelKind::GaussianPoint, sigma, 0.0f}; }
};

inline constexpr Kernel Kernel::Nearest{KernelKind::Nearest};
inline constexpr Kernel Kernel::Bilinear{KernelKind::Bilinear};
inline constexpr Kernel Kernel::Quadratic{KernelKind::Quadratic};
inline constexpr Kernel Kernel::BSpline{KernelKind::BSpline};
inline constexpr Kernel Kernel::CatmullRom{KernelKind::CatmullRom};
inline constexpr Kernel Kernel::Lanczos2{KernelKind::Lanczos2};
inline constexpr Kernel Kernel::Lanczos3{KernelKind::Lanczos3};

inline constexpr float kLeastSigma = 0.02f, kMostSigma = 16.0f;  ///< texels
/// Largest |B| and |C|: beyond, the weights of a filter that should average are in the hundreds.
inline constexpr float kMostMitchell = 10.0f;
inline constexpr int kMostAxisTaps = 130;  ///< of the widest kernel: 8 sigma + 2

/// Most taps along one axis: 1, 2, 3, 4, 4, 4, 4, 6; for Gaussians by sigma.
int axis_taps(const Kernel& kernel);

struct KernelInfo {
    KernelKind kind;
    std::string_view name;         ///< without parameters
    std::string_view parameters;   ///< what may follow a colon, such as "B,C"; empty for none
    std::string_view description;  ///< one line for people
};
std::span<const KernelInfo> all_kernels();

/// nearest bilinear quadratic bspline mitchell[:B,C] catmull-rom lanczos2 lanczos3 gaussian[:SIGMA] gaussian-point[:SIGMA].
std::string to_string(const Kernel& kernel);
/// Empty for an unknown name or a parameter that is malformed or out of range.
std::optional<Kernel> parse_kernel(std::string_view text);

}  // namespace rawtexel::texunit
