#include "texunit/fetch_replay.h"

namespace rawtexel::texunit {
namespace {

constexpr uint64_t kLine = 64;           // bytes
constexpr uint64_t kSmallestBlock = 64;  // bytes of a decoded 4x4 block

/// Sets bit `number`; whether it was clear.
bool take_first(const ReservedMemory& bits, uint64_t number) {
    auto* const word = reinterpret_cast<uint64_t*>(bits.data()) + number / 64;
    const uint64_t bit = uint64_t{1} << number % 64;
    if ((*word & bit) != 0) return false;
    *word |= bit;
    return true;
}

uint64_t bitmap_bytes(uint64_t bits) { return (bits + 63) / 64 * 8; }

}  // namespace

FetchReplay::FetchReplay(std::span<const Texture* const> textures, const std::optional<CacheSpec>& cache)
    : addresses_(textures),
      lines_(bitmap_bytes(addresses_.decoded_bytes() / kLine)),
      blocks_(bitmap_bytes(addresses_.decoded_bytes() / kSmallestBlock)),
      spec_(cache) {
    if (!cache) return;
    cache_.emplace(*cache);
    cache_counts_.resize(textures.size());
}

void FetchReplay::replay(const FetchStream& stream, uint64_t tile, std::vector<PixelCosts>& costs) {
    const int core = spec_ ? int(tile % uint64_t(spec_->cores)) : 0;
    costs.assign(stream.pixels.size(), {});
    auto fetch = stream.fetches.begin();
    for (size_t i = 0; i < stream.pixels.size(); ++i) {
        for (uint32_t n = 0; n < stream.pixels[i].count; ++n) replay(*fetch++, core, costs[i]);
    }
}

void FetchReplay::replay(TexelFetch fetch, int core, PixelCosts& costs) {
    const uint64_t decoded = addresses_.decoded(fetch);
    costs.lines_first += take_first(lines_, decoded / kLine);
    // The first line of a block stands for the block.
    const uint64_t block_bytes = kTexelsPerBlock * uint64_t(addresses_.bytes_per_texel(fetch));
    costs.blocks_first += take_first(blocks_, decoded / block_bytes * (block_bytes / kSmallestBlock));
    if (!cache_) return;

    const bool needs_stored = spec_->l1_holds == CacheContent::Stored || spec_->l2_holds == CacheContent::Stored;
    const uint64_t stored = needs_stored ? addresses_.stored(fetch) : 0;
    CacheCounts counts;
    cache_->access(core, spec_->l1_holds == CacheContent::Stored ? stored : decoded,
                   spec_->l2_holds == CacheContent::Stored ? stored : decoded, counts);
    costs.l1_misses += uint32_t(counts.l1_misses);
    costs.l2_misses += uint32_t(counts.l2_misses);
    cache_counts_[fetch.texture()][size_t(fetch.level())] += counts;
}

}  // namespace rawtexel::texunit
