// The sRGB transfer function (IEC 61966-2-1), as D3D11.3 3.2.3.7 and the Vulkan specification use it.
#pragma once

#include <cstdint>

namespace rawtexel::texunit {

/// Linear value in [0, 1] of the encoded value `encoded` in [0, 1].
double srgb_to_linear(double encoded);

/// Encoded value in [0, 1] of the linear value `linear`; values outside [0, 1] are clamped, NaN gives 0.
double linear_to_srgb(double linear);

/// The 8-bit code nearest to linear_to_srgb(linear), ties to the higher code. Exact: decided in linear space by thresholds, no pow.
/// Values outside [0, 1] are clamped, NaN gives 0. The linear value of any code comes back as that code.
uint8_t encode_srgb8(float linear);

/// Linear values of the 8-bit codes, each the correctly rounded float, and the halves of their bits, which vector registers look up.
struct Srgb8Tables {
    alignas(64) float whole[256];
    alignas(64) uint16_t low[256];   ///< the lower 16 bits
    alignas(64) uint16_t high[256];  ///< the upper 16 bits
};
const Srgb8Tables& srgb8_tables();

/// srgb8_tables().whole
const float* srgb8_table();

}  // namespace rawtexel::texunit
