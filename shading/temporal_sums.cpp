#include "shading/temporal_sums.h"

#include <cassert>
#include <cstddef>

namespace rawtexel::shading {

void TemporalSums::prepare(int64_t tiles, int tile_size) {
    const size_t values = size_t(3) * size_t(tile_size) * size_t(tile_size);
    if (tiles_.empty()) tiles_.assign(size_t(tiles), SampleTree(values));
    assert(tiles_.size() == size_t(tiles) && tiles_[0].width() == values);
}

const SampleTree& TemporalSums::add(int64_t tile, const SampleTree& samples) {
    SampleTree& all = tiles_[size_t(tile)];
    all.merge(samples);
    return all;
}

}  // namespace rawtexel::shading
