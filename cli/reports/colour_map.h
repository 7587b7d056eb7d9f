// The colours in which maps of numbers are shown.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace rawtexel::cli {

using Rgb8 = std::array<uint8_t, 3>;

/// Magma, by Smith and van der Walt (CC0): black for 0 to pale yellow for 1, growing evenly in lightness, as FLIP's authors show their
/// maps. The nearest of 256 sRGB colours; values beyond the ends get the ends' colours, what is not a number the colour of kNotANumber.
Rgb8 magma(double value);

/// A grey-green that is no colour of magma.
inline constexpr Rgb8 kNotANumber{0, 128, 110};

/// RGB codes of `values` with [low, high] spread over the map; where high is not above low everything is 0.
std::vector<uint8_t> magma_codes(std::span<const float> values, double low, double high);

}  // namespace rawtexel::cli
