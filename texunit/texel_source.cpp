#include "texunit/texel_source.h"

#include <algorithm>
#include <bit>
#include <cassert>

namespace rawtexel::texunit {

int full_level_count(int width, int height, int depth) {
    assert(width > 0 && height > 0 && depth > 0);
    return std::bit_width(unsigned(std::max({width, height, depth})));
}

}  // namespace rawtexel::texunit
