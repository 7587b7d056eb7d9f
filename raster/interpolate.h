// Perspective-correct barycentrics and their screen-space derivatives, from the unclipped triangle's planes.
#pragma once

#include "raster/frame.h"

namespace rawtexel::raster {

/// At one sample point: weights of vertices 0, 1, 2 (sum 1) and their change per pixel right (dx) and down (dy).
/// An attribute is f = f0 + b1*(f1 - f0) + b2*(f2 - f0); its derivative follows from db1, db2 in the same way.
/// Vulkan 27.10 "f = sum(b_i f_i / w_i) / sum(b_i / w_i)".
struct Barycentrics {
    double b1, b2;
    double db1_dx, db2_dx, db1_dy, db2_dy;
    double inverse_w;
};

/// (x, y) in pixels. Weights are not clamped: at a covered sample they lie in [0, 1] but for snapping.
Barycentrics barycentrics(const SetupTriangle& triangle, double x, double y);

/// 32 lanes, structure of arrays; raster/interpolate-inl.h computes it in vectors, bit-equal to `barycentrics` rounded to float.
struct alignas(64) BarycentricWave {
    float b1[32], b2[32], db1_dx[32], db2_dx[32], db1_dy[32], db2_dy[32];
};

}  // namespace rawtexel::raster
