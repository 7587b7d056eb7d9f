#include "tests/reference/texunit/bc_rounding.h"

#include <cmath>

namespace rawtexel::reference {
namespace {

/// The code's bits over and over, the highest first, until there are eight.
int repeated(int code, int bits) {
    int byte = 0;
    for (int k = 0; k < 8; ++k) byte = 2 * byte + ((code >> (bits - 1 - k % bits)) & 1);
    return byte;
}

int quotient(double numerator, double denominator) { return int(std::trunc(numerator / denominator)); }

int nvidia(int bits, int a, int b, bool half) {
    if (bits == 5) return half ? quotient((a + b) * 33.0, 8) : quotient((2 * a + b) * 22.0, 8);
    const int start = repeated(a, 6), difference = repeated(b, 6) - start;
    return quotient(256.0 * start + quotient(difference, 4) + 128 + (half ? 128.0 : 80.0) * difference, 256);
}

/// Two thirds of a and one of b, or half of each.
int mixed(Rounding rounding, int bits, int a, int b, bool half) {
    if (rounding == Rounding::Nvidia) return nvidia(bits, a, b, half);
    const double first = repeated(a, bits), second = repeated(b, bits);
    if (rounding == Rounding::Ideal8) return half ? quotient(first + second, 2) : quotient(2 * first + second, 3);
    return half ? quotient(first + second + 1, 2) : quotient(43 * first + 21 * second + 32, 64);
}

}  // namespace

int rounded_colour(Rounding rounding, int bits, int first, int second, bool four_colours, int index) {
    if (index < 2) return repeated(index == 0 ? first : second, bits);
    if (index == 2) return mixed(rounding, bits, first, second, !four_colours);
    return four_colours ? mixed(rounding, bits, second, first, false) : 0;
}

}  // namespace rawtexel::reference
