// Weighted reservoir sampling of a stream: one item is held, with a probability in proportion to its weight, without knowing the sum of the
// weights beforehand (Chao 1982, "A general purpose unequal probability sampling plan").
#pragma once

#include "texunit/random.h"

#include <cassert>
#include <cmath>
#include <cstdint>

namespace rawtexel::texunit {

/// One uniform number serves the whole stream: after each choice it is stretched back to [0, 1), which uses up as many of its bits as the
/// choice was worth, -log2 of its probability. Before they run short fresh ones are hashed from its seed.
class StreamingReservoir {
  public:
    /// `bits`: 32 random ones (random_bits).
    explicit StreamingReservoir(uint32_t bits) : state_(bits) { refill(); }

    /// Offers an item of `weight`, finite and >= 0. Returns whether it is the one held from now on.
    bool offer(double weight) {
        assert(weight >= 0 && std::isfinite(weight));
        sum_ += weight;
        if (!(weight > 0)) return false;
        const double probability = weight / sum_;
        const bool taken = number_ < probability;
        const double chosen = taken ? probability : 1 - probability;
        number_ = taken ? number_ / probability : (number_ - probability) / chosen;
        budget_ += std::log2(chosen);
        if (budget_ < kLeastBits || !(number_ < 1)) refill();
        return taken;
    }

    double sum() const { return sum_; }  ///< of the weights offered so far

  private:
    static constexpr double kBits = 53, kLeastBits = 24;

    void refill() {
        const uint32_t high = mix_bits(state_ += kRandomStart), low = mix_bits(state_ += kRandomStart);
        number_ = double(uint64_t{high} << 21 | low >> 11) * 0x1p-53;
        budget_ = kBits;
    }

    uint32_t state_;
    double number_ = 0, budget_ = 0, sum_ = 0;
};

}  // namespace rawtexel::texunit
