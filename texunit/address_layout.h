// Ways in which the texels of a level, or the blocks of a file, may lie in memory: what caches and buses see.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace rawtexel::texunit {

/// linear: row after row. morton: bits of column and row interleaved, column lowest, over extents rounded up to powers of two. tiled-4k
/// and tiled-64k: tiles of that many bytes, as wide as high or twice as wide (the tile extents of Vulkan "Standard Sparse Image Block
/// Shapes" and D3D12's 64 KiB tiles), row after row; inside a tile in Morton order.
enum class AddressLayout : uint8_t { Linear, Morton, Tiled4K, Tiled64K };
inline constexpr std::array kAddressLayouts = {AddressLayout::Linear, AddressLayout::Morton, AddressLayout::Tiled4K,
                                               AddressLayout::Tiled64K};

std::string_view to_string(AddressLayout layout);  // linear morton tiled-4k tiled-64k
std::optional<AddressLayout> parse_address_layout(std::string_view text);

/// Where the elements of one slice lie: texels, or a file's blocks. Every layout is a sum of what the column says and what the row says.
class SliceAddresses {
  public:
    /// `columns`, `rows`: elements, at least 1; `bytes_per_element`: a power of two up to 16.
    SliceAddresses(AddressLayout layout, int columns, int rows, int bytes_per_element);

    /// Bytes from the slice's base; never straddles a multiple of 16.
    uint64_t offset(int column, int row) const { return column_[size_t(column)] + row_[size_t(row)]; }
    /// Of the whole slice, up to a multiple of 128, so that slices share no line.
    uint64_t bytes() const { return bytes_; }

  private:
    std::vector<uint64_t> column_, row_;
    uint64_t bytes_ = 0;
};

}  // namespace rawtexel::texunit
