// Exact edge functions: integers throughout, so that both sides of a shared edge agree at every sample point.
#pragma once

#include "raster/frame.h"

#include <algorithm>
#include <cstdint>

namespace rawtexel::raster {

/// e(X, Y) = constant + dx*Y - dy*X at the sample point (X, Y) in 1/512 pixel: twice the signed area to the edge, in units of 1/(256*512)
/// pixel, less one where the top-left rule (D3D11.3, "Top-Left Rule") gives the edge to its neighbour: a point is covered where e >= 0.
/// Vertices lie within 2^23 units of 1/256, sample points within 2^24 of 1/512: |dx|, |dy| <= 2^24 and |e| < 2^51, exact in int64 and in
/// double.
struct Edge {
    int32_t dx, dy;  ///< from the edge's first vertex to its second, 1/256 pixel
    int64_t constant;

    int64_t at(int64_t x, int64_t y) const { return constant + (int64_t{dx} * y - int64_t{dy} * x); }
};

inline bool is_top_left(int32_t dx, int32_t dy) { return dy < 0 || (dy == 0 && dx > 0); }

/// The edge from vertex `i` to the next one.
inline Edge edge_of(const SetupTriangle& triangle, int i) {
    const int j = i == 2 ? 0 : i + 1;
    const int32_t dx = triangle.x[j] - triangle.x[i], dy = triangle.y[j] - triangle.y[i];
    const int64_t through_vertex = 2 * (int64_t{dy} * triangle.x[i] - int64_t{dx} * triangle.y[i]);
    return {dx, dy, through_vertex - (is_top_left(dx, dy) ? 0 : 1)};
}

/// A range of sample points, 1/512 pixel, ends included.
struct SampleBox {
    int64_t x_min, x_max, y_min, y_max;
};

/// Greatest and smallest value of dx*Y - dy*X over the box.
inline int64_t greatest_over(const Edge& edge, const SampleBox& box) {
    return int64_t{edge.dx} * (edge.dx > 0 ? box.y_max : box.y_min) - int64_t{edge.dy} * (edge.dy > 0 ? box.x_min : box.x_max);
}
inline int64_t smallest_over(const Edge& edge, const SampleBox& box) {
    return int64_t{edge.dx} * (edge.dx > 0 ? box.y_min : box.y_max) - int64_t{edge.dy} * (edge.dy > 0 ? box.x_max : box.x_min);
}

/// Smallest box that holds the triangle, in 1/512 pixel.
inline SampleBox bounds_of(const SetupTriangle& triangle) {
    const auto [x_min, x_max] = std::minmax({triangle.x[0], triangle.x[1], triangle.x[2]});
    const auto [y_min, y_max] = std::minmax({triangle.y[0], triangle.y[1], triangle.y[2]});
    return {2 * int64_t{x_min}, 2 * int64_t{x_max}, 2 * int64_t{y_min}, 2 * int64_t{y_max}};
}

}  // namespace rawtexel::raster
