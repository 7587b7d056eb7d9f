#include "raster/tile_grid.h"

#include <cassert>
#include <cmath>

namespace rawtexel::raster {

namespace {

constexpr int64_t kCentre = kSampleOne / 2;

int64_t floor_divide(int64_t a, int64_t b) { return a >= 0 ? a / b : -((b - 1 - a) / b); }

/// Whether some pixel's range of sample points along one axis meets [low, high].
bool meets_samples(int64_t low, int64_t high, int64_t first_offset, int64_t last_offset) {
    const int64_t first_pixel = floor_divide(low - last_offset + kSampleOne - 1, kSampleOne);
    return first_pixel * kSampleOne + first_offset <= high;
}

}  // namespace

TileGrid::TileGrid(const FrameOptions& options) : tile_size_(options.tile_size), width_(options.width), height_(options.height) {
    assert(width_ >= 1 && width_ <= kMaxFrameExtent && height_ >= 1 && height_ <= kMaxFrameExtent);
    assert(tile_size_ > 0 && tile_size_ % kBlockWidth == 0);
    assert(options.filter_radius >= 0.0f && options.filter_radius <= float(kMostFilterRadius));
    const int64_t radius = int64_t(std::ceil(double(options.filter_radius) * kSampleOne));
    support_ = {kCentre - radius, kCentre + radius, kCentre - radius, kCentre + radius};
    reach_ = support_;
    if (options.reach) {
        reach_ = {options.reach->x_min, options.reach->x_max, options.reach->y_min, options.reach->y_max};
        assert(support_.x_min <= reach_.x_min && reach_.x_min <= reach_.x_max && reach_.x_max <= support_.x_max);
        assert(support_.y_min <= reach_.y_min && reach_.y_min <= reach_.y_max && reach_.y_max <= support_.y_max);
    }
    tiles_x_ = (width_ + tile_size_ - 1) / tile_size_;
    tiles_y_ = (height_ + tile_size_ - 1) / tile_size_;

    const bool whole = options.crop_width <= 0 || options.crop_height <= 0;
    const int x0 = whole ? 0 : std::clamp(options.crop_x, 0, width_ - 1);
    const int y0 = whole ? 0 : std::clamp(options.crop_y, 0, height_ - 1);
    const int x1 = whole ? width_ : std::clamp(options.crop_x + options.crop_width, x0 + 1, width_);
    const int y1 = whole ? height_ : std::clamp(options.crop_y + options.crop_height, y0 + 1, height_);
    first_x_ = x0 / tile_size_;
    first_y_ = y0 / tile_size_;
    last_x_ = (x1 - 1) / tile_size_;
    last_y_ = (y1 - 1) / tile_size_;

    const SampleBox first = tile_box(first_x_, first_y_), last = tile_box(last_x_, last_y_);
    sample_box_ = {first.x_min, last.x_max, first.y_min, last.y_max};
}

SampleBox TileGrid::tile_box(int tile_x, int tile_y) const {
    const int x0 = tile_x * tile_size_, y0 = tile_y * tile_size_;
    const int x1 = std::min(x0 + tile_size_, width_) - 1, y1 = std::min(y0 + tile_size_, height_) - 1;
    const auto at = [](int pixel, int64_t offset) { return int64_t{pixel} * kSampleOne + offset; };
    return {at(x0, reach_.x_min), at(x1, reach_.x_max), at(y0, reach_.y_min), at(y1, reach_.y_max)};
}

bool TileGrid::may_hold_sample(const SampleBox& box, const SampleBox& offsets) {
    return meets_samples(box.x_min, box.x_max, offsets.x_min, offsets.x_max) &&
           meets_samples(box.y_min, box.y_max, offsets.y_min, offsets.y_max);
}

TileGrid::Range TileGrid::tiles_over(int64_t low, int64_t high, int64_t first_offset, int64_t last_offset, Range active, int extent) const {
    const int64_t tile = int64_t{tile_size_} * kSampleOne;
    const int64_t first_pixel = floor_divide(low - last_offset + kSampleOne - 1, kSampleOne);
    const int64_t last_pixel = std::min(floor_divide(high - first_offset, kSampleOne), int64_t{extent} - 1);
    if (first_pixel > last_pixel || last_pixel < 0) return {0, -1};
    const int64_t first = std::max(floor_divide(first_pixel * kSampleOne, tile), int64_t{active.first});
    const int64_t last = std::min(floor_divide(last_pixel * kSampleOne, tile), int64_t{active.last});
    return {int(first), int(last)};
}

}  // namespace rawtexel::raster
