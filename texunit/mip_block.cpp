#include "texunit/mip_block.h"

#include "texunit/texel_source.h"

#include <algorithm>
#include <cassert>

namespace rawtexel::texunit {
namespace {

using Colour = std::array<double, 4>;
using BlockWeights = std::array<AreaWeights, 4>;

/// Weights of the four texels of a block along one axis; those outside the level repeat its last texel.
BlockWeights block_weights(int finer_extent, int block) {
    const int extent = level_extent(finer_extent, 1);
    BlockWeights weights;
    for (int i = 0; i < 4; ++i) weights[size_t(i)] = area_weights(finer_extent, std::min(4 * block + i, extent - 1));
    return weights;
}

int end_of(const AreaWeights& weights) { return weights.first + weights.count; }

void add_scaled(Colour& sum, const Colour& value, double weight) {
    for (size_t c = 0; c < 4; ++c) sum[c] += weight * value[c];
}

Colour widen(const std::array<float, 4>& value) { return {value[0], value[1], value[2], value[3]}; }

}  // namespace

AreaWeights area_weights(int finer_extent, int i) {
    if (finer_extent == 1) return {0, 1, {1}};
    if (finer_extent % 2 == 0) return {2 * i, 2, {0.5, 0.5}};
    const int extent = finer_extent / 2;
    const double whole = finer_extent;
    return {2 * i, 3, {(extent - i) / whole, extent / whole, (i + 1) / whole}};
}

TexelBox texels_under(const FinerLevel& finer, int block_x, int block_y, int z) {
    const BlockWeights columns = block_weights(finer.width, block_x), rows = block_weights(finer.height, block_y);
    const AreaWeights depths = area_weights(finer.depth, z);
    return {columns[0].first, end_of(columns[3]), rows[0].first, end_of(rows[3]), depths.first, end_of(depths)};
}

void make_mip_block(const FinerLevel& finer, int block_x, int block_y, int z, const std::array<float, 4>* under,
                    const TexelEncoder& encoder, int texel_bytes, std::byte* out) {
    const TexelBox box = texels_under(finer, block_x, block_y, z);
    const BlockWeights columns = block_weights(finer.width, block_x), rows = block_weights(finer.height, block_y);
    const AreaWeights depths = area_weights(finer.depth, z);

    // Average over z and x first: one row of four texels for each row of the finer level, so the second pass has half the work.
    std::array<std::array<Colour, 4>, 9> averaged{};
    assert(box.height() <= int(averaged.size()));
    for (int d = 0; d < depths.count; ++d) {
        for (int y = 0; y < box.height(); ++y) {
            const std::array<float, 4>* const row = under + (d * box.height() + y) * box.width();
            for (size_t i = 0; i < 4; ++i) {
                for (int k = 0; k < columns[i].count; ++k) {
                    const double weight = columns[i].weight[size_t(k)] * depths.weight[size_t(d)];
                    add_scaled(averaged[size_t(y)][i], widen(row[columns[i].first - box.x0 + k]), weight);
                }
            }
        }
    }

    // Then over y, and encode.
    for (size_t j = 0; j < 4; ++j) {
        for (size_t i = 0; i < 4; ++i) {
            Colour mean{};
            for (int k = 0; k < rows[j].count; ++k) {
                add_scaled(mean, averaged[size_t(rows[j].first - box.y0 + k)][i], rows[j].weight[size_t(k)]);
            }
            encoder.store(mean, out + (4 * j + i) * size_t(texel_bytes));
        }
    }
}

}  // namespace rawtexel::texunit
