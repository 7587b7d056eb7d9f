#include "cli/metrics/flip.h"

#include "cli/metrics/flip_colour.h"
#include "cli/metrics/flip_filters.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numeric>

namespace rawtexel::cli {
namespace {

constexpr int kStripRows = 64;  // rows worked on at a time: they stay in the cache and are the unit of parallelism

// Section 4.1, equations 6 to 8 of the LDR paper: the exponents, and where the curve of colour errors has its knee.
constexpr double kColourExponent = 0.7, kFeatureExponent = 0.5, kKneeColour = 0.4, kKneeError = 0.95;
// The HDR paper, section 3.1: what the exposures aim at.
constexpr double kExposedTarget = 0.85;

/// Rows [first, last) of an image.
struct Rows {
    int first = 0, last = 0;
};

using ToDisplayLinear = std::function<Triple(const float* rgb)>;

double unit(double value) { return std::clamp(value, 0.0, 1.0); }

/// What the eye makes of the rows of one image.
struct SeenRows {
    std::vector<Triple> lab;            ///< after the contrast sensitivity, adjusted for Hunt's effect
    std::vector<double> edges, points;  ///< strength
};

class Strip {
  public:
    Strip(const FlipKernels& kernels, int width, int height, Rows rows) : kernels_(kernels), width_(width), height_(height), rows_(rows) {}

    SeenRows see(std::span<const float> image, const ToDisplayLinear& to_linear) const {
        const int first = std::max(rows_.first - kernels_.radius(), 0), last = std::min(rows_.last + kernels_.radius(), height_);
        FilteredRows filtered(kernels_, width_, height_, first, last);
        std::vector<Triple> row(static_cast<size_t>(width_));
        for (int y = first; y < last; ++y) {
            const float* rgb = image.data() + size_t(y) * size_t(width_) * 3;
            for (size_t x = 0; x < row.size(); ++x) row[x] = ycxcz(to_linear(rgb + 3 * x));
            filtered.add_row(y, row);
        }
        SeenRows seen;
        for (int y = rows_.first; y < rows_.last; ++y) {
            const FilteredRow out = filtered.row(y);
            for (size_t x = 0; x < size_t(width_); ++x) {
                const Triple linear = linear_of_ycxcz({out.y[x], out.cx[x], out.cz[x]});
                seen.lab.push_back(hunt_adjusted(lab({unit(linear[0]), unit(linear[1]), unit(linear[2])})));
                seen.edges.push_back(std::sqrt(out.edge_x[x] * out.edge_x[x] + out.edge_y[x] * out.edge_y[x]));
                seen.points.push_back(std::sqrt(out.point_x[x] * out.point_x[x] + out.point_y[x] * out.point_y[x]));
            }
        }
        return seen;
    }

