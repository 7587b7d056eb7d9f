// The structure of PNG files, checked before their pixels are decoded.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace rawtexel::scenes {

/// How far to read: everything, or only what precedes the pixels.
enum class PngExtent { Whole, Header };

/// The chunks that decide the pixels (IHDR, PLTE, tRNS, IDAT, IEND) as a PNG of their own: colour profiles, gamma and text play no part in
/// how glTF reads an image, and libpng complains about them on stderr. Throws TextureError when the file is cut off or out of order, a
/// chunk fails its checksum or the header is impossible. A header ends where the first IDAT's data would begin.
std::vector<std::byte> png_without_ancillary_chunks(const std::string& name, std::span<const std::byte> png, PngExtent extent);

}  // namespace rawtexel::scenes
