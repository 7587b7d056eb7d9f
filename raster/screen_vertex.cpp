#include "raster/screen_vertex.h"

#include <algorithm>
#include <cmath>

namespace rawtexel::raster {

namespace {

constexpr double kSnappedLimit = double(kGuardBand) * kSubpixelOne;

int32_t snap_coordinate(double pixels) {
    // Clipping ends a hair's breadth beside the guard band; the clamp makes the integer budget of edge.h exact.
    return int32_t(std::clamp(std::nearbyint(pixels * kSubpixelOne), -kSnappedLimit, kSnappedLimit));
}

}  // namespace

SnappedPosition snap(const ScreenVertex& v) { return {snap_coordinate(v.x / v.w), snap_coordinate(v.y / v.w)}; }

}  // namespace rawtexel::raster
