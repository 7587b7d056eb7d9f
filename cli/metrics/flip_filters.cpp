#include "cli/metrics/flip_filters.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <numbers>

namespace rawtexel::cli {
namespace {

// The LDR paper, section 4.1.1: contrast sensitivity in the frequency domain as a sum of a Gaussian or two; amplitude and width of each.
constexpr double kWidthY = 0.0047, kWidthCx = 0.0053;
constexpr double kAmplitudeCz[2] = {34.1, 13.5}, kWidthCz[2] = {0.04, 0.025};
// Section 4.2: the features that the eye looks for are this wide, degrees.
constexpr double kFeatureWidth = 0.082;

FlipKernel tabulated(int radius, const std::function<double(int)>& weight) {
    FlipKernel kernel;
    for (int i = -radius; i <= radius; ++i) kernel.push_back(weight(i));
    return kernel;
}

double total(const FlipKernel& kernel) {
    double sum = 0;
    for (const double weight : kernel) sum += weight;
    return sum;
}

FlipKernel scaled_to_one(FlipKernel kernel) {
    const double sum = total(kernel);
    for (double& weight : kernel) weight /= sum;
    return kernel;
}

FlipKernel signs_scaled_to_one(FlipKernel kernel) {
    double positive = 0, negative = 0;
    for (const double weight : kernel) (weight > 0 ? positive : negative) += std::abs(weight);
    for (double& weight : kernel) weight /= weight > 0 ? positive : negative;
    return kernel;
}

// out[x] = sum of kernel[k] * in[x + k - radius], `in` with `radius` more pixels at each end.
void convolve(const FlipKernel& kernel, const double* in, int radius, double* out, int width) {
    const int own = int(kernel.size()) / 2;
    std::fill(out, out + width, 0.0);
    for (int k = -own; k <= own; ++k) {
        const double weight = kernel[size_t(k + own)];
        const double* from = in + radius + k;
        for (int x = 0; x < width; ++x) out[x] += weight * from[x];
    }
}

}  // namespace

FlipKernels::FlipKernels(double pixels_per_degree) {
    constexpr double kPi = std::numbers::pi;
    const int contrast_radius = int(std::ceil(3.0 * std::sqrt(kWidthCz[0] / (2.0 * kPi * kPi)) * pixels_per_degree));
    const auto contrast = [&](double width) {
        return tabulated(contrast_radius, [&](int i) {
            const double degrees = i / pixels_per_degree;
            return std::exp(-kPi * kPi * degrees * degrees / width);
        });
    };
    y = scaled_to_one(contrast(kWidthY));
    cx = scaled_to_one(contrast(kWidthCx));
    // The 2-D kernel of cz is a sum of two products of Gaussians; what each holds of the whole is its amplitude times its volume.
    const auto volume = [&](int i) {
        const double sum = total(contrast(kWidthCz[i]));
        return kAmplitudeCz[i] * std::sqrt(kPi / kWidthCz[i]) * sum * sum;
    };
    cz_narrow = scaled_to_one(contrast(kWidthCz[1]));
    cz_wide = scaled_to_one(contrast(kWidthCz[0]));
    cz_narrow_share = volume(1) / (volume(0) + volume(1));

    const double deviation = 0.5 * kFeatureWidth * pixels_per_degree;
    const int feature_radius = int(std::ceil(3.0 * deviation));
    const auto gaussian = [&](int i) { return std::exp(-0.5 * i * i / (deviation * deviation)); };
    smooth = scaled_to_one(tabulated(feature_radius, gaussian));
    edge = signs_scaled_to_one(tabulated(feature_radius, [&](int i) { return -i * gaussian(i); }));
    point = signs_scaled_to_one(tabulated(feature_radius, [&](int i) { return (i * i / (deviation * deviation) - 1.0) * gaussian(i); }));
    radius_ = std::max(contrast_radius, feature_radius);
}

FilteredRows::FilteredRows(const FlipKernels& kernels, int width, int height, int first, int last)
    : kernels_(kernels),
      width_(width),
      height_(height),
      first_(first),
      last_(last),
      values_(size_t(kPlanes) * size_t(width) * size_t(last - first)) {
    assert(0 <= first && first < last && last <= height);
}

double* FilteredRows::plane_row(Plane plane, int y) {
    assert(first_ <= y && y < last_);
    return values_.data() + (size_t(plane) * size_t(last_ - first_) + size_t(y - first_)) * size_t(width_);
}

void FilteredRows::add_row(int y, std::span<const Triple> row) {
    const int radius = kernels_.radius();
    std::array<std::vector<double>, 4> padded;  // Y, Cx, Cz and what features are looked for in
    for (std::vector<double>& channel : padded) channel.reserve(size_t(width_ + 2 * radius));
    for (int x = -radius; x < width_ + radius; ++x) {
        const Triple& pixel = row[size_t(std::clamp(x, 0, width_ - 1))];
        for (size_t c = 0; c < 3; ++c) padded[c].push_back(pixel[c]);
        padded[3].push_back((pixel[0] + 16.0) / 116.0);
    }
    const auto filter = [&](Plane plane, const FlipKernel& kernel, size_t channel) {
        convolve(kernel, padded[channel].data(), radius, plane_row(plane, y), width_);
    };
    filter(kY, kernels_.y, 0);
    filter(kCx, kernels_.cx, 1);
    filter(kCzNarrow, kernels_.cz_narrow, 2);
    filter(kCzWide, kernels_.cz_wide, 2);
    filter(kSmooth, kernels_.smooth, 3);
    filter(kEdge, kernels_.edge, 3);
    filter(kPoint, kernels_.point, 3);
}

std::vector<double> FilteredRows::along_y(Plane plane, const FlipKernel& kernel, int y) const {
    const int own = int(kernel.size()) / 2;
    std::vector<double> out(size_t(width_), 0.0);
    for (int k = -own; k <= own; ++k) {
        const double weight = kernel[size_t(k + own)];
        const double* from = plane_row(plane, std::clamp(y + k, 0, height_ - 1));
        for (size_t x = 0; x < out.size(); ++x) out[x] += weight * from[x];
    }
    return out;
}

FilteredRow FilteredRows::row(int y) const {
    FilteredRow out;
    out.y = along_y(kY, kernels_.y, y);
    out.cx = along_y(kCx, kernels_.cx, y);
    const std::vector<double> narrow = along_y(kCzNarrow, kernels_.cz_narrow, y), wide = along_y(kCzWide, kernels_.cz_wide, y);
    const double share = kernels_.cz_narrow_share;
    for (size_t x = 0; x < narrow.size(); ++x) out.cz.push_back(share * narrow[x] + (1.0 - share) * wide[x]);
    out.edge_x = along_y(kEdge, kernels_.smooth, y);
    out.edge_y = along_y(kSmooth, kernels_.edge, y);
    out.point_x = along_y(kPoint, kernels_.smooth, y);
    out.point_y = along_y(kSmooth, kernels_.point, y);
    return out;
}

}  // namespace rawtexel::cli
