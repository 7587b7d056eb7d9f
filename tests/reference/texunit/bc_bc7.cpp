#include "tests/reference/texunit/bc_bc7.h"

#include "tests/reference/texunit/bc_partition_tables.h"

#include <utility>

namespace rawtexel::reference {
namespace {

constexpr Bc7Mode kModes[8] = {
    {3, 4, 0, 0, 4, 0, 1, 0, 3, 0}, {2, 6, 0, 0, 6, 0, 0, 1, 3, 0}, {3, 6, 0, 0, 5, 0, 0, 0, 2, 0}, {2, 6, 0, 0, 7, 0, 1, 0, 2, 0},
    {1, 0, 2, 1, 5, 6, 0, 0, 2, 3}, {1, 0, 2, 0, 7, 8, 0, 0, 2, 2}, {1, 0, 0, 0, 7, 7, 1, 0, 4, 0}, {2, 6, 0, 0, 5, 5, 1, 0, 2, 0},
};

int subset_of(const Bc7Fields& f, int texel) {
    const int subsets = kModes[f.mode].ns;
    if (subsets == 1) return 0;
    const auto& rows = subsets == 2 ? kPartitions2 : kPartitions3;
    return rows[f.partition][size_t(texel)] - '0';
}

/// Hands every field after the mode's code to `transfer(field, bits)`, in the order of the block.
template <class Fields, class Transfer>
void each_field(Fields& f, Transfer& transfer) {
    const Bc7Mode& m = kModes[f.mode];
    transfer(f.partition, m.pb);
    transfer(f.rotation, m.rb);
    transfer(f.selection, m.isb);
    for (int channel = 0; channel < 4; ++channel) {
        for (int subset = 0; subset < m.ns; ++subset) {
            for (int end = 0; end < 2; ++end) transfer(f.code[subset][end][channel], channel < 3 ? m.cb : m.ab);
        }
    }
    for (int subset = 0; subset < m.ns; ++subset) {
        for (int end = 0; end < m.spb + 2 * m.epb; ++end) transfer(f.p_bit[subset][end], 1);
    }
    for (int i = 0; i < 16; ++i) transfer(f.index[i], m.ib - (bc7_is_anchor(f, i) ? 1 : 0));
    if (m.ib2 == 0) return;
    for (int i = 0; i < 16; ++i) transfer(f.second_index[i], m.ib2 - (i == 0 ? 1 : 0));
}

int weight(int index, int bits) {
    static constexpr int two[] = {0, 21, 43, 64}, three[] = {0, 9, 18, 27, 37, 46, 55, 64},
                         four[] = {0, 4, 9, 13, 17, 21, 26, 30, 34, 38, 43, 47, 51, 55, 60, 64};
    return bits == 2 ? two[index] : bits == 3 ? three[index] : four[index];
}

/// A field of `bits` bits, its P-bit appended where there is one, widened to 8 bits by repeating its top bits.
int widen(const Bc7Fields& f, int subset, int end, int channel) {
    const Bc7Mode& m = kModes[f.mode];
    int bits = channel < 3 ? m.cb : m.ab;
    if (bits == 0) return 255;
    int value = f.code[subset][end][channel];
    if (m.epb || m.spb) {
        value = 2 * value + f.p_bit[subset][m.spb ? 0 : end];
        ++bits;
    }
    int byte = 0;
    for (int k = 0; k < 8; ++k) byte |= ((value >> (bits - 1 - k % bits)) & 1) << (7 - k);
    return byte;
}

}  // namespace

const Bc7Mode& bc7_mode(int mode) { return kModes[mode]; }

bool bc7_is_anchor(const Bc7Fields& f, int texel) {
    if (texel == 0) return true;
    const int subsets = kModes[f.mode].ns;
    if (subsets == 2) return texel == kAnchors2[f.partition];
    return subsets == 3 && (texel == kAnchors3[0][f.partition] || texel == kAnchors3[1][f.partition]);
}

Block16 build_bc7(const Bc7Fields& fields) {
    BlockWriter writer;
    if (fields.mode == 8) return writer.block();
    for (int i = 0; i < fields.mode; ++i) writer.put_bit(0);
    writer.put_bit(1);
    each_field(fields, writer);
    return writer.block();
}

Bc7Fields take_apart_bc7(const Block16& block) {
    BlockReader reader(block);
    Bc7Fields fields;
    while (fields.mode < 8 && reader.take_bit() == 0) ++fields.mode;
    if (fields.mode < 8) each_field(fields, reader);
    return fields;
}

std::array<std::array<uint8_t, 4>, 16> evaluate_bc7(const Bc7Fields& f) {
    std::array<std::array<uint8_t, 4>, 16> texels{};
    if (f.mode == 8) return texels;
    const Bc7Mode& m = kModes[f.mode];
    int endpoint[3][2][4];
    for (int subset = 0; subset < m.ns; ++subset) {
        for (int end = 0; end < 2; ++end) {
            for (int c = 0; c < 4; ++c) endpoint[subset][end][c] = widen(f, subset, end, c);
        }
    }
    for (int texel = 0; texel < 16; ++texel) {
        const auto& [first, second] = endpoint[subset_of(f, texel)];
        std::array<uint8_t, 4>& rgba = texels[size_t(texel)];
        for (int c = 0; c < 4; ++c) {
            // Colour takes the first indices and alpha the second; the selection bit exchanges them; without second indices both take the
            // first.
            const bool second_index = m.ib2 != 0 && (c == 3) != (f.selection == 1);
            const int w = weight(second_index ? f.second_index[texel] : f.index[texel], second_index ? m.ib2 : m.ib);
            rgba[size_t(c)] = uint8_t(((64 - w) * first[c] + w * second[c] + 32) / 64);
        }
        if (f.rotation != 0) std::swap(rgba[3], rgba[size_t(f.rotation - 1)]);
    }
    return texels;
}

}  // namespace rawtexel::reference
