#include "texunit/bc_rounded.h"

#include "texunit/bc_ramp.h"
#include "texunit/little_endian.h"

#include <array>
#include <cassert>
#include <cstdint>
#include <cstring>

namespace rawtexel::texunit {
namespace {

/// Codes of 5 and of 6 bits to 8: their highest bits are repeated below.
constexpr int expand5(int code) { return (code << 3) | (code >> 2); }
constexpr int expand6(int code) { return (code << 2) | (code >> 4); }

// The policies: two thirds of the first endpoint and one of the second, or half of each; of red and blue (5 bits) and of green (6 bits).

struct Ideal8 {
    static constexpr int third5(int a, int b) { return (2 * expand5(a) + expand5(b)) / 3; }
    static constexpr int third6(int a, int b) { return (2 * expand6(a) + expand6(b)) / 3; }
    static constexpr int half5(int a, int b) { return (expand5(a) + expand5(b)) / 2; }
    static constexpr int half6(int a, int b) { return (expand6(a) + expand6(b)) / 2; }
};

struct Amd {
    static constexpr int third(int a, int b) { return (43 * a + 21 * b + 32) >> 6; }
    static constexpr int half(int a, int b) { return (a + b + 1) >> 1; }
    static constexpr int third5(int a, int b) { return third(expand5(a), expand5(b)); }
    static constexpr int third6(int a, int b) { return third(expand6(a), expand6(b)); }
    static constexpr int half5(int a, int b) { return half(expand5(a), expand5(b)); }
    static constexpr int half6(int a, int b) { return half(expand6(a), expand6(b)); }
};

struct Nvidia {
    static constexpr int green(int a, int b, int share) {
        const int first = expand6(a), difference = expand6(b) - first;
        return (256 * first + difference / 4 + 128 + share * difference) / 256;
    }
    static constexpr int third5(int a, int b) { return (2 * a + b) * 22 / 8; }
    static constexpr int third6(int a, int b) { return green(a, b, 80); }
    static constexpr int half5(int a, int b) { return (a + b) * 33 / 8; }
    static constexpr int half6(int a, int b) { return green(a, b, 128); }
};

struct Rgb565 {
    int red, green, blue;

    explicit Rgb565(uint32_t bits) : red((bits >> 11) & 31), green((bits >> 5) & 63), blue(bits & 31) {}
};

/// 8-bit codes in fields `field` bits apart.
template <class Word, int field>
constexpr Word place(int red, int green, int blue) {
    return Word(red) | (Word(green) << field) | (Word(blue) << (2 * field));
}

template <class Policy, class Word>
struct Palette {
    static constexpr int kField = sizeof(Word) == 4 ? 8 : 16;

    static Word endpoint(const Rgb565& a) { return place<Word, kField>(expand5(a.red), expand6(a.green), expand5(a.blue)); }
    static Word third(const Rgb565& a, const Rgb565& b) {
        return place<Word, kField>(Policy::third5(a.red, b.red), Policy::third6(a.green, b.green), Policy::third5(a.blue, b.blue));
    }
    static Word half(const Rgb565& a, const Rgb565& b) {
        return place<Word, kField>(Policy::half5(a.red, b.red), Policy::half6(a.green, b.green), Policy::half5(a.blue, b.blue));
    }
    static std::array<Word, 4> four_colours(const Rgb565& a, const Rgb565& b) {
        return {endpoint(a), endpoint(b), third(a, b), third(b, a)};
    }
    static std::array<Word, 4> three_colours(const Rgb565& a, const Rgb565& b) { return {endpoint(a), endpoint(b), half(a, b), 0}; }
};

template <class Word>
void store(std::byte* texels, int i, Word word) {
    std::memcpy(texels + size_t(i) * sizeof(Word), &word, sizeof(Word));
}

template <class Policy, bool has_alpha>
void decode_bc1(const std::byte* block, std::byte* texels) {
    const uint32_t first = load<uint16_t>(block), second = load<uint16_t>(block + 2), indices = load<uint32_t>(block + 4);
    using Colours = Palette<Policy, uint32_t>;
    const bool four = first > second;
    auto palette = four ? Colours::four_colours(Rgb565(first), Rgb565(second)) : Colours::three_colours(Rgb565(first), Rgb565(second));
    constexpr uint32_t kOpaque = 0xFF000000;
    if constexpr (has_alpha) {
        for (size_t i = 0; i < (four ? 4 : 3); ++i) palette[i] |= kOpaque;
    }
    for (int i = 0; i < 16; ++i) store(texels, i, palette[(indices >> (2 * i)) & 3]);
}

template <class Policy>
void decode_bc2(const std::byte* block, std::byte* texels) {
    const uint64_t alphas = load<uint64_t>(block);
    const uint32_t endpoints = load<uint32_t>(block + 8), indices = load<uint32_t>(block + 12);
    const auto palette = Palette<Policy, uint32_t>::four_colours(Rgb565(endpoints & 0xFFFF), Rgb565(endpoints >> 16));
    for (int i = 0; i < 16; ++i) {
        const uint32_t alpha = 17 * (uint32_t(alphas >> (4 * i)) & 15);
        store(texels, i, palette[(indices >> (2 * i)) & 3] | (alpha << 24));
    }
}

template <class Policy>
void decode_bc3(const std::byte* block, std::byte* texels) {
    const ValueBlock alpha = read_unsigned_values(block);
    const uint32_t endpoints = load<uint32_t>(block + 8), indices = load<uint32_t>(block + 12);
    const auto palette = Palette<Policy, uint64_t>::four_colours(Rgb565(endpoints & 0xFFFF), Rgb565(endpoints >> 16));
    for (int i = 0; i < 16; ++i) store(texels, i, palette[(indices >> (2 * i)) & 3] | (uint64_t{alpha.value(i)} << 48));
}

template <class Policy>
constexpr RoundedDecoders decoders_of() {
    return {decode_bc1<Policy, false>, decode_bc1<Policy, true>, decode_bc2<Policy>, decode_bc3<Policy>};
}

}  // namespace

const RoundedDecoders& rounded_decoders(BcRounding rounding) {
    static constexpr RoundedDecoders kIdeal8 = decoders_of<Ideal8>(), kNvidia = decoders_of<Nvidia>(), kAmd = decoders_of<Amd>();
    assert(rounding != BcRounding::Exact);
    return rounding == BcRounding::Ideal8 ? kIdeal8 : rounding == BcRounding::Nvidia ? kNvidia : kAmd;
}

}  // namespace rawtexel::texunit
