#include "texunit/texel_source.h"

#include <algorithm>
#include <bit>
#include <cassert>

namespace rawtexel::texunit {

int full_level_count(int width, int height, int depth) {
    assert(width > 0 && height > 0 && depth > 0);
    return std::bit_width(unsigned(std::max({width, height, depth})));
}

uint64_t TexelSource::level_bytes(int level) const {
    const Shape whole = shape();
    const uint64_t slice = texunit::stored_bytes(format(), level_extent(whole.width, level), level_extent(whole.height, level));
    return slice * uint64_t(slice_count(whole, level));
}

}  // namespace rawtexel::texunit
