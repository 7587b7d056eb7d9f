#include "shading/fetch_account.h"

#include "texunit/fetch_trace.h"

#include <cassert>

namespace rawtexel::shading {
namespace {

bool is_asked(PixelCount count, const FetchOptions& options) {
    switch (count) {
        case PixelCount::TexelsRequested: return options.pixel_texels || options.pixel_layers;
        case PixelCount::LinesPixel: return options.pixel_lines || options.pixel_layers;
        case PixelCount::L1Miss:
        case PixelCount::L2Miss: return options.pixel_layers && options.cache;
        default: return options.pixel_layers;
    }
}

}  // namespace

FetchAccount::FetchAccount(const Scene& scene, const FetchOptions& options, const PixelRect& visible, int tile_size, int frame_width)
    : options_(options),
      visible_(visible),
      tile_size_(tile_size),
      frame_columns_((frame_width + tile_size - 1) / tile_size),
      tiles_(visible, tile_size),
      set_(scene),
      frame_(std::make_unique<FrameFetches>(set_)),
      sequencer_([this](int64_t tile, const texunit::FetchStream& stream) { consume(tile, stream); }) {
    assert(!options.needs_order() || tile_size == kCanonicalTile);
    frame_->pixels = make_pixels();
    if (!options.needs_order()) return;
    replay_.emplace(set_.textures, options.cache);
    if (options.trace) options.trace->begin(set_.textures);
}

std::vector<Image> FetchAccount::make_pixels() const {
    if (!options_.pixel_texels && !options_.pixel_lines && !options_.pixel_layers) return {};
    std::vector<Image> pixels(kPixelCounts);
    for (int i = 0; i < kPixelCounts; ++i) {
        if (is_asked(PixelCount(i), options_)) pixels[size_t(i)] = Image(visible_.x1 - visible_.x0, visible_.y1 - visible_.y0, 1);
    }
    return pixels;
}

LookupListener& FetchAccount::add_worker() {
    const auto hand_in = [this](int tile_x, int tile_y, texunit::FetchStream& stream) {
        sequencer_.hand_in(int64_t(tile_y - tiles_.y0) * tiles_.columns + (tile_x - tiles_.x0), stream);
    };
    const std::lock_guard lock(workers_mutex_);
    return *workers_.emplace_back(std::make_unique<FetchTally>(set_, options_, visible_, tile_size_, frame_->pixels, hand_in));
}

int64_t FetchAccount::begin_tile(int64_t index) { return options_.needs_order() ? sequencer_.next_tile() : index; }

void FetchAccount::end_tile(int64_t tile) {
    if (options_.needs_order()) sequencer_.finish(tile);
}

void FetchAccount::abandon() { sequencer_.abandon(); }

void FetchAccount::consume(int64_t tile, const texunit::FetchStream& stream) {
    const auto number = uint64_t(tiles_.y(tile)) * uint64_t(frame_columns_) + uint64_t(tiles_.x(tile));
    replay_->replay(stream, number, costs_);
    if (options_.trace) options_.trace->add(stream, replay_->addresses());
    if (!options_.pixel_layers) return;
    for (size_t i = 0; i < costs_.size(); ++i) {
        const texunit::PixelFetches& at = stream.pixels[i];
        const auto add = [&](PixelCount count, uint32_t cost) {
            Image& image = frame_->pixels[size_t(count)];
            if (image.width > 0) *image.pixel(at.x - visible_.x0, at.y - visible_.y0) += float(cost);
        };
        add(PixelCount::LinesFirst, costs_[i].lines_first);
        add(PixelCount::BlocksFirst, costs_[i].blocks_first);
        add(PixelCount::L1Miss, costs_[i].l1_misses);
        add(PixelCount::L2Miss, costs_[i].l2_misses);
    }
}

std::unique_ptr<FrameFetches> FetchAccount::take() {
    for (const std::unique_ptr<FetchTally>& worker : workers_) worker->add_to(*frame_);
    if (replay_) frame_->cache = replay_->cache_counts();
    return std::move(frame_);
}

}  // namespace rawtexel::shading
