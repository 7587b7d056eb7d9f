#include "texunit/noise/void_and_cluster.h"

#include "texunit/random.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace rawtexel::texunit::noise {
namespace {

/// How near the first numbers of two entries of a companion must be for the share of their repulsion that depends on them.
constexpr double kCompanionShare = 0.4;
constexpr double kCompanionSigma = 0.08;  ///< of the range of the first numbers, which is a circle

// Energies are integers, exact whatever the order of the sums: the same seed gives the same mask everywhere. The Gaussians of a full mask
// sum to 2*pi*sigma^2 + sqrt(2*pi)*sigma = 27.5 for sigma 1.9, which 32 bits hold.
constexpr double kEnergyUnit = 0x1p27;
constexpr int kWeightBits = 16;
constexpr uint32_t kNone = 0xFFFFFFFFu;

/// The step on a circle of n that leads from 0 to i: -n/2 to n/2 - 1.
int around(int i, int n) { return i < n / 2 ? i : i - n; }

struct Neighbour {
    int dx, dy, dz;
    uint32_t repulsion;
};

/// All that an entry repels, itself included; beyond some distance the Gaussian is less than half a unit.
std::vector<Neighbour> neighbours_of(const VoidAndCluster& method) {
    const int extent = method.shape.extent, depth = method.shape.depth;
    std::vector<Neighbour> neighbours;
    const auto add = [&](int dx, int dy, int dz) {
        const double squared_distance = dx * dx + dy * dy + dz * dz;
        const double gaussian = std::exp(-squared_distance / (2 * method.sigma * method.sigma));
        const auto repulsion = uint32_t(std::llround(gaussian * kEnergyUnit));
        if (repulsion > 0) neighbours.push_back({dx, dy, dz, repulsion});
    };
    for (int y = 0; y < extent; ++y) {
        for (int x = 0; x < extent; ++x) add(around(x, extent), around(y, extent), 0);
    }
    for (int z = 1; z < depth; ++z) add(0, 0, around(z, depth));
    return neighbours;
}

/// Weights of a companion's repulsions, in units of 2^-kWeightBits, by the difference of the first numbers.
std::vector<uint32_t> similarity_weights(size_t size) {
    std::vector<uint32_t> weights(size);
    for (size_t difference = 0; difference < size; ++difference) {
        const double distance = double(std::min(difference, size - difference)) / double(size);
        const double similarity = std::exp(-distance * distance / (2 * kCompanionSigma * kCompanionSigma));
        weights[difference] = uint32_t(std::lround((1 - kCompanionShare + kCompanionShare * similarity) * (1 << kWeightBits)));
    }
    return weights;
}

/// Which strata of the first numbers may be drawn from.
using Strata = std::vector<uint8_t>;

/// Which entries are set, and how strongly the set ones repel each entry.
class Pattern {
  public:
    Pattern(const VoidAndCluster& method, std::span<const uint32_t> first, size_t strata)
        : shape_(method.shape),
          first_(first),
          strata_(strata),
          neighbours_(neighbours_of(method)),
          weights_(similarity_weights(first.size())),
          energy_(shape_.size()),
          set_(shape_.size()),
          groups_(strata * size_t(shape_.depth)),
          voids_(groups_.size(), kNone),
          clusters_(voids_) {
        for (size_t entry = 0; entry < shape_.size(); ++entry) groups_[group_of(entry)].push_back(uint32_t(entry));
    }

    size_t stratum_of(size_t entry) const { return first_.empty() ? 0 : first_[entry] * strata_ / first_.size(); }
    bool is_set(size_t entry) const { return set_[entry] != 0; }

    void set(size_t entry) {
        assert(!is_set(entry));
        set_[entry] = 1;
        repel(entry, 1);
    }
    void clear(size_t entry) {
        assert(is_set(entry));
        set_[entry] = 0;
        repel(entry, 0u - 1);
    }

    /// Of the entries of `strata` that are not set the least repelled one; of those that are set the most repelled one. Of equals the
    /// first.
    size_t largest_void(const Strata& strata) {
        return least(strata, voids_, [this](size_t entry) { return void_key(entry); });
    }
    size_t tightest_cluster(const Strata& strata) {
        return least(strata, clusters_, [this](size_t entry) { return cluster_key(entry); });
    }

    /// From now on the largest void is where those entries that are not set repel most. Ulichney's third phase: for a first mask the same.
    void judge_by_voids() {
        std::fill(energy_.begin(), energy_.end(), kNone);
        for (size_t entry = 0; entry < set_.size(); ++entry) {
            if (set_[entry] == 0) repel(entry, 0u - 1);
        }
    }

  private:
    size_t slice_of(size_t entry) const { return entry / (size_t(shape_.extent) * size_t(shape_.extent)); }
    size_t group_of(size_t entry) const { return slice_of(entry) * strata_ + stratum_of(entry); }

    /// Least for the entry to choose, and different for all.
    uint64_t void_key(size_t entry) const { return uint64_t(set_[entry] != 0 ? kNone : energy_[entry]) << 32 | entry; }
    uint64_t cluster_key(size_t entry) const { return uint64_t(set_[entry] != 0 ? ~energy_[entry] : kNone) << 32 | entry; }

