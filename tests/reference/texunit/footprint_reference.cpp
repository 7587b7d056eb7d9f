#include "tests/reference/texunit/footprint_reference.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace rawtexel::texunit::reference {
namespace {

struct Jacobian {
    long double sx, tx, sy, ty;
};

Jacobian jacobian(const Image& image, const Lookup& at) {
    return {(long double)(at.dudx) * image.width, (long double)(at.dvdx) * image.height, (long double)(at.dudy) * image.width,
            (long double)(at.dvdy) * image.height};
}

/// Vulkan "Wrapping Operation", without borders.
int wrap_texel(Wrap wrap, long long i, int extent) {
    const auto mod = [](long long a, long long n) { return ((a % n) + n) % n; };
    switch (wrap) {
        case Wrap::Repeat: return int(mod(i, extent));
        case Wrap::MirroredRepeat: {
            const long long fold = mod(i, 2LL * extent) - extent;
            return int(extent - 1 - (fold >= 0 ? fold : -(1 + fold)));
        }
        case Wrap::MirrorOnce: return int(std::clamp<long long>(i >= 0 ? i : -(1 + i), 0, extent - 1));
        default: return int(std::clamp<long long>(i, 0, extent - 1));
    }
}

double clamp_lambda(const SamplerState& sampler, double lambda) {
    const double biased = lambda + double(sampler.lod_bias);
    const double bounded = std::max(double(sampler.min_lod), std::min(double(sampler.max_lod), biased));
    return sampler.precision == Precision::Gpu ? std::nearbyint(bounded * 256) / 256 : bounded;
}

/// Probability of [low, high] under the normal distribution of standard deviation sigma, from the smaller tail.
double normal_probability(double low, double high, double sigma) {
    if (low + high > 0) return normal_probability(-high, -low, sigma);
    const double scale = 1 / (sigma * std::sqrt(2.0));
    return 0.5 * (std::erfc(-high * scale) - std::erfc(-low * scale));
}

// Gauss-Legendre of five points on [-1, 1] (Abramowitz and Stegun, table 25.4).
constexpr std::array<double, 5> kNodes = {-0.9061798459386640, -0.5384693101056831, 0, 0.5384693101056831, 0.9061798459386640};
constexpr std::array<double, 5> kWeights = {0.2369268850561891, 0.4786286704993665, 0.5688888888888889, 0.4786286704993665,
                                            0.2369268850561891};

}  // namespace

bool ellipse_axes(const Image& image, LodRule rule, const Lookup& at, EllipseAxes& axes) {
    const Jacobian j = jacobian(image, at);
    if (!std::isfinite(float(j.sx)) || !std::isfinite(float(j.tx)) || !std::isfinite(float(j.sy)) || !std::isfinite(float(j.ty)))
        return false;
    const long double x = std::hypot(j.sx, j.tx), y = std::hypot(j.sy, j.ty);
    if (rule == LodRule::D3d) {
        axes = {double(std::max(x, y)), double(std::min(x, y)), double(x >= y ? j.sx / x : j.sy / y), double(x >= y ? j.tx / x : j.ty / y)};
        return true;
    }
    // One-sided Jacobi: a rotation of the screen that makes the columns orthogonal leaves them along the axes.
    const long double angle = 0.5L * std::atan2(2 * (j.sx * j.sy + j.tx * j.ty), x * x - y * y);
    const long double c = std::cos(angle), s = std::sin(angle);
    const long double a1 = c * j.sx + s * j.sy, a2 = c * j.tx + s * j.ty;
    const long double major = std::hypot(a1, a2), det = std::abs(j.sx * j.ty - j.sy * j.tx);
    axes = {double(major), major > 0 ? double(det / major) : 0, major > 0 ? double(a1 / major) : 1, major > 0 ? double(a2 / major) : 0};
    return true;
}

Footprint footprint(const Image& image, const SamplerState& sampler, const Lookup& at) {
    Footprint result;
    EllipseAxes axes;
    if (!ellipse_axes(image, sampler.lod_rule, at, axes)) {
        result.lambda = std::max(double(sampler.min_lod), double(sampler.max_lod));
        return result;
    }
    const double most = sampler.probes;
    if (axes.major > 0) result.eta = axes.minor > 0 ? std::min(axes.major / axes.minor, most) : most;
    const double minor = axes.major / result.eta;
    result.lambda = clamp_lambda(sampler, axes.major > 0 ? std::log2(minor) : -1e9);
    result.real_probes = std::max(1.0, result.eta * std::min(minor, 1.0));
    const bool border = sampler.wrap_s == Wrap::ClampToBorder || sampler.wrap_t == Wrap::ClampToBorder;
    const bool one_texel = sampler.mip != MipMode::None && result.lambda >= image.levels - 1;
    result.probes = one_texel && !border ? 1 : std::max(1, int(std::ceil(result.real_probes)));
    result.axis_u = axes.s * axes.major / image.width;
    result.axis_v = axes.t * axes.major / image.height;
    return result;
}

