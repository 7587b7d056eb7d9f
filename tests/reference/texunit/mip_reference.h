// The texels of a mip level by brute force: overlap of intervals, in double.
#pragma once

#include <array>
#include <functional>

namespace rawtexel::texunit::reference {

/// Mean of the texels of a level of `width` x `height` x `depth` texels over the area of texel (x, y, z) of the next level, whose extents
/// are max(1, extent / 2).
std::array<double, 4> area_mean(int width, int height, int depth, const std::function<std::array<double, 4>(int x, int y, int z)>& texel,
                                int x, int y, int z);

}  // namespace rawtexel::texunit::reference
