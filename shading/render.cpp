#include "shading/render.h"

#include "shading/camera.h"
#include "shading/draw_state.h"
#include "shading/lookup_refusal.h"
#include "shading/fetch_account.h"
#include "shading/temporal_sums.h"
#include "shading/tile.h"
#include "shading/tile_range.h"
#include "shading/tile_resolve.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <chrono>
#include <numeric>
#include <optional>

namespace rawtexel::shading {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

PixelRect visible_pixels(const RenderOptions& options) {
    const Crop& crop = options.crop;
    if (crop.width == 0 && crop.height == 0) return {0, 0, options.width, options.height};
    assert(crop.x >= 0 && crop.y >= 0 && crop.width > 0 && crop.height > 0);
    assert(crop.x + crop.width <= options.width && crop.y + crop.height <= options.height);
    return {crop.x, crop.y, crop.x + crop.width, crop.y + crop.height};
}

/// The offsets of the frame's samples, where all pixels share them.
std::optional<raster::OffsetRange> sample_reach(const RenderOptions& options) {
    if (options.pixel_jitter == PixelJitter::Pixel) return std::nullopt;
    const SequenceShift shift = sequence_shift(PixelJitter::Frame, 0, 0, options.seed);
    const auto offset = [&](int k) {
        return sample_offset(options.pixel_filter, PixelJitter::Frame, options.first_sample + uint32_t(k), shift);
    };
    raster::OffsetRange reach{offset(0).x, offset(0).x, offset(0).y, offset(0).y};
    for (int k = 1; k < options.spp; ++k) {
        const raster::SampleOffset at = offset(k);
        reach = {std::min(reach.x_min, at.x), std::max(reach.x_max, at.x), std::min(reach.y_min, at.y), std::max(reach.y_max, at.y)};
    }
    return reach;
}

raster::Frame make_frame(const DrawStates& states, const RenderOptions& options, const PixelRect& visible, int tile_size,
                         Executor& executor) {
    const float aspect = float(options.width) / float(options.height);
    const std::vector<raster::Draw> draws = make_raster_draws(states, clip_from_world(options.camera, aspect), DrawPurpose::Camera);
    const raster::FrameOptions frame_options{
        .width = options.width,
        .height = options.height,
        .crop_x = visible.x0,
        .crop_y = visible.y0,
        .crop_width = visible.x1 - visible.x0,
        .crop_height = visible.y1 - visible.y0,
        .tile_size = tile_size,
        .filter_radius = filter_radius(options.pixel_filter),
        .reach = sample_reach(options),
        // Who counts overdraw counts it in the order of the scene.
        .scene_order = options.fetches.model != FetchModel::Visible,
        .skips = {.clusters = options.skips.clusters,
                  .frustum = options.skips.frustum,
                  .backface = options.skips.backface,
                  .occlusion = options.skips.occlusion,
                  .hiz = options.skips.hiz},
    };
    return raster::Frame(frame_options, draws, parallel_for_of(executor));
}

/// One worker's memory, made when the worker gets its first tile.
struct Worker {
    explicit Worker(const TileInputs& inputs) : scratch(inputs), resolver(inputs) {}
    TileScratch scratch;
    TileResolver resolver;
};

/// Renders all tiles into the images of `result` and adds up the workers' totals. `account`: null when nobody counts.
TileTotals render_tiles(const TileInputs& inputs, FetchAccount* account, const RenderOptions& options, RenderResult& result,
                        Executor& executor, const Progress& progress) {
    assert((options.listener == nullptr && options.fragment_listener == nullptr) || executor.threads() == 1);
    const TileRange tiles(inputs.visible, inputs.frame->options().tile_size);
    std::vector<std::unique_ptr<Worker>> workers(size_t(executor.threads()));
    std::atomic<int64_t> done{0};
    const auto render_one = [&](int64_t tile, Worker& worker) {
        render_tile(inputs, tiles.x(tile), tiles.y(tile), worker.scratch);
        worker.resolver.resolve(tiles.x(tile), tiles.y(tile), worker.scratch, options.aovs, result);
        if (!options.sums) return;
        const SampleTree& all = options.sums->add(tile, worker.scratch.sums);
        worker.resolver.resolve_radiance(tiles.x(tile), tiles.y(tile), all, result);
    };
    if (options.sums) options.sums->prepare(tiles.count(), inputs.frame->options().tile_size);
    executor.parallel_for(tiles.count(), [&](int64_t index, int number) {
        std::unique_ptr<Worker>& worker = workers[size_t(number)];
        if (!worker) {
            worker = std::make_unique<Worker>(inputs);
            worker->scratch.fragment_listener = options.fragment_listener;
            worker->scratch.listener = account ? &account->add_worker() : options.listener;
        }
        if (!account) {
            render_one(index, *worker);
        } else {
            const int64_t tile = account->begin_tile(index);
            try {
                render_one(tile, *worker);
                account->end_tile(tile);
            } catch (...) {
                account->abandon();
                throw;
            }
        }
        if (progress) progress(double(++done) / double(tiles.count()));
    });
    TileTotals totals;
    for (const std::unique_ptr<Worker>& worker : workers)
        if (worker) totals += worker->scratch.totals;
    return totals;
}

LookupOverrides lookup_overrides(const RenderOptions& options, bool occlusion) {
    return {.filter = options.filter,
            .mip = options.mip,
            .footprint = options.footprint,
            .filtering = options.filtering,
            .precision = options.precision,
            .occlusion = occlusion,
            .constant_texels = options.skips.constant_texels};
}

/// Makes what the options do not leave to the lookups that need it.
void make_texels(const Scene& scene, const Skips& skips, Executor& executor) {
    if (skips.lazy_files && skips.lazy_levels && skips.lazy_blocks) return;
    executor.parallel_for(int64_t(scene.textures.size()), [&](int64_t index, int) {
        texunit::Texture& texture = *scene.textures[size_t(index)].texture;
        if (!skips.lazy_files) texture.ensure(0, 0, 0, 0);
        for (int level = 0; level < texture.shape().levels; ++level)
            if (level < texture.source_levels() ? !skips.lazy_blocks : !skips.lazy_levels) texture.make_level(level);
    });
}

/// With what the layers of counts need.
FetchOptions fetch_options(const RenderOptions& options) {
    FetchOptions fetches = options.fetches;
    for (const Aov aov : options.aovs) {
        fetches.pixel_texels |= aov == Aov::Texels;
        fetches.pixel_lines |= aov == Aov::Lines;
    }
    return fetches;
}

void fill_count_layers(const RenderOptions& options, RenderResult& result) {
    const auto samples = [&](size_t pixel) {
        return result.sample_counts.width > 0 ? result.sample_counts.values[pixel] : float(options.spp);
    };
    for (size_t i = 0; i < options.aovs.size(); ++i) {
        PixelValues& values = result.layers[i].image.values;
        if (options.aovs[i] == Aov::Lines) values = result.fetches->pixel(PixelCount::LinesPixel).values;
        if (options.aovs[i] != Aov::Texels) continue;
        values = result.fetches->pixel(PixelCount::TexelsRequested).values;
        for (size_t pixel = 0; pixel < values.size(); ++pixel) values[pixel] /= samples(pixel);
    }
}

}  // namespace

