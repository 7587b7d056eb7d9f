// BC4, BC5 and the alpha of BC3: one value a texel, interpolated between two 8-bit endpoints, kept as exact integer numerators.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace rawtexel::texunit {

/// The eight values of a block and its sixteen 3-bit indices. Values are numerators over 255*35, or over 127*35 in two's complement.
struct ValueBlock {
    std::array<uint16_t, 8> palette;
    uint64_t indices;

    uint16_t value(int texel) const { return palette[(indices >> (3 * texel)) & 7]; }
};

/// Reads 8 bytes (D3D11.3 19.5.9 to 19.5.12). The order of signed endpoints is that of the raw codes; then -128 means -127.
ValueBlock read_unsigned_values(const std::byte* block);
ValueBlock read_signed_values(const std::byte* block);

// Each decodes one block to sixteen 64-bit words, row by row (layout: texunit/format.h).
void decode_bc4_unorm(const std::byte* block, std::byte* texels);
void decode_bc4_snorm(const std::byte* block, std::byte* texels);
void decode_bc5_unorm(const std::byte* block, std::byte* texels);
void decode_bc5_snorm(const std::byte* block, std::byte* texels);

}  // namespace rawtexel::texunit
