#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shading/tile.cpp"
#include <hwy/foreach_target.h>

#include "shading/tile-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rawtexel::shading {
namespace HWY_NAMESPACE {

void render_tile_lanes(const TileInputs& inputs, int tile_x, int tile_y, TileScratch& scratch) {
    TileRenderer(inputs, tile_x, tile_y, scratch).render();
}

void draw_shadow_tile_lanes(const raster::Frame& frame, std::span<const DrawState> draws, int tile_x, int tile_y,
                            raster::TileVisibility& out) {
    const raster::FrameOptions& options = frame.options();
    TileInputs inputs;
    inputs.frame = &frame;
    inputs.draws = draws;
    AlphaCoverage coverage(inputs, {0, 0, options.width, options.height});
    const auto cover = [&](const raster::CandidateWave& candidate) HWY_ATTR { return coverage.cover(candidate); };
    raster::HWY_NAMESPACE::tile_visibility(frame, tile_x, tile_y, raster::TileSamples{}, cover, out);
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::shading
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rawtexel::shading {

HWY_EXPORT(render_tile_lanes);
HWY_EXPORT(draw_shadow_tile_lanes);

TileTotals& TileTotals::operator+=(const TileTotals& other) {
    samples_shaded += other.samples_shaded;
    hiz_rejected += other.hiz_rejected;
    raster_s += other.raster_s;
    shade_s += other.shade_s;
    return *this;
}

TileScratch::TileScratch(const TileInputs& inputs)
    : sums(size_t(inputs.planes.count) * size_t(inputs.frame->options().tile_size) * size_t(inputs.frame->options().tile_size)) {
    const size_t pixels = size_t(inputs.frame->options().tile_size) * size_t(inputs.frame->options().tile_size);
    const size_t waves = pixels / texunit::kWaveLanes;
    if (inputs.pixel_jitter == PixelJitter::Pixel) {
        shifts.resize(pixels);
        offsets.resize(pixels);
    }
    if (inputs.adaptive_error > 0) adaptive.emplace(inputs.frame->options().tile_size, inputs.planes.count, inputs.adaptive_error);
    sample.resize(size_t(inputs.planes.count) * waves);
    first_sample.resize(size_t(inputs.planes.first_sample_count) * waves);
}

void render_tile(const TileInputs& inputs, int tile_x, int tile_y, TileScratch& scratch) {
    HWY_DYNAMIC_DISPATCH(render_tile_lanes)(inputs, tile_x, tile_y, scratch);
}

void draw_shadow_tile(const raster::Frame& frame, std::span<const DrawState> draws, int tile_x, int tile_y, raster::TileVisibility& out) {
    HWY_DYNAMIC_DISPATCH(draw_shadow_tile_lanes)(frame, draws, tile_x, tile_y, out);
}

}  // namespace rawtexel::shading
#endif  // HWY_ONCE