    void repel(size_t entry, uint32_t sign) {
        const int extent = shape_.extent;
        const int x = int(entry) & (extent - 1), y = int(entry) / extent & (extent - 1), z = int(slice_of(entry));
        for (const Neighbour& near : neighbours_) {
            const int row = ((z + near.dz) & (shape_.depth - 1)) * extent + ((y + near.dy) & (extent - 1));
            const size_t other = size_t(row) * size_t(extent) + size_t((x + near.dx) & (extent - 1));
            energy_[other] += sign * weighed(near.repulsion, entry, other);
            if (near.dz != 0) forget_best_if_changed(other);
        }
        for (size_t stratum = 0; stratum < strata_; ++stratum) {
            const size_t group = size_t(z) * strata_ + stratum;
            voids_[group] = clusters_[group] = kNone;
        }
    }

    uint32_t weighed(uint32_t repulsion, size_t entry, size_t other) const {
        if (first_.empty()) return repulsion;
        const size_t difference = (first_[entry] - first_[other]) & (first_.size() - 1);
        return uint32_t(uint64_t(repulsion) * weights_[difference] >> kWeightBits);
    }

    /// The energy of one entry changed: the best of its group may be another now.
    void forget_best_if_changed(size_t entry) {
        uint32_t& empty = voids_[group_of(entry)];
        if (empty != kNone && void_key(entry) <= void_key(empty)) empty = kNone;
        uint32_t& cluster = clusters_[group_of(entry)];
        if (cluster != kNone && cluster_key(entry) <= cluster_key(cluster)) cluster = kNone;
    }

    /// The entry of least key, from what is known of the groups and by looking where nothing is.
    template <class Key>
    size_t least(const Strata& strata, std::vector<uint32_t>& known, const Key& key) {
        uint64_t best = ~uint64_t(0);
        for (size_t group = 0; group < groups_.size(); ++group) {
            if (strata[group % strata_] == 0 || groups_[group].empty()) continue;
            if (known[group] == kNone) known[group] = least_of(groups_[group], key);
            best = std::min(best, key(known[group]));
        }
        return uint32_t(best);
    }

    template <class Key>
    static uint32_t least_of(const std::vector<uint32_t>& entries, const Key& key) {
        uint64_t best = ~uint64_t(0);
        for (const uint32_t entry : entries) best = std::min(best, key(entry));
        return uint32_t(best);
    }

    MaskShape shape_;
    std::span<const uint32_t> first_;
    size_t strata_;
    std::vector<Neighbour> neighbours_;
    std::vector<uint32_t> weights_;
    std::vector<uint32_t> energy_;
    std::vector<uint8_t> set_;
    std::vector<std::vector<uint32_t>> groups_;  ///< entries of a slice in a stratum
    std::vector<uint32_t> voids_, clusters_;     ///< the best entry of each group, where known
};

/// Takes one entry of each stratum before any gets another.
class Rounds {
  public:
    explicit Rounds(size_t strata) : open_(strata, 1), left_(strata) {}
    const Strata& open() const { return open_; }
    void take(size_t stratum) {
        open_[stratum] = 0;
        if (--left_ > 0) return;
        std::fill(open_.begin(), open_.end(), uint8_t(1));
        left_ = open_.size();
    }

  private:
    Strata open_;
    size_t left_;
};

/// Sets `count` entries at random, equally many in each stratum; then moves the tightest cluster to the largest void of its stratum until
/// that is where it was.
void make_initial_pattern(size_t size, size_t count, size_t strata, uint32_t seed, Pattern& pattern) {
    uint32_t state = mix_bits(kRandomStart ^ seed);
    Rounds rounds(strata);
    for (size_t placed = 0; placed < count;) {
        state = mix_bits(state + kRandomStart);
        const size_t entry = state & (size - 1), stratum = pattern.stratum_of(entry);
        if (pattern.is_set(entry) || rounds.open()[stratum] == 0) continue;
        pattern.set(entry);
        rounds.take(stratum);
        ++placed;
    }
    const Strata all(strata, 1);
    for (;;) {
        const size_t cluster = pattern.tightest_cluster(all);
        pattern.clear(cluster);
        Strata same(strata, 0);
        same[pattern.stratum_of(cluster)] = 1;
        const size_t empty = pattern.largest_void(same);
        pattern.set(empty);
        if (empty == cluster) return;
    }
}

std::vector<uint32_t> rank_entries(const VoidAndCluster& method, std::span<const uint32_t> first, size_t strata) {
    const size_t size = method.shape.size();
    Pattern pattern(method, first, strata);
    const size_t initial = std::max<size_t>(1, size_t(double(size / strata) * method.initial_density)) * strata;
    make_initial_pattern(size, initial, strata, method.seed, pattern);

    std::vector<uint32_t> rank(size);
    Pattern shrinking = pattern;
    Rounds removed(strata), added(strata);
    for (size_t left = initial; left > 0; --left) {
        const size_t entry = shrinking.tightest_cluster(removed.open());
        shrinking.clear(entry);
        removed.take(shrinking.stratum_of(entry));
        rank[entry] = uint32_t(left - 1);
    }
    for (size_t next = initial; next < size; ++next) {
        if (next == size / 2) pattern.judge_by_voids();
        const size_t entry = pattern.largest_void(added.open());
        pattern.set(entry);
        added.take(pattern.stratum_of(entry));
        rank[entry] = uint32_t(next);
    }
    return rank;
}

}  // namespace

std::vector<uint32_t> make_mask(const VoidAndCluster& method) { return rank_entries(method, {}, 1); }

std::vector<uint32_t> make_companion(const VoidAndCluster& method, std::span<const uint32_t> first) {
    assert(first.size() == method.shape.size());
    return rank_entries(method, first, size_t(kCompanionStrata));
}

}  // namespace rawtexel::texunit::noise
