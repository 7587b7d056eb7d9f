// Bytes that texel reads fall on: every texture of a set in an address space of its own, as decoded and as its file stores it.
#pragma once

#include "texunit/address_layout.h"
#include "texunit/fetch_stream.h"

#include <cstdint>
#include <span>
#include <vector>

namespace rawtexel::texunit {

/// Decoded texels lie in rawtexel's own layout (texunit/level_table.h), stored ones in the file's order as TouchedLines has it. Textures
/// start at multiples of 64 KiB, one after the other.
class TexelAddresses {
  public:
    explicit TexelAddresses(std::span<const Texture* const> textures);

    uint64_t decoded(TexelFetch fetch) const {
        const Entry& entry = entries_[fetch.texture()];
        return entry.decoded_base + uint64_t(uint32_t(fetch.texel())) * entry.bytes_per_texel;
    }
    /// Of the file's unit (a block, or a texel) that holds the texel.
    uint64_t stored(TexelFetch fetch) const { return stored(fetch, position(fetch)); }

    /// Where a texel is in its image.
    struct Position {
        int slice, x, y;
    };
    Position position(TexelFetch fetch) const;
    uint64_t stored(TexelFetch fetch, const Position& at) const;

    uint64_t decoded_bytes() const { return decoded_end_; }  ///< of the whole address space
    uint32_t bytes_per_texel(TexelFetch fetch) const { return entries_[fetch.texture()].bytes_per_texel; }
    uint32_t bytes_per_unit(TexelFetch fetch) const { return entries_[fetch.texture()].bytes_per_unit; }

  private:
    struct Level {
        uint64_t base;
        SliceAddresses slice;
    };
    struct Entry {
        const Texture* texture;
        uint32_t bytes_per_texel, bytes_per_unit;
        int unit_extent;  ///< texels
        uint64_t decoded_base;
        std::vector<Level> stored;
    };
    std::vector<Entry> entries_;
    uint64_t decoded_end_ = 0;
};

}  // namespace rawtexel::texunit
