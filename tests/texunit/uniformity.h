// How even counts are.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

namespace rawtexel::texunit {

/// Standard deviations by which the chi-square statistic of `counts`, all expected alike, is above that of random numbers (Wilson and
/// Hilferty's cube root); below 0 for counts that are more even.
inline double unevenness(const std::vector<uint64_t>& counts) {
    uint64_t total = 0;
    for (const uint64_t count : counts) total += count;
    const double expected = double(total) / double(counts.size()), freedom = double(counts.size()) - 1;
    double statistic = 0;
    for (const uint64_t count : counts) statistic += (double(count) - expected) * (double(count) - expected) / expected;
    return (std::cbrt(statistic / freedom) - (1 - 2 / (9 * freedom))) / std::sqrt(2 / (9 * freedom));
}

}  // namespace rawtexel::texunit
