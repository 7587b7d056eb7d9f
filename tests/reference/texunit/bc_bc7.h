// BC7 by the letter of ARB_texture_compression_bptc: a block taken apart into its fields, put together from them, and evaluated.
// Shares no code and no table with the library.
#pragma once

#include "tests/reference/texunit/bc_block_bits.h"

#include <array>
#include <cstdint>

namespace rawtexel::reference {

/// Widths of the fields of a mode (table M): subsets, partition, rotation, index selection, colour, alpha, P-bits per endpoint, P-bits per
/// subset, indices, second indices.
struct Bc7Mode {
    int ns, pb, rb, isb, cb, ab, epb, spb, ib, ib2;
};
const Bc7Mode& bc7_mode(int mode);

struct Bc7Fields {
    int mode = 0;  ///< 8: the reserved code
    int partition = 0, rotation = 0, selection = 0;
    int code[3][2][4] = {};  ///< subset, end, channel
    int p_bit[3][2] = {};    ///< subset, end; a shared bit is that of end 0
    int index[16] = {}, second_index[16] = {};
};

/// Whether texel `texel` is the anchor of its subset, whose index has a bit less.
bool bc7_is_anchor(const Bc7Fields& fields, int texel);

Block16 build_bc7(const Bc7Fields& fields);
Bc7Fields take_apart_bc7(const Block16& block);

/// Red, green, blue, alpha of the sixteen texels.
std::array<std::array<uint8_t, 4>, 16> evaluate_bc7(const Bc7Fields& fields);

}  // namespace rawtexel::reference
