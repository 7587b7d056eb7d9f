// The tiles of a frame, and which of them a triangle may touch.
#pragma once

#include "raster/edge.h"
#include "raster/frame.h"

#include <algorithm>

namespace rawtexel::raster {

/// Tiles are aligned to the whole frame; only those that touch the crop are active.
class TileGrid {
  public:
    explicit TileGrid(const FrameOptions& options);

    int tiles_x() const { return tiles_x_; }
    int tiles_y() const { return tiles_y_; }
    int width() const { return width_; }
    int height() const { return height_; }
    int first_x() const { return first_x_; }
    int last_x() const { return last_x_; }
    int first_y() const { return first_y_; }
    int last_y() const { return last_y_; }
    int active_tiles() const { return (last_x_ - first_x_ + 1) * (last_y_ - first_y_ + 1); }
    /// Every sample point of the active tiles' pixels.
    const SampleBox& sample_box() const { return sample_box_; }

    int tile_size() const { return tile_size_; }

    /// Offsets from a pixel's upper left corner of all points that the pixel filter may sample, and of those that this frame samples.
    const SampleBox& support() const { return support_; }
    const SampleBox& reach() const { return reach_; }

    /// Whether a box holds a sample point of some pixel, offset by one of `offsets`. Never false wrongly.
    static bool may_hold_sample(const SampleBox& box, const SampleBox& offsets);

    /// Calls visit(tile index) for every active tile of which the triangle may cover a sample, row by row; stops when it returns false.
    /// Exact edge functions over the tile's box of sample points decide, or the triangle's own box where it meets one tile only.
    template <class Visit>
    void for_each_touched(const SetupTriangle& triangle, Visit&& visit) const;

  private:
    struct Range {
        int first, last;
    };
    /// Tiles along one axis whose sample points, at offsets [first_offset, last_offset] of their pixels, reach into [low, high].
    Range tiles_over(int64_t low, int64_t high, int64_t first_offset, int64_t last_offset, Range active, int extent) const;
    SampleBox tile_box(int tile_x, int tile_y) const;

    int tile_size_, width_, height_;
    int tiles_x_, tiles_y_;
    int first_x_, last_x_, first_y_, last_y_;
    SampleBox support_, reach_, sample_box_;
};

template <class Visit>
void TileGrid::for_each_touched(const SetupTriangle& triangle, Visit&& visit) const {
    const SampleBox box = bounds_of(triangle);
    const Range columns = tiles_over(box.x_min, box.x_max, reach_.x_min, reach_.x_max, {first_x_, last_x_}, width_);
    const Range rows = tiles_over(box.y_min, box.y_max, reach_.y_min, reach_.y_max, {first_y_, last_y_}, height_);
    const bool single = columns.first == columns.last && rows.first == rows.last;
    const Edge edges[3] = {edge_of(triangle, 0), edge_of(triangle, 1), edge_of(triangle, 2)};
    for (int y = rows.first; y <= rows.last; ++y) {
        for (int x = columns.first; x <= columns.last; ++x) {
            const SampleBox tile = tile_box(x, y);
            const auto misses = [&](const Edge& edge) { return edge.constant + greatest_over(edge, tile) < 0; };
            if (!single && std::any_of(edges, edges + 3, misses)) continue;
            if (!visit(size_t(y) * size_t(tiles_x_) + size_t(x))) return;
        }
    }
}

}  // namespace rawtexel::raster
