// Clipping of triangles against the view volume and its guard band, in homogeneous pixel coordinates.
#pragma once

#include "raster/screen_vertex.h"

#include <array>
#include <span>

namespace rawtexel::raster {

/// The planes that cut, in the order in which they cut. Left to Bottom bound the guard band, not the frame.
enum class ClipPlane : int { Near, Far, PositiveW, Left, Right, Top, Bottom };
inline constexpr int kClipPlanes = 7;

/// Not negative inside.
double distance(ClipPlane plane, const ScreenVertex& v);

/// One bit per plane: set where the vertex is outside.
uint32_t outside_planes(const ScreenVertex& v);

/// What is left of a triangle: a polygon, convex but for rounding.
class ClipPolygon {
  public:
    /// A plane adds one vertex to a convex polygon. Where rounding has bent it, one per pair of crossings, so at most half as many as it
    /// has: 3 grow to no more than 4, 6, 9, 13, 19, 28, 42 after the seven planes.
    static constexpr size_t kCapacity = 42;

    explicit ClipPolygon(const std::array<ScreenVertex, 3>& triangle);

    /// Cuts by the planes of the mask, in their order (Sutherland and Hodgman 1974). A cut point depends on its edge's end points and
    /// the plane alone, symmetrically, so the two triangles at an edge get the same points to the last bit.
    void clip(uint32_t planes);
    /// Empty when nothing is left.
    std::span<const ScreenVertex> vertices() const { return {vertex_.data(), size_t(count_)}; }

  private:
    void clip_by(ClipPlane plane);
    void push(const ScreenVertex& v) { vertex_[size_t(count_++)] = v; }

    std::array<ScreenVertex, kCapacity> vertex_;
    int count_ = 0;
};

}  // namespace rawtexel::raster
