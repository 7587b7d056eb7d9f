// BC1 to BC5 texel by texel, as exact fractions, by the letter of D3D11.3 19.5.6 to 19.5.12.
#pragma once

#include <cstddef>
#include <cstdint>

namespace rawtexel::reference {

struct Fraction {
    int64_t numerator, denominator;

    double value() const { return double(numerator) / double(denominator); }
    friend bool operator==(const Fraction& a, const Fraction& b) { return a.numerator * b.denominator == b.numerator * a.denominator; }
};

enum class ColourRule { Bc1, AlwaysFourColours };

/// Channel `channel` (0 red … 2 blue, 3 alpha: 1, or 0 for transparent black) of texel `texel` of an 8-byte colour block.
Fraction evaluate_colour(const std::byte* block, ColourRule rule, int channel, int texel);

/// Alpha of a texel of BC2, from the block's first 8 bytes.
Fraction evaluate_explicit_alpha(const std::byte* block, int texel);

/// A texel of an 8-byte block of BC4, of one channel of BC5, or of BC3's alpha.
Fraction evaluate_unsigned_value(const std::byte* block, int texel);
Fraction evaluate_signed_value(const std::byte* block, int texel);

}  // namespace rawtexel::reference
