#include "shading/tile_resolve.h"

#include <algorithm>

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
    : inputs_(inputs), tile_size_(inputs.frame->options().tile_size), pixels_(size_t(tile_size_) * size_t(tile_size_)), values_(pixels_) {
    if (inputs.planes.hits < 0) return;
    sums_.resize(pixels_);
    hits_.resize(pixels_);
}

void TileResolver::resolve(int tile_x, int tile_y, const TileScratch& tile, std::span<const Aov> aovs, Image& radiance, std::span<Layer> layers) {
    origin_x_ = tile_x * tile_size_;
    origin_y_ = tile_y * tile_size_;
    const PixelRect& visible = inputs_.visible;
    rect_ = {std::max(visible.x0, origin_x_), std::max(visible.y0, origin_y_), std::min(visible.x1, origin_x_ + tile_size_),
             std::min(visible.y1, origin_y_ + tile_size_)};
    put_means(tile.sums, TilePlanes::kRadiance, radiance);
    for (size_t i = 0; i < layers.size(); ++i) resolve_layer(aovs[i], tile, layers[i].image);
}

void TileResolver::resolve_layer(Aov aov, const TileScratch& tile, Image& image) {
    const TilePlanes& planes = inputs_.planes;
    switch (aov) {
        case Aov::Depth: return put_surface_means(tile.sums, planes.depth, image);
        case Aov::Normal: return put_surface_means(tile.sums, planes.normal, image);
        case Aov::Albedo: return put_surface_means(tile.sums, planes.albedo, image);
        case Aov::Uv: return put_surface_means(tile.sums, planes.uv, image);
        case Aov::Texels: return put_means(tile.sums, planes.texels, image);
        case Aov::Lod: return put_first_sample(tile, planes.lod, image);
        case Aov::Material: return put_first_sample(tile, planes.material, image);
        case Aov::Spp: break;
    }
    std::fill(values_.begin(), values_.end(), float(tile.sums.samples()));
    put(0, image);
}

void TileResolver::put_means(const SampleTree& sums, int first_plane, Image& image) {
    for (int channel = 0; channel < image.channels; ++channel) {
        sums.mean(size_t(first_plane + channel) * pixels_, values_);
        put(channel, image);
    }
}

void TileResolver::put_surface_means(const SampleTree& sums, int first_plane, Image& image) {
    sums.sum(size_t(inputs_.planes.hits) * pixels_, hits_);
    for (int channel = 0; channel < image.channels; ++channel) {
        sums.sum(size_t(first_plane + channel) * pixels_, sums_);
        for (size_t i = 0; i < pixels_; ++i) values_[i] = hits_[i] > 0.0 ? float(sums_[i] / hits_[i]) : 0.0f;
        put(channel, image);
    }
}

void TileResolver::put_first_sample(const TileScratch& tile, int plane, Image& image) {
    const size_t waves = pixels_ / kWaveLanes;
    for (size_t wave = 0; wave < waves; ++wave)
        std::copy_n(tile.first_sample[size_t(plane) * waves + wave].lane, kWaveLanes, &values_[wave * kWaveLanes]);
    put(0, image);
}

void TileResolver::put(int channel, Image& image) const {
    const int waves_x = tile_size_ / kWaveWidth;
    for (int y = rect_.y0; y < rect_.y1; ++y) {
        const int tile_y = y - origin_y_;
        float* out = image.pixel(rect_.x0 - inputs_.visible.x0, y - inputs_.visible.y0) + channel;
        for (int x = rect_.x0; x < rect_.x1; ++x, out += image.channels) {
            const int tile_x = x - origin_x_;
            const int wave = tile_y / kWaveHeight * waves_x + tile_x / kWaveWidth;
            *out = values_[size_t(wave * kWaveLanes + tile_y % kWaveHeight * kWaveWidth + tile_x % kWaveWidth)];
        }
    }
}

}  // namespace rawtexel::shading
