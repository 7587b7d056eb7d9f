// KTX 2.0 files (Khronos, "KTX File Format Specification, version 2").
#include "texunit/container_format_codes.h"
#include "texunit/container_payload.h"
#include "texunit/container_source.h"
#include "texunit/containers.h"
#include "texunit/little_endian.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <utility>

namespace rawtexel::texunit {
namespace {

constexpr uint64_t kHeaderBytes = 80, kLevelIndexBytes = 24;
constexpr uint32_t kUncompressed = 0, kZstandard = 2;

struct Header {
    uint32_t vk_format, width, height, depth, layers, faces, levels, scheme;
};

/// One entry of the level index.
struct LevelIndex {
    uint64_t offset, bytes, uncompressed_bytes;
};

void check_inside(const ByteSource& bytes, const std::string& what, uint64_t offset, uint64_t size) {
    if (size <= bytes.size() && offset <= bytes.size() - size) return;
    refuse(bytes.name(), "truncated: " + what + " is " + std::to_string(size) + " bytes at offset " + std::to_string(offset) +
                             ", the file has " + std::to_string(bytes.size()));
}

Header read_header(const ByteSource& bytes) {
    if (container_kind(bytes) != ContainerKind::Ktx2) refuse(bytes.name(), "is not a KTX2 file");
    check_inside(bytes, "the header", 0, kHeaderBytes);
    std::array<std::byte, kHeaderBytes> raw;
    bytes.read(0, raw);
    const auto u32 = [&](size_t offset) { return load<uint32_t>(raw.data() + offset); };
    const auto u64 = [&](size_t offset) { return load<uint64_t>(raw.data() + offset); };
    check_inside(bytes, "the data format descriptor", u32(48), u32(52));
    check_inside(bytes, "the key/value data", u32(56), u32(60));
    check_inside(bytes, "the supercompression data", u64(64), u64(72));
    return {.vk_format = u32(12),
            .width = u32(20),
            .height = u32(24),
            .depth = u32(28),
            .layers = u32(32),
            .faces = u32(36),
            .levels = u32(40),
            .scheme = u32(44)};
}

/// Nullopt for the schemes that are read.
std::optional<std::string> unsupported_scheme(uint32_t scheme) {
    switch (scheme) {
        case kUncompressed:
        case kZstandard: return std::nullopt;
        case 1: return "BasisLZ";
        case 3: return "ZLIB";
        default: return "scheme " + std::to_string(scheme);
    }
}

Shape read_shape(const std::string& name, const Header& header) {
    Shape shape;
    shape.width = checked_extent(name, "width", header.width);
    if (header.height == 0) refuse(name, "1-D texture; 2-D, cube map, array and 3-D are supported");
    shape.height = checked_extent(name, "height", header.height);
    if (header.faces != 1 && header.faces != 6) refuse(name, std::to_string(header.faces) + " faces; 1 or 6 are allowed");
    shape.cube = header.faces == 6;
    if (shape.cube && shape.width != shape.height) {
        refuse(name,
               "cube map with faces of " + std::to_string(shape.width) + "x" + std::to_string(shape.height) + " texels; faces are square");
    }
    if (header.depth != 0) {
        if (shape.cube || header.layers != 0) refuse(name, "3-D texture that is an array or a cube map");
        shape.depth = checked_extent(name, "depth", header.depth);
    } else {
        shape.layers = checked_layers(name, uint64_t{header.layers == 0 ? 1 : header.layers} * header.faces);
    }
    shape.levels = checked_levels(name, header.levels, shape);
    return shape;
}

std::vector<LevelIndex> read_level_index(const ByteSource& bytes, int levels) {
    std::vector<std::byte> raw(size_t(levels) * kLevelIndexBytes);
    check_inside(bytes, "the level index", kHeaderBytes, raw.size());
    bytes.read(kHeaderBytes, raw);
    std::vector<LevelIndex> index;
    for (int level = 0; level < levels; ++level) {
        const std::byte* const entry = raw.data() + size_t(level) * kLevelIndexBytes;
        index.push_back({load<uint64_t>(entry), load<uint64_t>(entry + 8), load<uint64_t>(entry + 16)});
        check_inside(bytes, "level " + std::to_string(level), index.back().offset, index.back().bytes);
    }
    return index;
}

void check_level_size(const std::string& name, int level, const LevelIndex& index, uint32_t scheme, uint64_t needed) {
    const std::string what = "level " + std::to_string(level) + " has ";
    const uint64_t inflated = scheme == kUncompressed ? index.bytes : index.uncompressed_bytes;
    if (inflated != needed) {
        refuse(name, what + std::to_string(inflated) + " bytes, its format and extents need " + std::to_string(needed));
    }
    if (scheme == kZstandard && index.bytes > InflatedBytes::compressed_bound(needed)) {
        refuse(name, what + std::to_string(index.bytes) + " compressed bytes, more than zstd makes of " + std::to_string(needed));
    }
}

/// The part of the file from the first level's first byte to the last level's last.
std::shared_ptr<const ByteSource> page(const std::shared_ptr<const ByteSource>& bytes, const std::vector<LevelIndex>& index) {
    uint64_t begin = bytes->size(), end = 0;
    for (const LevelIndex& level : index) {
        begin = std::min(begin, level.offset);
        end = std::max(end, level.offset + level.bytes);
    }
    return std::make_shared<PagedBytes>(bytes, begin, end);
}

}  // namespace

std::unique_ptr<TexelSource> open_ktx2(std::shared_ptr<const ByteSource> bytes, const ContainerOptions& options) {
    const std::string& name = bytes->name();
    const Header header = read_header(*bytes);
    if (const auto scheme = unsupported_scheme(header.scheme)) {
        refuse(name, "KTX2 supercompression is not supported: " + *scheme + "; none and Zstandard are");
    }
    const std::optional<FileTexel> stored = vulkan_texel(header.vk_format);
    if (!stored) refuse(name, "KTX2 format is not supported: " + describe_vulkan(header.vk_format));
    const FileTexel texel = rounded_texel(*stored, options.bc_rounding);
    const Shape shape = read_shape(name, header);
    check_texture_bytes(name, image_bytes(texel, shape), options);

    const std::vector<LevelIndex> index = read_level_index(*bytes, shape.levels);
    for (int level = 0; level < shape.levels; ++level) {
        check_level_size(name, level, index[size_t(level)], header.scheme, level_bytes(texel, shape, level));
    }
    std::shared_ptr<const ByteSource> payload = bytes;
    if (header.scheme == kUncompressed && !bytes->in_memory()) payload = page(bytes, index);

    std::vector<LevelPlace> places;
    for (int level = 0; level < shape.levels; ++level) {
        const LevelIndex& at = index[size_t(level)];
        const uint64_t slice = slice_bytes(texel, level_extent(shape.width, level), level_extent(shape.height, level));
        if (header.scheme == kUncompressed) {
            places.push_back({payload, at.offset, slice});
        } else {
            auto inflated =
                std::make_shared<InflatedBytes>(bytes, "level " + std::to_string(level), at.offset, at.bytes, at.uncompressed_bytes);
            places.push_back({std::move(inflated), 0, slice});
        }
    }
    return make_container_source(texel, shape, std::move(places));
}

}  // namespace rawtexel::texunit
