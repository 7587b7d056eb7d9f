#include "texunit/cache_model.h"

#include <algorithm>
#include <cassert>
#include <optional>
#include <unordered_map>
#include <unordered_set>

namespace rawtexel::texunit {
namespace {

/// Where an address lies.
struct LineAddress {
    LineAddress(const CacheSpec& spec, uint64_t address)
        : line(address / uint64_t(spec.line_bytes)),
          sector(int(address % uint64_t(spec.line_bytes)) * spec.sectors / spec.line_bytes),
          sector_id(line * uint64_t(spec.sectors) + uint64_t(sector)) {}
    uint64_t line;
    int sector;          ///< in the line
    uint64_t sector_id;  ///< of the whole address space
};

/// Which sectors of a line are there.
class SectorSet {
  public:
    void clear() { bits_ = 0; }
    /// Whether the sector was there; it is from now on.
    bool take(int sector) {
        const uint32_t bit = uint32_t{1} << sector;
        const bool present = (bits_ & bit) != 0;
        bits_ |= bit;
        return present;
    }

  private:
    static_assert(kMostSectors <= 32);
    uint32_t bits_ = 0;
};

/// Sets of lines.
class SetAssociative {
  public:
    SetAssociative(const CacheSpec& spec, const CacheLevelSpec& level)
        : ways_(level.ways), sets_(level.bytes / (uint64_t(spec.line_bytes) * uint64_t(level.ways))), lines_(sets_ * uint64_t(ways_)) {}

    /// Whether it hits; afterwards the sector is there and its line the set's most recent.
    bool access(const LineAddress& at) {
        Line* const set = &lines_[at.line % sets_ * uint64_t(ways_)];
        Line* const end = set + ways_;
        Line* found = std::find_if(set, end, [&](const Line& line) { return line.tag == at.line; });
        const bool hit_line = found != end;
        // Lines of a set are kept from the most recent to the least.
        Line line = hit_line ? *found : Line{at.line, {}};
        if (!hit_line) found = end - 1;
        std::move_backward(set, found, found + 1);
        const bool hit = line.sectors.take(at.sector);
        *set = line;
        return hit;
    }

  private:
    struct Line {
        uint64_t tag = ~uint64_t{0};
        SectorSet sectors;
    };
    int ways_;
    uint64_t sets_;
    std::vector<Line> lines_;
};

/// One set for all lines: found by tag, in a ring from the most recent to the least.
class FullyAssociative {
  public:
    explicit FullyAssociative(uint64_t lines) : ring_(lines + 1) {
        for (size_t i = 0; i < ring_.size(); ++i) {
            ring_[i].next = uint32_t((i + 1) % ring_.size());
            ring_[i].previous = uint32_t((i + ring_.size() - 1) % ring_.size());
        }
        places_.reserve(lines);
    }

    bool access(const LineAddress& at) {
        const uint32_t recent = ring_[kHead].next;
        if (ring_[recent].used && ring_[recent].tag == at.line) return ring_[recent].sectors.take(at.sector);
        const auto found = places_.find(at.line);
        const uint32_t place = found != places_.end() ? found->second : replace_oldest(at.line);
        move_to_front(place);
        return ring_[place].sectors.take(at.sector);
    }

  private:
    static constexpr uint32_t kHead = 0;
    struct Node {
        uint64_t tag = 0;
        SectorSet sectors;
        uint32_t next = 0, previous = 0;
        bool used = false;
    };

    uint32_t replace_oldest(uint64_t line) {
        const uint32_t place = ring_[kHead].previous;
        Node& node = ring_[place];
        if (node.used) places_.erase(node.tag);
        node.tag = line;
        node.used = true;
        node.sectors.clear();
        places_.emplace(line, place);
        return place;
    }

    void move_to_front(uint32_t place) {
        Node& node = ring_[place];
        ring_[node.previous].next = node.next;
        ring_[node.next].previous = node.previous;
        Node& head = ring_[kHead];
        node.next = head.next;
        node.previous = kHead;
        ring_[head.next].previous = place;
        head.next = place;
    }

    std::vector<Node> ring_;  ///< entry 0 is the head
    std::unordered_map<uint64_t, uint32_t> places_;
};

FullyAssociative make_fully_associative(const CacheSpec& spec, const CacheLevelSpec& level) {
    return FullyAssociative(level.bytes / uint64_t(spec.line_bytes));
}

}  // namespace

struct CacheModel::Core {
    explicit Core(const CacheSpec& spec) : fully(make_fully_associative(spec, spec.l1)) {
        if (spec.l1.ways > 0) sets.emplace(spec, spec.l1);
    }

    /// Whether the first level hits, and whether it would without sets.
    struct Hits {
        bool real, fully;
    };
    Hits access(const LineAddress& at) {
        const bool hit = fully.access(at);
        return {sets ? sets->access(at) : hit, hit};
    }

    std::optional<SetAssociative> sets;  ///< none: the cache is fully associative
    FullyAssociative fully;
    std::unordered_set<uint64_t> seen;  ///< sectors
};

struct CacheModel::Shared {
    explicit Shared(const CacheSpec& spec) {
        if (spec.l2.ways > 0) {
            sets.emplace(spec, spec.l2);
        } else {
            fully.emplace(make_fully_associative(spec, spec.l2));
        }
    }
    bool access(const LineAddress& at) { return sets ? sets->access(at) : fully->access(at); }

    std::optional<SetAssociative> sets;
    std::optional<FullyAssociative> fully;
};

CacheModel::CacheModel(const CacheSpec& spec) : spec_(spec), l2_(std::make_unique<Shared>(spec)) {
    for (int core = 0; core < spec.cores; ++core) cores_.push_back(std::make_unique<Core>(spec));
}

CacheModel::~CacheModel() = default;

void CacheModel::access(int core, uint64_t l1_address, uint64_t l2_address, CacheCounts& counts) {
    assert(core >= 0 && size_t(core) < cores_.size());
    Core& own = *cores_[size_t(core)];
    const LineAddress at(spec_, l1_address);
    const Core::Hits hits = own.access(at);
    if (hits.real) {
        ++counts.l1_hits;
        return;
    }
    ++counts.l1_misses;
    if (own.seen.insert(at.sector_id).second) {
        ++counts.compulsory;
    } else if (!hits.fully) {
        ++counts.capacity;
    } else {
        ++counts.conflict;
    }
    if (l2_->access(LineAddress(spec_, l2_address))) {
        ++counts.l2_hits;
    } else {
        ++counts.l2_misses;
    }
}

CacheCounts& CacheCounts::operator+=(const CacheCounts& other) {
    l1_hits += other.l1_hits;
    l1_misses += other.l1_misses;
    l2_hits += other.l2_hits;
    l2_misses += other.l2_misses;
    compulsory += other.compulsory;
    capacity += other.capacity;
    conflict += other.conflict;
    return *this;
}

}  // namespace rawtexel::texunit
