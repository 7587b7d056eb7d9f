// FLIP: how different two images look that are shown one after the other in the same place.
// LDR: Andersson et al., "FLIP: A Difference Evaluator for Alternating Images", HPG 2020.
// HDR: Andersson et al., "Visualizing Errors in Rendered High Dynamic Range Images", Eurographics 2021.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace rawtexel::cli {

/// 0.7 m in front of a screen of 3840 pixels and 0.7 m.
inline constexpr double kDefaultPixelsPerDegree = 67.02064327658225;
/// Below the first the kernels are narrower than a pixel, above the second an image is one detail.
inline constexpr double kMinPixelsPerDegree = 1.0, kMaxPixelsPerDegree = 1000.0;

/// Two images of the same extents: rows from top to bottom, red, green and blue interleaved, all finite (asserted).
struct FlipImages {
    std::span<const float> test, reference;
    int width = 0, height = 0;
};

/// The exposures at which HDR images are shown, in stops, evenly spaced.
struct FlipExposures {
    double start = 0, stop = 0;
    int count = 0;
    double at(int i) const { return start + (stop - start) * double(i) / double(count - 1); }
};

/// Runs body(index) for every index in [0, count), in any order.
using FlipParallelFor = std::function<void(int64_t count, const std::function<void(int64_t index)>& body)>;
void flip_serial_for(int64_t count, const std::function<void(int64_t index)>& body);

/// The error of each pixel in [0, 1]. The images hold display values encoded by the sRGB curve; what is outside [0, 1] is clamped, as a
/// screen does. Symmetric in the two images, the same bits for any order of work. `pixels_per_degree` is in the range above (asserted).
std::vector<float> ldr_flip(const FlipImages& images, double pixels_per_degree, const FlipParallelFor& parallel_for = flip_serial_for);

/// The largest LDR error over the exposures, each image tone mapped by ACES. The images hold linear light; what is negative counts as 0.
std::vector<float> hdr_flip(const FlipImages& images, const FlipExposures& exposures, double pixels_per_degree,
                            const FlipParallelFor& parallel_for = flip_serial_for);

/// From where the brightest pixel of `reference` shows at 0.85 to where the median luminance does, as many as there are stops between,
/// whole ones counted up, and at least two (section 3.1 of the HDR paper). Where the median is 0 it is that of the pixels above 0; of a
/// black image the exposures are 0.
FlipExposures flip_exposures(std::span<const float> reference);

/// An error map in figures. A weighted percentile is the smallest error such that it and the errors below it add up to that share of the
/// sum of all: half of what is wrong lies at or below the weighted median. All are 0 where the map is.
struct FlipFigures {
    double mean = 0, weighted_q1 = 0, weighted_median = 0, weighted_q3 = 0, min = 0, max = 0;
};
FlipFigures pooled_flip(std::span<const float> map);

}  // namespace rawtexel::cli
