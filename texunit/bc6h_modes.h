// The modes of BC6H: how their endpoints are coded and where the bits of a block go.
#pragma once

#include <array>
#include <string_view>

namespace rawtexel::texunit {

struct Bc6hMode {
    int code;          ///< 2 bits for the codes 0 and 1, else 5 bits
    bool transformed;  ///< endpoints other than the first are differences from it
    int subsets;       ///< 2 with a 5-bit partition, or 1
    int endpoint_bits;
    int delta_bits[3];      ///< of the other endpoints' red, green, blue
    std::string_view bits;  ///< where the block's bits go, from its lowest bit: v[a:b] fills bits b … a of v, v[b:a] with b < a likewise
                            ///< from the highest down; r, g, b are channels, 0 … 3 endpoints (two a subset), m the code, d the partition
};

/// ARB_texture_compression_bptc, tables MF and F.
// clang-format off
inline constexpr std::array<Bc6hMode, 14> kBc6hModes = {{
    {0, true, 2, 10, {5, 5, 5},
     "m[1:0],g2[4],b2[4],b3[4],r0[9:0],g0[9:0],b0[9:0],r1[4:0],g3[4],g2[3:0],g1[4:0],b3[0],g3[3:0],b1[4:0],b3[1],b2[3:0],r2[4:0],b3[2],"
     "r3[4:0],b3[3],d[4:0]"},
    {1, true, 2, 7, {6, 6, 6},
     "m[1:0],g2[5],g3[4],g3[5],r0[6:0],b3[0],b3[1],b2[4],g0[6:0],b2[5],b3[2],g2[4],b0[6:0],b3[3],b3[5],b3[4],r1[5:0],g2[3:0],g1[5:0],"
     "g3[3:0],b1[5:0],b2[3:0],r2[5:0],r3[5:0],d[4:0]"},
    {2, true, 2, 11, {5, 4, 4},
     "m[4:0],r0[9:0],g0[9:0],b0[9:0],r1[4:0],r0[10],g2[3:0],g1[3:0],g0[10],b3[0],g3[3:0],b1[3:0],b0[10],b3[1],b2[3:0],r2[4:0],b3[2],"
     "r3[4:0],b3[3],d[4:0]"},
    {6, true, 2, 11, {4, 5, 4},
     "m[4:0],r0[9:0],g0[9:0],b0[9:0],r1[3:0],r0[10],g3[4],g2[3:0],g1[4:0],g0[10],g3[3:0],b1[3:0],b0[10],b3[1],b2[3:0],r2[3:0],b3[0],"
     "b3[2],r3[3:0],g2[4],b3[3],d[4:0]"},
    {10, true, 2, 11, {4, 4, 5},
     "m[4:0],r0[9:0],g0[9:0],b0[9:0],r1[3:0],r0[10],b2[4],g2[3:0],g1[3:0],g0[10],b3[0],g3[3:0],b1[4:0],b0[10],b2[3:0],r2[3:0],b3[1],"
     "b3[2],r3[3:0],b3[4],b3[3],d[4:0]"},
    {14, true, 2, 9, {5, 5, 5},
     "m[4:0],r0[8:0],b2[4],g0[8:0],g2[4],b0[8:0],b3[4],r1[4:0],g3[4],g2[3:0],g1[4:0],b3[0],g3[3:0],b1[4:0],b3[1],b2[3:0],r2[4:0],b3[2],"
     "r3[4:0],b3[3],d[4:0]"},
    {18, true, 2, 8, {6, 5, 5},
     "m[4:0],r0[7:0],g3[4],b2[4],g0[7:0],b3[2],g2[4],b0[7:0],b3[3],b3[4],r1[5:0],g2[3:0],g1[4:0],b3[0],g3[3:0],b1[4:0],b3[1],b2[3:0],"
     "r2[5:0],r3[5:0],d[4:0]"},
    {22, true, 2, 8, {5, 6, 5},
     "m[4:0],r0[7:0],b3[0],b2[4],g0[7:0],g2[5],g2[4],b0[7:0],g3[5],b3[4],r1[4:0],g3[4],g2[3:0],g1[5:0],g3[3:0],b1[4:0],b3[1],b2[3:0],"
     "r2[4:0],b3[2],r3[4:0],b3[3],d[4:0]"},
    {26, true, 2, 8, {5, 5, 6},
     "m[4:0],r0[7:0],b3[1],b2[4],g0[7:0],b2[5],g2[4],b0[7:0],b3[5],b3[4],r1[4:0],g3[4],g2[3:0],g1[4:0],b3[0],g3[3:0],b1[5:0],b2[3:0],"
     "r2[4:0],b3[2],r3[4:0],b3[3],d[4:0]"},
    {30, false, 2, 6, {6, 6, 6},
     "m[4:0],r0[5:0],g3[4],b3[0],b3[1],b2[4],g0[5:0],g2[5],b2[5],b3[2],g2[4],b0[5:0],g3[5],b3[3],b3[5],b3[4],r1[5:0],g2[3:0],g1[5:0],"
     "g3[3:0],b1[5:0],b2[3:0],r2[5:0],r3[5:0],d[4:0]"},
    {3, false, 1, 10, {10, 10, 10}, "m[4:0],r0[9:0],g0[9:0],b0[9:0],r1[9:0],g1[9:0],b1[9:0]"},
    {7, true, 1, 11, {9, 9, 9}, "m[4:0],r0[9:0],g0[9:0],b0[9:0],r1[8:0],r0[10],g1[8:0],g0[10],b1[8:0],b0[10]"},
    {11, true, 1, 12, {8, 8, 8}, "m[4:0],r0[9:0],g0[9:0],b0[9:0],r1[7:0],r0[10:11],g1[7:0],g0[10:11],b1[7:0],b0[10:11]"},
    {15, true, 1, 16, {4, 4, 4}, "m[4:0],r0[9:0],g0[9:0],b0[9:0],r1[3:0],r0[10:15],g1[3:0],g0[10:15],b1[3:0],b0[10:15]"},
}};
// clang-format on

/// One element of `Bc6hMode::bits`: `count` bits of the block from `first` go to the variable's bits from `low` up, or reversed.
struct Bc6hField {
    int variable;  ///< 3*endpoint + channel, or one of the two below
    int first, low, count;
    bool reversed;
};
inline constexpr int kBc6hPartition = 12, kBc6hCode = 13;

struct Bc6hFields {
    std::array<Bc6hField, 32> field{};
    int count = 0;
    int bits = 0;  ///< of the block, all fields together: 82 with two subsets, 65 with one
};

/// Reads the notation of `Bc6hMode::bits`.
constexpr Bc6hFields parse_bc6h_fields(std::string_view text) {
    Bc6hFields fields;
    size_t at = 0;
    const auto number = [&] {
        int value = 0;
        while (text[at] >= '0' && text[at] <= '9') value = 10 * value + (text[at++] - '0');
        return value;
    };
    while (at < text.size()) {
        Bc6hField field{};
        const char letter = text[at++];
        switch (letter) {
            case 'm': field.variable = kBc6hCode; break;
            case 'd': field.variable = kBc6hPartition; break;
            case 'r': field.variable = 3 * number(); break;
            case 'g': field.variable = 3 * number() + 1; break;
            default: field.variable = 3 * number() + 2; break;
        }
        ++at;  // [
        const int left = number();
        const int right = text[at] == ':' ? (++at, number()) : left;
        at += 2;  // ],
        field.reversed = left < right;
        field.low = left < right ? left : right;
        field.count = (left < right ? right - left : left - right) + 1;
        field.first = fields.bits;
        fields.bits += field.count;
        fields.field[size_t(fields.count++)] = field;
    }
    return fields;
}

constexpr bool bc6h_modes_fill_the_block() {
    for (const Bc6hMode& mode : kBc6hModes) {
        const int index_bits = mode.subsets == 2 ? 16 * 3 - 2 : 16 * 4 - 1;
        if (parse_bc6h_fields(mode.bits).bits + index_bits != 128) return false;
    }
    return true;
}
static_assert(bc6h_modes_fill_the_block());

}  // namespace rawtexel::texunit
