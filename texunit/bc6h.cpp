#include "texunit/bc6h.h"

#include "texunit/bc6h_modes.h"
#include "texunit/bc_bits.h"
#include "texunit/bc_partitions.h"

#include <array>
#include <cstring>
#include <utility>

namespace rawtexel::texunit {
namespace {

constexpr bool modes_fill_the_block() {
    for (const Bc6hMode& mode : kBc6hModes) {
        const int bits = parse_bc6h_fields(mode.bits).bits;
        const int index_bits = mode.subsets == 2 ? 16 * 3 - 2 : 16 * 4 - 1;
        if (bits + index_bits != 128) return false;
    }
    return true;
}
static_assert(modes_fill_the_block());

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
inline void read_field(const BlockBits& bits, Endpoints& out) {
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
inline Endpoints read_endpoints(const BlockBits& bits) {
    constexpr size_t count = size_t(parse_bc6h_fields(kBc6hModes[mode].bits).count);
    Endpoints out;
    [&]<size_t... i>(std::index_sequence<i...>) { (read_field<mode, i>(bits, out), ...); }
    (std::make_index_sequence<count>{});
    return out;
}

constexpr int sign_extend(int value, int bits) {
    const int sign = 1 << (bits - 1);
    return ((value & ((1 << bits) - 1)) ^ sign) - sign;
}

/// Codes to endpoint codes of full width: differences are added to the base and wrap; signed codes are extended.
template <int mode, bool is_signed>
inline void resolve_differences(Endpoints& e) {
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

/// The half whose bits an interpolated integer stands for, scaled so that the largest is 65504 (0x7BFF).
template <bool is_signed>
constexpr uint16_t finish(int value) {
    if (!is_signed) return uint16_t((value * 31) >> 6);
    const int magnitude = ((value < 0 ? -value : value) * 31) >> 5;
    return uint16_t(value < 0 && magnitude > 0 ? 0x8000 | magnitude : magnitude);
}

constexpr uint64_t kAlphaOne = uint64_t{0x3C00} << 48;

template <int mode, bool is_signed>
void decode(const BlockBits& bits, std::byte* texels) {
    constexpr Bc6hMode m = kBc6hModes[mode];
    constexpr int n = m.subsets == 2 ? 3 : 4;
    constexpr auto& weights = interpolation_weights<n>();

    Endpoints e = read_endpoints<mode>(bits);
    resolve_differences<mode, is_signed>(e);
    std::array<uint64_t, size_t(m.subsets) << n> palette;
    palette.fill(kAlphaOne);
    for (int subset = 0; subset < m.subsets; ++subset) {
        for (int c = 0; c < 3; ++c) {
            const auto unquantize = is_signed ? unquantize_signed<m.endpoint_bits> : unquantize_unsigned<m.endpoint_bits>;
            const int first = unquantize(e.code[2 * subset][c]), second = unquantize(e.code[2 * subset + 1][c]);
            for (size_t i = 0; i < weights.size(); ++i) {
                const int value = ((64 - weights[i]) * first + weights[i] * second + 32) >> 6;
                palette[size_t(subset) * weights.size() + i] |= uint64_t{finish<is_signed>(value)} << (16 * c);
            }
        }
    }

    uint64_t indices = widen_anchor(bits.field(128 - 16 * n + m.subsets, 16 * n - m.subsets), 0, n);
    uint32_t subsets = 0;
    if constexpr (m.subsets == 2) {
        indices = widen_anchor(indices, kAnchors2[size_t(e.partition)], n);
        subsets = kPartitions2[size_t(e.partition)];
    }
    for (int i = 0; i < 16; ++i) {
        const uint64_t word = palette[(((subsets >> i) & 1) << n) | ((indices >> (n * i)) & ((1u << n) - 1))];
        std::memcpy(texels + 8 * i, &word, 8);
    }
}

void decode_reserved(const BlockBits&, std::byte* texels) {
    for (int i = 0; i < 16; ++i) std::memcpy(texels + 8 * i, &kAlphaOne, 8);
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
void decode_bc6h(const std::byte* block, std::byte* texels) {
    static constexpr std::array<Decoder, 32> decoders = decoders_by_code<is_signed>();
    const BlockBits bits(block);
    decoders[bits.low & 31](bits, texels);
}

}  // namespace

void decode_bc6h_ufloat(const std::byte* block, std::byte* texels) { decode_bc6h<false>(block, texels); }
void decode_bc6h_sfloat(const std::byte* block, std::byte* texels) { decode_bc6h<true>(block, texels); }

}  // namespace rawtexel::texunit
