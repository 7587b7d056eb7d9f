// What lookups asked for. Counting is a policy: the wave code is compiled once with FetchCounter and once with NoFetchCount.
#pragma once

#include "texunit/wave.h"

#include <cstdint>

namespace rawtexel::texunit {

/// Demanded counts: what material and sampler ask for, independent of skips, threads and tile size.
struct FetchCounts {
    uint64_t lookups = 0;            ///< one map asked at one shading point
    uint64_t taps = 0;               ///< taps weighed
    uint64_t texels_requested = 0;   ///< texel reads, with repeats

    FetchCounts& operator+=(const FetchCounts& other);
    bool operator==(const FetchCounts&) const = default;
};

/// Counts nothing and costs nothing.
struct NoFetchCount {
    static constexpr bool kCounts = false;
};

/// One per worker and texture set; merged in any order, since sums of integers do not depend on it.
struct FetchCounter {
    static constexpr bool kCounts = true;
    FetchCounts* texture = nullptr;      ///< of the texture looked up now
    Wave<uint32_t>* pixel = nullptr;     ///< texels requested by each lane's pixel, added to; null where nobody asks
};

}  // namespace rawtexel::texunit
