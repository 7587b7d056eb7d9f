// The modes of BC7: the widths of their fields and where these lie in a block.
#pragma once

#include <array>
#include <cstddef>

namespace rawtexel::texunit {

/// Widths of a mode's fields, in the order in which the block holds them (ARB_texture_compression_bptc, table M).
struct Bc7Mode {
    int subsets, partition_bits, rotation_bits, selection_bits, colour_bits, alpha_bits, endpoint_p_bits, shared_p_bits, index_bits,
        second_index_bits;
};

inline constexpr std::array<Bc7Mode, 8> kBc7Modes = {{
    {3, 4, 0, 0, 4, 0, 1, 0, 3, 0},
    {2, 6, 0, 0, 6, 0, 0, 1, 3, 0},
    {3, 6, 0, 0, 5, 0, 0, 0, 2, 0},
    {2, 6, 0, 0, 7, 0, 1, 0, 2, 0},
    {1, 0, 2, 1, 5, 6, 0, 0, 2, 3},
    {1, 0, 2, 0, 7, 8, 0, 0, 2, 2},
    {1, 0, 0, 0, 7, 7, 1, 0, 4, 0},
    {2, 6, 0, 0, 5, 5, 1, 0, 2, 0},
}};

/// First bits of the fields of mode `mode`, whose own code takes mode + 1 bits.
struct Bc7Places {
    int partition, rotation, selection, colour, alpha, p_bits, indices, second_indices;
};

constexpr Bc7Places bc7_places(int mode) {
    const Bc7Mode& m = kBc7Modes[size_t(mode)];
    const int endpoints = 2 * m.subsets;
    Bc7Places at{};
    at.partition = mode + 1;
    at.rotation = at.partition + m.partition_bits;
    at.selection = at.rotation + m.rotation_bits;
    at.colour = at.selection + m.selection_bits;
    at.alpha = at.colour + 3 * endpoints * m.colour_bits;
    at.p_bits = at.alpha + endpoints * m.alpha_bits;
    at.indices = at.p_bits + endpoints * m.endpoint_p_bits + m.subsets * m.shared_p_bits;
    at.second_indices = at.indices + 16 * m.index_bits - m.subsets;
    return at;
}

constexpr bool bc7_modes_fill_the_block() {
    for (int mode = 0; mode < 8; ++mode) {
        const Bc7Mode& m = kBc7Modes[size_t(mode)];
        const int second = m.second_index_bits == 0 ? 0 : 16 * m.second_index_bits - 1;
        if (bc7_places(mode).second_indices + second != 128) return false;
    }
    return true;
}
static_assert(bc7_modes_fill_the_block());

}  // namespace rawtexel::texunit
