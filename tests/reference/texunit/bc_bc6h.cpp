#include "tests/reference/texunit/bc_bc6h.h"

#include "tests/reference/texunit/bc_partition_tables.h"

#include <string_view>
#include <vector>

namespace rawtexel::reference {
namespace {

struct ModePlaces {
    Bc6hModeWidths widths;
    /// For each endpoint's red, green and blue: where in the block its bits are, lowest first; "a-b" runs up or down.
    std::string_view places[12];
};

// clang-format off
constexpr ModePlaces kModes[kBc6hModeCount] = {
    {{0, true, 2, 10, {5, 5, 5}},
     {"5-14", "15-24", "25-34", "35-39", "45-49", "55-59",
      "65-69", "41-44,2", "61-64,3", "71-75", "51-54,40", "50,60,70,76,4"}},
    {{1, true, 2, 7, {6, 6, 6}},
     {"5-11", "15-21", "25-31", "35-40", "45-50", "55-60",
      "65-70", "41-44,24,2", "61-64,14,22", "71-76", "51-54,3-4", "12-13,23,32,34-33"}},
    {{2, true, 2, 11, {5, 4, 4}},
     {"5-14,40", "15-24,49", "25-34,59", "35-39", "45-48", "55-58",
      "65-69", "41-44", "61-64", "71-75", "51-54", "50,60,70,76"}},
    {{6, true, 2, 11, {4, 5, 4}},
     {"5-14,39", "15-24,50", "25-34,59", "35-38", "45-49", "55-58",
      "65-68", "41-44,75", "61-64", "71-74", "51-54,40", "69,60,70,76"}},
    {{10, true, 2, 11, {4, 4, 5}},
     {"5-14,39", "15-24,49", "25-34,60", "35-38", "45-48", "55-59",
      "65-68", "41-44", "61-64,40", "71-74", "51-54", "50,69-70,76-75"}},
    {{14, true, 2, 9, {5, 5, 5}},
     {"5-13", "15-23", "25-33", "35-39", "45-49", "55-59",
      "65-69", "41-44,24", "61-64,14", "71-75", "51-54,40", "50,60,70,76,34"}},
    {{18, true, 2, 8, {6, 5, 5}},
     {"5-12", "15-22", "25-32", "35-40", "45-49", "55-59",
      "65-70", "41-44,24", "61-64,14", "71-76", "51-54,13", "50,60,23,33-34"}},
    {{22, true, 2, 8, {5, 6, 5}},
     {"5-12", "15-22", "25-32", "35-39", "45-50", "55-59",
      "65-69", "41-44,24-23", "61-64,14", "71-75", "51-54,40,33", "13,60,70,76,34"}},
    {{26, true, 2, 8, {5, 5, 6}},
     {"5-12", "15-22", "25-32", "35-39", "45-49", "55-60",
      "65-69", "41-44,24", "61-64,14,23", "71-75", "51-54,40", "50,13,70,76,34-33"}},
    {{30, false, 2, 6, {6, 6, 6}},
     {"5-10", "15-20", "25-30", "35-40", "45-50", "55-60",
      "65-70", "41-44,24,21", "61-64,14,22", "71-76", "51-54,11,31", "12-13,23,32,34-33"}},
    {{3, false, 1, 10, {10, 10, 10}},
     {"5-14", "15-24", "25-34", "35-44", "45-54", "55-64",
      "", "", "", "", "", ""}},
    {{7, true, 1, 11, {9, 9, 9}},
     {"5-14,44", "15-24,54", "25-34,64", "35-43", "45-53", "55-63",
      "", "", "", "", "", ""}},
    {{11, true, 1, 12, {8, 8, 8}},
     {"5-14,44-43", "15-24,54-53", "25-34,64-63", "35-42", "45-52", "55-62",
      "", "", "", "", "", ""}},
    {{15, true, 1, 16, {4, 4, 4}},
     {"5-14,44-39", "15-24,54-49", "25-34,64-59", "35-38", "45-48", "55-58",
      "", "", "", "", "", ""}},
};
// clang-format on

constexpr int kPartitionPlace = 77;

std::vector<int> read_places(std::string_view text) {
    std::vector<int> places;
    int number = 0, run_start = -1;
    const auto finish = [&] {
        if (run_start < 0) run_start = number;
        const int step = number >= run_start ? 1 : -1;
        for (int at = run_start; at != number + step; at += step) places.push_back(at);
        number = 0;
        run_start = -1;
    };
    if (text.empty()) return places;
    for (const char c : text) {
        if (c == ',') {
            finish();
        } else if (c == '-') {
            run_start = number;
            number = 0;
        } else {
            number = 10 * number + (c - '0');
        }
    }
    finish();
    return places;
}

const std::vector<int>& places(int mode, int variable) {
    static const auto all = [] {
        std::array<std::array<std::vector<int>, 12>, kBc6hModeCount> table;
        for (int m = 0; m < kBc6hModeCount; ++m) {
            for (int v = 0; v < 12; ++v) table[size_t(m)][size_t(v)] = read_places(kModes[m].places[v]);
        }
        return table;
    }();
    return all[size_t(mode)][size_t(variable)];
}

int index_bits(const Bc6hModeWidths& m) { return m.subsets == 2 ? 3 : 4; }

/// Calls visit(texel, place, bits) for every index, in the order of the block.
template <class Visit>
void each_index(const Bc6hBlockFields& f, Visit visit) {
    const Bc6hModeWidths& m = kModes[f.mode].widths;
    int at = m.subsets == 2 ? 82 : 65;
    for (int texel = 0; texel < 16; ++texel) {
        const int bits = index_bits(m) - (bc6h_is_anchor(f, texel) ? 1 : 0);
        visit(texel, at, bits);
        at += bits;
    }
}

/// The value modulo 2^bits that lies in [-2^(bits-1), 2^(bits-1)).
int as_signed(int value, int bits) {
    const int range = 1 << bits;
    value = ((value % range) + range) % range;
    return value >= range / 2 ? value - range : value;
}

int as_unsigned(int value, int bits) {
    const int range = 1 << bits;
    return ((value % range) + range) % range;
}

/// Endpoint `endpoint` after sign extension and transformation.
int resolved(const Bc6hBlockFields& f, bool is_signed, int endpoint, int channel) {
    const Bc6hModeWidths& m = kModes[f.mode].widths;
    const int base = f.code[0][channel], code = f.code[endpoint][channel];
    int value = code;
    if (endpoint > 0 && m.transformed) value = base + as_signed(code, m.delta_bits[channel]);
    return is_signed ? as_signed(value, m.endpoint_bits) : as_unsigned(value, m.endpoint_bits);
}

int unquantized(int value, int bits, bool is_signed) {
    if (!is_signed) {
        if (bits >= 15 || value == 0) return value;
        return value == (1 << bits) - 1 ? 0xFFFF : ((value << 15) + 0x4000) >> (bits - 1);
    }
    if (bits >= 16 || value == 0) return value;
    if (value < 0) return -unquantized(-value, bits, true);
    return value >= (1 << (bits - 1)) - 1 ? 0x7FFF : ((value << 15) + 0x4000) >> (bits - 1);
}

int weight(int index, int bits) {
    static constexpr int three[] = {0, 9, 18, 27, 37, 46, 55, 64}, four[] = {0, 4, 9, 13, 17, 21, 26, 30, 34, 38, 43, 47, 51, 55, 60, 64};
    return bits == 3 ? three[index] : four[index];
}

int floor_divide(int value, int by) { return value >= 0 ? value / by : -((-value + by - 1) / by); }

uint16_t finished(int value, bool is_signed) {
    if (!is_signed) return uint16_t(value * 31 / 64);
    if (value >= 0) return uint16_t(value * 31 / 32);
    const int magnitude = -value * 31 / 32;
    return magnitude == 0 ? uint16_t{0} : uint16_t(0x8000 + magnitude);
}

}  // namespace

const Bc6hModeWidths& bc6h_mode(int mode) { return kModes[mode].widths; }

bool bc6h_is_anchor(const Bc6hBlockFields& f, int texel) {
    return texel == 0 || (kModes[f.mode].widths.subsets == 2 && texel == kAnchors2[f.partition]);
}

Block16 build_bc6h(const Bc6hBlockFields& f) {
    Block16 block{};
    const auto put = [&](int value, int at, int bits) {
        for (int i = 0; i < bits; ++i) {
            if ((value >> i) & 1) set_block_bit(block, at + i);
        }
    };
    if (f.mode < 0) {
        put(f.reserved_code, 0, 5);
        return block;
    }
    const Bc6hModeWidths& m = kModes[f.mode].widths;
    put(m.code, 0, m.code < 2 ? 2 : 5);
    if (m.subsets == 2) put(f.partition, kPartitionPlace, 5);
    for (int variable = 0; variable < 12; ++variable) {
        const std::vector<int>& at = places(f.mode, variable);
        for (size_t i = 0; i < at.size(); ++i) put((f.code[variable / 3][variable % 3] >> i) & 1, at[i], 1);
    }
    each_index(f, [&](int texel, int at, int bits) { put(f.index[texel], at, bits); });
    return block;
}

Bc6hBlockFields take_apart_bc6h(const Block16& block) {
    const auto take = [&](int at, int bits) {
        int value = 0;
        for (int i = 0; i < bits; ++i) value |= block_bit(block, at + i) << i;
        return value;
    };
    Bc6hBlockFields f;
    f.mode = -1;
    const int code = take(0, 2) < 2 ? take(0, 2) : take(0, 5);
    for (int mode = 0; mode < kBc6hModeCount; ++mode) {
        if (kModes[mode].widths.code == code) f.mode = mode;
    }
    if (f.mode < 0) {
        f.reserved_code = code;
        return f;
    }
    const Bc6hModeWidths& m = kModes[f.mode].widths;
    if (m.subsets == 2) f.partition = take(kPartitionPlace, 5);
    for (int variable = 0; variable < 12; ++variable) {
        const std::vector<int>& at = places(f.mode, variable);
        for (size_t i = 0; i < at.size(); ++i) f.code[variable / 3][variable % 3] |= take(at[i], 1) << i;
    }
    each_index(f, [&](int texel, int at, int bits) { f.index[texel] = take(at, bits); });
    return f;
}

std::array<std::array<uint16_t, 3>, 16> evaluate_bc6h(const Bc6hBlockFields& f, bool is_signed) {
    std::array<std::array<uint16_t, 3>, 16> texels{};
    if (f.mode < 0) return texels;
    const Bc6hModeWidths& m = kModes[f.mode].widths;
    int endpoint[4][3];
    for (int e = 0; e < 2 * m.subsets; ++e) {
        for (int c = 0; c < 3; ++c) endpoint[e][c] = unquantized(resolved(f, is_signed, e, c), m.endpoint_bits, is_signed);
    }
    for (int texel = 0; texel < 16; ++texel) {
        const int subset = m.subsets == 2 ? kPartitions2[f.partition][size_t(texel)] - '0' : 0;
        const int w = weight(f.index[texel], index_bits(m));
        for (int c = 0; c < 3; ++c) {
            const int sum = (64 - w) * endpoint[2 * subset][c] + w * endpoint[2 * subset + 1][c] + 32;
            texels[size_t(texel)][size_t(c)] = finished(floor_divide(sum, 64), is_signed);
        }
    }
    return texels;
}

}  // namespace rawtexel::reference
