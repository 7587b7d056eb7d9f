#include "texunit/dds_writer.h"

#include "texunit/texel_value.h"

#include <array>
#include <cassert>
#include <cstring>
#include <initializer_list>

namespace rawtexel::texunit {
namespace {

using enum Format;

/// DXGI_FORMAT of the formats that are written.
uint32_t dxgi_code(Format format) {
    switch (format) {
        case RGBA32Float: return 2;
        case RGBA16Half: return 10;
        case RGBA16Unorm: return 11;
        case RG32Float: return 16;
        case RGBA8Unorm: return 28;
        case RGBA8Srgb: return 29;
        case RGBA8Snorm: return 31;
        case RG16Half: return 34;
        case RG16Unorm: return 35;
        case R32Float: return 41;
        case RG8Unorm: return 49;
        case RG8Snorm: return 51;
        case R16Half: return 54;
        case R16Unorm: return 56;
        case R8Unorm: return 61;
        case R8Snorm: return 63;
        default: assert(false); return 0;
    }
}

void append_words(std::vector<std::byte>& bytes, std::initializer_list<uint32_t> words) {
    const size_t start = bytes.size();
    bytes.resize(start + words.size() * sizeof(uint32_t));
    std::memcpy(bytes.data() + start, std::data(words), words.size() * sizeof(uint32_t));
}

/// Magic, DDS_HEADER, DDS_PIXELFORMAT and DDS_HEADER_DXT10 (Microsoft, "Programming Guide for DDS").
std::vector<std::byte> header(const Shape& shape, Format format) {
    constexpr uint32_t kMagic = 0x20534444, kDx10 = 0x30315844;               // "DDS ", "DX10"
    constexpr uint32_t kSizesFormatLevels = 0x21007, kDepth = 0x800000;       // dwFlags
    constexpr uint32_t kFourCc = 0x4, kTextureWithLevels = 0x401008;          // of the pixel format, dwCaps
    constexpr uint32_t kCubeAllFaces = 0xFE00, kVolume = 0x200000;            // dwCaps2
    constexpr uint32_t kTexture2D = 3, kTexture3D = 4, kMiscTextureCube = 4;  // of the extension
    const bool volume = shape.depth > 1;
    const auto layers = uint32_t(shape.cube ? shape.layers / 6 : shape.layers);
    std::vector<std::byte> bytes;
    append_words(bytes, {kMagic, 124, kSizesFormatLevels | (volume ? kDepth : 0), uint32_t(shape.height), uint32_t(shape.width), 0,
                         uint32_t(volume ? shape.depth : 0), uint32_t(shape.levels)});
    append_words(bytes, {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0});
    append_words(bytes, {32, kFourCc, kDx10, 0, 0, 0, 0, 0});
    append_words(bytes, {kTextureWithLevels, shape.cube ? kCubeAllFaces : volume ? kVolume : 0, 0, 0, 0});
    append_words(bytes, {dxgi_code(format), volume ? kTexture3D : kTexture2D, shape.cube ? kMiscTextureCube : 0, layers, 0});
    return bytes;
}

/// The bytes of a texel of `layout` that come first are those of the file: both hold channel c at its place.
void append_slice(std::vector<std::byte>& bytes, Texture& texture, int level, int slice, const TexelEncoder& encoder, size_t texel_bytes) {
    const int width = level_extent(texture.shape().width, level), height = level_extent(texture.shape().height, level);
    alignas(16) std::array<std::byte, sizeof(float[4])> stored;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const std::array<float, 4> value = texture.texel(level, slice, x, y);
            encoder.store({value[0], value[1], value[2], value[3]}, stored.data());
            bytes.insert(bytes.end(), stored.begin(), stored.begin() + std::ptrdiff_t(texel_bytes));
        }
    }
}

}  // namespace

Format dds_format(Format format) {
    switch (format) {
        case R8Srgb:
        case RG8Srgb:
        case BC1RgbSrgb:
        case BC1RgbaSrgb:
        case BC2Srgb:
        case BC3Srgb:
        case BC7Srgb: return RGBA8Srgb;
        case BC1RgbUnorm:
        case BC1RgbaUnorm:
        case BC2Unorm:
        case BC3Unorm:
        case BC7Unorm: return RGBA8Unorm;
        case BC4Unorm: return R16Unorm;
        case BC5Unorm: return RG16Unorm;
        case BC4Snorm: return R32Float;
        case BC5Snorm: return RG32Float;
        case BC6HUfloat:
        case BC6HSfloat: return RGBA16Half;
        default: return format;
    }
}

std::vector<std::byte> encode_dds(Texture& texture) {
    const Shape& shape = texture.shape();
    const Format format = dds_format(texture.format());
    const TexelEncoder encoder(layout(format));
    const auto texel_bytes = size_t(info(format).bytes_per_block);
    std::vector<std::byte> bytes = header(shape, format);
    // A layer holds all its levels; a level of a volume holds all its slices.
    const bool volume = shape.depth > 1;
    for (int layer = 0; layer < (volume ? 1 : shape.layers); ++layer) {
        for (int level = 0; level < shape.levels; ++level) {
            const int first = volume ? 0 : layer, end = volume ? slice_count(shape, level) : layer + 1;
            for (int slice = first; slice < end; ++slice) append_slice(bytes, texture, level, slice, encoder, texel_bytes);
        }
    }
    return bytes;
}

}  // namespace rawtexel::texunit
