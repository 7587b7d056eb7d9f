#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shading/tile.cpp"
#include <hwy/foreach_target.h>

#include "shading/tile-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rawtexel::shading {
namespace HWY_NAMESPACE {

void render_tile_plain(const TileInputs& inputs, int tile_x, int tile_y, TileScratch& scratch) {
    TileRenderer<texunit::NoFetchCount>(inputs, tile_x, tile_y, scratch).render();
}

void render_tile_counted(const TileInputs& inputs, int tile_x, int tile_y, TileScratch& scratch) {
    TileRenderer<texunit::FetchCounter>(inputs, tile_x, tile_y, scratch).render();
}

void draw_shadow_tile_lanes(const raster::Frame& frame, std::span<const DrawState> draws, int tile_x, int tile_y,
                            raster::TileVisibility& out) {
    const raster::FrameOptions& options = frame.options();
    AlphaCoverage<texunit::NoFetchCount> coverage(frame, draws, {0, 0, options.width, options.height}, 0);
    const auto nothing_counted = [](int, int) HWY_ATTR -> texunit::Wave<uint32_t>* { return nullptr; };
    const auto cover = [&](const raster::CandidateWave& candidate) HWY_ATTR { return coverage.cover(candidate, nullptr, nothing_counted); };
    raster::HWY_NAMESPACE::tile_visibility(frame, tile_x, tile_y, raster::TileSamples{}, cover, out);
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::shading
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rawtexel::shading {

HWY_EXPORT(render_tile_plain);
HWY_EXPORT(render_tile_counted);
HWY_EXPORT(draw_shadow_tile_lanes);

TileTotals& TileTotals::operator+=(const TileTotals& other) {
    samples_shaded += other.samples_shaded;
    hiz_rejected += other.hiz_rejected;
    raster_s += other.raster_s;
    shade_s += other.shade_s;
    fetches.resize(std::max(fetches.size(), other.fetches.size()));
    for (size_t i = 0; i < other.fetches.size(); ++i) fetches[i] += other.fetches[i];
    return *this;
}

TileScratch::TileScratch(const TileInputs& inputs, size_t texture_count)
    : sums(size_t(inputs.planes.count) * size_t(inputs.frame->options().tile_size) * size_t(inputs.frame->options().tile_size)) {
    const size_t pixels = size_t(inputs.frame->options().tile_size) * size_t(inputs.frame->options().tile_size);
    const size_t waves = pixels / texunit::kWaveLanes;
    if (inputs.pixel_jitter == PixelJitter::Pixel) {
        shifts.resize(pixels);
        offsets.resize(pixels);
    }
    sample.resize(size_t(inputs.planes.count) * waves);
    first_sample.resize(size_t(inputs.planes.first_sample_count) * waves);
    texels.resize(waves);
    totals.fetches.resize(texture_count);
}

void render_tile(const TileInputs& inputs, int tile_x, int tile_y, TileScratch& scratch) {
    if (inputs.count || inputs.planes.texels >= 0) {
        HWY_DYNAMIC_DISPATCH(render_tile_counted)(inputs, tile_x, tile_y, scratch);
    } else {
        HWY_DYNAMIC_DISPATCH(render_tile_plain)(inputs, tile_x, tile_y, scratch);
    }
}

void draw_shadow_tile(const raster::Frame& frame, std::span<const DrawState> draws, int tile_x, int tile_y, raster::TileVisibility& out) {
    HWY_DYNAMIC_DISPATCH(draw_shadow_tile_lanes)(frame, draws, tile_x, tile_y, out);
}

}  // namespace rawtexel::shading
#endif  // HWY_ONCE
