#include "texunit/bc7.h"

#include "texunit/bc_bits.h"
#include "texunit/bc_partitions.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <utility>

namespace rawtexel::texunit {
namespace {

/// Widths of a mode's fields, in the order in which the block holds them (ARB_texture_compression_bptc, table M).
struct Mode {
    int subsets, partition_bits, rotation_bits, selection_bits, colour_bits, alpha_bits, endpoint_p_bits, shared_p_bits, index_bits,
        second_index_bits;
};

constexpr std::array<Mode, 8> kModes = {{
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
struct Places {
    int partition, rotation, selection, colour, alpha, p_bits, indices, second_indices;
};

constexpr Places places_of(int mode) {
    const Mode& m = kModes[size_t(mode)];
    const int endpoints = 2 * m.subsets;
    Places at{};
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

constexpr bool modes_fill_the_block() {
    for (int mode = 0; mode < 8; ++mode) {
        const Mode& m = kModes[size_t(mode)];
        const int second = m.second_index_bits == 0 ? 0 : 16 * m.second_index_bits - 1;
        if (places_of(mode).second_indices + second != 128) return false;
    }
    return true;
}
static_assert(modes_fill_the_block());

/// Four channels in the 16-bit lanes of one word, red lowest: wide enough to weigh two 8-bit colours with 64ths in one go.
using Lanes = uint64_t;
constexpr Lanes kEveryLane = 0x0001000100010001;
constexpr Lanes kByteOfLane = 0xFF * kEveryLane;

constexpr Lanes interpolate(Lanes first, Lanes second, uint32_t weight) {
    return (((64 - weight) * first + weight * second + 32 * kEveryLane) >> 6) & kByteOfLane;
}

/// The low bytes of the four lanes, next to each other.
constexpr uint32_t pack(Lanes lanes) {
    const uint64_t pairs = (lanes | (lanes >> 8)) & 0x0000FFFF0000FFFF;
    return uint32_t(pairs | (pairs >> 16));
}

/// A code of `bits` bits to 8 bits: its highest bits are repeated below.
constexpr uint64_t to_8_bits(uint64_t code, int bits) {
    const uint64_t high = code << (8 - bits);
    return high | (high >> bits);
}

/// Endpoint `e` (subset e / 2) of a mode, as 8-bit codes.
template <int mode, int e>
inline Lanes endpoint(const BlockBits& bits) {
    constexpr Mode m = kModes[mode];
    constexpr Places at = places_of(mode);
    constexpr bool has_p_bit = m.endpoint_p_bits + m.shared_p_bits > 0;
    constexpr int p_bit = m.shared_p_bits > 0 ? e / 2 : e;

    const auto with_p_bit = [&](uint64_t code) { return has_p_bit ? (code << 1) | bits.field(at.p_bits + p_bit, 1) : code; };
    const auto colour = [&](int c) {
        const uint64_t code = bits.field(at.colour + (2 * m.subsets * c + e) * m.colour_bits, m.colour_bits);
        return to_8_bits(with_p_bit(code), m.colour_bits + has_p_bit);
    };
    uint64_t alpha = 255;
    if constexpr (m.alpha_bits > 0) {
        alpha = to_8_bits(with_p_bit(bits.field(at.alpha + e * m.alpha_bits, m.alpha_bits)), m.alpha_bits + has_p_bit);
    }
    return colour(0) | (colour(1) << 16) | (colour(2) << 32) | (alpha << 48);
}

void store(std::byte* texels, int i, uint32_t word) { std::memcpy(texels + 4 * i, &word, 4); }

template <int mode, int subset, class Palette>
inline void fill_palette(const BlockBits& bits, Palette& palette) {
    const Lanes first = endpoint<mode, 2 * subset>(bits), second = endpoint<mode, 2 * subset + 1>(bits);
    const auto& weights = interpolation_weights<kModes[mode].index_bits>();
    for (size_t i = 0; i < weights.size(); ++i) palette[subset * weights.size() + i] = pack(interpolate(first, second, weights[i]));
}

/// Modes with one set of indices: 0, 1, 2, 3, 6 and 7.
template <int mode>
void decode_with_one_index(const BlockBits& bits, std::byte* texels) {
    constexpr Mode m = kModes[mode];
    constexpr Places at = places_of(mode);
    constexpr int n = m.index_bits;

    std::array<uint32_t, size_t(m.subsets) << n> palette;
    [&]<int... subset>(std::integer_sequence<int, subset...>) { (fill_palette<mode, subset>(bits, palette), ...); }
    (std::make_integer_sequence<int, m.subsets>{});

    const size_t partition = bits.field(at.partition, m.partition_bits);
    uint64_t indices = widen_anchor(bits.field(at.indices, 16 * n - m.subsets), 0, n);
    uint32_t subsets = 0;
    if constexpr (m.subsets == 2) {
        indices = widen_anchor(indices, kAnchors2[partition], n);
        subsets = kPartitions2[partition];
    } else if constexpr (m.subsets == 3) {
        // The lower anchor goes first, so that the place of the higher one is right when its turn comes.
        const auto [lower, higher] = std::minmax(kAnchors3[0][partition], kAnchors3[1][partition]);
        indices = widen_anchor(widen_anchor(indices, lower, n), higher, n);
        subsets = kPartitions3[partition];
    }

    constexpr int subset_bits = m.subsets - 1;
    for (int i = 0; i < 16; ++i) {
        const uint64_t subset = m.subsets == 1 ? 0 : (subsets >> (subset_bits * i)) & uint32_t(subset_bits == 2 ? 3 : 1);
        store(texels, i, palette[(subset << n) | ((indices >> (n * i)) & ((1u << n) - 1))]);
    }
}

/// Exchanges alpha with the channel that a rotation of 1, 2 or 3 names; 0 changes nothing.
constexpr Lanes rotate(Lanes lanes, int rotation) {
    if (rotation == 0) return lanes;
    const int channel = 16 * (rotation - 1);
    const uint64_t difference = ((lanes >> channel) ^ (lanes >> 48)) & 0xFFFF;
    return lanes ^ (difference << channel) ^ (difference << 48);
}

template <int index_bits>
inline void fill_palette(Lanes first, Lanes second, uint32_t kept, uint32_t* palette) {
    const auto& weights = interpolation_weights<index_bits>();
    for (size_t i = 0; i < weights.size(); ++i) palette[i] = pack(interpolate(first, second, weights[i])) & kept;
}

/// Modes 4 and 5: alpha has indices of its own. Endpoints are rotated before interpolation, which is the same and touches two words only.
template <int mode>
void decode_with_two_indices(const BlockBits& bits, std::byte* texels) {
    constexpr Mode m = kModes[mode];
    constexpr Places at = places_of(mode);
    constexpr int n1 = m.index_bits, n2 = m.second_index_bits;

    const int rotation = int(bits.field(at.rotation, m.rotation_bits));
    const Lanes first = rotate(endpoint<mode, 0>(bits), rotation), second = rotate(endpoint<mode, 1>(bits), rotation);
    const uint32_t alpha_place = 0xFFu << (rotation == 0 ? 24 : 8 * (rotation - 1));

    // The first indices weigh colour and the second alpha, unless the selection bit exchanges them.
    const bool exchanged = bits.field(at.selection, m.selection_bits) != 0;
    const uint32_t first_kept = exchanged ? alpha_place : ~alpha_place;
    std::array<uint32_t, 1 << n1> palette1;
    std::array<uint32_t, 1 << n2> palette2;
    fill_palette<n1>(first, second, first_kept, palette1.data());
    fill_palette<n2>(first, second, ~first_kept, palette2.data());

    const uint64_t indices1 = widen_anchor(bits.field(at.indices, 16 * n1 - 1), 0, n1);
    const uint64_t indices2 = widen_anchor(bits.field(at.second_indices, 16 * n2 - 1), 0, n2);
    for (int i = 0; i < 16; ++i) {
        store(texels, i, palette1[(indices1 >> (n1 * i)) & ((1u << n1) - 1)] | palette2[(indices2 >> (n2 * i)) & ((1u << n2) - 1)]);
    }
}

}  // namespace

void decode_bc7(const std::byte* block, std::byte* texels) {
    const BlockBits bits(block);
    switch (std::countr_zero(uint32_t(bits.low & 0xFF) | 0x100)) {
        case 0: return decode_with_one_index<0>(bits, texels);
        case 1: return decode_with_one_index<1>(bits, texels);
        case 2: return decode_with_one_index<2>(bits, texels);
        case 3: return decode_with_one_index<3>(bits, texels);
        case 4: return decode_with_two_indices<4>(bits, texels);
        case 5: return decode_with_two_indices<5>(bits, texels);
        case 6: return decode_with_one_index<6>(bits, texels);
        case 7: return decode_with_one_index<7>(bits, texels);
        default: std::memset(texels, 0, 64);
    }
}

}  // namespace rawtexel::texunit
