#include "shading/accumulation.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <iterator>
#include <utility>

namespace rawtexel::shading {
namespace {

template <class T>
std::vector<T> latest_of(std::vector<std::vector<T>>& free) {
    if (free.empty()) return {};
    std::vector<T> memory = std::move(free.back());
    free.pop_back();
    return memory;
}

/// The values of all waves in a row. Not `data()->lane`, beyond whose 32 values compilers see no more.
float* values_of(std::vector<texunit::WaveFloat>& waves) { return reinterpret_cast<float*>(waves.data()); }
const float* values_of(const std::vector<texunit::WaveFloat>& waves) { return reinterpret_cast<const float*>(waves.data()); }

template <class T>
void add_to(T* left, std::span<const T> right) {
    for (size_t i = 0; i < right.size(); ++i) left[i] += right[i];
}

}  // namespace

uint64_t SampleTree::samples() const {
    uint64_t samples = 0;
    for (const Range& range : ranges_) samples += uint64_t(1) << range.level;
    return samples;
}

void SampleTree::clear() {
    for (Range& range : ranges_) recycle(range);
    ranges_.clear();
}

void SampleTree::add(uint64_t sample, std::span<const float> values) {
    assert(values.size() == width_);
    if (ends_pair(sample)) return add_right_half(values);
    insert(copy_of(sample, 0, values, {}));
}

void SampleTree::take(uint64_t sample, Waves& waves) {
    assert(waves.size() * size_t(texunit::kWaveLanes) == width_);
    if (ends_pair(sample)) return add_right_half({values_of(waves), width_});
    Range range{.first = sample, .level = 0, .low = free_waves(), .high = {}};
    range.low.swap(waves);
    insert(std::move(range));
}

/// The common case, a right half that follows its left half, needs no memory of its own.
bool SampleTree::ends_pair(uint64_t sample) const {
    return sample % 2 == 1 && !ranges_.empty() && ranges_.back().first == sample - 1 && ranges_.back().level == 0;
}

void SampleTree::add_right_half(std::span<const float> values) {
    Range left = std::move(ranges_.back());
    ranges_.pop_back();
    add_to(values_of(left.low), values);
    left.level = 1;
    insert(std::move(left));
}

std::span<const float> SampleTree::low_of(const Range& range) const {
    if (range.low.empty()) return {};
    return {values_of(range.low), width_};
}

SampleTree::Waves SampleTree::free_waves() {
    Waves waves = latest_of(free_low_);
    waves.resize((width_ + size_t(texunit::kWaveLanes) - 1) / size_t(texunit::kWaveLanes));
    return waves;
}

void SampleTree::merge(const SampleTree& other) {
    assert(other.width_ >= width_ && &other != this);
    for (const Range& range : other.ranges_) {
        const std::span<const float> low = other.low_of(range);
        insert(copy_of(range.first, range.level, low.first(std::min(width_, low.size())),
                       std::span(range.high).first(std::min(width_, range.high.size()))));
    }
}

bool SampleTree::are_siblings(const Range& left, const Range& right) const {
    const uint64_t samples = uint64_t(1) << left.level;
    return left.level == right.level && left.first % (2 * samples) == 0 && right.first == left.first + samples;
}

/// The sum of the two halves, in place of the left one.
void SampleTree::combine(Range& left, Range& right) {
    if (left.level < kFloatLevels) {
        add_to(values_of(left.low), low_of(right));
    } else if (left.level == kFloatLevels) {
        left.high = latest_of(free_high_);
        left.high.resize(width_);
        const std::span<const float> a = low_of(left), b = low_of(right);
        for (size_t i = 0; i < width_; ++i) left.high[i] = double(a[i]) + double(b[i]);
        free_low_.push_back(std::move(left.low));
        left.low.clear();
    } else {
        add_to(left.high.data(), std::span<const double>(right.high));
    }
    ++left.level;
    recycle(right);
}

void SampleTree::insert(Range range) {
    auto at = std::lower_bound(ranges_.begin(), ranges_.end(), range.first, [](const Range& r, uint64_t first) { return r.first < first; });
    assert(at == ranges_.end() || range.first + (uint64_t(1) << range.level) <= at->first);
    assert(at == ranges_.begin() || std::prev(at)->first + (uint64_t(1) << std::prev(at)->level) <= range.first);
    at = ranges_.insert(at, std::move(range));
    // Each completed range may complete its parent.
    for (;;) {
        if (at != ranges_.begin() && are_siblings(*std::prev(at), *at)) {
            --at;
        } else if (std::next(at) == ranges_.end() || !are_siblings(*at, *std::next(at))) {
            return;
        }
        combine(*at, *std::next(at));
        at = std::prev(ranges_.erase(std::next(at)));
    }
}

SampleTree::Range SampleTree::copy_of(uint64_t first, int level, std::span<const float> low, std::span<const double> high) {
    Range range{.first = first, .level = level, .low = {}, .high = {}};
    if (!low.empty()) {
        range.low = free_waves();
        std::copy(low.begin(), low.end(), values_of(range.low));
    } else {
        range.high = latest_of(free_high_);
        range.high.assign(high.begin(), high.end());
    }
    return range;
}

void SampleTree::recycle(Range& range) {
    if (range.low.capacity() > 0) free_low_.push_back(std::move(range.low));
    if (range.high.capacity() > 0) free_high_.push_back(std::move(range.high));
}

void SampleTree::sum(size_t first, std::span<double> sum) const {
    assert(first + sum.size() <= width_);
    std::fill(sum.begin(), sum.end(), 0.0);
    for (auto range = ranges_.rbegin(); range != ranges_.rend(); ++range) {
        if (range->level <= kFloatLevels) {
            const std::span<const float> low = low_of(*range);
            for (size_t i = 0; i < sum.size(); ++i) sum[i] += double(low[first + i]);
        } else {
            for (size_t i = 0; i < sum.size(); ++i) sum[i] += range->high[first + i];
        }
    }
}

std::optional<SampleTree::ScaledSums> SampleTree::scaled_sums() const {
    // A single range of floats holds a power of two of samples: the division is exact in float too.
    if (ranges_.size() != 1 || ranges_[0].level > kFloatLevels) return std::nullopt;
    return ScaledSums{low_of(ranges_[0]), float(1.0 / double(samples()))};
}

void SampleTree::mean(size_t first, std::span<float> mean) const {
    const auto count = double(samples());
    assert(count > 0);
    assert(first + mean.size() <= width_);
    if (const std::optional<ScaledSums> sums = scaled_sums()) {
        for (size_t i = 0; i < mean.size(); ++i) mean[i] = sums->sum[first + i] * sums->share;
        return;
    }
    // In pieces that stay in the first-level cache.
    std::array<double, 512> piece;
    for (size_t done = 0; done < mean.size(); done += piece.size()) {
        const size_t size = std::min(piece.size(), mean.size() - done);
        sum(first + done, std::span(piece).first(size));
        for (size_t i = 0; i < size; ++i) mean[done + i] = float(piece[i] / count);
    }
}

}  // namespace rawtexel::shading
