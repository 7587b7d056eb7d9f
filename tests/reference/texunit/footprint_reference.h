// Footprints in double precision, one pixel at a time, written from the specifications and from linear algebra; nothing is shared with the
// product but the sampler's description. Float coordinates and derivatives are taken as exact.
#pragma once

#include "tests/reference/texunit/sampler_reference.h"

#include <vector>

namespace rawtexel::texunit::reference {

/// The ellipse that J, in texels of level 0, makes of the pixel's circle.
struct EllipseAxes {
    double major = 0, minor = 0;  ///< lengths, texels
    double s = 1, t = 0;          ///< direction of the major axis, of length 1; without meaning where major = minor
};
/// False when a derivative is not finite.
bool ellipse_axes(const Image& image, LodRule rule, const Lookup& at, EllipseAxes& axes);

/// An anisotropic footprint by the D3D and Vulkan rule.
struct Footprint {
    double eta = 1;          ///< ratio of the axes, at most the sampler's probes
    double real_probes = 1;  ///< before rounding up
    int probes = 1;
    double lambda = 0;              ///< after bias and bounds, before the clamp to the levels
    double axis_u = 0, axis_v = 0;  ///< the major axis
};
Footprint footprint(const Image& image, const SamplerState& sampler, const Lookup& at);

/// A (bi/tri)linear lookup at a coordinate in double, between the levels that `lod` lies between, by `sampler`'s mip mode and wraps.
Sample linear_sample(const Image& image, const SamplerState& sampler, double u, double v, double lod);

/// The weights of the exact elliptical filter over level 0: the normal distribution of covariance S2*J*J^T + I/12 about the lookup,
/// integrated over texel boxes by nested Gauss-Legendre panels, cut as texunit/ellipse.h says, normalised.
struct WeighedTexel {
    long long x, y;  ///< not wrapped
    double weight;
};
std::vector<WeighedTexel> ellipse_weights(const Image& image, double s2, const Lookup& at);

}  // namespace rawtexel::texunit::reference
