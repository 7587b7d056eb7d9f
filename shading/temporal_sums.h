// The radiance of all samples so far, kept from frame to frame: the exact mean over frames.
#pragma once

#include "shading/accumulation.h"

#include <cstdint>
#include <vector>

namespace rawtexel::shading {

/// A SampleTree for each tile of a frame, so that the mean over frames has the bits of one frame with all their samples. Frames that take
/// consecutive samples from 0 on leave at most 1 + log2(samples) sums per value.
class TemporalSums {
  public:
    /// Before each frame: that has `tiles` tiles of `tile_size` x `tile_size` pixels, as the frame before had (asserted).
    void prepare(int64_t tiles, int tile_size);
    /// Adds a tile's samples, whose first three planes are their radiance, and returns all that are held of these planes. Different tiles
    /// may come at the same time.
    const SampleTree& add(int64_t tile, const SampleTree& samples);

  private:
    std::vector<SampleTree> tiles_;
};

}  // namespace rawtexel::shading
