// BC6H: fourteen modes of half-precision colour, bit exact.
#pragma once

#include <cstddef>

namespace rawtexel::texunit {

// Each decodes one block of 16 bytes to sixteen texels of four halves, row by row; alpha is 1 (D3D11.3 19.5.14,
// ARB_texture_compression_bptc). The four reserved modes decode to (0, 0, 0, 1). A negative value that rounds to zero is +0, as D3D's
// finishing step has it. The signed format can hold -infinity.
void decode_bc6h_ufloat(const std::byte* block, std::byte* texels);
void decode_bc6h_sfloat(const std::byte* block, std::byte* texels);

}  // namespace rawtexel::texunit
