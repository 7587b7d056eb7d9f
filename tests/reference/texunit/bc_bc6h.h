// BC6H by the letter of ARB_texture_compression_bptc: a block put together from its fields, taken apart and evaluated.
// Shares no code and no table with the library; its field places are those of D3D's table, which lists them bit by bit.
#pragma once

#include "tests/reference/texunit/bc_block_bits.h"

#include <array>
#include <cstdint>

namespace rawtexel::reference {

/// Code of a mode, whether endpoints are transformed, subsets, bits of the first endpoint and of the others' channels.
struct Bc6hModeWidths {
    int code;
    bool transformed;
    int subsets, endpoint_bits, delta_bits[3];
};
inline constexpr int kBc6hModeCount = 14;
const Bc6hModeWidths& bc6h_mode(int mode);

struct Bc6hBlockFields {
    int mode = 0;            ///< 0 to 13; -1: a reserved code
    int reserved_code = 19;  ///< 19, 23, 27 or 31, where mode is -1
    int partition = 0;
    int code[4][3] = {};  ///< endpoint, channel: unsigned codes as stored
    int index[16] = {};
};

bool bc6h_is_anchor(const Bc6hBlockFields& fields, int texel);

Block16 build_bc6h(const Bc6hBlockFields& fields);
Bc6hBlockFields take_apart_bc6h(const Block16& block);

/// Bits of the halves of red, green and blue of the sixteen texels. A negative value that becomes zero is +0 (D3D11.3 19.5.14).
std::array<std::array<uint16_t, 3>, 16> evaluate_bc6h(const Bc6hBlockFields& fields, bool is_signed);

}  // namespace rawtexel::reference
