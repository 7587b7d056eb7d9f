// Vertices in homogeneous pixel coordinates, in double: where all of clipping and setup happens.
#pragma once

#include "raster/frame.h"

#include <array>
#include <cmath>
#include <cstdint>

namespace rawtexel::raster {

/// (x/w, y/w) are pixels of the frame, z/w is the depth.
struct ScreenVertex {
    double x, y, z, w;
};

inline bool is_finite(const ScreenVertex& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z) && std::isfinite(v.w);
}

/// A position snapped to 24.8.
struct SnappedPosition {
    int32_t x, y;
};

/// To 1/256 pixel, nearest, ties to even (D3D11.3, "Coordinate Snapping"). The vertex lies in the view volume's guard band.
SnappedPosition snap(const ScreenVertex& v);

/// Object space to homogeneous pixels: the same bits for the same position and matrix, whatever the triangle.
class VertexTransform {
  public:
    VertexTransform(const Draw& draw, const FrameOptions& options);
    ScreenVertex operator()(uint32_t vertex) const;

  private:
    const glm::vec3* positions_;
    double matrix_[4][4];              ///< columns, as in GLM
    double half_width_, half_height_;  ///< pixels
};

/// Remembers the vertices transformed last, which the triangles of a mesh ask for again and again.
class VertexCache {
  public:
    explicit VertexCache(const VertexTransform& transform);
    const ScreenVertex& operator[](uint32_t vertex);

  private:
    static constexpr uint32_t kSlots = 256;
    const VertexTransform& transform_;
    std::array<uint32_t, kSlots> vertex_;
    std::array<ScreenVertex, kSlots> value_;
};

}  // namespace rawtexel::raster
