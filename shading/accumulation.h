// Sums of samples as fixed trees: the same bits whatever is summed apart, on however many threads or machines.
#pragma once

#include "texunit/wave.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace rawtexel::shading {

/// Sums vectors of `width` values, one vector per sample. The sum over an aligned range [k 2^l, (k+1) 2^l) of samples is the sum of its
/// left half plus the sum of its right half, in float up to 16 samples and in double above. Any set of samples is held as the fewest
/// aligned ranges that cover it, so it has one representation, and sums made apart merge to the bits of a sum made in one go.
class SampleTree {
  public:
    static constexpr int kFloatLevels = 4;  ///< ranges of up to 2^4 samples are sums of floats

    explicit SampleTree(size_t width) : width_(width) {}

    size_t width() const { return width_; }
    /// Samples held.
    uint64_t samples() const;

    /// Forgets all samples; keeps the memory.
    void clear();
    /// Adds one sample that is not held yet (asserted); `values` has `width` entries.
    void add(uint64_t sample, std::span<const float> values);
    /// The same for whole waves, width()/32 of them: takes their memory and leaves other waves in its place, of no meaning.
    void take(uint64_t sample, std::vector<texunit::WaveFloat>& waves);
    /// Adds the samples of `other`, none of which is held yet (asserted): their first width() entries, where they have more.
    void merge(const SampleTree& other);

    /// Sum of entries [first, first + sum.size()) over all samples: the ranges added in double from the last to the first.
    void sum(size_t first, std::span<double> sum) const;
    /// The same divided by samples(), rounded to float. At least one sample is held (asserted).
    void mean(size_t first, std::span<float> mean) const;

    /// Sums whose mean is sum*share, to the bit.
    struct ScaledSums {
        std::span<const float> sum;
        float share;
    };
    /// Those of all entries, where one sum of floats holds all samples.
    std::optional<ScaledSums> scaled_sums() const;

  private:
    using Waves = std::vector<texunit::WaveFloat>;

    /// Sum of the 2^level samples from `first` on; one of the two arrays is in use.
    struct Range {
        uint64_t first = 0;
        int level = 0;
        Waves low;  ///< level <= kFloatLevels; the last wave may hold more than the sum
        std::vector<double> high;
    };

    bool are_siblings(const Range& left, const Range& right) const;
    void combine(Range& left, Range& right);
    void insert(Range range);
    bool ends_pair(uint64_t sample) const;
    void add_right_half(std::span<const float> values);
    std::span<const float> low_of(const Range& range) const;
    Waves free_waves();
    Range copy_of(uint64_t first, int level, std::span<const float> low, std::span<const double> high);
    void recycle(Range& range);

    size_t width_;
    std::vector<Range> ranges_;    ///< in the order of their samples
    std::vector<Waves> free_low_;  ///< memory of ranges that are gone
    std::vector<std::vector<double>> free_high_;
};

}  // namespace rawtexel::shading
