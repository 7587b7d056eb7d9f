#include "tests/cli/texture_files.h"

#include <cstring>

namespace rawtexel::test {
namespace {

using Bytes = std::vector<std::byte>;

void append(Bytes& bytes, const void* data, size_t size) {
    const auto* const first = static_cast<const std::byte*>(data);
    bytes.insert(bytes.end(), first, first + size);
}

void append_words(Bytes& bytes, std::initializer_list<uint32_t> words) { append(bytes, std::data(words), 4 * words.size()); }

uint32_t channels_of(FileFormat format) { return format == FileFormat::R8Unorm ? 1 : format == FileFormat::Rg8Unorm ? 2 : 4; }

void append_texel(Bytes& bytes, FileFormat format, int level, int slice, int x, int y) {
    for (int c = 0; c < int(channels_of(format)); ++c) {
        const uint8_t code = code_of(level, slice, x, y, c);
        const uint16_t wide = wide_code_of(level, slice, x, y, c);
        const float number = float(code) / 255.0f;
        if (format == FileFormat::Rgba32Float)
            append(bytes, &number, sizeof number);
        else if (format == FileFormat::Rgba16Unorm)
            append(bytes, &wide, sizeof wide);
        else
            append(bytes, &code, sizeof code);
    }
}

void append_slice(Bytes& bytes, FileFormat format, const texunit::Shape& shape, int level, int slice) {
    const int width = texunit::level_extent(shape.width, level), height = texunit::level_extent(shape.height, level);
    if (format == FileFormat::Bc1Unorm) {
        for (int block = 0; block < ((width + 3) / 4) * ((height + 3) / 4); ++block)
            for (int i = 0; i < 8; ++i) bytes.push_back(std::byte(code_of(level, slice, block, i, 0)));
        return;
    }
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) append_texel(bytes, format, level, slice, x, y);
}

// "DDS ", DDS_HEADER, DDS_HEADER_DXT10.
Bytes header(const texunit::Shape& shape, FileFormat format) {
    const bool volume = shape.depth > 1;
    Bytes bytes;
    append_words(bytes, {0x20534444, 124, 0x1007u | (volume ? 0x800000u : 0u), uint32_t(shape.height), uint32_t(shape.width), 0,
                         uint32_t(volume ? shape.depth : 0), uint32_t(shape.levels)});
    for (int i = 0; i < 11; ++i) append_words(bytes, {0});
    append_words(bytes, {32, 4, 0x30315844, 0, 0, 0, 0, 0});  // "DX10"
    append_words(bytes, {0x1000, shape.cube ? 0xFE00u : volume ? 0x200000u : 0u, 0, 0, 0});
    append_words(bytes, {uint32_t(format), volume ? 4u : 3u, shape.cube ? 4u : 0u, uint32_t(shape.cubes()), 0});
    return bytes;
}

}  // namespace

ShapeFiles write_shapes(const TemporaryFolder& folder) {
    return {.flat = write_dds(folder, "flat.dds", {.width = 13, .height = 7, .levels = 2}, FileFormat::Rgba8Srgb),
            .array = write_dds(folder, "array.dds", {.width = 8, .height = 8, .layers = 3}, FileFormat::Rgba8Unorm),
            .volume = write_dds(folder, "volume.dds", {.width = 8, .height = 6, .depth = 5, .levels = 2}, FileFormat::Rgba8Unorm),
            .cube = write_dds(folder, "cube.dds", {.width = 8, .height = 8, .layers = 12, .cube = true}, FileFormat::Rgba8Unorm)};
}

uint8_t code_of(int level, int slice, int x, int y, int c) {
    uint32_t hash = uint32_t(level) * 0x9E3779B1u + uint32_t(slice) * 0x85EBCA77u + uint32_t(x) * 0xC2B2AE3Du + uint32_t(y) * 0x27D4EB2Fu +
                    uint32_t(c) * 0x165667B1u;
    hash = (hash ^ hash >> 15) * 0x2C1B3C6Du;
    hash = (hash ^ hash >> 12) * 0x297A2D39u;
    return uint8_t(hash >> 24);
}

uint16_t wide_code_of(int level, int slice, int x, int y, int c) { return uint16_t(251 * code_of(level, slice, x, y, c) + 90); }

std::string write_dds(const TemporaryFolder& folder, const std::string& name, const texunit::Shape& shape, FileFormat format) {
    Bytes bytes = header(shape, format);
    // Layers hold all their levels; the levels of a volume hold all their slices.
    const bool volume = shape.depth > 1;
    for (int layer = 0; layer < (volume ? 1 : shape.layers); ++layer)
        for (int level = 0; level < shape.levels; ++level)
            for (int z = 0; z < (volume ? texunit::level_extent(shape.depth, level) : 1); ++z)
                append_slice(bytes, format, shape, level, volume ? z : layer);
    return folder.write(name, std::span<const std::byte>(bytes));
}

}  // namespace rawtexel::test
