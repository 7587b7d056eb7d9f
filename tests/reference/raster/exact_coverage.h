// Coverage of one triangle at one sample point, one at a time, in 128-bit integers.
#pragma once

#include "raster/frame.h"

#include <cstdint>

namespace rawtexel::reference {

/// Vertices in 1/256 pixel, in any winding.
struct SnappedTriangle {
    int64_t x[3], y[3];
};

SnappedTriangle snapped(const raster::SetupTriangle& triangle);

/// Whether the triangle covers the sample point, in 1/512 pixel. The top-left rule is had from its reason rather than its wording: a sample
/// point on an edge counts as if it lay a hair to the right of where it is, and a hair of a hair below.
bool covers(const SnappedTriangle& triangle, int64_t sample_x, int64_t sample_y);

}  // namespace rawtexel::reference
