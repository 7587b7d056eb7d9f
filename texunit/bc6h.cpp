#include "texunit/bc6h.h"

#include "texunit/bc6h_modes.h"
#include "texunit/bc_bits.h"
#include "texunit/bc_partitions.h"

#include <array>
#include <cstring>
#include <utility>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "texunit/bc6h.cpp"
#include <hwy/foreach_target.h>

#include "texunit/bc_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rawtexel::texunit {
namespace HWY_NAMESPACE {
namespace {

/// Endpoint codes, then values; and the partition.
struct Endpoints {
    int code[4][3] = {};
    int partition = 0;
};

constexpr int reverse_bits(int value, int count) {
    int reversed = 0;
    for (int i = 0; i < count; ++i) reversed |= ((value >> i) & 1) << (count - 1 - i);
    return reversed;
}

template <int mode, size_t i>
HWY_INLINE void read_field(const BlockBits& bits, Endpoints& out) {
    constexpr Bc6hField field = parse_bc6h_fields(kBc6hModes[mode].bits).field[i];
    if constexpr (field.variable != kBc6hCode) {
        int value = int(bits.field(field.first, field.count));
        if constexpr (field.reversed) value = reverse_bits(value, field.count);
        if constexpr (field.variable == kBc6hPartition) {
            out.partition |= value << field.low;
        } else {
            out.code[field.variable / 3][field.variable % 3] |= value << field.low;
        }
    }
}

template <int mode>
HWY_INLINE Endpoints read_endpoints(const BlockBits& bits) {
    constexpr size_t count = size_t(parse_bc6h_fields(kBc6hModes[mode].bits).count);
    Endpoints out;
    [&]<size_t... i>(std::index_sequence<i...>) HWY_ATTR { (read_field<mode, i>(bits, out), ...); }
    (std::make_index_sequence<count>{});
    return out;
}

constexpr int sign_extend(int value, int bits) {
    const int sign = 1 << (bits - 1);
    return ((value & ((1 << bits) - 1)) ^ sign) - sign;
}

/// Codes to endpoint codes of full width: differences are added to the base and wrap; signed codes are extended.
template <int mode, bool is_signed>
HWY_INLINE void resolve_differences(Endpoints& e) {
    constexpr Bc6hMode m = kBc6hModes[mode];
    for (int c = 0; c < 3; ++c) {
        if (is_signed) e.code[0][c] = sign_extend(e.code[0][c], m.endpoint_bits);
        for (int i = 1; i < 2 * m.subsets; ++i) {
            int& code = e.code[i][c];
            if (is_signed || m.transformed) code = sign_extend(code, m.delta_bits[c]);
            if (m.transformed) {
                code = (e.code[0][c] + code) & ((1 << m.endpoint_bits) - 1);
                if (is_signed) code = sign_extend(code, m.endpoint_bits);
            }
        }
    }
}

/// 16-bit integer that a code stands for.
template <int bits>
constexpr int unquantize_unsigned(int code) {
    if (bits >= 15 || code == 0) return code;
    if (code == (1 << bits) - 1) return 0xFFFF;
    return ((code << 16) + 0x8000) >> bits;
}

template <int bits>
constexpr int unquantize_signed(int code) {
    if (bits >= 16 || code == 0) return code;
    const int magnitude = code < 0 ? -code : code;
    const int value = magnitude >= (1 << (bits - 1)) - 1 ? 0x7FFF : ((magnitude << 15) + 0x4000) >> (bits - 1);
    return code < 0 ? -value : value;
}

/// Endpoint `e` of channel `c` as the integer to interpolate.
template <int mode, bool is_signed>
HWY_INLINE int unquantized(const Endpoints& endpoints, int e, int c) {
    constexpr int bits = kBc6hModes[mode].endpoint_bits;
    return is_signed ? unquantize_signed<bits>(endpoints.code[e][c]) : unquantize_unsigned<bits>(endpoints.code[e][c]);
}

constexpr uint16_t kHalfOne = 0x3C00;

#if RAWTEXEL_BC_LANES

/// The half whose bits an interpolated integer stands for, scaled so that the largest is 65504 (0x7BFF).
template <bool is_signed>
HWY_INLINE TexelLanes finish(TexelLanes value) {
    const TexelTag d;
    const auto times_31 = [](TexelLanes v) HWY_ATTR { return hn::Sub(hn::ShiftLeft<5>(v), v); };
    if constexpr (!is_signed) return hn::ShiftRight<6>(times_31(value));
    const auto zero = hn::Zero(d), magnitude = hn::ShiftRight<5>(times_31(hn::Abs(value)));
    const auto negative = hn::And(hn::Lt(value, zero), hn::Gt(magnitude, zero));
    return hn::Or(magnitude, hn::IfThenElseZero(negative, hn::Set(d, 0x8000)));
}

/// Eight colours of a subset in the low and high halves of 64-bit texels.
struct ColourLanes {
    TexelLanes red_green, blue_alpha;
};

template <int mode, bool is_signed>
HWY_INLINE ColourLanes interpolate(const Endpoints& endpoints, int subset, const int32_t* weights) {
    const TexelTag d;
    const auto weight = hn::Load(d, weights);
    const auto channel = [&](int c) HWY_ATTR {
        const int first = unquantized<mode, is_signed>(endpoints, 2 * subset, c);
        const int second = unquantized<mode, is_signed>(endpoints, 2 * subset + 1, c);
        const auto sum = hn::Add(hn::Set(d, 64 * first + 32), hn::Mul(weight, hn::Set(d, second - first)));
        return finish<is_signed>(hn::ShiftRight<6>(sum));
    };
    return {hn::Or(channel(0), hn::ShiftLeft<16>(channel(1))), hn::Or(channel(2), hn::Set(d, int32_t{kHalfOne} << 16))};
}

/// Two subsets of eight colours, or one of sixteen.
template <int mode, bool is_signed>
HWY_INLINE void store_colours(const Endpoints& e, uint32_t subsets, uint64_t indices, std::byte* texels) {
    constexpr bool two = kBc6hModes[mode].subsets == 2;
    constexpr int n = two ? 3 : 4;
    alignas(32) static constexpr int32_t kEight[8] = {0, 9, 18, 27, 37, 46, 55, 64};
    alignas(32) static constexpr int32_t kSixteen[16] = {0, 4, 9, 13, 17, 21, 26, 30, 34, 38, 43, 47, 51, 55, 60, 64};
    const ColourLanes low = interpolate<mode, is_signed>(e, 0, two ? kEight : kSixteen);
    const ColourLanes high = interpolate<mode, is_signed>(e, two ? 1 : 0, two ? kEight : kSixteen + 8);
    const TexelLanes red_green[2] = {low.red_green, high.red_green}, blue_alpha[2] = {low.blue_alpha, high.blue_alpha};
    for (int half = 0; half < 2; ++half) {
        TexelLanes index = unpack_fields<n>(indices >> (8 * n * half));
        if constexpr (two) index = hn::Or(index, hn::ShiftLeft<n>(unpack_fields<1>(subsets >> (8 * half))));
        store_texels(look_up(red_green, index), look_up(blue_alpha, index), texels + 64 * half);
    }
}

#else

template <bool is_signed>
constexpr uint16_t finish(int value) {
    if (!is_signed) return uint16_t((value * 31) >> 6);
    const int magnitude = ((value < 0 ? -value : value) * 31) >> 5;
    return uint16_t(value < 0 && magnitude > 0 ? 0x8000 | magnitude : magnitude);
}

template <int mode, bool is_signed>
HWY_INLINE void store_colours(const Endpoints& e, uint32_t subsets, uint64_t indices, std::byte* texels) {
    constexpr Bc6hMode m = kBc6hModes[mode];
    constexpr int n = m.subsets == 2 ? 3 : 4;
    constexpr auto& weights = interpolation_weights<n>();
    std::array<uint64_t, size_t(m.subsets) << n> palette;
    palette.fill(uint64_t{kHalfOne} << 48);
    for (int subset = 0; subset < m.subsets; ++subset) {
        for (int c = 0; c < 3; ++c) {
            const int first = unquantized<mode, is_signed>(e, 2 * subset, c), second = unquantized<mode, is_signed>(e, 2 * subset + 1, c);
            for (size_t i = 0; i < weights.size(); ++i) {
                const int value = ((64 - weights[i]) * first + weights[i] * second + 32) >> 6;
                palette[size_t(subset) * weights.size() + i] |= uint64_t{finish<is_signed>(value)} << (16 * c);
            }
        }
    }
    for (int i = 0; i < 16; ++i) {
        const uint64_t word = palette[(((subsets >> i) & 1) << n) | ((indices >> (n * i)) & ((1u << n) - 1))];
        std::memcpy(texels + 8 * i, &word, 8);
    }
}

#endif  // RAWTEXEL_BC_LANES

template <int mode, bool is_signed>
void decode(const BlockBits& bits, std::byte* texels) {
    constexpr Bc6hMode m = kBc6hModes[mode];
    constexpr int n = m.subsets == 2 ? 3 : 4;
    Endpoints e = read_endpoints<mode>(bits);
    resolve_differences<mode, is_signed>(e);
    uint64_t indices = widen_anchor(bits.field(128 - 16 * n + m.subsets, 16 * n - m.subsets), 0, n);
    uint32_t subsets = 0;
    if constexpr (m.subsets == 2) {
        indices = widen_anchor(indices, kAnchors2[size_t(e.partition)], n);
        subsets = kPartitions2[size_t(e.partition)];
    }
    store_colours<mode, is_signed>(e, subsets, indices, texels);
}

void decode_reserved(const BlockBits&, std::byte* texels) {
    constexpr uint64_t kOpaqueBlack = uint64_t{kHalfOne} << 48;
    for (int i = 0; i < 16; ++i) std::memcpy(texels + 8 * i, &kOpaqueBlack, 8);
}

using Decoder = void (*)(const BlockBits&, std::byte*);

/// Decoders by the block's lowest five bits.
template <bool is_signed>
constexpr std::array<Decoder, 32> decoders_by_code() {
    std::array<Decoder, 32> decoders;
    decoders.fill(decode_reserved);
    const auto enter = [&]<int mode>() {
        const int code = kBc6hModes[mode].code;
        for (int five_bits = 0; five_bits < 32; ++five_bits) {
            if (code < 2 ? (five_bits & 3) == code : five_bits == code) decoders[size_t(five_bits)] = decode<mode, is_signed>;
        }
    };
    [&]<int... mode>(std::integer_sequence<int, mode...>) { (enter.template operator()<mode>(), ...); }
    (std::make_integer_sequence<int, int(kBc6hModes.size())>{});
    return decoders;
}

template <bool is_signed>
HWY_INLINE void decode_block_of(const std::byte* block, std::byte* texels) {
    static constexpr std::array<Decoder, 32> decoders = decoders_by_code<is_signed>();
    const BlockBits bits(block);
    decoders[bits.low & 31](bits, texels);
}

void decode_ufloat(const std::byte* block, std::byte* texels) { decode_block_of<false>(block, texels); }
void decode_sfloat(const std::byte* block, std::byte* texels) { decode_block_of<true>(block, texels); }

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::texunit
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rawtexel::texunit {
namespace {
HWY_EXPORT(decode_ufloat);
HWY_EXPORT(decode_sfloat);
}  // namespace

void decode_bc6h_ufloat(const std::byte* block, std::byte* texels) { HWY_DYNAMIC_DISPATCH(decode_ufloat)(block, texels); }
void decode_bc6h_sfloat(const std::byte* block, std::byte* texels) { HWY_DYNAMIC_DISPATCH(decode_sfloat)(block, texels); }

}  // namespace rawtexel::texunit
#endif
