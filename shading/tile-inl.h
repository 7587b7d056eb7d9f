// The tile kernel: for each sample, visibility -> shading, wave by wave -> sum.
#if defined(RAWTEXEL_SHADING_TILE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_SHADING_TILE_INL_H_
#undef RAWTEXEL_SHADING_TILE_INL_H_
#else
#define RAWTEXEL_SHADING_TILE_INL_H_
#endif

#include "raster/visibility-inl.h"
#include "shading/coverage-inl.h"
#include "shading/demanded_lookups-inl.h"
#include "shading/tile.h"
#include "shading/wave_shader-inl.h"

#include <algorithm>
#include <bit>
#include <chrono>
#include <optional>

HWY_BEFORE_NAMESPACE();
namespace rawtexel::shading {
namespace HWY_NAMESPACE {

class TileRenderer {
  public:
    TileRenderer(const TileInputs& inputs, int tile_x, int tile_y, TileScratch& scratch)
        : inputs_(inputs),
          frame_(*inputs.frame),
          scratch_(scratch),
          tile_x_(tile_x),
          tile_y_(tile_y),
          tile_size_(frame_.options().tile_size),
          waves_x_(tile_size_ / texunit::kWaveWidth),
          tested_(scratch.listener && inputs.fetch_model == FetchModel::Quad ? whole_quads(inputs.visible, frame_.options())
                                                                             : inputs.visible),
          coverage_(inputs, tested_),
          waves_(inputs, tile_x * tile_size_, tile_y * tile_size_, scratch) {}

    void render() {
        using Clock = std::chrono::steady_clock;
        find_sequence_shifts();
        scratch_.sums.clear();
        if (scratch_.adaptive) scratch_.adaptive->begin_tile(shown_pixels());
        std::optional<DemandedLookups> demanded;
        if (listens()) {
            demanded.emplace(inputs_, tile_x_, tile_y_, scratch_);
            scratch_.listener->begin_tile(tile_x_, tile_y_);
        }
        for (uint32_t k = 0; k < uint32_t(inputs_.spp); ++k) {
            if (scratch_.adaptive && !scratch_.adaptive->any_takes_samples()) break;
            const uint32_t sample = inputs_.first_sample + k;
            const auto start = Clock::now();
            find_offsets(sample);
            find_visible(sample);
            const auto drawn = Clock::now();
            shade_sample(sample);
            if (demanded) demanded->tell_sample(sample, frame_offset_);
            if (scratch_.adaptive) scratch_.adaptive->add(scratch_.sample);
            scratch_.sums.take(sample, scratch_.sample);
            if (scratch_.adaptive) judge_samples(k + 1);
            scratch_.totals.raster_s += std::chrono::duration<double>(drawn - start).count();
            scratch_.totals.shade_s += std::chrono::duration<double>(Clock::now() - drawn).count();
        }
        if (listens()) scratch_.listener->end_tile();
    }

  private:
    bool listens() const { return scratch_.listener != nullptr; }
    bool watched() const { return scratch_.fragment_listener != nullptr; }
    /// Of the tile; may be none.
    PixelRect shown_pixels() const {
        const PixelRect& shown = inputs_.visible;
        const int left = tile_x_ * tile_size_, top = tile_y_ * tile_size_;
        return {std::max(shown.x0 - left, 0), std::max(shown.y0 - top, 0), std::min(shown.x1 - left, tile_size_),
                std::min(shown.y1 - top, tile_size_)};
    }
    bool takes_samples(size_t wave) const { return !scratch_.adaptive || scratch_.adaptive->takes_samples(wave); }
    size_t wave_of(const raster::CandidateWave& candidate) const {
        return wave_at(candidate.x - tile_x_ * tile_size_, candidate.y - tile_y_ * tile_size_);
    }

    /// After `count` samples.
    HWY_NOINLINE void judge_samples(uint32_t count) {
        const bool decides = count >= uint32_t(kFirstAdaptiveDecision) && std::has_single_bit(count);
        if (decides && count < uint32_t(inputs_.spp)) scratch_.adaptive->decide(scratch_.sums);
    }

    void find_sequence_shifts() {
        if (inputs_.pixel_jitter != PixelJitter::Pixel) return;
        for (int y = 0, i = 0; y < tile_size_; ++y)
            for (int x = 0; x < tile_size_; ++x, ++i)
                scratch_.shifts[size_t(i)] = sequence_shift(inputs_.pixel_jitter, uint32_t(tile_x_ * tile_size_ + x),
                                                            uint32_t(tile_y_ * tile_size_ + y), inputs_.seed);
    }

