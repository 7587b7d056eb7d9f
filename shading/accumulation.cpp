#include "shading/accumulation.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <iterator>
#include <utility>

namespace rawtexel::shading {
namespace {

template <class T>
std::vector<T> take(std::vector<std::vector<T>>& free) {
    if (free.empty()) return {};
    std::vector<T> memory = std::move(free.back());
    free.pop_back();
    return memory;
}

template <class T>
void add_to(std::vector<T>& left, const T* right) {
    for (size_t i = 0; i < left.size(); ++i) left[i] += right[i];
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
    // The common case, a right half that follows its left half, needs no copy of the values.
    const bool right_half = sample % 2 == 1 && !ranges_.empty() && ranges_.back().first == sample - 1 && ranges_.back().level == 0;
    if (!right_half) return insert(copy_of(sample, 0, values, {}));
    Range left = std::move(ranges_.back());
    ranges_.pop_back();
    add_to(left.low, values.data());
    left.level = 1;
    insert(std::move(left));
}

void SampleTree::merge(const SampleTree& other) {
    assert(other.width_ >= width_ && &other != this);
    const auto leading = [&](const auto& values) { return std::span(values).first(std::min(width_, values.size())); };
    for (const Range& range : other.ranges_) insert(copy_of(range.first, range.level, leading(range.low), leading(range.high)));
}

bool SampleTree::are_siblings(const Range& left, const Range& right) const {
    const uint64_t samples = uint64_t(1) << left.level;
    return left.level == right.level && left.first % (2 * samples) == 0 && right.first == left.first + samples;
}

/// The sum of the two halves, in place of the left one.
void SampleTree::combine(Range& left, Range& right) {
    if (left.level < kFloatLevels) {
        add_to(left.low, right.low.data());
    } else if (left.level == kFloatLevels) {
        left.high = take(free_high_);
        left.high.resize(width_);
        for (size_t i = 0; i < width_; ++i) left.high[i] = double(left.low[i]) + double(right.low[i]);
        free_low_.push_back(std::move(left.low));
        left.low.clear();
    } else {
        add_to(left.high, right.high.data());
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
        range.low = take(free_low_);
        range.low.assign(low.begin(), low.end());
    } else {
        range.high = take(free_high_);
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
            for (size_t i = 0; i < sum.size(); ++i) sum[i] += double(range->low[first + i]);
        } else {
            for (size_t i = 0; i < sum.size(); ++i) sum[i] += range->high[first + i];
        }
    }
}

std::optional<SampleTree::ScaledSums> SampleTree::scaled_sums() const {
    // A single range of floats holds a power of two of samples: the division is exact in float too.
    if (ranges_.size() != 1 || ranges_[0].level > kFloatLevels) return std::nullopt;
    return ScaledSums{ranges_[0].low, float(1.0 / double(samples()))};
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
