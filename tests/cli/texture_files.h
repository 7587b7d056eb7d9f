// Texture files for the tests of commands that read them.
#pragma once

#include "tests/temporary_folder.h"
#include "texunit/texel_source.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace rawtexel::test {

/// The formats that the files are written in, by their DXGI_FORMAT.
enum class FileFormat : uint32_t {
    Rgba32Float = 2,
    Rgba16Unorm = 11,
    Rgba8Unorm = 28,
    Rgba8Srgb = 29,
    Rgba8Snorm = 31,
    Rg8Unorm = 49,
    R8Unorm = 61,
    Bc1Unorm = 71
};

/// A DDS file whose every byte of texels is a hash of its place: all levels of all layers, faces and depth slices that `shape` has.
/// Floats are code_of / 255. Returns the path.
std::string write_dds(const TemporaryFolder& folder, const std::string& name, const texunit::Shape& shape, FileFormat format);

/// One such file of each shape: flat 13x7 with 2 levels in sRGB, an array of 3 layers, a volume of 8x6x5 with 2 levels, an array of 2
/// cubes.
struct ShapeFiles {
    std::string flat, array, volume, cube;
};
ShapeFiles write_shapes(const TemporaryFolder& folder);

/// Channel `c` of a texel of such a file with four channels of 8 bits.
uint8_t code_of(int level, int slice, int x, int y, int c);
/// With 16 bits; as 8 bits they lie anywhere between two codes.
uint16_t wide_code_of(int level, int slice, int x, int y, int c);

}  // namespace rawtexel::test
