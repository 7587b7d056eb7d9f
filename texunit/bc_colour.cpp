#include "texunit/bc_colour.h"

#include "texunit/bc_ramp.h"
#include "texunit/little_endian.h"

#include <array>
#include <cstdint>
#include <cstring>

namespace rawtexel::texunit {
namespace {

/// An endpoint's 5:6:5 bits spread to the places of its numerators. No sum of six endpoints carries into the next field
/// (6*31 < 2^8, 6*63 < 2^9), so a word is interpolated as a whole.
template <class Word, int green_shift, int blue_shift>
constexpr Word spread_endpoint(uint32_t rgb565) {
    const Word red = (rgb565 >> 11) & 31, green = (rgb565 >> 5) & 63, blue = rgb565 & 31;
    return red | (green << green_shift) | (blue << blue_shift);
}

/// In sixths: the endpoints and their thirds.
template <class Word>
constexpr std::array<Word, 4> four_colours(Word first, Word second) {
    return {6 * first, 6 * second, 4 * first + 2 * second, 2 * first + 4 * second};
}

/// In sixths: the endpoints, their half, and black.
template <class Word>
constexpr std::array<Word, 4> three_colours(Word first, Word second) {
    return {6 * first, 6 * second, 3 * first + 3 * second, 0};
}

constexpr auto spread32 = spread_endpoint<uint32_t, kBc1GreenShift, kBc1BlueShift>;
constexpr auto spread64 = spread_endpoint<uint64_t, 16, 32>;

template <class Word>
void store(std::byte* texels, int i, Word word) {
    std::memcpy(texels + size_t(i) * sizeof(Word), &word, sizeof(Word));
}

template <bool has_alpha>
void decode_bc1(const std::byte* block, std::byte* texels) {
    const uint32_t endpoints = load<uint32_t>(block), indices = load<uint32_t>(block + 4);
    const uint32_t first_code = endpoints & 0xFFFF, second_code = endpoints >> 16;
    const uint32_t first = spread32(first_code), second = spread32(second_code);
    std::array<uint32_t, 4> palette = first_code > second_code ? four_colours(first, second) : three_colours(first, second);
    if constexpr (has_alpha) {
        constexpr uint32_t opaque = 1u << kBc1AlphaShift;
        for (int i = 0; i < 3; ++i) palette[size_t(i)] |= opaque;
        if (first_code > second_code) palette[3] |= opaque;
    }
    for (int i = 0; i < 16; ++i) store(texels, i, palette[(indices >> (2 * i)) & 3]);
}

}  // namespace

void decode_bc1_rgb(const std::byte* block, std::byte* texels) { decode_bc1<false>(block, texels); }
void decode_bc1_rgba(const std::byte* block, std::byte* texels) { decode_bc1<true>(block, texels); }

void decode_bc2(const std::byte* block, std::byte* texels) {
    const uint64_t alphas = load<uint64_t>(block);
    const uint32_t endpoints = load<uint32_t>(block + 8), indices = load<uint32_t>(block + 12);
    const std::array<uint32_t, 4> palette = four_colours(spread32(endpoints & 0xFFFF), spread32(endpoints >> 16));
    for (int i = 0; i < 16; ++i) {
        const uint32_t alpha = uint32_t(alphas >> (4 * i)) & 15;
        store(texels, i, palette[(indices >> (2 * i)) & 3] | (alpha << kBc1AlphaShift));
    }
}

void decode_bc3(const std::byte* block, std::byte* texels) {
    const ValueBlock alpha = read_unsigned_values(block);
    const uint32_t endpoints = load<uint32_t>(block + 8), indices = load<uint32_t>(block + 12);
    const std::array<uint64_t, 4> palette = four_colours(spread64(endpoints & 0xFFFF), spread64(endpoints >> 16));
    for (int i = 0; i < 16; ++i) store(texels, i, palette[(indices >> (2 * i)) & 3] | (uint64_t(alpha.value(i)) << 48));
}

}  // namespace rawtexel::texunit
