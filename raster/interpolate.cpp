#include "raster/interpolate.h"

namespace rawtexel::raster {

namespace {

/// The exact line through the edge that faces corner i of the snapped triangle: zero on the edge, twice the area at the corner.
Plane facing_edge(const SetupTriangle& triangle, int i) {
    const int j = i == 2 ? 0 : i + 1, k = j == 2 ? 0 : j + 1;
    const double dx = triangle.x[k] - triangle.x[j], dy = triangle.y[k] - triangle.y[j];
    return {-dy, dx, (dy * triangle.x[j] - dx * triangle.y[j]) / kSubpixelOne};
}

}  // namespace

InterpolationPlanes interpolation_planes(const SetupTriangle& triangle) {
    InterpolationPlanes planes;
    if (triangle.bary_over_w != nullptr) {
        for (int i = 0; i < 3; ++i) {
            planes.plane[i] = (*triangle.bary_over_w)[size_t(i)];
            planes.scale[i] = 1.0;
        }
        planes.inverse_area = 1.0;
        return planes;
    }
    for (int i = 0; i < 3; ++i) {
        planes.plane[triangle.corner[i]] = facing_edge(triangle, i);
        planes.scale[triangle.corner[i]] = triangle.inverse_w[size_t(i)];
    }
    // The three lines sum to twice the area everywhere, without rounding.
    planes.inverse_area = 1.0 / (planes.plane[0].c + planes.plane[1].c + planes.plane[2].c);
    return planes;
}

Barycentrics barycentrics(const SetupTriangle& triangle, double x, double y) {
    const InterpolationPlanes planes = interpolation_planes(triangle);
    double over_w[3], dx[3], dy[3];
    for (int i = 0; i < 3; ++i) {
        over_w[i] = planes.scale[i] * planes.plane[i].at(x, y);
        dx[i] = planes.scale[i] * planes.plane[i].a;
        dy[i] = planes.scale[i] * planes.plane[i].b;
    }
    const double sum = (over_w[0] + over_w[1]) + over_w[2];
    const double sum_dx = (dx[0] + dx[1]) + dx[2], sum_dy = (dy[0] + dy[1]) + dy[2];
    const double w = 1.0 / sum;
    // Quotient rule: (n/s)' = (n' - (n/s) s')/s.
    Barycentrics result;
    result.b1 = over_w[1] * w;
    result.b2 = over_w[2] * w;
    result.db1_dx = (dx[1] - result.b1 * sum_dx) * w;
    result.db2_dx = (dx[2] - result.b2 * sum_dx) * w;
    result.db1_dy = (dy[1] - result.b1 * sum_dy) * w;
    result.db2_dy = (dy[2] - result.b2 * sum_dy) * w;
    result.inverse_w = sum * planes.inverse_area;
    return result;
}

PerspectiveSlope perspective_slope(const SetupTriangle& triangle, double x, double y) {
    const InterpolationPlanes planes = interpolation_planes(triangle);
    double sum = 0, dx = 0, dy = 0;
    for (int i = 0; i < 3; ++i) {
        sum += planes.scale[i] * planes.plane[i].at(x, y);
        dx += planes.scale[i] * planes.plane[i].a;
        dy += planes.scale[i] * planes.plane[i].b;
    }
    return {dx / sum, dy / sum};
}

}  // namespace rawtexel::raster
