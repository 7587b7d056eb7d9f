// What the canonical order of fetches decides: who touched a line or a block first, and what a cache would have held.
#pragma once

#include "texunit/cache_model.h"
#include "texunit/fetch_stream.h"
#include "texunit/texel_addresses.h"

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace rawtexel::texunit {

/// Hears of the fetches of a frame in canonical order, one stretch after the other.
class FetchReplay {
  public:
    /// Of one entry of a stream.
    struct PixelCosts {
        uint32_t lines_first = 0;   ///< 64-byte lines of the decoded layout that nobody touched before
        uint32_t blocks_first = 0;  ///< 4x4 blocks likewise
        uint32_t l1_misses = 0, l2_misses = 0;
    };
    using LevelCacheCounts = std::array<CacheCounts, kMaxLevels>;

    FetchReplay(std::span<const Texture* const> textures, const std::optional<CacheSpec>& cache);

    /// Tile `tile` of the frame, 64x64 pixels, row by row: modelled core tile % cores reads it. costs[i] is that of stream.pixels[i].
    void replay(const FetchStream& stream, uint64_t tile, std::vector<PixelCosts>& costs);

    const TexelAddresses& addresses() const { return addresses_; }
    /// Per texture and level; empty without a cache.
    const std::vector<LevelCacheCounts>& cache_counts() const { return cache_counts_; }

  private:
    void replay(TexelFetch fetch, int core, PixelCosts& costs);

    TexelAddresses addresses_;
    ReservedMemory lines_, blocks_;  ///< a bit for each that was touched; blocks by 16 decoded texels of 4 bytes, however large they are
    std::optional<CacheSpec> spec_;
    std::optional<CacheModel> cache_;
    std::vector<LevelCacheCounts> cache_counts_;
};

}  // namespace rawtexel::texunit
