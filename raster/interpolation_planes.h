// Planes of a triangle that a plane cut, from its unclipped vertices in homogeneous coordinates (Olano and Greer 1997).
#pragma once

#include "raster/screen_vertex.h"

#include <array>

namespace rawtexel::raster {

struct HomogeneousPlanes {
    std::array<Plane, 3> bary_over_w;  ///< b_i/w
    Plane depth;                       ///< z/w
};

/// The rows of the inverse of the matrix of (x, y, w). A triangle seen edge-on has none: its weights are then 1/3 and its depth
/// `fallback_depth` everywhere, so that it still closes the seam between its neighbours.
HomogeneousPlanes homogeneous_planes(const std::array<ScreenVertex, 3>& vertex, double fallback_depth);

}  // namespace rawtexel::raster
