#include "tests/reference/texunit/footprint_truth.h"

#include <algorithm>
#include <cmath>

namespace rawtexel::texunit::reference {
namespace {

struct WeighedPoint {
    double place, weight;
};

double half_width(PixelFilterShape shape, double variance) {
    const double sigma = std::sqrt(variance);
    switch (shape) {
        case PixelFilterShape::Box: return sigma * std::sqrt(3.0);
        case PixelFilterShape::Tent: return sigma * std::sqrt(6.0);
        default: return 5 * sigma;
    }
}

double density(PixelFilterShape shape, double variance, double place) {
    switch (shape) {
        case PixelFilterShape::Box: return 1;
        case PixelFilterShape::Tent: return std::max(0.0, 1 - std::abs(place) / half_width(shape, variance));
        default: return std::exp(-0.5 * place * place / variance);
    }
}

/// Points along one axis of the screen, weights summing to 1.
std::vector<WeighedPoint> points(PixelFilterShape shape, double variance, double texels_per_pixel, double step) {
    const double half = half_width(shape, variance);
    const int n = std::max(16, int(std::ceil(2 * half * texels_per_pixel / step)));
    std::vector<WeighedPoint> all;
    double sum = 0;
    for (int i = 0; i < n; ++i) {
        const double place = ((i + 0.5) / n * 2 - 1) * half;
        all.push_back({place, density(shape, variance, place)});
        sum += all.back().weight;
    }
    for (WeighedPoint& point : all) point.weight /= sum;
    return all;
}

int wrap(long long i, int n) { return int(((i % n) + n) % n); }

}  // namespace

double Plane::bilinear(double x, double y) const {
    const double left = std::floor(x - 0.5), top = std::floor(y - 0.5);
    const double fx = x - 0.5 - left, fy = y - 0.5 - top;
    const int x0 = wrap((long long)(left), width), x1 = x0 + 1 == width ? 0 : x0 + 1;
    const int y0 = wrap((long long)(top), height), y1 = y0 + 1 == height ? 0 : y0 + 1;
    const double* const upper = texel.data() + ptrdiff_t(y0) * width;
    const double* const lower = texel.data() + ptrdiff_t(y1) * width;
    return (1 - fy) * ((1 - fx) * upper[x0] + fx * upper[x1]) + fy * ((1 - fx) * lower[x0] + fx * lower[x1]);
}

double Plane::deviation() const {
    double sum = 0, squares = 0;
    for (const double value : texel) sum += value;
    const double mean = sum / double(texel.size());
    for (const double value : texel) squares += (value - mean) * (value - mean);
    return std::sqrt(squares / double(texel.size()));
}

double footprint_truth(const Plane& plane, PixelFilterShape shape, double variance, const Lookup& at, double step) {
    const double sx = double(at.dudx) * plane.width, tx = double(at.dvdx) * plane.height;
    const double sy = double(at.dudy) * plane.width, ty = double(at.dvdy) * plane.height;
    const std::vector<WeighedPoint> across = points(shape, variance, std::hypot(sx, tx), step);
    const std::vector<WeighedPoint> down = points(shape, variance, std::hypot(sy, ty), step);
    const double x = double(at.u) * plane.width, y = double(at.v) * plane.height;
    double sum = 0;
    for (const WeighedPoint& q : down) {
        double row = 0;
        for (const WeighedPoint& p : across) {
            row += p.weight * plane.bilinear(x + p.place * sx + q.place * sy, y + p.place * tx + q.place * ty);
        }
        sum += q.weight * row;
    }
    return sum;
}

}  // namespace rawtexel::texunit::reference
