#include "shading/tile_resolve.h"

#include "shading/interleave.h"

#include <algorithm>
#include <cassert>

namespace rawtexel::shading {
namespace {

using texunit::kWaveHeight;
using texunit::kWaveLanes;
using texunit::kWaveWidth;

std::vector<std::string> channel_names(Aov aov) {
    switch (aov) {
        case Aov::Depth: return {"Z"};
        case Aov::Normal: return {"X", "Y", "Z"};
        case Aov::Albedo: return {"R", "G", "B"};
        case Aov::Uv: return {"U", "V"};
        case Aov::Lod:
        case Aov::Material:
        case Aov::Texels:
        case Aov::Lines:
        case Aov::Spp: break;
    }
    return {"Y"};
}

}  // namespace

Layer make_layer(Aov aov, int width, int height) {
    Layer layer{std::string(to_string(aov)), channel_names(aov), {}};
    layer.image = Image(width, height, int(layer.channel_names.size()));
    return layer;
}

TileResolver::TileResolver(const TileInputs& inputs)
    : inputs_(inputs),
      tile_size_(inputs.frame->options().tile_size),
      pixels_(size_t(tile_size_) * size_t(tile_size_)),
      values_(3 * pixels_) {
    if (inputs.planes.hits < 0) return;
    sums_.resize(pixels_);
    hits_.resize(pixels_);
}

void TileResolver::begin(int tile_x, int tile_y) {
    origin_x_ = tile_x * tile_size_;
    origin_y_ = tile_y * tile_size_;
    const PixelRect& visible = inputs_.visible;
    rect_ = {std::max(visible.x0, origin_x_), std::max(visible.y0, origin_y_), std::min(visible.x1, origin_x_ + tile_size_),
             std::min(visible.y1, origin_y_ + tile_size_)};
}

void TileResolver::resolve_radiance(int tile_x, int tile_y, const SampleTree& sums, RenderResult& result) {
    begin(tile_x, tile_y);
    put_mean(sums, size_t(TilePlanes::kRadiance) * pixels_, result.radiance);
}

void TileResolver::resolve(int tile_x, int tile_y, const TileScratch& tile, std::span<const Aov> aovs, RenderResult& result) {
    begin(tile_x, tile_y);
    put_means(tile, TilePlanes::kRadiance, result.radiance);
    for (size_t i = 0; i < result.layers.size(); ++i) resolve_layer(aovs[i], tile, result.layers[i].image);
    if (result.coverage.width > 0) put_means(tile, inputs_.planes.hits, result.coverage);
    if (result.sample_counts.width > 0) put_sample_counts(tile, result.sample_counts);
}

void TileResolver::resolve_layer(Aov aov, const TileScratch& tile, Image& image) {
    const TilePlanes& planes = inputs_.planes;
    switch (aov) {
        case Aov::Depth: return put_surface_means(tile, planes.depth, image);
        case Aov::Normal: return put_surface_means(tile, planes.normal, image);
        case Aov::Albedo: return put_surface_means(tile, planes.albedo, image);
        case Aov::Uv: return put_surface_means(tile, planes.uv, image);
        case Aov::Texels:
        case Aov::Lines: return;  // the frame's account of fetches has them
        case Aov::Lod: return put_first_sample(tile, planes.lod, image);
        case Aov::Material: return put_first_sample(tile, planes.material, image);
        case Aov::Spp: return put_sample_counts(tile, image);
    }
}

void TileResolver::put_means(const TileScratch& tile, int first_plane, Image& image) {
    const size_t first = size_t(first_plane) * pixels_;
    if (!tile.adaptive) return put_mean(tile.sums, first, image);
    tile.sums.mean(first, values(image.channels));
    tile.adaptive->put_means(first, values(image.channels));
    put(image);
}

void TileResolver::put_mean(const SampleTree& sums, size_t first, Image& image) {
    if (const std::optional<SampleTree::ScaledSums> scaled = sums.scaled_sums()) return put(&scaled->sum[first], scaled->share, image);
    sums.mean(first, values(image.channels));
    put(image);
}

void TileResolver::put_surface_means(const TileScratch& tile, int first_plane, Image& image) {
    const auto find_sums = [&](int plane, std::vector<double>& sums) {
        const size_t first = size_t(plane) * pixels_;
        tile.sums.sum(first, sums);
        if (tile.adaptive) tile.adaptive->put_sums(first, sums);
    };
    find_sums(inputs_.planes.hits, hits_);
    for (int channel = 0; channel < image.channels; ++channel) {
        find_sums(first_plane + channel, sums_);
        float* value = &values_[size_t(channel) * pixels_];
        for (size_t i = 0; i < pixels_; ++i) value[i] = hits_[i] > 0.0 ? float(sums_[i] / hits_[i]) : 0.0f;
    }
    put(image);
}

void TileResolver::put_sample_counts(const TileScratch& tile, Image& image) {
    std::fill_n(values_.begin(), pixels_, float(tile.sums.samples()));
    if (tile.adaptive) tile.adaptive->put_counts(values(1));
    put(image);
}

void TileResolver::put_first_sample(const TileScratch& tile, int plane, Image& image) {
    const size_t waves = pixels_ / kWaveLanes;
    for (size_t wave = 0; wave < waves; ++wave)
        std::copy_n(tile.first_sample[size_t(plane) * waves + wave].lane, kWaveLanes, &values_[wave * kWaveLanes]);
    put(image);
}

void TileResolver::put(const float* planes, float factor, Image& image) const {
    const size_t channels = size_t(image.channels), waves_x = size_t(tile_size_ / kWaveWidth);
    const PixelRect rect{rect_.x0 - origin_x_, rect_.y0 - origin_y_, rect_.x1 - origin_x_, rect_.y1 - origin_y_};
    float* const out = image.pixel(rect_.x0 - inputs_.visible.x0, rect_.y0 - inputs_.visible.y0);
    const size_t out_stride = size_t(image.width) * channels;
    const auto put_columns = [&](int first, int last) {
        for (int y = rect.y0; y < rect.y1; ++y) {
            for (int x = first; x < last; ++x) {
                const size_t wave = size_t(y / kWaveHeight) * waves_x + size_t(x / kWaveWidth);
                const float* const value = planes + wave * kWaveLanes + size_t(y % kWaveHeight * kWaveWidth + x % kWaveWidth);
                float* const pixel = out + size_t(y - rect.y0) * out_stride + size_t(x - rect.x0) * channels;
                for (size_t channel = 0; channel < channels; ++channel) pixel[channel] = value[channel * pixels_] * factor;
            }
        }
    };
    // Whole waves lie between the two.
    const int first_whole = std::min((rect.x0 + kWaveWidth - 1) / kWaveWidth * kWaveWidth, rect.x1);
    const int last_whole = std::max(rect.x1 / kWaveWidth * kWaveWidth, first_whole);
    if (rect.x0 < first_whole) put_columns(rect.x0, first_whole);
    interleave_waves({planes, pixels_, waves_x, image.channels}, {first_whole, rect.y0, last_whole, rect.y1}, factor,
                     out + size_t(first_whole - rect.x0) * channels, out_stride);
    if (last_whole < rect.x1) put_columns(last_whole, rect.x1);
}

}  // namespace rawtexel::shading
