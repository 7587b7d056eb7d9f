// A cache hierarchy of a texture unit, as its user describes it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace rawtexel::texunit {

/// What the lines of a cache hold: texels as rawtexel decodes them, or a file's own blocks, from which a hit must be decoded again.
enum class CacheContent : uint8_t { Decoded, Stored };

struct CacheLevelSpec {
    uint64_t bytes = 0;
    int ways = 1;  ///< lines per set; 0: fully associative

    bool operator==(const CacheLevelSpec&) const = default;
};

/// Two levels. A line is filled by sectors, so that a miss brings line_bytes/sectors bytes. Every core has a first level of its own, all
/// share the second.
struct CacheSpec {
    int line_bytes = 64;
    int sectors = 1;
    CacheLevelSpec l1{16 * 1024, 8}, l2{256 * 1024, 16};
    int cores = 1;
    CacheContent l1_holds = CacheContent::Decoded, l2_holds = CacheContent::Stored;

    bool operator==(const CacheSpec&) const = default;
};

inline constexpr int kMostCores = 256;
inline constexpr int kMostSectors = 32;
inline constexpr uint64_t kMostCacheBytes = uint64_t{1} << 30;

/// Any of line=BYTES sectors=N l1=BYTES[:WAYS] l2=BYTES[:WAYS] cores=N holds=L1[:L2], separated by commas; what is not said keeps its
/// default. BYTES may end in K or M, WAYS may be `full`; contents are `decoded` or `stored`, and one of them alone holds for both levels.
/// Lines are powers of two, 16 to 4096 bytes, in 1, 2, 4 … 32 sectors of 16 bytes or more; a capacity is a whole number of sets, at most
/// 1 GiB; cores 1 to 256. On failure empty, and `error` says what is wrong.
std::optional<CacheSpec> parse_cache_spec(std::string_view text, std::string& error);
/// All of it, in the same spelling.
std::string to_string(const CacheSpec& spec);

}  // namespace rawtexel::texunit