  private:
    const FlipKernels& kernels_;
    int width_, height_;
    Rows rows_;
};

double colour_error(double hyab_distance) {
    static const double most = std::pow(hyab(hunt_adjusted(lab({0, 1, 0})), hunt_adjusted(lab({0, 0, 1}))), kColourExponent);
    const double error = std::pow(hyab_distance, kColourExponent), knee = kKneeColour * most;
    if (error < knee) return kKneeError / knee * error;
    return kKneeError + (error - knee) / (most - knee) * (1.0 - kKneeError);
}

double feature_error(double edges, double points) { return std::pow(std::max(edges, points) / std::sqrt(2.0), kFeatureExponent); }

void raise(std::span<float> errors, const SeenRows& a, const SeenRows& b) {
    for (size_t i = 0; i < errors.size(); ++i) {
        const double colour = colour_error(hyab(a.lab[i], b.lab[i]));
        const double feature = feature_error(std::abs(a.edges[i] - b.edges[i]), std::abs(a.points[i] - b.points[i]));
        errors[i] = std::max(errors[i], float(unit(std::pow(colour, 1.0 - unit(feature)))));
    }
}

/// The largest error over `count` ways to show the images.
std::vector<float> flip_map(const FlipImages& images, double pixels_per_degree, int count,
                            const std::function<Triple(const float* rgb, int i)>& shown, const FlipParallelFor& parallel_for) {
    assert(pixels_per_degree >= kMinPixelsPerDegree && pixels_per_degree <= kMaxPixelsPerDegree);
    assert(images.test.size() == images.reference.size());
    assert(images.test.size() == size_t(images.width) * size_t(images.height) * 3);
    const FlipKernels kernels(pixels_per_degree);
    std::vector<float> map(size_t(images.width) * size_t(images.height), 0.0f);
    parallel_for((images.height + kStripRows - 1) / kStripRows, [&](int64_t index) {
        const int first = int(index) * kStripRows;
        const Rows rows{first, std::min(first + kStripRows, images.height)};
        const Strip strip(kernels, images.width, images.height, rows);
        const std::span errors =
            std::span(map).subspan(size_t(rows.first) * size_t(images.width), size_t(rows.last - rows.first) * size_t(images.width));
        for (int i = 0; i < count; ++i) {
            const ToDisplayLinear show = [&](const float* rgb) { return shown(rgb, i); };
            raise(errors, strip.see(images.test, show), strip.see(images.reference, show));
        }
    });
    return map;
}

double luminance(const float* rgb) {
    return ycxcz_luminance({std::max(double(rgb[0]), 0.0), std::max(double(rgb[1]), 0.0), std::max(double(rgb[2]), 0.0)});
}

double median(std::vector<double>& values) {
    const auto middle = values.begin() + ptrdiff_t(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

}  // namespace

void flip_serial_for(int64_t count, const std::function<void(int64_t index)>& body) {
    for (int64_t i = 0; i < count; ++i) body(i);
}

std::vector<float> ldr_flip(const FlipImages& images, double pixels_per_degree, const FlipParallelFor& parallel_for) {
    const auto shown = [](const float* rgb, int) -> Triple {
        return {linear_of_srgb(unit(rgb[0])), linear_of_srgb(unit(rgb[1])), linear_of_srgb(unit(rgb[2]))};
    };
    return flip_map(images, pixels_per_degree, 1, shown, parallel_for);
}

std::vector<float> hdr_flip(const FlipImages& images, const FlipExposures& exposures, double pixels_per_degree,
                            const FlipParallelFor& parallel_for) {
    std::vector<double> scales;
    for (int i = 0; i < exposures.count; ++i) scales.push_back(std::exp2(exposures.at(i)));
    const auto shown = [&](const float* rgb, int i) -> Triple {
        const auto channel = [&](int c) { return unit(aces(scales[size_t(i)] * std::max(double(rgb[c]), 0.0))); };
        return {channel(0), channel(1), channel(2)};
    };
    return flip_map(images, pixels_per_degree, exposures.count, shown, parallel_for);
}

FlipExposures flip_exposures(std::span<const float> reference) {
    std::vector<double> luminances;
    for (size_t i = 0; i < reference.size(); i += 3) luminances.push_back(luminance(reference.data() + i));
    const double brightest = *std::max_element(luminances.begin(), luminances.end());
    if (brightest <= 0) return {0.0, 0.0, 2};
    double middle = median(luminances);
    if (middle <= 0) {
        std::erase_if(luminances, [](double value) { return value <= 0; });
        middle = median(luminances);
    }
    const double exposed = inverse_aces(kExposedTarget);
    FlipExposures exposures{std::log2(exposed / brightest), std::log2(exposed / middle), 2};
    exposures.count = std::max(2, int(std::ceil(exposures.stop - exposures.start)));
    return exposures;
}

FlipFigures pooled_flip(std::span<const float> map) {
    std::vector<float> sorted(map.begin(), map.end());
    std::ranges::sort(sorted);
    const double sum = std::accumulate(sorted.begin(), sorted.end(), 0.0);
    FlipFigures figures;
    figures.mean = sum / double(sorted.size());
    figures.min = double(sorted.front());
    figures.max = double(sorted.back());
    const std::array<std::pair<double, double*>, 3> percentiles{
        {{0.25, &figures.weighted_q1}, {0.5, &figures.weighted_median}, {0.75, &figures.weighted_q3}}};
    double below = 0;
    size_t next = 0;
    for (const float error : sorted) {
        below += double(error);
        for (; next < percentiles.size() && below >= percentiles[next].first * sum; ++next) *percentiles[next].second = double(error);
    }
    return figures;
}

}  // namespace rawtexel::cli
