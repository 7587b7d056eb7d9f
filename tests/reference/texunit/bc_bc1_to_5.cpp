#include "tests/reference/texunit/bc_bc1_to_5.h"

namespace rawtexel::reference {
namespace {

/// `bits` bits from bit `first` of the block, read one by one.
int take(const std::byte* block, int first, int bits) {
    int value = 0;
    for (int i = 0; i < bits; ++i) value |= (int(block[(first + i) / 8] >> ((first + i) % 8)) & 1) << i;
    return value;
}

/// (wa*a + wb*b) / ((wa + wb) * maximum)
Fraction mix(int wa, int a, int wb, int b, int maximum) { return {int64_t(wa) * a + int64_t(wb) * b, int64_t(wa + wb) * maximum}; }

Fraction interpolated_value(int index, int first, int second, bool eight_values, int minimum, int maximum) {
    if (index < 2) return {index == 0 ? first : second, maximum};
    if (eight_values) return mix(8 - index, first, index - 1, second, maximum);
    if (index < 6) return mix(6 - index, first, index - 1, second, maximum);
    return {index == 6 ? minimum : maximum, maximum};
}

}  // namespace

Fraction evaluate_colour(const std::byte* block, ColourRule rule, int channel, int texel) {
    static constexpr int shift[] = {11, 5, 0}, width[] = {5, 6, 5};
    const bool four = rule == ColourRule::AlwaysFourColours || take(block, 0, 16) > take(block, 16, 16);
    const int index = take(block, 32 + 2 * texel, 2);
    const bool black = !four && index == 3;
    if (channel == 3) return {black ? 0 : 1, 1};
    const int maximum = (1 << width[channel]) - 1;
    const int first = take(block, shift[channel], width[channel]), second = take(block, 16 + shift[channel], width[channel]);
    if (black) return {0, 1};
    if (index < 2) return {index == 0 ? first : second, maximum};
    if (!four) return mix(1, first, 1, second, maximum);
    return index == 2 ? mix(2, first, 1, second, maximum) : mix(1, first, 2, second, maximum);
}

Fraction evaluate_explicit_alpha(const std::byte* block, int texel) { return {take(block, 4 * texel, 4), 15}; }

Fraction evaluate_unsigned_value(const std::byte* block, int texel) {
    const int first = take(block, 0, 8), second = take(block, 8, 8);
    return interpolated_value(take(block, 16 + 3 * texel, 3), first, second, first > second, 0, 255);
}

Fraction evaluate_signed_value(const std::byte* block, int texel) {
    const auto code = [&](int at) { return take(block, at, 8) < 128 ? take(block, at, 8) : take(block, at, 8) - 256; };
    const auto value = [&](int at) { return code(at) == -128 ? -127 : code(at); };
    return interpolated_value(take(block, 16 + 3 * texel, 3), value(0), value(8), code(0) > code(8), -127, 127);
}

}  // namespace rawtexel::reference
