// What a minified lookup should return: level 0, reconstructed bilinearly, integrated over the pixel's filter by quadrature in double.
#pragma once

#include "tests/reference/texunit/sampler_reference.h"

#include <vector>

namespace rawtexel::texunit::reference {

/// Pixel filters, each of a given variance along both axes of the screen.
enum class PixelFilterShape { Box, Tent, Gaussian };

/// One channel of level 0, repeated without end.
struct Plane {
    int width = 0, height = 0;
    std::vector<double> texel;  ///< row by row

    double bilinear(double x, double y) const;  ///< texel i has its centre at i + 1/2
    double deviation() const;                   ///< standard deviation of the texels
};

/// Integral of filter(p)*bilinear(x + J*p) over the screen, J in texels a pixel. The midpoint rule in steps of at most `step` texels;
/// Gaussians are cut at 5 standard deviations.
double footprint_truth(const Plane& plane, PixelFilterShape shape, double variance, const Lookup& at, double step = 0.25);

}  // namespace rawtexel::texunit::reference
