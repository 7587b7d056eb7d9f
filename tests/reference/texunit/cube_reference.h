// Cube maps in double precision and integers, by walking on the surface of a cube.
#pragma once

#include "tests/reference/texunit/sampler_reference.h"

#include <vector>

namespace rawtexel::texunit::reference {

/// Where a direction meets the cube: face 0..5 = +X -X +Y -Y +Z -Z, coordinates 0..1 on it and their derivatives (Vulkan "Cube Map Face
/// Selection", "Cube Map Coordinate Transformation", "Cube Map Derivative Transformation").
struct FacePoint {
    int face;
    double s, t;
    double dsdx, dtdx, dsdy, dtdy;
};
FacePoint face_point(const Lookup3& direction);

struct CubeTexelPlace {
    int face, x, y;
};
/// What column `x` and row `y` of a face `size` texels wide mean: one texel, that of another face beyond an edge, or beyond a corner the
/// three texels that meet there.
std::vector<CubeTexelPlace> cube_texels(int face, long long x, long long y, int size);

}  // namespace rawtexel::texunit::reference
