// Making a mip level: each texel is the mean of the finer level over the area it covers, in linear light.
#pragma once

#include "texunit/texel_value.h"

#include <array>
#include <cstddef>

namespace rawtexel::texunit {

/// The texels of the finer level that one texel covers along one axis, and how much of each. With n = max(1, N / 2) texels over N, texel i
/// covers [i*N/n, (i+1)*N/n): two halves when N is even, weights (n - i, n, i + 1) / N when N is odd, the one texel when N is 1.
struct AreaWeights {
    int first = 0, count = 0;
    std::array<double, 3> weight{};  ///< sums to 1
};
AreaWeights area_weights(int finer_extent, int i);

/// Extents of the finer level in texels; depth is 1 unless the texture is 3-D.
struct FinerLevel {
    int width, height, depth;
};

/// Texels of the finer level, half-open ranges.
struct TexelBox {
    int x0, x1, y0, y1, z0, z1;
    int width() const { return x1 - x0; }
    int height() const { return y1 - y0; }
};
/// The most texels that lie under one block: four texels of an odd axis cover nine, one depth slice covers three.
inline constexpr int kMostTexelsUnderBlock = 9 * 9 * 3;

/// What the block (`block_x`, `block_y`) of depth slice `z` is made from.
TexelBox texels_under(const FinerLevel& finer, int block_x, int block_y, int z);

/// Writes the 16 texels of that block, encoded last, to `out` (16 * texel_bytes). Texels outside the level repeat its last column and row.
/// `under` holds the linear values of texels_under(...): x fastest, then y, then z.
void make_mip_block(const FinerLevel& finer, int block_x, int block_y, int z, const std::array<float, 4>* under,
                    const TexelEncoder& encoder, int texel_bytes, std::byte* out);

}  // namespace rawtexel::texunit
