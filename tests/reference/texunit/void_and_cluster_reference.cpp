#include "tests/reference/texunit/void_and_cluster_reference.h"

#include "texunit/random.h"

#include <algorithm>
#include <cmath>

namespace rawtexel::texunit::reference {
namespace {

using noise::VoidAndCluster;

double circle_distance(int a, int b, int n) { return std::min((a - b + n) % n, (b - a + n) % n); }

class Entries {
  public:
    Entries(const VoidAndCluster& method, const std::vector<uint32_t>& first)
        : method_(method), first_(first), size_(method.shape.size()), set_(size_), by_set_(size_), by_unset_(size_) {
        for (size_t i = 0; i < size_; ++i) {
            for (size_t j = 0; j < size_; ++j) by_unset_[j] += repulsion_.emplace_back(repulsion(int(i), int(j)));
        }
    }

    size_t size() const { return size_; }
    size_t strata() const { return first_.empty() ? 1 : noise::kCompanionStrata; }
    size_t stratum(size_t entry) const { return first_.empty() ? 0 : first_[entry] / (size_ / strata()); }
    bool is_set(size_t entry) const { return set_[entry]; }

    /// How strongly an entry is repelled by all that are set, and by all that are not.
    int64_t by_set(size_t entry) const { return by_set_[entry]; }
    int64_t by_unset(size_t entry) const { return by_unset_[entry]; }

    void change(size_t entry) {
        const int64_t sign = set_[entry] ? -1 : 1;
        set_[entry] = !set_[entry];
        for (size_t other = 0; other < size_; ++other) {
            by_set_[other] += sign * repulsion_[entry * size_ + other];
            by_unset_[other] -= sign * repulsion_[entry * size_ + other];
        }
    }

    /// The entry whose state is `set` and whose stratum is admitted that has the largest value. Of equals the first.
    template <class Admits, class Value>
    size_t largest(bool set, const Admits& admits, const Value& value) const {
        size_t best = size_;
        for (size_t entry = 0; entry < size_; ++entry) {
            if (set_[entry] != set || !admits(stratum(entry))) continue;
            if (best == size_ || value(entry) > value(best)) best = entry;
        }
        return best;
    }

  private:
    int64_t repulsion(int i, int j) const {
        const int extent = method_.shape.extent, slice = extent * extent;
        const double dx = circle_distance(i % extent, j % extent, extent);
        const double dy = circle_distance(i / extent % extent, j / extent % extent, extent);
        const double dz = circle_distance(i / slice, j / slice, method_.shape.depth);
        if (dz > 0 && (dx > 0 || dy > 0)) return 0;
        const double gaussian = std::exp(-(dx * dx + dy * dy + dz * dz) / (2 * method_.sigma * method_.sigma));
        const int64_t whole = std::llround(gaussian * 0x1p27);
        if (first_.empty() || whole == 0) return whole;
        const double apart = circle_distance(int(first_[size_t(i)]), int(first_[size_t(j)]), int(size_)) / double(size_);
        return whole * std::llround((0.6 + 0.4 * std::exp(-apart * apart / (2 * 0.08 * 0.08))) * 65536) / 65536;
    }

    VoidAndCluster method_;
    const std::vector<uint32_t>& first_;
    size_t size_;
    std::vector<bool> set_;
    std::vector<int64_t> repulsion_, by_set_, by_unset_;
};

/// How many entries each stratum has had: none may be ahead of another by more than one.
struct Turns {
    std::vector<int> had;
    bool operator()(size_t stratum) const { return had[stratum] == *std::min_element(had.begin(), had.end()); }
};

void start(Entries& entries, size_t count, uint32_t seed) {
    Turns turns{std::vector<int>(entries.strata())};
    uint32_t state = mix_bits(kRandomStart ^ seed);
    while (count > 0) {
        state = mix_bits(state + kRandomStart);
        const size_t entry = state % entries.size();
        if (entries.is_set(entry) || !turns(entries.stratum(entry))) continue;
        entries.change(entry);
        ++turns.had[entries.stratum(entry)];
        --count;
    }
    const auto crowded = [&](size_t entry) { return entries.by_set(entry); };
    const auto lonely = [&](size_t entry) { return -entries.by_set(entry); };
    for (;;) {
        const size_t cluster = entries.largest(
            true, [](size_t) { return true; }, crowded);
        entries.change(cluster);
        const size_t empty = entries.largest(
            false, [&](size_t stratum) { return stratum == entries.stratum(cluster); }, lonely);
        entries.change(empty);
        if (empty == cluster) return;
    }
}

}  // namespace

std::vector<uint32_t> void_and_cluster(const VoidAndCluster& method, const std::vector<uint32_t>& first) {
    Entries entries(method, first);
    const size_t strata = entries.strata(), size = entries.size();
    const size_t initial = strata * std::max<size_t>(1, size_t(double(size / strata) * method.initial_density));
    start(entries, initial, method.seed);
    std::vector<uint32_t> rank(size);

    Entries shrinking = entries;
    Turns removed{std::vector<int>(strata)}, added = removed;
    for (size_t left = initial; left-- > 0;) {
        const size_t entry = shrinking.largest(true, removed, [&](size_t of) { return shrinking.by_set(of); });
        shrinking.change(entry);
        ++removed.had[entries.stratum(entry)];
        rank[entry] = uint32_t(left);
    }
    for (size_t next = initial; next < size; ++next) {
        const bool few = next < size / 2;
        const size_t entry = entries.largest(false, added, [&](size_t of) { return few ? -entries.by_set(of) : entries.by_unset(of); });
        entries.change(entry);
        ++added.had[entries.stratum(entry)];
        rank[entry] = uint32_t(next);
    }
    return rank;
}

}  // namespace rawtexel::texunit::reference
