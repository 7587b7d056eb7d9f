// BC7: eight modes of 8-bit colour and alpha, bit exact.
#pragma once

#include <cstddef>

namespace rawtexel::texunit {

/// Decodes one block of 16 bytes to sixteen words of four 8-bit codes, red lowest, row by row (D3D11.3 19.5.15,
/// ARB_texture_compression_bptc). A block whose first byte is 0 has the reserved mode and decodes to zero, alpha too, as D3D says.
void decode_bc7(const std::byte* block, std::byte* texels);

}  // namespace rawtexel::texunit
