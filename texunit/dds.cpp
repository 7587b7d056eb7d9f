// DirectDraw Surface files: the legacy header with a FourCC or bit masks, and the DX10 extension (Microsoft, "Programming Guide for DDS").
#include "texunit/container_format_codes.h"
#include "texunit/container_payload.h"
#include "texunit/container_source.h"
#include "texunit/containers.h"
#include "texunit/little_endian.h"

#include <array>
#include <cctype>
#include <cstdio>
#include <optional>
#include <string>

namespace rawtexel::texunit {
namespace {

constexpr uint32_t four_cc(const char (&text)[5]) {
    return uint32_t(uint8_t(text[0])) | uint32_t(uint8_t(text[1])) << 8 | uint32_t(uint8_t(text[2])) << 16 |
           uint32_t(uint8_t(text[3])) << 24;
}

constexpr size_t kHeaderBytes = 4 + 124;  // magic and DDS_HEADER
constexpr size_t kDx10Bytes = 20;         // DDS_HEADER_DXT10

// DDS_HEADER.dwFlags, dwCaps2, DDS_PIXELFORMAT.dwFlags, and the fields of DDS_HEADER_DXT10.
constexpr uint32_t kHasDepth = 0x800000;
constexpr uint32_t kCube = 0x200, kAllFaces = 0xFC00, kVolume = 0x200000;
constexpr uint32_t kAlphaPixels = 0x1, kAlpha = 0x2, kFourCc = 0x4, kRgb = 0x40, kLuminance = 0x20000, kBump = 0x80000;
constexpr uint32_t kTexture2D = 3, kTexture3D = 4, kMiscCube = 0x4;

struct PixelFormat {
    uint32_t flags, four_cc, bits;
    std::array<uint32_t, 4> mask;
};

struct Header {
    uint32_t flags, height, width, depth, levels, caps2;
    PixelFormat pixel;
};

/// The DX10 extension.
struct Extension {
    uint32_t format, dimension, misc, layers;
};

/// Reads `out.size()` bytes of header; a file that ends before them is told apart from one whose texels are missing.
void read_header_bytes(const ByteSource& bytes, uint64_t offset, std::span<std::byte> out) {
    if (bytes.size() < offset + out.size()) {
        refuse(bytes.name(), "truncated: a DDS header needs " + std::to_string(offset + out.size()) + " bytes, the file has " +
                                 std::to_string(bytes.size()));
    }
    bytes.read(offset, out);
}

Header read_header(const ByteSource& bytes) {
    std::array<std::byte, kHeaderBytes> raw;
    if (container_kind(bytes) != ContainerKind::Dds) refuse(bytes.name(), "is not a DDS file");
    read_header_bytes(bytes, 0, raw);
    const auto at = [&](size_t offset) { return load<uint32_t>(raw.data() + offset); };
    if (at(4) != 124) refuse(bytes.name(), "DDS header of " + std::to_string(at(4)) + " bytes; 124 are expected");
    if (at(76) != 32) refuse(bytes.name(), "DDS pixel format of " + std::to_string(at(76)) + " bytes; 32 are expected");
    return {.flags = at(8),
            .height = at(12),
            .width = at(16),
            .depth = at(24),
            .levels = at(28),
            .caps2 = at(112),
            .pixel = {.flags = at(80), .four_cc = at(84), .bits = at(88), .mask = {at(92), at(96), at(100), at(104)}}};
}

Extension read_extension(const ByteSource& bytes) {
    std::array<std::byte, kDx10Bytes> raw;
    read_header_bytes(bytes, kHeaderBytes, raw);
    const auto at = [&](size_t offset) { return load<uint32_t>(raw.data() + offset); };
    return {.format = at(0), .dimension = at(4), .misc = at(8), .layers = at(12)};
}

/// The formats that predate DX10 headers. DXT2 and DXT4 hold premultiplied colours, which are returned as they are. ATI2 is read as BC5,
/// red first, as every reader but the oldest does. Numbers below 128 are D3DFORMAT values.
std::optional<FileTexel> four_cc_texel(uint32_t code) {
    using enum Format;
    switch (code) {
        case four_cc("DXT1"): return plain_texel(BC1RgbaUnorm);
        case four_cc("DXT2"):
        case four_cc("DXT3"): return plain_texel(BC2Unorm);
        case four_cc("DXT4"):
        case four_cc("DXT5"): return plain_texel(BC3Unorm);
        case four_cc("RXGB"): return rxgb_block();
        case four_cc("ATI1"):
        case four_cc("BC4U"): return plain_texel(BC4Unorm);
        case four_cc("BC4S"): return plain_texel(BC4Snorm);
        case four_cc("ATI2"):
        case four_cc("BC5U"): return plain_texel(BC5Unorm);
        case four_cc("BC5S"): return plain_texel(BC5Snorm);
        case 36: return plain_texel(RGBA16Unorm);
        case 110: return snorm16_texel(4);
        case 111: return plain_texel(R16Half);
        case 112: return plain_texel(RG16Half);
        case 113: return plain_texel(RGBA16Half);
        case 114: return plain_texel(R32Float);
        case 115: return plain_texel(RG32Float);
        case 116: return plain_texel(RGBA32Float);
        default: return std::nullopt;
    }
}

std::string describe_four_cc(uint32_t code) {
    std::string text;
    for (int i = 0; i < 4; ++i) text += char((code >> (8 * i)) & 0xFF);
    for (const char c : text) {
        if (!std::isprint(uint8_t(c))) return "D3DFORMAT " + std::to_string(code);
    }
    return "FourCC \"" + text + "\"";
}

std::string describe_masks(const PixelFormat& pixel) {
    std::string text = std::to_string(pixel.bits) + " bits a texel with the masks";
    for (const uint32_t mask : pixel.mask) {
        char hexadecimal[12];
        std::snprintf(hexadecimal, sizeof hexadecimal, " %08x", unsigned(mask));
        text += hexadecimal;
    }
    return text;
}

/// Bump maps of D3D9: signed bytes, red lowest. Nullopt for their other layouts.
std::optional<FileTexel> bump_texel(const PixelFormat& pixel) {
    using Masks = std::array<uint32_t, 4>;
    if (pixel.bits == 16 && pixel.mask == Masks{0xFF, 0xFF00, 0, 0}) return plain_texel(Format::RG8Snorm);
    if (pixel.bits == 32 && pixel.mask == Masks{0xFF, 0xFF00, 0xFF0000, 0xFF000000}) return plain_texel(Format::RGBA8Snorm);
    if (pixel.bits == 32 && pixel.mask == Masks{0xFFFF, 0xFFFF0000, 0, 0}) return snorm16_texel(2);
    return std::nullopt;
}

/// Uncompressed texels of any arrangement. Masks that the flags do not announce are ignored, as writers leave anything there.
std::optional<FileTexel> masked_texel(const PixelFormat& pixel) {
    if ((pixel.flags & kBump) != 0) return bump_texel(pixel);
    std::array<uint32_t, 4> mask{};
    if ((pixel.flags & kLuminance) != 0)
        mask = {pixel.mask[0], pixel.mask[0], pixel.mask[0], 0};
    else if ((pixel.flags & kRgb) != 0)
        mask = {pixel.mask[0], pixel.mask[1], pixel.mask[2], 0};
    if ((pixel.flags & (kAlpha | kAlphaPixels)) != 0) mask[3] = pixel.mask[3];
    if (pixel.bits % 8 != 0 || pixel.bits > 32 || !valid_field_masks(mask, int(pixel.bits / 8))) return std::nullopt;
    return field_texel(mask, int(pixel.bits / 8));
}

FileTexel legacy_texel(const std::string& name, const PixelFormat& pixel) {
    const bool coded = (pixel.flags & kFourCc) != 0;
    const std::optional<FileTexel> texel = coded ? four_cc_texel(pixel.four_cc) : masked_texel(pixel);
    if (!texel) refuse(name, "DDS format is not supported: " + (coded ? describe_four_cc(pixel.four_cc) : describe_masks(pixel)));
    return *texel;
}

struct Image {
    FileTexel texel;
    Shape shape;
    uint64_t data_offset;
};

void check_cube(const std::string& name, const Shape& shape) {
    if (shape.width != shape.height) {
        refuse(name,
               "cube map with faces of " + std::to_string(shape.width) + "x" + std::to_string(shape.height) + " texels; faces are square");
    }
}

/// Extents without levels.
Shape legacy_shape(const std::string& name, const Header& header) {
    Shape shape;
    shape.width = checked_extent(name, "width", header.width);
    shape.height = checked_extent(name, "height", header.height);
    // Writers disagree about the flags of volumes; a depth above 1 with either of them is one.
    const bool volume = (header.caps2 & kVolume) != 0 || ((header.flags & kHasDepth) != 0 && header.depth > 1);
    shape.cube = (header.caps2 & kCube) != 0;
    if (shape.cube && volume) refuse(name, "is marked as a cube map and as a volume texture");
    if (shape.cube && (header.caps2 & kAllFaces) != kAllFaces) refuse(name, "cube map with missing faces; all six are needed");
    if (shape.cube) shape.layers = 6;
    if (volume) shape.depth = checked_extent(name, "depth", header.depth);
    return shape;
}

Shape dx10_shape(const std::string& name, const Header& header, const Extension& extension) {
    Shape shape;
    shape.width = checked_extent(name, "width", header.width);
    shape.height = checked_extent(name, "height", header.height);
    if (extension.dimension != kTexture2D && extension.dimension != kTexture3D) {
        refuse(name, "DDS resource dimension " + std::to_string(extension.dimension) + " is not supported; 3 (2-D) and 4 (3-D) are");
    }
    shape.cube = (extension.misc & kMiscCube) != 0;
    if (extension.dimension == kTexture3D) {
        if (shape.cube || extension.layers != 1) refuse(name, "3-D texture that is an array or a cube map");
        shape.depth = checked_extent(name, "depth", header.depth);
    } else {
        shape.layers = checked_layers(name, uint64_t{extension.layers} * (shape.cube ? 6 : 1));
    }
    return shape;
}

Image read_image(const ByteSource& bytes) {
    const std::string& name = bytes.name();
    const Header header = read_header(bytes);
    Image image;
    if ((header.pixel.flags & kFourCc) != 0 && header.pixel.four_cc == four_cc("DX10")) {
        const Extension extension = read_extension(bytes);
        const std::optional<FileTexel> texel = dxgi_texel(extension.format);
        if (!texel) refuse(name, "DDS format is not supported: " + describe_dxgi(extension.format));
        image = {*texel, dx10_shape(name, header, extension), kHeaderBytes + kDx10Bytes};
    } else {
        image = {legacy_texel(name, header.pixel), legacy_shape(name, header), kHeaderBytes};
    }
    if (image.shape.cube) check_cube(name, image.shape);
    image.shape.levels = checked_levels(name, header.levels, image.shape);
    return image;
}

/// Layer after layer, each with all its levels; a volume has one chain of levels, each with all its slices.
std::vector<LevelPlace> places(const Image& image, const std::shared_ptr<const ByteSource>& payload) {
    const Shape& shape = image.shape;
    const bool volume = shape.depth > 1;
    Shape one_layer = shape;
    one_layer.layers = 1;
    const uint64_t chain = image_bytes(image.texel, one_layer);
    std::vector<LevelPlace> levels;
    uint64_t offset = image.data_offset;
    for (int level = 0; level < shape.levels; ++level) {
        const uint64_t slice = slice_bytes(image.texel, level_extent(shape.width, level), level_extent(shape.height, level));
        levels.push_back({payload, offset, volume ? slice : chain});
        offset += level_bytes(image.texel, one_layer, level);
    }
    return levels;
}

}  // namespace

std::unique_ptr<TexelSource> open_dds(std::shared_ptr<const ByteSource> bytes, const ContainerOptions& options) {
    Image image = read_image(*bytes);
    image.texel = rounded_texel(image.texel, options.bc_rounding);
    const uint64_t needed = image_bytes(image.texel, image.shape), available = bytes->size() - image.data_offset;
    if (needed > available) {
        refuse(bytes->name(), "truncated: its format and extents need " + std::to_string(needed) + " bytes of texels, the file has " +
                                  std::to_string(available));
    }
    check_texture_bytes(bytes->name(), needed, options);
    std::shared_ptr<const ByteSource> payload = bytes;
    if (!bytes->in_memory()) payload = std::make_shared<PagedBytes>(bytes, image.data_offset, image.data_offset + needed);
    return make_container_source(image.texel, image.shape, places(image, payload));
}

}  // namespace rawtexel::texunit
