// Barycentrics of a wave with the derivatives that lookups are to see.
#if defined(RAWTEXEL_SHADING_DERIVATIVES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_SHADING_DERIVATIVES_INL_H_
#undef RAWTEXEL_SHADING_DERIVATIVES_INL_H_
#else
#define RAWTEXEL_SHADING_DERIVATIVES_INL_H_
#endif

#include "raster/interpolate-inl.h"
#include "shading/footprint_options.h"
#include "texunit/wave.h"

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace rawtexel::shading {
namespace HWY_NAMESPACE {

/// A block of sample points and the triangle that each lane lies on (raster::barycentric_wave).
struct SampleBlock {
    const raster::Frame& frame;
    const uint32_t* setup_index;
    raster::BlockPoints points;
    raster::LatestAnchors& latest;  ///< of the frame; lasts from block to block
};

/// Barycentrics of every lane's triangle at pixel (column, row) of the lane's 2x2 quad, where the lane's own offset puts the sample.
HWY_ATTR inline void quad_corner_barycentrics(const SampleBlock& block, int column, int row, uint32_t mask, raster::BarycentricWave& out) {
    alignas(64) raster::SampleOffset offset[texunit::kWaveLanes];
    for (int lane = 0; lane < texunit::kWaveLanes; ++lane) {
        const int x = lane % texunit::kWaveWidth & 1, y = lane / texunit::kWaveWidth & 1;
        const raster::SampleOffset own = block.points.offset[lane];
        offset[lane] = {own.x + (column - x) * raster::kSampleOne, own.y + (row - y) * raster::kSampleOne};
    }
    const raster::BlockPoints corners{block.points.x, block.points.y, offset};
    raster::HWY_NAMESPACE::barycentric_wave(block.frame, block.setup_index, corners, mask, block.latest, out);
}

/// Replaces the derivatives by the coarse differences of each lane's quad (Vulkan "Derivative Operations"): from its upper left pixel to
/// the right and down.
HWY_ATTR inline void take_quad_differences(const SampleBlock& block, uint32_t mask, raster::BarycentricWave& weights) {
    raster::BarycentricWave corner, right, below;
    quad_corner_barycentrics(block, 0, 0, mask, corner);
    quad_corner_barycentrics(block, 1, 0, mask, right);
    quad_corner_barycentrics(block, 0, 1, mask, below);
    for (int lane = 0; lane < texunit::kWaveLanes; ++lane) {
        weights.db1_dx[lane] = right.b1[lane] - corner.b1[lane];
        weights.db2_dx[lane] = right.b2[lane] - corner.b2[lane];
        weights.db1_dy[lane] = below.b1[lane] - corner.b1[lane];
        weights.db2_dy[lane] = below.b2[lane] - corner.b2[lane];
    }
}

HWY_ATTR inline void find_barycentrics(const DerivativeRule& rule, const SampleBlock& block, uint32_t mask,
                                       raster::BarycentricWave& weights) {
    raster::HWY_NAMESPACE::barycentric_wave(block.frame, block.setup_index, block.points, mask, block.latest, weights);
    if (rule.quad) take_quad_differences(block, mask, weights);
    if (rule.scale == 1.0f) return;
    for (float* const values : {weights.db1_dx, weights.db2_dx, weights.db1_dy, weights.db2_dy}) {
        for (int lane = 0; lane < texunit::kWaveLanes; ++lane) values[lane] *= rule.scale;
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::shading
HWY_AFTER_NAMESPACE();
#endif
