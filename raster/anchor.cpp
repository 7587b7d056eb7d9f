#include "raster/anchor.h"

#include "raster/interpolate.h"

#include <cmath>

namespace rawtexel::raster {

namespace {

/// Beyond what floats hold, of slivers whose weights mean nothing.
float finite(double value) {
    const float narrow = float(value);
    return std::isfinite(narrow) ? narrow : 0.0f;
}

}  // namespace

Anchor anchor_in_cell(const Frame& frame, uint32_t setup_index, int x, int y) {
    const SetupTriangle& triangle = frame.triangle(setup_index);
    // Quads reach one pixel farther than samples.
    const int margin = int(std::ceil(frame.options().filter_radius)) + 1;
    const int left = x / kAnchorCell * kAnchorCell - margin, top = y / kAnchorCell * kAnchorCell - margin;
    const int right = left + kAnchorCell + 2 * margin, bottom = top + kAnchorCell + 2 * margin;
    const InterpolationPlanes planes = interpolation_planes(triangle);
    double slope_x = 0, slope_y = 0;  // of 1/w, up to a positive factor
    for (int i = 0; i < 3; ++i) {
        slope_x += planes.scale[i] * planes.plane[i].a;
        slope_y += planes.scale[i] * planes.plane[i].b;
    }
    Anchor anchor;
    anchor.x = slope_x > 0 ? right : left;
    anchor.y = slope_y > 0 ? bottom : top;
    const Barycentrics at = barycentrics(triangle, anchor.x, anchor.y);
    const PerspectiveSlope w = perspective_slope(triangle, anchor.x, anchor.y);
    anchor.b1 = finite(at.b1);
    anchor.b2 = finite(at.b2);
    anchor.b1_dx = finite(at.db1_dx);
    anchor.b2_dx = finite(at.db2_dx);
    anchor.b1_dy = finite(at.db1_dy);
    anchor.b2_dy = finite(at.db2_dy);
    anchor.w_dx = finite(w.dx);
    anchor.w_dy = finite(w.dy);
    return anchor;
}

}  // namespace rawtexel::raster
