#include "raster/interpolation_planes.h"

#include <cmath>

namespace rawtexel::raster {

namespace {

/// a*b - c*d, good to its last two bits whatever cancels (Kahan; Jeannerod, Louvet and Muller 2013).
double difference_of_products(double a, double b, double c, double d) {
    const double cd = c * d;
    const double error = std::fma(-c, d, cd);
    return std::fma(a, b, -cd) + error;
}

/// The three products' sum as if formed in twice the precision (Ogita, Rump and Oishi 2005, Dot2).
double dot(const Plane& plane, const ScreenVertex& v) {
    double sum = plane.a * v.x;
    double error = std::fma(plane.a, v.x, -sum);
    const auto add = [&](double p, double q) {
        const double product = p * q, next = sum + product;
        const double part = next - sum;
        error += ((sum - (next - part)) + (product - part)) + std::fma(p, q, -product);
        sum = next;
    };
    add(plane.b, v.y);
    add(plane.c, v.w);
    return sum + error;
}

Plane cross(const ScreenVertex& p, const ScreenVertex& q) {
    return {difference_of_products(p.y, q.w, p.w, q.y), difference_of_products(p.w, q.x, p.x, q.w),
            difference_of_products(p.x, q.y, p.y, q.x)};
}

bool is_finite(const Plane& plane) { return std::isfinite(plane.a) && std::isfinite(plane.b) && std::isfinite(plane.c); }

}  // namespace

HomogeneousPlanes homogeneous_planes(const std::array<ScreenVertex, 3>& vertex, double fallback_depth) {
    HomogeneousPlanes planes{{cross(vertex[1], vertex[2]), cross(vertex[2], vertex[0]), cross(vertex[0], vertex[1])}, {}};
    const double determinant = dot(planes.bary_over_w[0], vertex[0]);
    for (size_t i = 0; i < 3; ++i) {
        Plane& plane = planes.bary_over_w[i];
        plane = {plane.a / determinant, plane.b / determinant, plane.c / determinant};
        planes.depth.a += plane.a * vertex[i].z;
        planes.depth.b += plane.b * vertex[i].z;
        planes.depth.c += plane.c * vertex[i].z;
    }
    // Any weight that is not finite makes the depth not finite either, unless all z are 0, so both are looked at.
    const bool usable =
        is_finite(planes.depth) && is_finite(planes.bary_over_w[0]) && is_finite(planes.bary_over_w[1]) && is_finite(planes.bary_over_w[2]);
    if (!usable) {
        planes.bary_over_w.fill({0.0, 0.0, 1.0 / 3.0});
        planes.depth = {0.0, 0.0, fallback_depth};
    }
    return planes;
}

}  // namespace rawtexel::raster
