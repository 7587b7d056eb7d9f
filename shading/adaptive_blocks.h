// Adaptive sampling: blocks of pixels whose mean is known well enough take no more samples.
#pragma once

#include "shading/accumulation.h"
#include "shading/pixel_rect.h"
#include "texunit/wave.h"

#include <cstdint>
#include <span>
#include <vector>

namespace rawtexel::shading {

inline constexpr int kAdaptiveBlock = 16;          ///< pixels along either side, aligned in the frame: every tile holds whole blocks
inline constexpr int kFirstAdaptiveDecision = 16;  ///< samples; decided again at 2, 4, 8 ... times as many

/// One worker's: which blocks of the tile at hand still take samples. A block stops when the standard error of its pixels' means, the root
/// mean square over its pixels and channels of s/sqrt(n), is below the error asked for; s is the standard deviation of the n samples, which
/// overrates the error of samples that are more even than chance. What has stopped keeps the bits of a frame of so many samples. Stopping
/// by what was seen is not unbiased: a block whose rare bright samples are late stops without them (docs/performance.md).
class AdaptiveBlocks {
  public:
    /// `planes`: of a sample; radiance is the first three. `error` > 0, of linear radiance.
    AdaptiveBlocks(int tile_size, int planes, double error);

    /// A tile, of which the pixels of `shown` are rendered; relative to the tile.
    void begin_tile(const PixelRect& shown);
    /// Whether the pixels of wave `wave` of the tile, row by row, take samples.
    bool takes_samples(size_t wave) const { return active_ >> block_of_wave_[wave] & 1; }
    bool any_takes_samples() const { return active_ != 0; }

    /// After each sample: its planes, wave by wave.
    void add(std::span<const texunit::WaveFloat> sample);
    /// At 16, 32, 64 ... samples: stops the blocks that have converged. `sums`: all samples so far.
    void decide(const SampleTree& sums);

    /// Sums, means and counts of the samples that blocks which have stopped took, in place of those that `sums` and their like hold; the
    /// first entry is the plane's `first`.
    void put_sums(size_t first, std::span<double> sums) const;
    void put_means(size_t first, std::span<float> means) const;
    void put_counts(std::span<float> counts) const;

  private:
    size_t pixels() const { return block_of_wave_.size() * texunit::kWaveLanes; }
    bool has_converged(int block) const;
    void stop(int block, const SampleTree& sums);
    template <class Put>
    void for_each_stopped(const Put& put) const;

    int tile_size_, blocks_x_, planes_;
    double error_;
    std::vector<uint8_t> block_of_wave_;
    uint64_t active_ = 0;  ///< bit b: block b, row by row
    PixelRect shown_{};
    int samples_ = 0;
    std::vector<double> mean_, squares_;  ///< of radiance: Welford's (1962), 3*pixels
    std::vector<double> stopped_sums_;    ///< planes*pixels
    std::vector<int> stopped_at_;         ///< samples, by block
};

}  // namespace rawtexel::shading
