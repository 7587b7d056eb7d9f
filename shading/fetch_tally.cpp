#include "shading/fetch_tally.h"

#include "texunit/footprint.h"

#include <algorithm>
#include <bit>

namespace rawtexel::shading {
namespace {

constexpr int kLineBytes = 64;

}  // namespace

FetchTally::FetchTally(const TextureSet& set, const FetchOptions& options, const PixelRect& visible, int tile_size,
                       std::vector<Image>& pixels, HandIn hand_in)
    : set_(set),
      options_(options),
      visible_(visible),
      tile_size_(tile_size),
      pixels_(pixels),
      hand_in_(std::move(hand_in)),
      counts_(set.textures.size()),
      touched_(set.texels()) {}

void FetchTally::begin_tile(int tile_x, int tile_y) {
    tile_x_ = tile_x;
    tile_y_ = tile_y;
    if (!sums_pixels()) return;
    sums_.assign(size_t(tile_size_) * size_t(tile_size_), {});
    lines_.clear();
}

void FetchTally::begin_wave(const ListenedWave& wave) {
    wave_ = wave;
    if (records()) recorder_.begin_wave(wave.x, wave.y, wave.sample);
    if (sums_pixels()) wave_texels_ = {};
}

texunit::FetchCounter FetchTally::counter_of(size_t place) {
    texunit::FetchCounter counter;
    counter.counts = &counts_[place];
    counter.touched = touched_.bits(place);
    counter.pixel = sums_pixels() ? &wave_texels_ : nullptr;
    return counter;
}

void FetchTally::lookup(const ListenedLookup& lookup) {
    const uint32_t place = set_.place[lookup.map->texture_index];
    texunit::FetchCounter counter = counter_of(place);
    texunit::WaveFloat lod;
    const texunit::Wave<uint32_t> before = wave_texels_;
    count_wave(*lookup.map->texture, lookup.map->sampler, *lookup.at, lookup.lanes, counter, options_.pixel_layers ? &lod : nullptr);
    if (records()) {
        recorder_.set_texture(place);
        record_wave(*lookup.map->texture, lookup.map->sampler, *lookup.at, lookup.lanes, recorder_);
    }
    if (!options_.pixel_layers) return;
    measure(lookup, lod);
    for (texunit::WaveMask rest = lookup.lanes; rest != 0; rest &= rest - 1) {
        const int lane = std::countr_zero(rest);
        histograms_.add_texels(wave_texels_[lane] - before[lane]);
    }
}

void FetchTally::drawn(const ListenedDraw& draw) {
    const ListenedLookup& lookup = draw.lookup;
    const uint32_t place = set_.place[lookup.map->texture_index];
    const texunit::Texture& texture = *lookup.map->texture;
    texunit::FetchCounter counter = counter_of(place);
    const texunit::Wave<uint32_t> before = wave_texels_;
    count_drawn_wave(texture, *draw.draw, lookup.lanes, draw.first, counter);
    if (records()) {
        recorder_.set_texture(place);
        record_drawn_wave(texture, *draw.draw, lookup.lanes, draw.first, recorder_);
    }
    if (!options_.pixel_layers) return;
    add_drawn_texels(draw, before);
    if (!draw.first) return;
    texunit::WaveFloat lod;
    texunit::FetchCounts unused;
    texunit::FetchCounter measured{.counts = &unused};
    count_wave(*lookup.map->texture, lookup.map->sampler, *lookup.at, lookup.lanes, measured, &lod);
    measure(lookup, lod);
}

void FetchTally::add_drawn_texels(const ListenedDraw& draw, const texunit::Wave<uint32_t>& before) {
    DrawnLookup& drawn = drawn_[size_t(draw.lookup.slot)];
    if (draw.first) {
        end_drawn(drawn);
        drawn.lanes = draw.lookup.lanes;
    }
    for (int lane = 0; lane < texunit::kWaveLanes; ++lane) drawn.texels[lane] += wave_texels_[lane] - before[lane];
}

void FetchTally::end_drawn(DrawnLookup& drawn) {
    for (texunit::WaveMask rest = drawn.lanes; rest != 0; rest &= rest - 1) histograms_.add_texels(drawn.texels[std::countr_zero(rest)]);
    drawn = {};
}

void FetchTally::end_all_drawn() {
    for (DrawnLookup& drawn : drawn_)
        if (drawn.lanes != 0) end_drawn(drawn);
}

void FetchTally::measure(const ListenedLookup& lookup, const texunit::WaveFloat& lod) {
    texunit::WaveFootprint footprint;
    measure_footprint(lookup.map->texture->levels(), lookup.map->sampler, *lookup.at, footprint);
    for (texunit::WaveMask rest = lookup.lanes; rest != 0; rest &= rest - 1) {
        const int lane = std::countr_zero(rest);
        PixelSums& sums = sums_[pixel(lane)];
        sums.level += double(lod[lane]);
        sums.anisotropy += double(footprint.anisotropy[lane]);
        ++sums.lookups;
        histograms_.add_lookup(lod[lane], footprint.anisotropy[lane]);
    }
}

size_t FetchTally::pixel(int lane) const {
    const int x = wave_.x - tile_x_ * tile_size_ + lane % texunit::kWaveWidth;
    const int y = wave_.y - tile_y_ * tile_size_ + lane / texunit::kWaveWidth;
    return size_t(y) * size_t(tile_size_) + size_t(x);
}

void FetchTally::end_wave() {
    end_all_drawn();
    if (sums_pixels()) sum_pixels_of_wave();
    if (options_.needs_order()) recorder_.end_wave(stream_);
}

void FetchTally::sum_pixels_of_wave() {
    for (int lane = 0; lane < texunit::kWaveLanes; ++lane) {
        PixelSums& sums = sums_[pixel(lane)];
        sums.texels += wave_texels_[lane];
        sums.samples += wave_.surface >> lane & 1;
        if (!records()) continue;
        for (const texunit::TexelFetch fetch : recorder_.fetches(lane)) {
            const auto bytes = uint64_t(bytes_per_texel(set_.textures[fetch.texture()]->texel_layout().storage));
            const auto line = uint32_t(uint64_t(uint32_t(fetch.texel())) * bytes / kLineBytes);
            sums.lines += lines_.add(uint32_t(pixel(lane)), fetch.texture(), line);
        }
    }
}

void FetchTally::end_sample() {
    if (options_.needs_order()) hand_in_(tile_x_, tile_y_, stream_);
}

void FetchTally::end_tile() {
    if (!sums_pixels()) return;
    const auto put = [&](PixelCount count, int x, int y, float value) {
        Image& image = pixels_[size_t(count)];
        if (image.width > 0) *image.pixel(x - visible_.x0, y - visible_.y0) = value;
    };
    const int x0 = tile_x_ * tile_size_, y0 = tile_y_ * tile_size_;
    for (int y = std::max(y0, visible_.y0); y < std::min(y0 + tile_size_, visible_.y1); ++y) {
        for (int x = std::max(x0, visible_.x0); x < std::min(x0 + tile_size_, visible_.x1); ++x) {
            const PixelSums& sums = sums_[size_t(y - y0) * size_t(tile_size_) + size_t(x - x0)];
            const double lookups = std::max(sums.lookups, 1u);
            put(PixelCount::TexelsRequested, x, y, float(sums.texels));
            put(PixelCount::LinesPixel, x, y, float(sums.lines));
            put(PixelCount::Level, x, y, float(sums.level / lookups));
            put(PixelCount::Anisotropy, x, y, float(sums.anisotropy / lookups));
            put(PixelCount::Samples, x, y, float(sums.samples));
        }
    }
}

void FetchTally::add_to(FrameFetches& frame) const {
    for (size_t i = 0; i < counts_.size(); ++i) frame.counts[i] += counts_[i];
    frame.touched.merge(touched_);
    frame.histograms += histograms_;
}

}  // namespace rawtexel::shading
