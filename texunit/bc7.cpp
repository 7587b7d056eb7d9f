#include "texunit/bc7.h"

#include "texunit/bc7_modes.h"
#include "texunit/bc_bits.h"
#include "texunit/bc_partitions.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <utility>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "texunit/bc7.cpp"
#include <hwy/foreach_target.h>

#include "texunit/bc_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rawtexel::texunit {
namespace HWY_NAMESPACE {
namespace {

/// Four channels in the 16-bit lanes of one word, red lowest: wide enough to weigh two 8-bit colours with 64ths in one go.
using Colour = uint64_t;
constexpr Colour kEveryLane = 0x0001000100010001;
constexpr Colour kByteOfLane = 0xFF * kEveryLane;

/// Codes of `bits` bits to 8 bits: their highest bits are repeated below.
template <int bits>
constexpr Colour to_8_bits(Colour codes) {
    const Colour high = codes << (8 - bits);
    return (high | (high >> bits)) & kByteOfLane;
}

/// Endpoint `e` (subset e / 2) of a mode, as 8-bit codes.
template <int mode, int e>
HWY_INLINE Colour endpoint(const BlockBits& bits) {
    constexpr Bc7Mode m = kBc7Modes[mode];
    constexpr Bc7Places at = bc7_places(mode);
    constexpr int p_bits = m.endpoint_p_bits + m.shared_p_bits;
    constexpr int p_bit = m.shared_p_bits > 0 ? e / 2 : e;

    Colour codes = 0;
    for (int c = 0; c < 3; ++c) codes |= bits.field(at.colour + (2 * m.subsets * c + e) * m.colour_bits, m.colour_bits) << (16 * c);
    const uint64_t alpha = m.alpha_bits == 0 ? 255 : bits.field(at.alpha + e * m.alpha_bits, m.alpha_bits);
    if constexpr (m.alpha_bits == m.colour_bits) codes |= alpha << 48;
    if constexpr (p_bits > 0) codes = (codes << 1) | (bits.field(at.p_bits + p_bit, 1) * kEveryLane);
    codes = to_8_bits<m.colour_bits + p_bits>(codes);
    if constexpr (m.alpha_bits == m.colour_bits) return codes;
    constexpr Colour kColours = ~(Colour{0xFFFF} << 48);
    return (codes & kColours) | (to_8_bits < m.alpha_bits == 0 ? 8 : m.alpha_bits > (alpha) << 48);
}

template <int mode>
using Endpoints = std::array<Colour, size_t(2 * kBc7Modes[mode].subsets)>;

template <int mode>
HWY_INLINE Endpoints<mode> read_endpoints(const BlockBits& bits) {
    return [&]<int... e>(std::integer_sequence<int, e...>) HWY_ATTR { return Endpoints<mode>{endpoint<mode, e>(bits)...}; }
    (std::make_integer_sequence<int, 2 * kBc7Modes[mode].subsets>{});
}

/// Exchanges alpha with the channel that a rotation of 1, 2 or 3 names; 0 changes nothing.
HWY_INLINE Colour rotate(Colour colour, int rotation) {
    if (rotation == 0) return colour;
    const int channel = 16 * (rotation - 1);
    const uint64_t difference = ((colour >> channel) ^ (colour >> 48)) & 0xFFFF;
    return colour ^ (difference << channel) ^ (difference << 48);
}

/// Which subset each texel belongs to, in fields of subsets - 1 bits; and the indices, whole.
struct TexelFields {
    uint32_t subsets;
    uint64_t indices;
};

template <int mode>
HWY_INLINE TexelFields read_texel_fields(const BlockBits& bits) {
    constexpr Bc7Mode m = kBc7Modes[mode];
    constexpr Bc7Places at = bc7_places(mode);
    constexpr int n = m.index_bits;
    const size_t partition = bits.field(at.partition, m.partition_bits);
    const uint64_t indices = widen_anchor(bits.field(at.indices, 16 * n - m.subsets), 0, n);
    if constexpr (m.subsets == 1) return {0, indices};
    if constexpr (m.subsets == 2) return {kPartitions2[partition], widen_anchor(indices, kAnchors2[partition], n)};
    // The lower anchor goes first, so that the place of the higher one is right when its turn comes.
    const auto [lower, higher] = std::minmax(kAnchors3[0][partition], kAnchors3[1][partition]);
    return {kPartitions3[partition], widen_anchor(widen_anchor(indices, lower, n), higher, n)};
}

#if RAWTEXEL_BC_LANES

/// Weights of the second endpoint for eight colours, four times each: those that interpolate() computes first, then the others.
template <int index_bits>
constexpr std::array<int16_t, 32> spread_weights(int first_index) {
    const auto& weights = interpolation_weights<index_bits>();
    std::array<int16_t, 32> lanes{};
    for (int lane = 0; lane < 32; ++lane) {
        const int half = lane / 16, block = lane / 8 % 2, within = lane / 4 % 2;
        lanes[size_t(lane)] = weights[size_t(first_index + 4 * block + 2 * half + within) % weights.size()];
    }
    return lanes;
}

/// Eight colours as 32-bit texels: four (index_bits 2) of subset a and four of subset b, or eight of a, from index `first_index` on.
template <int index_bits, int first_index = 0>
HWY_INLINE TexelLanes interpolate(Colour first_a, Colour second_a, Colour first_b, Colour second_b) {
    const hn::FixedTag<uint64_t, 4> colours;
    const hn::FixedTag<int16_t, 16> d;
    const hn::FixedTag<uint8_t, 32> bytes;
    alignas(32) static constexpr std::array<int16_t, 32> kWeights = spread_weights<index_bits>(first_index);
    const auto both = [&](Colour a, Colour b) HWY_ATTR {
        if constexpr (index_bits > 2) return hn::BitCast(d, hn::Set(colours, a));
        return hn::BitCast(d, hn::ConcatLowerLower(colours, hn::Set(colours, b), hn::Set(colours, a)));
    };
    const auto first = both(first_a, first_b), second = both(second_a, second_b);
    // 64*first + 32 + weight*(second - first): all within 0 … 16352.
    const auto start = hn::Add(hn::ShiftLeft<6>(first), hn::Set(d, 32)), step = hn::Sub(second, first);
    const auto colour = [&](int half)
                            HWY_ATTR { return hn::ShiftRight<6>(hn::Add(start, hn::Mul(step, hn::Load(d, kWeights.data() + 16 * half)))); };
    const auto interleaved = hn::BitCast(bytes, hn::Or(colour(0), hn::ShiftLeft<8>(colour(1))));
    alignas(32) static constexpr uint8_t kEvenThenOdd[32] = {0, 2, 4, 6, 8, 10, 12, 14, 1, 3, 5, 7, 9, 11, 13, 15,
                                                             0, 2, 4, 6, 8, 10, 12, 14, 1, 3, 5, 7, 9, 11, 13, 15};
    return hn::BitCast(TexelTag(), hn::TableLookupBytes(interleaved, hn::Load(bytes, kEvenThenOdd)));
}

/// Modes with one set of indices: 0, 1, 2, 3, 6 and 7.
template <int mode>
HWY_INLINE void decode_with_one_index(const BlockBits& bits, std::byte* texels) {
    constexpr Bc7Mode m = kBc7Modes[mode];
    constexpr int n = m.index_bits, subset_bits = m.subsets - 1;
    constexpr int tables = ((m.subsets << n) + 7) / 8;

    const Endpoints<mode> e = read_endpoints<mode>(bits);
    TexelLanes palette[tables];
    if constexpr (n == 2) {
        palette[0] = interpolate<n>(e[0], e[1], e[2], e[3]);
        if constexpr (tables == 2) palette[1] = interpolate<n>(e[4], e[5], e[4], e[5]);
    } else if constexpr (n == 3) {
        for (size_t subset = 0; subset < tables; ++subset) {
            palette[subset] = interpolate<n>(e[2 * subset], e[2 * subset + 1], 0, 0);
        }
    } else {
        palette[0] = interpolate<n>(e[0], e[1], 0, 0);
        palette[1] = interpolate<n, 8>(e[0], e[1], 0, 0);
    }

    const TexelFields of = read_texel_fields<mode>(bits);
    for (int half = 0; half < 2; ++half) {
        TexelLanes index = unpack_fields<n>(of.indices >> (8 * n * half));
        if constexpr (subset_bits > 0) {
            index = hn::Or(index, hn::ShiftLeft<n>(unpack_fields<subset_bits>(of.subsets >> (8 * subset_bits * half))));
        }
        store_texels(look_up(palette, index), texels + 32 * half);
    }
}

/// Both palettes of modes 4 and 5 looked up; they have no channel in common.
template <int n1, int n2>
HWY_INLINE void store_two_palettes(Colour first, Colour second, uint32_t kept1, uint64_t indices1, uint64_t indices2, std::byte* texels) {
    const auto kept = hn::Set(TexelTag(), int32_t(kept1));
    const TexelLanes palette1 = hn::And(interpolate<n1>(first, second, first, second), kept);
    const TexelLanes palette2 = hn::AndNot(kept, interpolate<n2>(first, second, first, second));
    for (int half = 0; half < 2; ++half) {
        const TexelLanes part1 = look_up(palette1, unpack_fields<n1>(indices1 >> (8 * n1 * half)));
        const TexelLanes part2 = look_up(palette2, unpack_fields<n2>(indices2 >> (8 * n2 * half)));
        store_texels(hn::Or(part1, part2), texels + 32 * half);
    }
}

#else

/// A colour as a texel: the low bytes of the four lanes, next to each other.
constexpr uint32_t pack(Colour colour) {
    const uint64_t pairs = (colour | (colour >> 8)) & 0x0000FFFF0000FFFF;
    return uint32_t(pairs | (pairs >> 16));
}

template <int index_bits>
HWY_INLINE void fill_palette(Colour first, Colour second, uint32_t* palette) {
    const auto& weights = interpolation_weights<index_bits>();
    for (size_t i = 0; i < weights.size(); ++i) {
        const Colour sum = (64 - weights[i]) * first + weights[i] * second + 32 * kEveryLane;
        palette[i] = pack((sum >> 6) & kByteOfLane);
    }
}

HWY_INLINE void store(std::byte* texels, int i, uint32_t word) { std::memcpy(texels + 4 * i, &word, 4); }

template <int mode>
HWY_INLINE void decode_with_one_index(const BlockBits& bits, std::byte* texels) {
    constexpr Bc7Mode m = kBc7Modes[mode];
    constexpr int n = m.index_bits, subset_bits = m.subsets - 1;
    const Endpoints<mode> e = read_endpoints<mode>(bits);
    std::array<uint32_t, size_t(m.subsets) << n> palette;
    for (size_t subset = 0; subset < size_t(m.subsets); ++subset) {
        fill_palette<n>(e[2 * subset], e[2 * subset + 1], palette.data() + (subset << n));
    }
    const TexelFields of = read_texel_fields<mode>(bits);
    for (int i = 0; i < 16; ++i) {
        const uint64_t subset = (of.subsets >> (subset_bits * i)) & ((1u << subset_bits) - 1);
        store(texels, i, palette[(subset << n) | ((of.indices >> (n * i)) & ((1u << n) - 1))]);
    }
}

template <int n1, int n2>
HWY_INLINE void store_two_palettes(Colour first, Colour second, uint32_t kept1, uint64_t indices1, uint64_t indices2, std::byte* texels) {
    std::array<uint32_t, 1 << n1> palette1;
    std::array<uint32_t, 1 << n2> palette2;
    fill_palette<n1>(first, second, palette1.data());
    fill_palette<n2>(first, second, palette2.data());
    for (int i = 0; i < 16; ++i) {
        const uint32_t part1 = palette1[(indices1 >> (n1 * i)) & ((1u << n1) - 1)];
        const uint32_t part2 = palette2[(indices2 >> (n2 * i)) & ((1u << n2) - 1)];
        store(texels, i, (part1 & kept1) | (part2 & ~kept1));
    }
}

#endif  // RAWTEXEL_BC_LANES

/// Modes 4 and 5: alpha has indices of its own. Endpoints are rotated before interpolation, which is the same and touches two words only.
template <int mode>
HWY_INLINE void decode_with_two_indices(const BlockBits& bits, std::byte* texels) {
    constexpr Bc7Mode m = kBc7Modes[mode];
    constexpr Bc7Places at = bc7_places(mode);
    constexpr int n1 = m.index_bits, n2 = m.second_index_bits;

    const int rotation = int(bits.field(at.rotation, m.rotation_bits));
    const Endpoints<mode> e = read_endpoints<mode>(bits);
    const uint32_t alpha_place = 0xFFu << (rotation == 0 ? 24 : 8 * (rotation - 1));
    // The first indices weigh colour and the second alpha, unless the selection bit exchanges them.
    const bool exchanged = bits.field(at.selection, m.selection_bits) != 0;
    store_two_palettes<n1, n2>(rotate(e[0], rotation), rotate(e[1], rotation), exchanged ? alpha_place : ~alpha_place,
                               widen_anchor(bits.field(at.indices, 16 * n1 - 1), 0, n1),
                               widen_anchor(bits.field(at.second_indices, 16 * n2 - 1), 0, n2), texels);
}

void decode(const std::byte* block, std::byte* texels) {
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

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::texunit
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rawtexel::texunit {
namespace {
HWY_EXPORT(decode);
}  // namespace

void decode_bc7(const std::byte* block, std::byte* texels) { HWY_DYNAMIC_DISPATCH(decode)(block, texels); }

}  // namespace rawtexel::texunit
#endif