    void find_offsets(uint32_t sample) {
        const PixelFilter filter = inputs_.pixel_filter;
        if (inputs_.pixel_jitter == PixelJitter::Pixel) {
            for (size_t i = 0; i < scratch_.offsets.size(); ++i)
                scratch_.offsets[i] = sample_offset(filter, PixelJitter::Pixel, sample, scratch_.shifts[i]);
        } else {
            frame_offset_ = sample_offset(filter, PixelJitter::Frame, sample, sequence_shift(PixelJitter::Frame, 0, 0, inputs_.seed));
        }
    }

    void find_visible(uint32_t sample) {
        scratch_.visibility.may_leave_blocks = !listens() && !watched();
        if (inputs_.skip_empty_tiles && frame_.bin(tile_x_, tile_y_).empty()) {
            if (sample == inputs_.first_sample) scratch_.visibility.reset(tile_size_);
            scratch_.candidates.clear();
            return;
        }
        const bool per_pixel = inputs_.pixel_jitter == PixelJitter::Pixel;
        const raster::TileSamples samples{frame_offset_, per_pixel ? scratch_.offsets.data() : nullptr};
        coverage_.begin_sample(sample);
        if (listens() || watched()) {
            scratch_.candidates.clear();
            scratch_.candidates.keeps_opaque = listens() && inputs_.fetch_model != FetchModel::Visible;
            raster::HWY_NAMESPACE::tile_visibility(frame_, tile_x_, tile_y_, samples, ToldCoverage{*this, sample}, scratch_.visibility);
        } else {
            const auto cover = [this](const raster::CandidateWave& candidate)
                                   HWY_ATTR { return takes_samples(wave_of(candidate)) ? coverage_.cover(candidate) : 0u; };
            raster::HWY_NAMESPACE::tile_visibility(frame_, tile_x_, tile_y_, samples, cover, scratch_.visibility);
        }
        scratch_.totals.hiz_rejected += scratch_.visibility.hiz_rejected;
    }

    /// The tile's coverage, which also writes down or tells whom it was asked about.
    struct ToldCoverage {
        TileRenderer& tile;
        uint32_t sample;
        uint32_t operator()(const raster::CandidateWave& candidate) {
            if (!tile.takes_samples(tile.wave_of(candidate))) return 0;
            const uint32_t covered = tile.coverage_.cover(candidate);
            if (tile.listens()) tile.log(candidate, covered);
            if (tile.watched()) tile.tell_judged(candidate, covered, sample);
            return covered;
        }
        void opaque(const raster::CandidateWave& candidate) {
            if (tile.scratch_.candidates.keeps_opaque) tile.log(candidate, candidate.mask);
        }
    };

    void log(const raster::CandidateWave& candidate, WaveMask covered) {
        const WaveMask lanes = candidate.mask & lanes_inside(tested_, candidate.x, candidate.y);
        scratch_.candidates.add(candidate, uint32_t(wave_of(candidate)), lanes, covered & lanes);
    }

    void tell_judged(const raster::CandidateWave& candidate, WaveMask covered, uint32_t sample) {
        const WaveMask lanes = candidate.mask & lanes_inside(inputs_.visible, candidate.x, candidate.y);
        if (lanes == 0) return;
        scratch_.fragment_listener->judged({.block = {candidate.x, candidate.y, sample, lanes},
                                            .draw = &inputs_.draws[candidate.triangle->draw],
                                            .triangle = candidate.triangle,
                                            .setup_index = candidate.setup_index,
                                            .covered = covered & lanes,
                                            .depth = candidate.depth,
                                            .alpha = &coverage_.alpha(),
                                            .base_color = &coverage_.coordinates(*inputs_.draws[candidate.triangle->draw].material)});
    }

    /// Index of the wave whose upper left pixel is (x, y) of the tile.
    size_t wave_at(int x, int y) const { return size_t(y / texunit::kWaveHeight * waves_x_ + x / texunit::kWaveWidth); }

    void shade_sample(uint32_t sample) {
        waves_.begin_sample(sample, frame_offset_);
        for (int y = 0; y < tile_size_; y += texunit::kWaveHeight) {
            for (int x = 0; x < tile_size_; x += texunit::kWaveWidth) {
                const size_t wave = wave_at(x, y);
                if (takes_samples(wave)) waves_.shade(x, y, wave);
            }
        }
    }

    const TileInputs& inputs_;
    const raster::Frame& frame_;
    TileScratch& scratch_;
    int tile_x_, tile_y_, tile_size_, waves_x_;
    PixelRect tested_;  ///< whose fragments are asked whether they cover
    AlphaCoverage coverage_;
    WaveShader waves_;
    raster::SampleOffset frame_offset_{};  ///< of all pixels, where each has not its own
};

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::shading
HWY_AFTER_NAMESPACE();
#endif
