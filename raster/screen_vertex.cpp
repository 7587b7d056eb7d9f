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

ScreenVertex to_screen(const glm::mat4& clip_from_object, const glm::vec3& position, const FrameOptions& options) {
    const glm::mat4& m = clip_from_object;
    const double px = double(position.x), py = double(position.y), pz = double(position.z);
    const auto row = [&](int r) { return ((double(m[0][r]) * px + double(m[1][r]) * py) + double(m[2][r]) * pz) + double(m[3][r]); };
    const double x = row(0), y = row(1), z = row(2), w = row(3);
    return {(w + x) * (0.5 * options.width), (w - y) * (0.5 * options.height), z, w};
}

double depth_of(const ScreenVertex& v) {
    // Adding zero turns -0 into 0.
    return std::clamp(v.z / v.w, 0.0, 1.0) + 0.0;
}

SnappedPosition snap(const ScreenVertex& v) { return {snap_coordinate(v.x / v.w), snap_coordinate(v.y / v.w)}; }

}  // namespace rawtexel::raster
