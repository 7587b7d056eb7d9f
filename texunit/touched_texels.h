// Which texels of a set of textures were asked for: one bit for each texel of the decoded layout (texunit/level_table.h).
#pragma once

#include "texunit/reserved_memory.h"

#include <bit>
#include <cstdint>
#include <span>
#include <vector>

namespace rawtexel::texunit {

/// The bits of one texture, for those who mark them: texel index i is bit i % 32 of words[i / 32]. A set bit has set bit
/// (i / kTexelsPerChunk) % 64 of chunks[i / kTexelsPerChunk / 64], so that readers find what was touched without reading the rest.
struct TouchedBits {
    static constexpr int64_t kTexelsPerChunk = 8 * 4096;  ///< the bits of one 4 KiB page
    uint32_t* words = nullptr;
    uint64_t* chunks = nullptr;

    bool empty() const { return words == nullptr; }
    void mark(int32_t texel) const {
        words[texel / 32] |= uint32_t{1} << texel % 32;
        chunks[texel / (64 * kTexelsPerChunk)] |= uint64_t{1} << texel / kTexelsPerChunk % 64;
    }
};

/// A worker's own set: no other thread may mark it meanwhile. Costs memory only where texels were touched.
class TouchedTexels {
  public:
    /// `texels`: of each texture, as LevelTable::texels has it.
    explicit TouchedTexels(std::span<const uint64_t> texels);

    size_t textures() const { return first_chunk_.size() - 1; }
    TouchedBits bits(size_t texture) const;

    /// Adds the texels of a set of the same textures.
    void merge(const TouchedTexels& other);

    /// Calls use(index of the first of 32 texels, their bits) for every group of 32 with a touched texel, in ascending order.
    template <class Use>
    void for_each_group(size_t texture, const Use& use) const {
        for_each_chunk(texture, [&](int64_t chunk) {
            const uint32_t* const words = bits(texture).words + chunk * kWordsPerChunk;
            for (int64_t w = 0; w < kWordsPerChunk; ++w) {
                if (words[w] != 0) use(int32_t((chunk * kWordsPerChunk + w) * 32), words[w]);
            }
        });
    }

  private:
    static constexpr int64_t kWordsPerChunk = TouchedBits::kTexelsPerChunk / 32;

    template <class Use>
    void for_each_chunk(size_t texture, const Use& use) const {
        const uint64_t* const chunks = bits(texture).chunks;
        const int64_t groups = (first_chunk_[texture + 1] - first_chunk_[texture]) / 64;
        for (int64_t group = 0; group < groups; ++group) {
            for (uint64_t rest = chunks[group]; rest != 0; rest &= rest - 1) use(64 * group + std::countr_zero(rest));
        }
    }

    std::vector<int64_t> first_chunk_;  ///< of each texture, a multiple of 64, and past the last
    ReservedMemory words_, chunks_;
};

}  // namespace rawtexel::texunit
