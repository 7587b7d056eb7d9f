// From a tile's sums to pixels of the images.
#pragma once

#include "shading/image.h"
#include "shading/render.h"
#include "shading/tile.h"

#include <span>
#include <vector>

namespace rawtexel::shading {

/// The empty layer of `aov`, named as in files: "depth.Z", "normal.X" ….
Layer make_layer(Aov aov, int width, int height);

/// One worker's: writes what a rendered tile holds to its pixels of the images, whose upper left pixel is that of `inputs.visible`.
class TileResolver {
  public:
    explicit TileResolver(const TileInputs& inputs);

    /// Radiance, the layers of `aovs` and, where it has an image, coverage.
    void resolve(int tile_x, int tile_y, const TileScratch& tile, std::span<const Aov> aovs, RenderResult& result);
    /// Radiance alone, from sums whose first planes it is.
    void resolve_radiance(int tile_x, int tile_y, const SampleTree& sums, RenderResult& result);

  private:
    void begin(int tile_x, int tile_y);
    void resolve_layer(Aov aov, const TileScratch& tile, Image& image);
    /// Means over samples, or over the samples that saw a surface.
    void put_means(const TileScratch& tile, int first_plane, Image& image);
    void put_surface_means(const TileScratch& tile, int first_plane, Image& image);
    void put_sample_counts(const TileScratch& tile, Image& image);
    void put_first_sample(const TileScratch& tile, int plane, Image& image);
    std::span<float> values(int channels) { return std::span(values_).first(size_t(channels) * pixels_); }
    void put_mean(const SampleTree& sums, size_t first, Image& image);
    /// The tile's visible pixels of `planes`, times `factor`, to the image, a plane per channel.
    void put(const float* planes, float factor, Image& image) const;
    void put(Image& image) const { put(values_.data(), 1.0f, image); }

    const TileInputs& inputs_;
    int tile_size_;
    size_t pixels_;   ///< of a tile
    PixelRect rect_;  ///< of the tile at hand that is visible
    int origin_x_ = 0, origin_y_ = 0;
    std::vector<float> values_;  ///< of up to three planes, in the order of waves
    std::vector<double> sums_, hits_;
};

}  // namespace rawtexel::shading
