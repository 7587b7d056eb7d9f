#include "raster/visibility.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster/visibility.cpp"
#include <hwy/foreach_target.h>  // compiles this file once per instruction set

#include "raster/visibility-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rawtexel::raster {
namespace HWY_NAMESPACE {

void draw_all_covering(const Frame& frame, int tile_x, int tile_y, const TileSamples& samples, TileVisibility& out) {
    tile_visibility(
        frame, tile_x, tile_y, samples, [](const CandidateWave& wave) { return wave.mask; }, out);
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::raster
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace rawtexel::raster {

HWY_EXPORT(draw_all_covering);

void tile_visibility_opaque(const Frame& frame, int tile_x, int tile_y, const TileSamples& samples, TileVisibility& out) {
    HWY_DYNAMIC_DISPATCH(draw_all_covering)(frame, tile_x, tile_y, samples, out);
}

void TileVisibility::reset(int size) {
    tile_size = size;
    const size_t pixels = size_t(size) * size_t(size);
    hiz_rejected = 0;
    block.assign(pixels / size_t(kBlockSide * kBlockSide), {.written = !may_leave_blocks});
    if (may_leave_blocks) {
        triangle.resize(pixels);
        depth.resize(pixels);
        covered.resize(pixels / 8);
        return;
    }
    triangle.assign(pixels, kNoTriangle);
    depth.assign(pixels, 0.0f);
    covered.assign(pixels / 8, 0);
}

}  // namespace rawtexel::raster

#endif  // HWY_ONCE
