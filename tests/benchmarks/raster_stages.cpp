#include "tests/benchmarks/raster_stages.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/benchmarks/raster_stages.cpp"
#include <hwy/foreach_target.h>  // compiles this file once per instruction set

#include "raster/coverage-inl.h"
#include "raster/interpolate-inl.h"
#include "shading/derivatives-inl.h"

#include <bit>

HWY_BEFORE_NAMESPACE();
namespace rawtexel::raster {
namespace HWY_NAMESPACE {

uint64_t covered_samples_here(const Frame& frame, uint32_t count, const TileSamples& samples) {
    const TilePass pass(frame, 0, 0, samples);
    uint64_t covered = 0;
    for (uint32_t t = 0; t < count; ++t) {
        TriangleCoverage coverage(frame.triangle(t), pass);
        for (int row = 0; row < pass.height; row += kHiZWidth)
            for (int column = 0; column < pass.width; column += kHiZWidth) {
                if (!coverage.enter_block(column, row)) continue;
                for (int wave = 0; wave < kHiZWidth; wave += kBlockHeight)
                    covered += uint64_t(std::popcount(coverage.wave(column, row + wave)));
            }
    }
    return covered;
}

void interpolate_tile_here(const Frame& frame, const uint32_t* setup_index, stages::Derivatives derivatives, BarycentricWave& out) {
    SampleOffset offset[32];
    for (SampleOffset& one : offset) one = {129, 385};
    LatestAnchors latest(frame);
    for (int y = 0; y < 64; y += kBlockHeight)
        for (int x = 0; x < 64; x += kBlockWidth) {
            if (derivatives == stages::Derivatives::Analytic) {
                barycentric_wave(frame, setup_index, {x, y, offset, true}, 0xFFFFFFFFu, latest, out);
            } else {
                shading::HWY_NAMESPACE::find_barycentrics({.quad = true}, {frame, setup_index, {x, y, offset, true}, latest}, 0xFFFFFFFFu,
                                                          out);
            }
        }
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::raster
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace rawtexel::raster {

HWY_EXPORT(covered_samples_here);
HWY_EXPORT(interpolate_tile_here);

namespace stages {

uint64_t covered_samples(const Frame& frame, uint32_t count, const TileSamples& samples) {
    return HWY_DYNAMIC_DISPATCH(covered_samples_here)(frame, count, samples);
}

void interpolate_tile(const Frame& frame, const uint32_t* setup_index, Derivatives derivatives, BarycentricWave& out) {
    HWY_DYNAMIC_DISPATCH(interpolate_tile_here)(frame, setup_index, derivatives, out);
}

}  // namespace stages
}  // namespace rawtexel::raster

#endif  // HWY_ONCE