std::optional<double> mean_samples(const RenderResult& result) {
    const PixelValues& counts = result.sample_counts.values;
    if (counts.empty()) return std::nullopt;
    return std::accumulate(counts.begin(), counts.end(), 0.0) / double(counts.size());
}

bool holds_whole_blocks(const Crop& crop, int width, int height) {
    if (crop.width == 0) return true;
    const auto is_edge = [](int at, int extent) { return at % kAdaptiveBlock == 0 || at == extent; };
    return is_edge(crop.x, width) && is_edge(crop.y, height) && is_edge(crop.x + crop.width, width) &&
           is_edge(crop.y + crop.height, height);
}

std::string refusal(const Scene& scene, const RenderOptions& options) { return refusal(scene, lookup_overrides(options, true)); }

RenderResult render(const Scene& scene, const Lighting& lighting, const RenderOptions& options, Executor& executor,
                    const Progress& progress) {
    assert(options.width > 0 && options.height > 0 && options.spp > 0);
    assert(options.adaptive_error == 0 || (options.sums == nullptr && holds_whole_blocks(options.crop, options.width, options.height)));
    const Clock::time_point start = Clock::now();
    const PixelRect visible = visible_pixels(options);
    const FetchOptions fetches = fetch_options(options);
    // The same image whatever the tiles: the order of fetches is that of its own.
    const int tile_size = fetches.needs_order() ? kCanonicalTile : options.tile_size;
    const bool indirect_light = lighting.environment != nullptr || lighting.ambient != 0.0f;
    const DrawStates states = make_draw_states(scene, lookup_overrides(options, indirect_light));
    make_texels(scene, options.skips, executor);
    const raster::Frame frame = make_frame(states, options, visible, tile_size, executor);

    RenderResult result;
    result.times.geometry_s = seconds_since(start);
    result.radiance = Image::unwritten(visible.x1 - visible.x0, visible.y1 - visible.y0, 3);
    if (options.coverage) result.coverage = Image(result.radiance.width, result.radiance.height, 1);
    if (options.adaptive_error > 0) result.sample_counts = Image(result.radiance.width, result.radiance.height, 1);
    for (const Aov aov : options.aovs) result.layers.push_back(make_layer(aov, result.radiance.width, result.radiance.height));

    const TileInputs inputs{
        .frame = &frame,
        .draws = states.draws,
        .lighting = &lighting,
        .rays = make_view_rays(options.camera, options.width, options.height),
        .visible = visible,
        .first_sample = options.first_sample,
        .spp = options.spp,
        .adaptive_error = options.adaptive_error,
        .pixel_filter = options.pixel_filter,
        .pixel_jitter = options.pixel_jitter,
        .seed = options.seed,
        .derivatives = derivative_rule(options.footprint, options.image_spp > 0 ? options.image_spp : options.spp),
        .background = options.background,
        .planes = TilePlanes(options.aovs, options.coverage),
        .shadow_taps = options.filtering.shadow_taps,
        .texture_jitter = options.filtering.texture_jitter,
        .noise = options.filtering.noise,
        .fetch_model = fetches.model,
        .skip_zero_weights = options.skips.zero_weight_taps,
        .skip_empty_tiles = options.skips.empty_tiles,
    };
    std::optional<FetchAccount> account;
    if (fetches.counts() && !options.listener) account.emplace(scene, fetches, visible, tile_size, options.width);
    const TileTotals totals = render_tiles(inputs, account ? &*account : nullptr, options, result, executor, progress);
    result.geometry = frame.counts();
    result.geometry.hiz_rejected += totals.hiz_rejected;
    result.samples_shaded = totals.samples_shaded;
    if (account) result.fetches = account->take();
    if (account) fill_count_layers(options, result);
    result.times.raster_s = totals.raster_s;
    result.times.shade_s = totals.shade_s;
    result.times.frame_s = seconds_since(start);
    return result;
}

}  // namespace rawtexel::shading
