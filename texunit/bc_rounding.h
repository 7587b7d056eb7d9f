// How the interpolated colours of BC1, BC2 and BC3 are rounded: not at all, or to 8 bits as hardware does.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace rawtexel::texunit {

/// With a and b two endpoint codes of 5 or 6 bits, A and B the same repeated to 8 bits, d = B - A, and all divisions truncating:
///
///            two thirds a, one third b                    half a, half b                     largest error of the thirds in 1/255
///   Exact    (2a + b)/3                                   (a + b)/2                          0
///   Ideal8   (2A + B)/3                                   (A + B)/2                          1.19 (red, blue), 1.37 (green)
///   Nvidia   (2a + b)*22/8 of red and blue,               (a + b)*33/8,                      0.74, 5.40
///            (256A + d/4 + 128 + 80d)/256 of green        (256A + d/4 + 128 + 128d)/256
///   Amd      (43A + 21B + 32)/64                          (A + B + 1)/2                      1.97, 1.89
///
/// Ideal8 is the text of D3D11.3 19.5.6 with nothing beyond 8 bits; the other two are what those vendors' GPUs do. Only colour is
/// rounded: the alpha of BC2 fits 8 bits, that of BC3 stays exact, as BC4 and BC5 do, for which D3D allows no 8-bit rounding.
enum class BcRounding : uint8_t { Exact, Ideal8, Nvidia, Amd };
inline constexpr std::array kBcRoundings = {BcRounding::Exact, BcRounding::Ideal8, BcRounding::Nvidia, BcRounding::Amd};

std::string_view to_string(BcRounding rounding);  // exact ideal8 nvidia amd
std::optional<BcRounding> parse_bc_rounding(std::string_view text);

}  // namespace rawtexel::texunit
