#include "shading/adaptive_blocks.h"

#include <algorithm>
#include <bit>
#include <cassert>

namespace rawtexel::shading {
namespace {

using texunit::kWaveHeight;
using texunit::kWaveLanes;
using texunit::kWaveWidth;

constexpr int kRadiancePlanes = 3;

}  // namespace

AdaptiveBlocks::AdaptiveBlocks(int tile_size, int planes, double error)
    : tile_size_(tile_size), blocks_x_(tile_size / kAdaptiveBlock), planes_(planes), error_(error) {
    assert(tile_size % kAdaptiveBlock == 0 && blocks_x_ * blocks_x_ <= 64 && planes >= kRadiancePlanes && error > 0);
    for (int y = 0; y < tile_size; y += kWaveHeight)
        for (int x = 0; x < tile_size; x += kWaveWidth)
            block_of_wave_.push_back(uint8_t(y / kAdaptiveBlock * blocks_x_ + x / kAdaptiveBlock));
    mean_.resize(kRadiancePlanes * pixels());
    squares_.resize(mean_.size());
    stopped_sums_.resize(size_t(planes) * pixels());
    stopped_at_.resize(size_t(blocks_x_ * blocks_x_));
}

void AdaptiveBlocks::begin_tile(const PixelRect& shown) {
    shown_ = shown;
    samples_ = 0;
    std::fill(mean_.begin(), mean_.end(), 0.0);
    std::fill(squares_.begin(), squares_.end(), 0.0);
    active_ = 0;
    for (int block = 0; block < blocks_x_ * blocks_x_; ++block) {
        const int x = block % blocks_x_ * kAdaptiveBlock, y = block / blocks_x_ * kAdaptiveBlock;
        const bool seen = x < shown.x1 && y < shown.y1 && x + kAdaptiveBlock > shown.x0 && y + kAdaptiveBlock > shown.y0;
        active_ |= uint64_t{seen} << block;
        stopped_at_[size_t(block)] = 0;
    }
}

void AdaptiveBlocks::add(std::span<const texunit::WaveFloat> sample) {
    ++samples_;
    const double share = 1.0 / samples_;
    const size_t waves = block_of_wave_.size();
    for (size_t wave = 0; wave < kRadiancePlanes * waves; ++wave) {
        if (!takes_samples(wave % waves)) continue;
        double* const mean = &mean_[wave * kWaveLanes];
        double* const squares = &squares_[wave * kWaveLanes];
        for (int lane = 0; lane < kWaveLanes; ++lane) {
            const double value = double(sample[wave].lane[lane]), before = value - mean[lane];
            mean[lane] += before * share;
            squares[lane] += before * (value - mean[lane]);
        }
    }
}

bool AdaptiveBlocks::has_converged(int block) const {
    const int left = block % blocks_x_ * kAdaptiveBlock, top = block / blocks_x_ * kAdaptiveBlock;
    const int x0 = std::max(left, shown_.x0), x1 = std::min(left + kAdaptiveBlock, shown_.x1);
    const int y0 = std::max(top, shown_.y0), y1 = std::min(top + kAdaptiveBlock, shown_.y1);
    double sum = 0;
    for (int channel = 0; channel < kRadiancePlanes; ++channel) {
        for (int y = y0; y < y1; ++y) {
            for (int x = x0; x < x1; ++x) {
                const int wave = y / kWaveHeight * (tile_size_ / kWaveWidth) + x / kWaveWidth;
                const int lane = y % kWaveHeight * kWaveWidth + x % kWaveWidth;
                sum += squares_[size_t(channel) * pixels() + size_t(wave * kWaveLanes + lane)];
            }
        }
    }
    const double values = double(kRadiancePlanes) * (x1 - x0) * (y1 - y0);
    // Not so where anything is no number.
    return sum / values / (samples_ - 1) / samples_ < error_ * error_;
}

void AdaptiveBlocks::stop(int block, const SampleTree& sums) {
    active_ &= ~(uint64_t{1} << block);
    stopped_at_[size_t(block)] = samples_;
    for (size_t wave = 0; wave < block_of_wave_.size(); ++wave) {
        if (block_of_wave_[wave] != block) continue;
        for (size_t plane = 0; plane < size_t(planes_); ++plane) {
            const size_t first = plane * pixels() + wave * kWaveLanes;
            sums.sum(first, std::span(stopped_sums_).subspan(first, kWaveLanes));
        }
    }
}

void AdaptiveBlocks::decide(const SampleTree& sums) {
    assert(samples_ >= 2 && sums.samples() == uint64_t(samples_));
    for (uint64_t rest = active_; rest != 0; rest &= rest - 1) {
        const int block = std::countr_zero(rest);
        if (has_converged(block)) stop(block, sums);
    }
}

/// Calls put(first entry, samples) for every wave that has stopped.
template <class Put>
void AdaptiveBlocks::for_each_stopped(const Put& put) const {
    for (size_t wave = 0; wave < block_of_wave_.size(); ++wave) {
        const int samples = stopped_at_[block_of_wave_[wave]];
        if (samples > 0) put(wave * kWaveLanes, samples);
    }
}

void AdaptiveBlocks::put_sums(size_t first, std::span<double> sums) const {
    for_each_stopped([&](size_t entry, int) { std::copy_n(&stopped_sums_[first + entry], kWaveLanes, &sums[entry]); });
}

void AdaptiveBlocks::put_means(size_t first, std::span<float> means) const {
    for (size_t plane = 0; plane < means.size(); plane += pixels()) {
        for_each_stopped([&](size_t entry, int samples) {
            const double* const sum = &stopped_sums_[first + plane + entry];
            std::transform(sum, sum + kWaveLanes, &means[plane + entry], [&](double value) { return float(value / samples); });
        });
    }
}

void AdaptiveBlocks::put_counts(std::span<float> counts) const {
    for_each_stopped([&](size_t entry, int samples) { std::fill_n(&counts[entry], kWaveLanes, float(samples)); });
}

}  // namespace rawtexel::shading
