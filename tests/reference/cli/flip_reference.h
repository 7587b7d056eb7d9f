// FLIP by the equations of its two papers, one step after the other, pixel by pixel and in double precision.
#pragma once

#include <span>
#include <vector>

namespace rawtexel::reference {

/// Error of every pixel. `test` and `reference`: RGB interleaved, sRGB-encoded in [0, 1].
std::vector<double> ldr_flip(std::span<const float> test, std::span<const float> reference, int width, int height,
                             double pixels_per_degree);

struct Exposures {
    double start, stop;
    int count;
};
Exposures exposures(std::span<const float> reference);

/// RGB interleaved, linear, not negative.
std::vector<double> hdr_flip(std::span<const float> test, std::span<const float> reference, int width, int height,
                             double pixels_per_degree);

/// The smallest error whose sum with all that are not larger is at least `share` of the whole sum.
double weighted_percentile(std::span<const double> errors, double share);

}  // namespace rawtexel::reference
