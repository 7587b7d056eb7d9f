#include "tests/reference/texunit/mip_reference.h"

#include <algorithm>

namespace rawtexel::texunit::reference {
namespace {

/// Share of texel `i` of the coarser level that texel `k` of the finer one covers, along one axis. Measured in units of 1/coarser of a
/// finer texel both grids are whole numbers: k is [k*coarser, (k + 1)*coarser), i is [i*finer, (i + 1)*finer).
double share(int finer, int i, int k) {
    const long coarser = std::max(1, finer / 2);
    const long from = std::max(long(k) * coarser, long(i) * finer), to = std::min((long(k) + 1) * coarser, (long(i) + 1) * finer);
    return to > from ? double(to - from) / finer : 0;
}

}  // namespace

std::array<double, 4> area_mean(int width, int height, int depth, const std::function<std::array<double, 4>(int, int, int)>& texel, int x,
                                int y, int z) {
    std::array<double, 4> mean{};
    for (int k = 0; k < depth; ++k) {
        for (int j = 0; j < height; ++j) {
            for (int i = 0; i < width; ++i) {
                const double weight = share(width, x, i) * share(height, y, j) * share(depth, z, k);
                if (weight == 0) continue;
                const std::array<double, 4> value = texel(i, j, k);
                for (size_t c = 0; c < 4; ++c) mean[c] += weight * value[c];
            }
        }
    }
    return mean;
}

}  // namespace rawtexel::texunit::reference
