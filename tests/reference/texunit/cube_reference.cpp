#include "tests/reference/texunit/cube_reference.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

namespace rawtexel::texunit::reference {
namespace {

using Vector = std::array<long long, 3>;

Vector scaled(const Vector& v, long long f) { return {v[0] * f, v[1] * f, v[2] * f}; }
Vector sum(const Vector& a, const Vector& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
long long dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// Table "Cube map face and coordinate selection": the directions of +s, +t and the face's normal.
struct Face {
    Vector s, t, normal;
};
constexpr std::array<Face, 6> kFaces = {{{{0, 0, -1}, {0, -1, 0}, {1, 0, 0}},
                                         {{0, 0, 1}, {0, -1, 0}, {-1, 0, 0}},
                                         {{1, 0, 0}, {0, 0, 1}, {0, 1, 0}},
                                         {{1, 0, 0}, {0, 0, -1}, {0, -1, 0}},
                                         {{1, 0, 0}, {0, -1, 0}, {0, 0, 1}},
                                         {{-1, 0, 0}, {0, -1, 0}, {0, 0, -1}}}};

/// A walk of `a` half texels from the middle of a face along `direction`, over its edges and on: in the plane of `normal` and `direction`
/// the cube is a square of half side n.
Vector walk(Vector normal, Vector direction, long long a, long long n) {
    while (std::llabs(a) > n) {
        const Vector ahead = a > 0 ? direction : scaled(direction, -1);
        const long long beyond = std::llabs(a) - n;
        direction = scaled(normal, -1);
        normal = ahead;
        a = beyond - n;
    }
    return sum(scaled(normal, n), scaled(direction, a));
}

/// The texel whose centre is `p`, in half texels of a cube of half side n.
CubeTexelPlace place_of(const Vector& p, long long n) {
    for (int face = 0; face < 6; ++face) {
        const Face& f = kFaces[size_t(face)];
        if (dot(p, f.normal) == n) return {face, int((dot(p, f.s) + n - 1) / 2), int((dot(p, f.t) + n - 1) / 2)};
    }
    std::abort();
}

}  // namespace

FacePoint face_point(const Lookup3& at) {
    std::array<double, 3> p;
    for (size_t axis = 0; axis < 3; ++axis) p[axis] = std::isfinite(at.position[axis]) ? double(at.position[axis]) : 0.0;
    const double x = std::abs(p[0]), y = std::abs(p[1]), z = std::abs(p[2]);
    const size_t major = z >= x && z >= y ? 2 : y >= x ? 1 : 0;
    FacePoint result;
    result.face = int(2 * major) + (p[major] < 0);
    const Face& f = kFaces[size_t(result.face)];
    const auto along = [](const Vector& axis, const auto& v) {
        return double(axis[0]) * double(v[0]) + double(axis[1]) * double(v[1]) + double(axis[2]) * double(v[2]);
    };
    const double length = std::abs(p[major]);
    const double qs = length == 0 ? 0 : along(f.s, p) / length, qt = length == 0 ? 0 : along(f.t, p) / length;
    result.s = (qs + 1) / 2, result.t = (qt + 1) / 2;
    const auto derivative = [&](const Vector& axis, double q, const std::array<float, 3>& change) {
        return 0.5 * (along(axis, change) - q * along(f.normal, change)) / length;
    };
    result.dsdx = derivative(f.s, qs, at.dx), result.dtdx = derivative(f.t, qt, at.dx);
    result.dsdy = derivative(f.s, qs, at.dy), result.dtdy = derivative(f.t, qt, at.dy);
    return result;
}

std::vector<CubeTexelPlace> cube_texels(int face, long long x, long long y, int size) {
    const Face& f = kFaces[size_t(face)];
    const long long n = size;
    const auto at = [&](long long column, long long row) {
        const long long a = 2 * column + 1 - n, b = 2 * row + 1 - n;
        if (std::llabs(a) > n) return place_of(sum(walk(f.normal, f.s, a, n), scaled(f.t, b)), n);
        return place_of(sum(walk(f.normal, f.t, b, n), scaled(f.s, a)), n);
    };
    const bool inside_x = x >= 0 && x < n, inside_y = y >= 0 && y < n;
    if (inside_x || inside_y) return {at(x, y)};
    const long long corner_x = std::clamp<long long>(x, 0, n - 1), corner_y = std::clamp<long long>(y, 0, n - 1);
    return {at(corner_x, corner_y), at(x < 0 ? -1 : n, corner_y), at(corner_x, y < 0 ? -1 : n)};
}

}  // namespace rawtexel::texunit::reference
