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

/// Object space to homogeneous pixels: the same bits for the same position and matrix, whatever the triangle; raster/cluster_setup-inl.h
/// has it in vectors.
ScreenVertex to_screen(const glm::mat4& clip_from_object, const glm::vec3& position, const FrameOptions& options);

/// z/w from 0 to 1, never -0. The vertex lies before the near plane.
double depth_of(const ScreenVertex& v);

/// A position snapped to 24.8.
struct SnappedPosition {
    int32_t x, y;
};

/// To 1/256 pixel, nearest, ties to even (D3D11.3, "Coordinate Snapping"). The vertex lies in the view volume's guard band.
SnappedPosition snap(const ScreenVertex& v);

}  // namespace rawtexel::raster
