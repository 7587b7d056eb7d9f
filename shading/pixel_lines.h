// Which lines of texels each pixel of a tile has read.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace rawtexel::shading {

/// A set of (pixel, texture, line) triples.
class PixelLines {
  public:
    void clear();
    /// Whether the triple is new. `pixel` < 2^14, `texture` < 2^20, `line` < 2^27 (asserted).
    bool add(uint32_t pixel, uint32_t texture, uint32_t line);

  private:
    void grow();
    std::vector<uint64_t> slots_ = std::vector<uint64_t>(1 << 12);  ///< open addressing; 0: free
    size_t used_ = 0;
};

}  // namespace rawtexel::shading
