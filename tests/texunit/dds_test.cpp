#include "tests/texunit/container_writer.h"

#include "texunit/containers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace rawtexel::texunit {
namespace {

using test_files::Bytes;
using test_files::DdsPixelFormat;
using test_files::four_cc;
using test_files::random_image;
using test_files::StoredImage;

constexpr uint32_t kAlphaPixels = 1, kAlpha = 2, kFourCc = 4, kRgb = 0x40, kLuminance = 0x20000, kBump = 0x80000;

std::unique_ptr<TexelSource> open_bytes(Bytes bytes) { return open_dds(open_memory("test.dds", std::move(bytes))); }

/// The message of the TextureError that opening throws; empty when it opens.
std::string refusal(Bytes bytes, const ContainerOptions& options = {}) {
    try {
        open_dds(open_memory("test.dds", std::move(bytes)), options);
    } catch (const TextureError& error) {
        return error.what();
    }
    return "";
}

void expect_refusal(const Bytes& bytes, const std::string& part) {
    const std::string message = refusal(bytes);
    EXPECT_NE(message.find("test.dds: "), std::string::npos) << message;
    EXPECT_NE(message.find(part), std::string::npos) << "\"" << message << "\" does not say \"" << part << "\"";
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
}

struct DxgiCase {
    uint32_t code;
    Format format;
};

/// Formats whose units the file stores as texunit does.
const DxgiCase kDxgiFormats[] = {
    {2, Format::RGBA32Float}, {10, Format::RGBA16Half},   {11, Format::RGBA16Unorm}, {16, Format::RG32Float}, {28, Format::RGBA8Unorm},
    {29, Format::RGBA8Srgb},  {31, Format::RGBA8Snorm},   {34, Format::RG16Half},    {35, Format::RG16Unorm}, {41, Format::R32Float},
    {49, Format::RG8Unorm},   {51, Format::RG8Snorm},     {54, Format::R16Half},     {56, Format::R16Unorm},  {61, Format::R8Unorm},
    {63, Format::R8Snorm},    {71, Format::BC1RgbaUnorm}, {72, Format::BC1RgbaSrgb}, {74, Format::BC2Unorm},  {75, Format::BC2Srgb},
    {77, Format::BC3Unorm},   {78, Format::BC3Srgb},      {80, Format::BC4Unorm},    {81, Format::BC4Snorm},  {83, Format::BC5Unorm},
    {84, Format::BC5Snorm},   {95, Format::BC6HUfloat},   {96, Format::BC6HSfloat},  {98, Format::BC7Unorm},  {99, Format::BC7Srgb},
};

/// Extents that are no multiples of 4, chains whose axes end at different levels, and every kind of texture.
const Shape kShapes[] = {
    {.width = 1, .height = 1},
    {.width = 4, .height = 4, .levels = 3},
    {.width = 16, .height = 4, .levels = 5},
    {.width = 3, .height = 17, .levels = 5},
    {.width = 13, .height = 7, .levels = 2},
    {.width = 9, .height = 6, .layers = 3, .levels = 4},
    {.width = 6, .height = 6, .layers = 6, .levels = 3, .cube = true},
    {.width = 5, .height = 5, .layers = 12, .levels = 2, .cube = true},
    {.width = 7, .height = 10, .depth = 5, .levels = 4},
};

StoredImage image_of(Format format, const Shape& shape, uint64_t seed) {
    return random_image(shape, info(format).block_extent, info(format).bytes_per_block, seed);
}

TEST(Dds, HoldsEveryDxgiFormatInEveryShape) {
    for (const DxgiCase& dxgi : kDxgiFormats) {
        for (const Shape& shape : kShapes) {
            const StoredImage image = image_of(dxgi.format, shape, dxgi.code);
            const auto source = open_bytes(write_dds(image, dxgi.code));
            test_files::expect_same_texels(*source, image, dxgi.format);
            if (HasFatalFailure()) return;
        }
    }
}

TEST(Dds, HoldsLegacyFormatsInEveryShape) {
    const std::pair<uint32_t, Format> formats[] = {
        {four_cc("DXT1"), Format::BC1RgbaUnorm},
        {four_cc("DXT2"), Format::BC2Unorm},
        {four_cc("DXT3"), Format::BC2Unorm},
        {four_cc("DXT4"), Format::BC3Unorm},
        {four_cc("DXT5"), Format::BC3Unorm},
        {four_cc("ATI1"), Format::BC4Unorm},
        {four_cc("BC4U"), Format::BC4Unorm},
        {four_cc("BC4S"), Format::BC4Snorm},
        {four_cc("ATI2"), Format::BC5Unorm},
        {four_cc("BC5U"), Format::BC5Unorm},
        {four_cc("BC5S"), Format::BC5Snorm},
        {36, Format::RGBA16Unorm},
        {111, Format::R16Half},
        {112, Format::RG16Half},
        {113, Format::RGBA16Half},
        {114, Format::R32Float},
        {115, Format::RG32Float},
        {116, Format::RGBA32Float},
    };
    for (const auto& [code, format] : formats) {
        for (const Shape& shape : kShapes) {
            if (shape.layers != 1 && shape.layers != 6) continue;
            if (shape.layers == 6 && !shape.cube) continue;
            const StoredImage image = image_of(format, shape, code);
            const auto source = open_bytes(write_legacy_dds(image, {.flags = kFourCc, .four_cc = code}));
            test_files::expect_same_texels(*source, image, format);
            if (HasFatalFailure()) return;
        }
    }
}

/// One texel of a layout that is not texunit's own, and what it must read as.
struct FieldCase {
    const char* name;
    DdsPixelFormat pixel;
    uint32_t word;
    Format format;
    double value[4];
};

TEST(Dds, ReadsUncompressedTexelsOfAnyArrangement) {
    const FieldCase cases[] = {
        {"a8", {kAlpha, 0, 8, {0, 0, 0, 0xFF}}, 0x33, Format::RGBA8Unorm, {0, 0, 0, 0.2}},
        {"l8", {kLuminance, 0, 8, {0xFF, 0xFF, 0xFF, 0}}, 0x33, Format::RGBA8Unorm, {0.2, 0.2, 0.2, 1}},
        {"l8 with one mask", {kLuminance, 0, 8, {0xFF, 0, 0, 0}}, 0x33, Format::RGBA8Unorm, {0.2, 0.2, 0.2, 1}},
        {"l8a8", {kLuminance | kAlphaPixels, 0, 16, {0xFF, 0, 0, 0xFF00}}, 0x6633, Format::RGBA8Unorm, {0.2, 0.2, 0.2, 0.4}},
        {"l16", {kLuminance, 0, 16, {0xFFFF, 0, 0, 0}}, 0x3333, Format::RGBA16Unorm, {0.2, 0.2, 0.2, 1}},
        {"a4l4", {kLuminance | kAlphaPixels, 0, 8, {0x0F, 0, 0, 0xF0}}, 0x96, Format::RGBA8Unorm, {0.4, 0.4, 0.4, 0.6}},
        {"r3g3b2", {kRgb, 0, 8, {0xE0, 0x1C, 0x03, 0}}, 0xB1, Format::RGBA16Unorm, {5 / 7.0, 4 / 7.0, 1 / 3.0, 1}},
        {"a8r3g3b2",
         {kRgb | kAlphaPixels, 0, 16, {0xE0, 0x1C, 0x03, 0xFF00}},
         0x33B1,
         Format::RGBA16Unorm,
         {5 / 7.0, 4 / 7.0, 1 / 3.0, 0.2}},
        {"a1r5g5b5",
         {kRgb | kAlphaPixels, 0, 16, {0x7C00, 0x3E0, 0x1F, 0x8000}},
         0x8000 | (30u << 10) | (7u << 5) | 1,
         Format::RGBA16Unorm,
         {30 / 31.0, 7 / 31.0, 1 / 31.0, 1}},
        {"x1r5g5b5", {kRgb, 0, 16, {0x7C00, 0x3E0, 0x1F, 0x8000}}, 30u << 10, Format::RGBA16Unorm, {30 / 31.0, 0, 0, 1}},
        {"a4r4g4b4", {kRgb | kAlphaPixels, 0, 16, {0xF00, 0xF0, 0xF, 0xF000}}, 0x3692, Format::RGBA8Unorm, {0.4, 0.6, 2 / 15.0, 0.2}},
        {"r5g6b5",
         {kRgb, 0, 16, {0xF800, 0x7E0, 0x1F, 0}},
         (3u << 11) | (62u << 5) | 17,
         Format::RGBA16Unorm,
         {3 / 31.0, 62 / 63.0, 17 / 31.0, 1}},
        {"r8g8b8", {kRgb, 0, 24, {0xFF0000, 0xFF00, 0xFF, 0}}, 0x336699, Format::RGBA8Unorm, {0.2, 0.4, 0.6, 1}},
        {"b8g8r8", {kRgb, 0, 24, {0xFF, 0xFF00, 0xFF0000, 0}}, 0x336699, Format::RGBA8Unorm, {0.6, 0.4, 0.2, 1}},
        {"a8r8g8b8",
         {kRgb | kAlphaPixels, 0, 32, {0xFF0000, 0xFF00, 0xFF, 0xFF000000}},
         0xCC336699,
         Format::RGBA8Unorm,
         {0.2, 0.4, 0.6, 0.8}},
        {"x8r8g8b8", {kRgb, 0, 32, {0xFF0000, 0xFF00, 0xFF, 0xFF000000}}, 0x00336699, Format::RGBA8Unorm, {0.2, 0.4, 0.6, 1}},
        {"a8b8g8r8",
         {kRgb | kAlphaPixels, 0, 32, {0xFF, 0xFF00, 0xFF0000, 0xFF000000}},
         0xCC336699,
         Format::RGBA8Unorm,
         {0.6, 0.4, 0.2, 0.8}},
        {"r8g8b8a8 high",
         {kRgb | kAlphaPixels, 0, 32, {0xFF000000, 0xFF0000, 0xFF00, 0xFF}},
         0x336699CC,
         Format::RGBA8Unorm,
         {0.2, 0.4, 0.6, 0.8}},
        {"a2b10g10r10",
         {kRgb | kAlphaPixels, 0, 32, {0x3FF, 0xFFC00, 0x3FF00000, 0xC0000000}},
         (2u << 30) | (1000u << 20) | (33u << 10) | 1,
         Format::RGBA16Unorm,
         {1 / 1023.0, 33 / 1023.0, 1000 / 1023.0, 2 / 3.0}},
        {"g16r16", {kRgb, 0, 32, {0xFFFF, 0xFFFF0000, 0, 0}}, 0x66663333, Format::RG16Unorm, {0.2, 0.4, 0, 1}},
        {"r8", {kRgb, 0, 8, {0xFF, 0, 0, 0}}, 0x33, Format::R8Unorm, {0.2, 0, 0, 1}},
        {"r16", {kRgb, 0, 16, {0xFFFF, 0, 0, 0}}, 0x3333, Format::R16Unorm, {0.2, 0, 0, 1}},
        {"v8u8", {kBump, 0, 16, {0xFF, 0xFF00, 0, 0}}, 0x817F, Format::RG8Snorm, {1, -1, 0, 1}},
        {"q8w8v8u8", {kBump, 0, 32, {0xFF, 0xFF00, 0xFF0000, 0xFF000000}}, 0x0080817F, Format::RGBA8Snorm, {1, -1, -1, 0}},
        {"v16u16", {kBump, 0, 32, {0xFFFF, 0xFFFF0000, 0, 0}}, 0x80007FFF, Format::RG32Float, {1, -1, 0, 1}},
    };
    for (const FieldCase& c : cases) {
        StoredImage image{{}, 1, int(c.pixel.bits / 8), {{Bytes(4)}}};
        test_files::put32(image.slices[0][0], 0, c.word);
        image.slices[0][0].resize(size_t(image.unit_bytes));
        const auto source = open_bytes(write_legacy_dds(image, c.pixel));
        EXPECT_EQ(info(source->format()).name, info(c.format).name) << c.name;
        std::array<std::byte, 256> texels;
        source->decode_block(0, 0, 0, 0, texels.data());
        // Codes of 8 bits are exact; others are rounded to 16 bits.
        const double tolerance = c.format == Format::RGBA16Unorm ? 0.5 / 65535 + 1e-12 : 1e-12;
        for (int texel = 0; texel < 16; ++texel) {
            const auto value = test_files::decoded_value(source->format(), texels.data(), texel);
            for (size_t i = 0; i < 4; ++i) ASSERT_NEAR(value[i], c.value[i], tolerance) << c.name << " channel " << i << " texel " << texel;
        }
    }
}

TEST(Dds, AddressesOddTexelSizesInEveryShape) {
    // 3-byte texels: what is written must come back from its own place, whatever the expansion.
    for (const Shape& shape : {Shape{.width = 13, .height = 7, .levels = 4}, Shape{.width = 5, .height = 3, .depth = 4, .levels = 3},
                               Shape{.width = 6, .height = 6, .layers = 6, .levels = 2, .cube = true}}) {
        const StoredImage image = random_image(shape, 1, 3, 77);
        const auto source = open_bytes(write_legacy_dds(image, {kRgb, 0, 24, {0xFF, 0xFF00, 0xFF0000, 0}}));
        StoredImage expanded = random_image(shape, 1, 4, 0);
        for (size_t level = 0; level < image.slices.size(); ++level) {
            for (size_t slice = 0; slice < image.slices[level].size(); ++slice) {
                const Bytes& from = image.slices[level][slice];
                Bytes& to = expanded.slices[level][slice];
                for (size_t i = 0; i < from.size() / 3; ++i) {
                    for (size_t c = 0; c < 3; ++c) to[4 * i + c] = from[3 * i + c];
                    to[4 * i + 3] = std::byte{255};
                }
            }
        }
        EXPECT_EQ(source->shape(), shape);
        for (int level = 0; level < shape.levels; ++level) {
            for (int slice = 0; slice < int(image.slices[size_t(level)].size()); ++slice) {
                for (int y = 0; 4 * y < level_extent(shape.height, level); ++y) {
                    for (int x = 0; 4 * x < level_extent(shape.width, level); ++x) {
                        Bytes got(64);
                        source->decode_block(level, slice, x, y, got.data());
                        ASSERT_TRUE(got == test_files::expected_block(expanded, Format::RGBA8Unorm, level, slice, x, y))
                            << level << ' ' << slice;
                    }
                }
            }
        }
    }
}

TEST(Dds, TakesTheRedOfRxgbFromAlpha) {
    const StoredImage image = random_image({.width = 6, .height = 5}, 4, 16, 8);
    const auto source = open_bytes(write_legacy_dds(image, {.flags = kFourCc, .four_cc = four_cc("RXGB")}));
    ASSERT_EQ(source->format(), Format::RGBA16Unorm);
    for (int block = 0; block < 4; ++block) {
        Bytes got(128);
        source->decode_block(0, 0, block % 2, block / 2, got.data());
        const Bytes bc3 = test_files::expected_block(image, Format::BC3Unorm, 0, 0, block % 2, block / 2);
        for (int texel = 0; texel < 16; ++texel) {
            const auto value = test_files::decoded_value(Format::RGBA16Unorm, got.data(), texel);
            const auto stored = test_files::decoded_value(Format::BC3Unorm, bc3.data(), texel);
            const double expected[] = {stored[3], stored[1], stored[2], 1};
            for (size_t c = 0; c < 4; ++c) ASSERT_NEAR(value[c], expected[c], 0.5 / 65535 + 1e-12) << "texel " << texel << " channel " << c;
        }
    }
}

TEST(Dds, ReadsDx10LayoutsThatAreNotItsOwn) {
    struct Case {
        uint32_t code;
        std::vector<uint32_t> words;
        int bytes;
        double value[4];
        double tolerance;
    };
    const Case cases[] = {
        {6, {0x3F000000, 0xBF800000, 0x40000000}, 12, {0.5, -1, 2, 1}, 0},
        {13, {0x80017FFF, 0x80004000}, 8, {1, -1, 16384 / 32767.0, -1}, 1e-7},
        {24, {(2u << 30) | (1000u << 20) | (33u << 10) | 1}, 4, {1 / 1023.0, 33 / 1023.0, 1000 / 1023.0, 2 / 3.0}, 0.5 / 65535 + 1e-12},
        {26, {0x3C0u | (0x400u << 11) | (0x1A0u << 22)}, 4, {1, 2, 0.25, 1}, 0},
        {67, {0x100u | (0x80u << 9) | (0x1FFu << 18) | (16u << 27)}, 4, {1, 0.5, 511 / 256.0, 1}, 0},
        {67, {0x1FFu | (0x1u << 9) | (31u << 27)}, 4, {65408, 128, 0, 1}, 0},
        {67, {0x1FFu | (0x1u << 9)}, 4, {511 * 0x1p-24, 0x1p-24, 0, 1}, 0},
        {65, {0x33}, 1, {0, 0, 0, 0.2}, 1e-12},
        {85, {(3u << 11) | (62u << 5) | 17}, 2, {3 / 31.0, 62 / 63.0, 17 / 31.0, 1}, 0.5 / 65535 + 1e-12},
        {86, {0x8000 | (30u << 10) | (7u << 5) | 1}, 2, {30 / 31.0, 7 / 31.0, 1 / 31.0, 1}, 0.5 / 65535 + 1e-12},
        {87, {0xCC336699}, 4, {0.2, 0.4, 0.6, 0.8}, 1e-12},
        {88, {0xCC336699}, 4, {0.2, 0.4, 0.6, 1}, 1e-12},
        {91, {0xCC336699}, 4, {0.0331047666, 0.1328683216, 0.3185467781, 0.8}, 1e-9},
        {93, {0x00336699}, 4, {0.0331047666, 0.1328683216, 0.3185467781, 1}, 1e-9},
        {115, {0x3692}, 2, {0.4, 0.6, 2 / 15.0, 0.2}, 1e-12},
    };
    for (const Case& c : cases) {
        StoredImage image{{}, 1, c.bytes, {{Bytes(4 * c.words.size())}}};
        for (size_t i = 0; i < c.words.size(); ++i) test_files::put32(image.slices[0][0], 4 * i, c.words[i]);
        image.slices[0][0].resize(size_t(c.bytes));
        const auto source = open_bytes(write_dds(image, c.code));
        std::array<std::byte, 256> texels;
        source->decode_block(0, 0, 0, 0, texels.data());
        const auto value = test_files::decoded_value(source->format(), texels.data(), 0);
        for (size_t i = 0; i < 4; ++i) EXPECT_NEAR(value[i], c.value[i], c.tolerance) << "DXGI " << c.code << " channel " << i;
    }
}

TEST(Dds, RefusesWhatItCannotReadByName) {
    const StoredImage image = random_image({.width = 8, .height = 8}, 4, 16, 9);
    expect_refusal(write_dds(image, 97), "BC7_TYPELESS");
    expect_refusal(write_dds(image, 70), "BC1_TYPELESS");
    expect_refusal(write_dds(image, 45), "DXGI format 45");
    expect_refusal(write_legacy_dds(image, {.flags = kFourCc, .four_cc = four_cc("UYVY")}), "FourCC \"UYVY\"");
    expect_refusal(write_legacy_dds(image, {.flags = kFourCc, .four_cc = 42}), "D3DFORMAT 42");
    expect_refusal(write_legacy_dds(image, {kRgb, 0, 32, {0xF0F, 0xF0, 0xF000, 0}}), "00000f0f");
    expect_refusal(write_legacy_dds(image, {kRgb, 0, 8, {0xF00, 0xF0, 0xF, 0}}), "8 bits");
    expect_refusal(write_legacy_dds(image, {kRgb, 0, 64, {0xFF, 0, 0, 0}}), "64 bits");
    expect_refusal(write_legacy_dds(image, {kRgb, 0, 12, {0xFF, 0, 0, 0}}), "12 bits");
    expect_refusal(write_legacy_dds(image, {kRgb, 0, 32, {0xFFFFFFFF, 0, 0, 0}}), "ffffffff");
    expect_refusal(write_legacy_dds(image, {0, 0, 32, {0xFF, 0xFF00, 0xFF0000, 0}}), "not supported");
}

TEST(Dds, RefusesHeadersThatContradictThemselves) {
    const Bytes good = write_dds(random_image({.width = 8, .height = 8, .levels = 4}, 4, 16, 9), 98);
    const auto with = [&](size_t at, uint32_t value) {
        Bytes bytes = good;
        test_files::put32(bytes, at, value);
        return bytes;
    };
    EXPECT_EQ(refusal(good), "");
    expect_refusal(with(0, 0), "is not a DDS file");
    expect_refusal(with(4, 100), "header of 100 bytes");
    expect_refusal(with(76, 24), "pixel format of 24 bytes");
    expect_refusal(with(16, 0), "width of 0");
    expect_refusal(with(16, 65536), "width of 65536");
    expect_refusal(with(12, 0), "height of 0");
    expect_refusal(with(12, 0xFFFFFFFF), "height of 4294967295");
    expect_refusal(with(28, 5), "5 mip levels");
    expect_refusal(with(28, 0xFFFFFFFF), "at most 4");
    expect_refusal(with(140, 0), "0 array layers");
    expect_refusal(with(140, 0xFFFFFFFF), "array layers");
    expect_refusal(with(140, 2), "truncated");
    expect_refusal(with(132, 2), "resource dimension 2");
    expect_refusal(with(132, 4), "depth of 0");
    EXPECT_EQ(refusal(with(28, 0)), "") << "a mip count of 0 means 1";
    Bytes wide_cube = with(136, 4);
    test_files::put32(wide_cube, 12, 4);
    expect_refusal(wide_cube, "faces are square");
    Bytes faces =
        write_legacy_dds(random_image({.width = 4, .height = 4, .layers = 6, .cube = true}, 4, 8, 1), {kFourCc, four_cc("DXT1"), 0, {}});
    EXPECT_EQ(refusal(faces), "");
    test_files::put32(faces, 112, 0x3E00);
    expect_refusal(faces, "missing faces");
    test_files::put32(faces, 112, 0x20FE00);
    expect_refusal(faces, "cube map and as a volume");
}

TEST(Dds, RefusesEveryTruncation) {
    const Bytes good = write_dds(random_image({.width = 9, .height = 5, .layers = 2, .levels = 3}, 4, 8, 9), 71);
    for (size_t length = 0; length < good.size(); ++length) {
        const std::string message = refusal(Bytes(good.begin(), good.begin() + std::ptrdiff_t(length)));
        ASSERT_NE(message.find(length < 4 ? "is not a DDS file" : "truncated"), std::string::npos)
            << length << " bytes: \"" << message << '"';
    }
    EXPECT_EQ(refusal(good), "");
}

TEST(Dds, RefusesMoreTexelsThanTheLimit) {
    const Bytes bytes = write_dds(random_image({.width = 16, .height = 16}, 1, 4, 9), 28);
    EXPECT_EQ(refusal(bytes, {.max_texture_bytes = 1024}), "");
    EXPECT_NE(refusal(bytes, {.max_texture_bytes = 1023}).find("at most 1023 are allowed"), std::string::npos);
}

}  // namespace
}  // namespace rawtexel::texunit
