// Perspective-correct barycentrics and their screen-space derivatives, from the unclipped triangle's planes.
#pragma once

#include "raster/frame.h"

namespace rawtexel::raster {

/// At one sample point: weights of vertices 0, 1, 2 (sum 1) and their change per pixel right (dx) and down (dy).
/// An attribute is f = f0 + b1*(f1 - f0) + b2*(f2 - f0); its derivative follows from db1, db2 in the same way.
/// Vulkan, "Basic Polygon Rasterization": f = sum(b_i f_i / w_i) / sum(b_i / w_i).
struct Barycentrics {
    double b1, b2;
    double db1_dx, db2_dx, db1_dy, db2_dy;
    double inverse_w;
};

/// (x, y) in pixels. Weights are not clamped, so that points beside the triangle extrapolate. At a covered sample of a whole triangle
/// they lie in [0, 1 + 2^-52]; on a piece that clipping left they may leave [0, 1] by what they change over
/// 1/256 pixel, for its planes are those of the unsnapped vertices.
Barycentrics barycentrics(const SetupTriangle& triangle, double x, double y);

/// Relative change of 1/w per pixel at (x, y). A step j along the screen changes an attribute of derivatives J by J*j/(1 + slope*j), in
/// perspective and exactly; the denominator is what 1/w becomes there over what it is, above 0 wherever the plane can be seen.
struct PerspectiveSlope {
    double dx, dy;
};
PerspectiveSlope perspective_slope(const SetupTriangle& triangle, double x, double y);

/// What `barycentrics` evaluates, by the primitive's corners: b_i/w = scale[i]*plane[i].at(x, y), up to one common factor.
/// Planes of whole triangles are exact at every sample point: multiples of 1/512 below 2^53 of them.
struct InterpolationPlanes {
    Plane plane[3];
    double scale[3];
    double inverse_area;  ///< the common factor
};
InterpolationPlanes interpolation_planes(const SetupTriangle& triangle);

/// The sample points of an 8x4 block's lanes: lane i at offset[i] from its pixel's corner.
struct BlockPoints {
    int x, y;                    ///< upper left pixel of the block
    const SampleOffset* offset;  ///< 32
    bool same_offset = false;    ///< all 32 are equal, as the caller knows
    bool same_triangle = false;  ///< all 32 lanes see one triangle, as the caller knows
};

/// 32 lanes, structure of arrays, in single precision; raster/interpolate-inl.h computes it in vectors. At covered samples and to within
/// a few units in the last place they are the `barycentrics` of a point within 2^-16 pixel of the sample; those of compact triangles
/// (SetupTriangle::compact) are the sample's own.
struct alignas(64) BarycentricWave {
    float b1[32], b2[32], db1_dx[32], db2_dx[32], db1_dy[32], db2_dy[32];
};

}  // namespace rawtexel::raster
