// A two-level set-associative cache, run over a stream of addresses.
#pragma once

#include "texunit/cache_spec.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace rawtexel::texunit {

/// Of accesses, one for each texel read. A first-level miss asks the second level once. It is compulsory where its sector was never in that
/// core's cache before, capacity where a fully associative cache of the same size would have missed too, and else conflict (Hill 1987).
struct CacheCounts {
    uint64_t l1_hits = 0, l1_misses = 0;
    uint64_t l2_hits = 0, l2_misses = 0;                  ///< their sum is l1_misses
    uint64_t compulsory = 0, capacity = 0, conflict = 0;  ///< likewise

    CacheCounts& operator+=(const CacheCounts& other);
    bool operator==(const CacheCounts&) const = default;
};

/// Replaces the least recently used line of a set.
class CacheModel {
  public:
    explicit CacheModel(const CacheSpec& spec);
    ~CacheModel();
    CacheModel(const CacheModel&) = delete;
    CacheModel& operator=(const CacheModel&) = delete;

    /// One read of at most 16 bytes, aligned to its size, by `core`: at `l1_address` of what the first level holds, at `l2_address` of what
    /// the second holds. Adds to `counts`.
    void access(int core, uint64_t l1_address, uint64_t l2_address, CacheCounts& counts);

  private:
    struct Core;
    struct Shared;

    CacheSpec spec_;
    std::vector<std::unique_ptr<Core>> cores_;
    std::unique_ptr<Shared> l2_;
};

}  // namespace rawtexel::texunit
