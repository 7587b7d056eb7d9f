// What the texels that were asked for cost in memory: blocks, and cache lines of several sizes in several layouts.
#pragma once

#include "texunit/address_layout.h"
#include "texunit/texture.h"
#include "texunit/touched_texels.h"

#include <array>
#include <cstdint>
#include <vector>

namespace rawtexel::texunit {

inline constexpr std::array kLineBytes = {32, 64, 128};

/// Distinct lines of each size of kLineBytes.
struct LineCounts {
    std::array<uint64_t, kLineBytes.size()> lines{};

    uint64_t of_64() const { return lines[1]; }
    LineCounts& operator+=(const LineCounts& other);
    bool operator==(const LineCounts&) const = default;
};

/// Distinct texels of one level, or of several, and what holds them. `decoded` are lines of rawtexel's own storage: 4x4 blocks in pages
/// (texunit/level_table.h). `stored` are lines of the file's own order: its blocks or texels row after row, every slice of a level at a
/// new 128 bytes; levels that the file lacks are counted as if it held them. `decoded_as` and `stored_as` have decoded texels and the
/// file's blocks in each of kAddressLayouts.
struct TouchedLines {
    uint64_t texels_unique = 0;
    uint64_t blocks_touched = 0;  ///< 4x4 texels, aligned
    uint64_t texel_bytes = 0;     ///< of the distinct texels, decoded
    LineCounts decoded, stored;
    std::array<LineCounts, kAddressLayouts.size()> decoded_as{}, stored_as{};

    uint64_t bytes_decoded() const { return 64 * decoded.of_64(); }
    uint64_t bytes_stored() const { return 64 * stored.of_64(); }
    TouchedLines& operator+=(const TouchedLines& other);
    bool operator==(const TouchedLines&) const = default;
};

/// One entry a level. `index` is the texture's place in `touched`.
std::vector<TouchedLines> measure_touched(const Texture& texture, const TouchedTexels& touched, size_t index);

}  // namespace rawtexel::texunit
