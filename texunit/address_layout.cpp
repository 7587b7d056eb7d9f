#include "texunit/address_layout.h"

#include <algorithm>
#include <bit>
#include <cassert>

namespace rawtexel::texunit {
namespace {

constexpr uint64_t kLargestLine = 128;  // bytes

constexpr std::array<std::string_view, kAddressLayouts.size()> kNames = {"linear", "morton", "tiled-4k", "tiled-64k"};

/// Bits of `value` below `shared` go to every second place, the others follow above.
uint64_t spread_bits(uint32_t value, int shared) {
    uint64_t spread = 0;
    for (int bit = 0; bit < shared; ++bit) spread |= uint64_t{value >> bit & 1} << (2 * bit);
    return spread | uint64_t{value >> shared} << (2 * shared);
}

/// Extents of a tile, as powers of two: as wide as high, or twice as wide.
struct TileShape {
    TileShape(uint64_t tile_bytes, int bytes_per_element) {
        const int log2_elements = std::countr_zero(tile_bytes / uint64_t(bytes_per_element));
        log2_width = (log2_elements + 1) / 2;
        log2_height = log2_elements / 2;
    }
    int log2_width, log2_height;
};

int ceil_log2(int n) { return std::bit_width(uint32_t(n) - 1); }

}  // namespace

std::string_view to_string(AddressLayout layout) { return kNames[size_t(layout)]; }

std::optional<AddressLayout> parse_address_layout(std::string_view text) {
    const auto found = std::ranges::find(kNames, text);
    if (found == kNames.end()) return std::nullopt;
    return AddressLayout(found - kNames.begin());
}

SliceAddresses::SliceAddresses(AddressLayout layout, int columns, int rows, int bytes_per_element)
    : column_(size_t(columns)), row_(size_t(rows)) {
    assert(columns > 0 && rows > 0 && std::has_single_bit(unsigned(bytes_per_element)) && bytes_per_element <= 16);
    const auto element = uint64_t(bytes_per_element);
    uint64_t elements = 0;  // that the slice takes up, padding included
    // What of a column is Morton code within a tile of these extents, and what of it counts tiles.
    const auto place = [&](const TileShape& tile, uint64_t tiles_per_row) {
        const int shared = std::min(tile.log2_width, tile.log2_height);
        const int log2_tile = tile.log2_width + tile.log2_height;
        for (uint32_t x = 0; x < column_.size(); ++x) {
            const uint32_t inside = x & ((1u << tile.log2_width) - 1);
            column_[x] = element * ((uint64_t{x >> tile.log2_width} << log2_tile) + spread_bits(inside, shared));
        }
        for (uint32_t y = 0; y < row_.size(); ++y) {
            const uint32_t inside = y & ((1u << tile.log2_height) - 1);
            const uint64_t code = spread_bits(inside & ((1u << shared) - 1), shared) << 1 | uint64_t{inside >> shared} << (2 * shared);
            row_[y] = element * (((uint64_t{y >> tile.log2_height} * tiles_per_row) << log2_tile) + code);
        }
        const uint64_t tile_rows = ((row_.size() - 1) >> tile.log2_height) + 1;
        elements = tiles_per_row * tile_rows << log2_tile;
    };
    const auto place_tiles = [&](uint64_t tile_bytes) {
        const TileShape tile(tile_bytes, bytes_per_element);
        place(tile, ((column_.size() - 1) >> tile.log2_width) + 1);
    };
    switch (layout) {
        case AddressLayout::Linear:
            for (size_t x = 0; x < column_.size(); ++x) column_[x] = element * x;
            for (size_t y = 0; y < row_.size(); ++y) row_[y] = element * y * column_.size();
            elements = column_.size() * row_.size();
            break;
        case AddressLayout::Morton: {
            TileShape whole(1, 1);
            whole.log2_width = ceil_log2(columns);
            whole.log2_height = ceil_log2(rows);
            place(whole, 1);
            break;
        }
        case AddressLayout::Tiled4K: place_tiles(4 * 1024); break;
        case AddressLayout::Tiled64K: place_tiles(64 * 1024); break;
    }
    bytes_ = (elements * element + kLargestLine - 1) / kLargestLine * kLargestLine;
}

}  // namespace rawtexel::texunit
