#include "tests/reference/raster/exact_interpolation.h"

#include <algorithm>
#include <cmath>

namespace rawtexel::reference {

namespace {

Quad determinant(const Quad (&p)[3], const Quad (&q)[3], const Quad (&r)[3]) {
    return p[0] * (q[1] * r[2] - q[2] * r[1]) - p[1] * (q[0] * r[2] - q[2] * r[0]) + p[2] * (q[0] * r[1] - q[1] * r[0]);
}

/// a*x + b*y + c over pixels.
struct QuadLine {
    Quad a, b, c;
};

Quad magnitude(Quad value) { return value < 0 ? -value : value; }

/// Zero along the line through two vertices.
QuadLine line_through(const QuadVertex& p, const QuadVertex& q) {
    return {p.y * q.w - p.w * q.y, p.w * q.x - p.x * q.w, p.x * q.y - p.y * q.x};
}

/// The function that is value[i] at vertex i, over w.
QuadLine plane_of(const QuadLine (&edge)[3], const Quad (&value)[3], Quad all) {
    QuadLine sum{0, 0, 0};
    for (int i = 0; i < 3; ++i) {
        sum.a += edge[i].a * value[i] / all;
        sum.b += edge[i].b * value[i] / all;
        sum.c += edge[i].c * value[i] / all;
    }
    return sum;
}

}  // namespace

QuadVertex to_screen(const glm::mat4& m, const glm::vec3& p, int width, int height) {
    const auto row = [&](int r) { return Quad(m[0][r]) * p.x + Quad(m[1][r]) * p.y + Quad(m[2][r]) * p.z + Quad(m[3][r]); };
    const Quad w = row(3);
    return {(w + row(0)) * width / 2, (w - row(1)) * height / 2, row(2), w};
}

QuadWeights weights_at(const QuadVertex (&v)[3], Quad x, Quad y) {
    const Quad p[3][3] = {{v[0].x, v[0].y, v[0].w}, {v[1].x, v[1].y, v[1].w}, {v[2].x, v[2].y, v[2].w}};
    const Quad s[3] = {x, y, 1};
    const Quad all = determinant(p[0], p[1], p[2]);
    // The weights over w; their sum is 1/w.
    const Quad n[3] = {determinant(s, p[1], p[2]) / all, determinant(p[0], s, p[2]) / all, determinant(p[0], p[1], s) / all};
    const Quad sum = n[0] + n[1] + n[2];
    return {{n[0] / sum, n[1] / sum, n[2] / sum}, sum, n[0] * v[0].z + n[1] * v[1].z + n[2] * v[2].z};
}

VisiblePart::VisiblePart(const QuadVertex (&v)[3]) {
    const QuadLine edge[3] = {line_through(v[1], v[2]), line_through(v[2], v[0]), line_through(v[0], v[1])};
    const Quad all = edge[0].a * v[0].x + edge[0].b * v[0].y + edge[0].c * v[0].w;
    edge_on_ = all == 0;
    if (edge_on_) return;
    const Quad values[6][3] = {
        {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}, {v[0].z, v[1].z, v[2].z}, {v[0].w - v[0].z, v[1].w - v[1].z, v[2].w - v[2].z}};
    for (int i = 0; i < 6; ++i) {
        const QuadLine line = plane_of(edge, values[i], all);
        // Scaled first: the squares of what quadruple holds may not fit long double.
        const Quad largest = std::max({magnitude(line.a), magnitude(line.b), Quad(1e-300L) * magnitude(line.c)});
        if (largest == 0) {
            bound_[i] = {0, 0, 0};
            continue;
        }
        const auto a = (long double)(line.a / largest), b = (long double)(line.b / largest), c = (long double)(line.c / largest);
        const long double length = std::hypot(a, b);
        bound_[i] = length > 0 ? Bound{a / length, b / length, c / length} : Bound{0, 0, c};
    }
}

Side VisiblePart::side_of(double x, double y, double tolerance) const {
    if (edge_on_) return Side::OnBorder;
    bool inside = true;
    for (const Bound& bound : bound_) {
        const long double distance = bound.a * x + bound.b * y + bound.c;
        if (std::abs(distance) <= tolerance) return Side::OnBorder;
        inside &= distance > 0;
    }
    return inside ? Side::Inside : Side::Outside;
}

}  // namespace rawtexel::reference