Sample linear_sample(const Image& image, const SamplerState& sampler, double u, double v, double lod) {
    const double d = std::clamp(lod, 0.0, double(image.levels - 1));
    const int finer = sampler.mip == MipMode::None ? 0 : sampler.mip == MipMode::Nearest ? int(std::ceil(d + 0.5)) - 1 : int(std::floor(d));
    const double fraction = sampler.mip == MipMode::Linear ? d - finer : 0;
    Sample sum;
    for (const auto& [level, share] : {std::pair{finer, 1 - fraction}, {finer + 1, fraction}}) {
        if (share == 0) continue;
        const int width = std::max(1, image.width >> level), height = std::max(1, image.height >> level);
        const double x = u * width - 0.5, y = v * height - 0.5;
        for (int j = 0; j < 2; ++j) {
            for (int i = 0; i < 2; ++i) {
                const double across = x - std::floor(x), down = y - std::floor(y);
                const double weight = share * (i ? across : 1 - across) * (j ? down : 1 - down);
                if (weight == 0) continue;
                const int column = wrap_texel(sampler.wrap_s, (long long)(std::floor(x)) + i, width);
                const int row = wrap_texel(sampler.wrap_t, (long long)(std::floor(y)) + j, height);
                const Colour texel = image.texel(level, column, row);
                for (size_t c = 0; c < 4; ++c) {
                    sum.colour[c] += weight * texel[c];
                    sum.least[c] = sum.taps == 0 ? texel[c] : std::min(sum.least[c], texel[c]);
                    sum.most[c] = sum.taps == 0 ? texel[c] : std::max(sum.most[c], texel[c]);
                    sum.largest = std::max(sum.largest, std::abs(texel[c]));
                }
                ++sum.taps;
            }
        }
    }
    return sum;
}

std::vector<WeighedTexel> ellipse_weights(const Image& image, double s2, const Lookup& at) {
    const Jacobian j = jacobian(image, at);
    const double a = double(s2 * (j.sx * j.sx + j.sy * j.sy)) + 1.0 / 12, b = double(s2 * (j.sx * j.tx + j.sy * j.ty));
    const double c = double(s2 * (j.tx * j.tx + j.ty * j.ty)) + 1.0 / 12;
    // det of S2*J*J^T + I/12 without the cancellation of a*c - b*b.
    const long double det_j = j.sx * j.ty - j.sy * j.tx;
    const double det = double(s2 * s2 * det_j * det_j + (long double)(a + c - 1.0 / 6) / 12 + 1.0L / 144);
    const double x0 = double(at.u) * image.width, y0 = double(at.v) * image.height;
    const double sigma = std::sqrt(det / c), reach = 5;
    constexpr int kPanels = 4;  // of a texel's height

    std::vector<WeighedTexel> weights;
    double total = 0;
    for (auto row = (long long)(std::floor(y0 - reach * std::sqrt(c))); double(row) <= y0 + reach * std::sqrt(c); ++row) {
        for (auto column = (long long)(std::floor(x0 - reach * std::sqrt(a))); double(column) <= x0 + reach * std::sqrt(a); ++column) {
            // The texel counts when some point of its box lies within the cut: minimise d^T C^-1 d along both of its nearer edges.
            const double left = double(column) - x0, top = double(row) - y0;
            const auto form = [&](double x, double y) { return (c * x * x - 2 * b * x * y + a * y * y) / det; };
            const auto along_x = [&](double y) { return form(std::clamp(b / c * y, left, left + 1), y); };
            const auto along_y = [&](double x) { return form(x, std::clamp(b / a * x, top, top + 1)); };
            const bool holds_centre = left <= 0 && left + 1 > 0 && top <= 0 && top + 1 > 0;
            const double nearest = std::min({along_x(top), along_x(top + 1), along_y(left), along_y(left + 1)});
            if (!holds_centre && nearest > reach * reach) continue;
            double weight = 0;
            for (int panel = 0; panel < kPanels; ++panel) {
                for (size_t k = 0; k < kNodes.size(); ++k) {
                    const double y = top + (panel + (kNodes[k] + 1) / 2) / kPanels;
                    const double centre = b / c * y;
                    weight += kWeights[k] * std::exp(-y * y / (2 * c)) * normal_probability(left - centre, left + 1 - centre, sigma);
                }
            }
            weights.push_back({column, row, weight});
            total += weight;
        }
    }
    for (WeighedTexel& texel : weights) texel.weight /= total;
    return weights;
}

}  // namespace rawtexel::texunit::reference
