#include "texunit/bc_ramp.h"

#include "texunit/little_endian.h"

#include <algorithm>
#include <cstring>

namespace rawtexel::texunit {
namespace {

/// Sevenths of the way where `eight_values`, else fifths and the two extremes; all over 35 times the codes' denominator.
std::array<uint16_t, 8> interpolate(int first, int second, bool eight_values, int minimum, int maximum) {
    std::array<uint16_t, 8> palette;
    palette[0] = uint16_t(35 * first);
    palette[1] = uint16_t(35 * second);
    if (eight_values) {
        for (int i = 2; i < 8; ++i) palette[size_t(i)] = uint16_t(5 * ((8 - i) * first + (i - 1) * second));
        return palette;
    }
    for (int i = 2; i < 6; ++i) palette[size_t(i)] = uint16_t(7 * ((6 - i) * first + (i - 1) * second));
    palette[6] = uint16_t(35 * minimum);
    palette[7] = uint16_t(35 * maximum);
    return palette;
}

void store_one(const ValueBlock& red, std::byte* texels) {
    for (int i = 0; i < 16; ++i) {
        const uint64_t word = red.value(i);
        std::memcpy(texels + 8 * i, &word, 8);
    }
}

void store_two(const ValueBlock& red, const ValueBlock& green, std::byte* texels) {
    for (int i = 0; i < 16; ++i) {
        const uint64_t word = red.value(i) | (uint64_t{green.value(i)} << 16);
        std::memcpy(texels + 8 * i, &word, 8);
    }
}

}  // namespace

ValueBlock read_unsigned_values(const std::byte* block) {
    const uint64_t bits = load<uint64_t>(block);
    const int first = int(bits & 0xFF), second = int((bits >> 8) & 0xFF);
    return {interpolate(first, second, first > second, 0, 255), bits >> 16};
}

ValueBlock read_signed_values(const std::byte* block) {
    const uint64_t bits = load<uint64_t>(block);
    const int first = int8_t(bits & 0xFF), second = int8_t((bits >> 8) & 0xFF);
    return {interpolate(std::max(first, -127), std::max(second, -127), first > second, -127, 127), bits >> 16};
}

void decode_bc4_unorm(const std::byte* block, std::byte* texels) { store_one(read_unsigned_values(block), texels); }
void decode_bc4_snorm(const std::byte* block, std::byte* texels) { store_one(read_signed_values(block), texels); }

void decode_bc5_unorm(const std::byte* block, std::byte* texels) {
    store_two(read_unsigned_values(block), read_unsigned_values(block + 8), texels);
}

void decode_bc5_snorm(const std::byte* block, std::byte* texels) {
    store_two(read_signed_values(block), read_signed_values(block + 8), texels);
}

}  // namespace rawtexel::texunit
