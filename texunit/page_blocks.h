// Which of a page's 8x8 blocks lie in a range of columns or rows, as bits in the order that BlockStates keeps them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace rawtexel::texunit {

/// Block (x, y) of a page of 32-bit texels is bit number Morton(x, y), x in the even places (texunit/level_table.h).
class PageBlocks {
  public:
    constexpr PageBlocks() {
        for (int first = 0; first < 8; ++first) {
            for (int last = first; last < 8; ++last) {
                for (int along = first; along <= last; ++along) {
                    for (int across = 0; across < 8; ++across) {
                        columns_[std::size_t(8 * first + last)] |= uint64_t{1} << morton(along, across);
                        rows_[std::size_t(8 * first + last)] |= uint64_t{1} << morton(across, along);
                    }
                }
            }
        }
    }
    /// Bits of the blocks in columns, or rows, [first, last]; 0 <= first <= last < 8.
    constexpr uint64_t columns_between(int first, int last) const { return columns_[std::size_t(8 * first + last)]; }
    constexpr uint64_t rows_between(int first, int last) const { return rows_[std::size_t(8 * first + last)]; }

  private:
    static constexpr int morton(int x, int y) { return (x & 1) | (x & 2) << 1 | (x & 4) << 2 | (y & 1) << 1 | (y & 2) << 2 | (y & 4) << 3; }
    std::array<uint64_t, 64> columns_{}, rows_{};
};
inline constexpr PageBlocks kPageBlocks;

}  // namespace rawtexel::texunit
