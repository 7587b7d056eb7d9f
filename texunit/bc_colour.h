// BC1, BC2 and BC3: colours interpolated between two 5:6:5 endpoints, kept as exact integer numerators.
#pragma once

#include <cstddef>

namespace rawtexel::texunit {

/// Where the numerators R/186, G/378, B/186 and A/1 or A/15 lie in a 32-bit word (BC1, BC2).
inline constexpr int kBc1GreenShift = 8, kBc1BlueShift = 17, kBc1AlphaShift = 25;

// Each decodes one block to sixteen words, row by row (layout: texunit/format.h). The rules are D3D11.3 19.5.6 to 19.5.8.
void decode_bc1_rgb(const std::byte* block, std::byte* texels);   // the fourth colour of a three-colour block is opaque black
void decode_bc1_rgba(const std::byte* block, std::byte* texels);  // … is transparent black
void decode_bc2(const std::byte* block, std::byte* texels);       // always four colours, whatever the order of the endpoints
void decode_bc3(const std::byte* block, std::byte* texels);       // likewise

}  // namespace rawtexel::texunit
