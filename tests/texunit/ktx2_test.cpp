#include "tests/texunit/container_writer.h"

#include "texunit/containers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <string>
#include <utility>

namespace rawtexel::texunit {
namespace {

using test_files::Bytes;
using test_files::random_image;
using test_files::StoredImage;

std::unique_ptr<TexelSource> open_bytes(Bytes bytes) { return open_ktx2(open_memory("test.ktx2", std::move(bytes))); }

std::string refusal(Bytes bytes, const ContainerOptions& options = {}) {
    try {
        open_ktx2(open_memory("test.ktx2", std::move(bytes)), options);
    } catch (const TextureError& error) {
        return error.what();
    }
    return "";
}

void expect_refusal(const Bytes& bytes, const std::string& part) {
    const std::string message = refusal(bytes);
    EXPECT_NE(message.find("test.ktx2: "), std::string::npos) << message;
    EXPECT_NE(message.find(part), std::string::npos) << "\"" << message << "\" does not say \"" << part << "\"";
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
}

struct VulkanCase {
    uint32_t code;
    Format format;
};

const VulkanCase kVulkanFormats[] = {
    {9, Format::R8Unorm},      {10, Format::R8Snorm},       {15, Format::R8Srgb},       {16, Format::RG8Unorm},
    {17, Format::RG8Snorm},    {22, Format::RG8Srgb},       {37, Format::RGBA8Unorm},   {38, Format::RGBA8Snorm},
    {43, Format::RGBA8Srgb},   {51, Format::RGBA8Unorm},    {70, Format::R16Unorm},     {76, Format::R16Half},
    {77, Format::RG16Unorm},   {83, Format::RG16Half},      {91, Format::RGBA16Unorm},  {97, Format::RGBA16Half},
    {100, Format::R32Float},   {103, Format::RG32Float},    {109, Format::RGBA32Float}, {131, Format::BC1RgbUnorm},
    {132, Format::BC1RgbSrgb}, {133, Format::BC1RgbaUnorm}, {134, Format::BC1RgbaSrgb}, {135, Format::BC2Unorm},
    {136, Format::BC2Srgb},    {137, Format::BC3Unorm},     {138, Format::BC3Srgb},     {139, Format::BC4Unorm},
    {140, Format::BC4Snorm},   {141, Format::BC5Unorm},     {142, Format::BC5Snorm},    {143, Format::BC6HUfloat},
    {144, Format::BC6HSfloat}, {145, Format::BC7Unorm},     {146, Format::BC7Srgb},
};

const Shape kShapes[] = {
    {.width = 1, .height = 1},
    {.width = 16, .height = 4, .levels = 5},
    {.width = 13, .height = 7, .levels = 4},
    {.width = 9, .height = 6, .layers = 3, .levels = 4},
    {.width = 6, .height = 6, .layers = 6, .levels = 3, .cube = true},
    {.width = 5, .height = 5, .layers = 12, .levels = 2, .cube = true},
    {.width = 7, .height = 10, .depth = 5, .levels = 4},
};

StoredImage image_of(Format format, const Shape& shape, uint64_t seed) {
    return random_image(shape, info(format).block_extent, info(format).bytes_per_block, seed);
}

class Ktx2Schemes : public ::testing::TestWithParam<uint32_t> {};

TEST_P(Ktx2Schemes, HoldEveryFormatInEveryShape) {
    for (const VulkanCase& vulkan : kVulkanFormats) {
        for (const Shape& shape : kShapes) {
            const StoredImage image = image_of(vulkan.format, shape, vulkan.code);
            const auto source = open_bytes(write_ktx2(image, vulkan.code, GetParam()));
            test_files::expect_same_texels(*source, image, vulkan.format);
            if (HasFatalFailure()) return;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(NoneAndZstandard, Ktx2Schemes, ::testing::Values(0u, 2u));

TEST(Ktx2, ReadsLayoutsThatAreNotItsOwn) {
    struct Case {
        uint32_t code, word;
        int bytes;
        double value[4];
    };
    const Case cases[] = {
        {1, 0x36, 1, {0.2, 0.4, 0, 1}},
        {2, 0x369C, 2, {0.2, 0.4, 0.6, 0.8}},
        {3, 0x369C, 2, {0.6, 0.4, 0.2, 0.8}},
        {4, (3u << 11) | (62u << 5) | 17, 2, {3 / 31.0, 62 / 63.0, 17 / 31.0, 1}},
        {5, (3u << 11) | (62u << 5) | 17, 2, {17 / 31.0, 62 / 63.0, 3 / 31.0, 1}},
        {6, (3u << 11) | (30u << 6) | (17u << 1) | 1, 2, {3 / 31.0, 30 / 31.0, 17 / 31.0, 1}},
        {7, (3u << 11) | (30u << 6) | (17u << 1), 2, {17 / 31.0, 30 / 31.0, 3 / 31.0, 0}},
        {8, 0x8000 | (30u << 10) | (7u << 5) | 1, 2, {30 / 31.0, 7 / 31.0, 1 / 31.0, 1}},
        {23, 0x996633, 3, {0.2, 0.4, 0.6, 1}},
        {24, 0x00817F, 3, {1, -1, 0, 1}},
        {30, 0x996633, 3, {0.6, 0.4, 0.2, 1}},
        {44, 0xCC336699, 4, {0.2, 0.4, 0.6, 0.8}},
        {58, (2u << 30) | (1000u << 20) | (33u << 10) | 1, 4, {1000 / 1023.0, 33 / 1023.0, 1 / 1023.0, 2 / 3.0}},
        {64, (2u << 30) | (1000u << 20) | (33u << 10) | 1, 4, {1 / 1023.0, 33 / 1023.0, 1000 / 1023.0, 2 / 3.0}},
        {71, 0x8001, 2, {-1, 0, 0, 1}},
        {78, 0x80007FFF, 4, {1, -1, 0, 1}},
        {122, 0x3C0u | (0x400u << 11) | (0x1A0u << 22), 4, {1, 2, 0.25, 1}},
        {123, 0x100u | (0x80u << 9) | (0x1FFu << 18) | (16u << 27), 4, {1, 0.5, 511 / 256.0, 1}},
        {1000340000, 0x3692, 2, {0.4, 0.6, 2 / 15.0, 0.2}},
    };
    for (const Case& c : cases) {
        StoredImage image{{}, 1, c.bytes, {{Bytes(4)}}};
        test_files::put32(image.slices[0][0], 0, c.word);
        image.slices[0][0].resize(size_t(c.bytes));
        const auto source = open_bytes(write_ktx2(image, c.code));
        std::array<std::byte, 256> texels;
        source->decode_block(0, 0, 0, 0, texels.data());
        const auto value = test_files::decoded_value(source->format(), texels.data(), 0);
        for (size_t i = 0; i < 4; ++i) EXPECT_NEAR(value[i], c.value[i], 0.5 / 65535 + 1e-12) << "VkFormat " << c.code << " channel " << i;
    }
}

TEST(Ktx2, ReadsThreeChannelsAsFourWithAlphaOne) {
    const std::pair<uint32_t, Format> formats[] = {{23, Format::RGBA8Unorm},  {24, Format::RGBA8Snorm}, {29, Format::RGBA8Srgb},
                                                   {84, Format::RGBA16Unorm}, {90, Format::RGBA16Half}, {106, Format::RGBA32Float}};
    for (const auto& [code, format] : formats) {
        const int bytes = info(format).bytes_per_block / 4 * 3;
        const StoredImage image = random_image({.width = 5, .height = 3}, 1, bytes, code);
        const auto source = open_bytes(write_ktx2(image, code));
        ASSERT_EQ(source->format(), format);
        StoredImage four = random_image({.width = 5, .height = 3}, 1, info(format).bytes_per_block, 0);
        const uint32_t one = format == Format::RGBA32Float  ? 0x3F800000
                             : format == Format::RGBA16Half ? 0x3C00
                             : format == Format::RGBA8Snorm ? 0x7F
                                                            : 0xFFFF;
        for (int i = 0; i < 15; ++i) {
            std::byte* const to = four.slices[0][0].data() + i * bytes / 3 * 4;
            std::memcpy(to, image.slices[0][0].data() + i * bytes, size_t(bytes));
            std::memcpy(to + bytes, &one, size_t(bytes / 3));
        }
        for (int x = 0; x < 2; ++x) {
            Bytes got(size_t(16 * bytes_per_texel(layout(format).storage)));
            source->decode_block(0, 0, x, 0, got.data());
            ASSERT_TRUE(got == test_files::expected_block(four, format, 0, 0, x, 0)) << "VkFormat " << code;
        }
    }
}

TEST(Ktx2, RefusesWhatItCannotReadByName) {
    const StoredImage image = random_image({.width = 8, .height = 8}, 4, 16, 9);
    expect_refusal(write_ktx2(image, 146, 1), "BasisLZ");
    expect_refusal(write_ktx2(image, 146, 3), "ZLIB");
    expect_refusal(write_ktx2(image, 146, 77), "scheme 77");
    expect_refusal(write_ktx2(image, 0), "Basis Universal");
    expect_refusal(write_ktx2(image, 157), "ASTC");
    expect_refusal(write_ktx2(image, 147), "ETC2");
    expect_refusal(write_ktx2(image, 5000), "VkFormat 5000");
}

TEST(Ktx2, RefusesHeadersThatContradictThemselves) {
    const Bytes good = write_ktx2(random_image({.width = 8, .height = 8, .levels = 4}, 4, 16, 9), 145);
    const auto with = [&](size_t at, uint32_t value) {
        Bytes bytes = good;
        test_files::put32(bytes, at, value);
        return bytes;
    };
    EXPECT_EQ(refusal(good), "");
    expect_refusal(with(0, 0), "is not a KTX2 file");
    expect_refusal(with(20, 0), "width of 0");
    expect_refusal(with(20, 16385), "width of 16385");
    expect_refusal(with(20, 12), "level 0 has");
    expect_refusal(with(24, 0), "1-D texture");
    expect_refusal(with(28, 0xFFFFFFFF), "depth of 4294967295");
    expect_refusal(with(32, 0xFFFFFFFF), "array layers");
    expect_refusal(with(36, 2), "2 faces");
    expect_refusal(with(36, 0), "0 faces");
    expect_refusal(with(36, 6), "level 0 has");
    expect_refusal(with(40, 5), "5 mip levels");
    expect_refusal(with(48, 0xFFFFFFFF), "data format descriptor");
    expect_refusal(with(60, 0xFFFFFFFF), "key/value data");
    expect_refusal(with(76, 0xFFFFFFFF), "supercompression data");
    expect_refusal(with(84, 0xFFFFFFFF), "level 0 is");
    expect_refusal(with(92, 0xFFFFFFFF), "level 0 is");
    Bytes cube = with(36, 6);
    test_files::put32(cube, 24, 4);
    expect_refusal(cube, "faces are square");
    Bytes volume = with(28, 4);
    test_files::put32(volume, 32, 2);
    expect_refusal(volume, "3-D texture that is an array");
}

TEST(Ktx2, RefusesEveryTruncation) {
    for (const uint32_t scheme : {0u, 2u}) {
        // The last bytes of the file are the largest level's.
        const Bytes good = write_ktx2(random_image({.width = 9, .height = 5, .layers = 2, .levels = 3}, 4, 8, 9), 131, scheme);
        for (size_t length = 0; length < good.size(); ++length) {
            const std::string message = refusal(Bytes(good.begin(), good.begin() + std::ptrdiff_t(length)));
            ASSERT_NE(message.find(length < 12 ? "is not a KTX2 file" : "truncated"), std::string::npos)
                << length << " bytes: \"" << message << '"';
        }
        EXPECT_EQ(refusal(good), "");
    }
}

/// The message of the TextureError of the first block of level 0, which a second reader gets as well; empty when it is sound.
std::string damage(Bytes bytes) {
    const auto source = open_bytes(std::move(bytes));
    Bytes texels(256);
    for (int attempt = 0; attempt < 2; ++attempt) {
        try {
            source->decode_block(0, 0, 0, 0, texels.data());
            return "";
        } catch (const TextureError& error) {
            if (attempt == 1) return error.what();
        }
    }
    return "";
}

TEST(Ktx2, ReportsDamagedZstandardLevelsWhenTheyAreRead) {
    const StoredImage image = random_image({.width = 64, .height = 64}, 1, 4, 9);
    const Bytes good = write_ktx2(image, 37, 2);
    EXPECT_EQ(damage(good), "");
    const size_t offset = 112;  // of the only level: after the header and its index entry, on 16 bytes
    Bytes no_frame = good;
    test_files::put32(no_frame, offset, 0);
    EXPECT_NE(damage(no_frame).find("not a zstd frame"), std::string::npos) << damage(no_frame);
    Bytes garbled = good;
    for (size_t i = offset + 6; i < offset + 12; ++i) garbled[i] ^= std::byte{0x5A};
    EXPECT_NE(damage(garbled).find("level 0 "), std::string::npos) << damage(garbled);
}

TEST(Ktx2, BoundsWhatAFrameMayInflateTo) {
    // A frame of 64 KiB where the header asks for 16 KiB and for 256 KiB.
    const StoredImage image = random_image({.width = 128, .height = 128}, 1, 4, 9);
    Bytes bytes = write_ktx2(image, 37, 2);
    const auto resized = [&](uint32_t extent) {
        Bytes changed = bytes;
        test_files::put32(changed, 20, extent);
        test_files::put32(changed, 24, extent);
        test_files::put32(changed, 96, extent * extent * 4);
        return changed;
    };
    EXPECT_NE(damage(resized(256)).find("inflates to 65536 bytes"), std::string::npos) << damage(resized(256));
    EXPECT_NE(refusal(resized(64)).find("more than zstd makes of"), std::string::npos) << refusal(resized(64));
    // A bomb: the frame is small, what it holds is not.
    StoredImage black = image;
    std::fill(black.slices[0][0].begin(), black.slices[0][0].end(), std::byte{0});
    bytes = write_ktx2(black, 37, 2);
    EXPECT_NE(damage(resized(64)).find("inflates to 65536 bytes"), std::string::npos) << damage(resized(64));
}

TEST(Ktx2, RefusesMoreTexelsThanTheLimit) {
    const Bytes bytes = write_ktx2(random_image({.width = 16, .height = 16}, 1, 4, 9), 37, 2);
    EXPECT_EQ(refusal(bytes, {.max_texture_bytes = 1024}), "");
    EXPECT_NE(refusal(bytes, {.max_texture_bytes = 1023}).find("at most 1023 are allowed"), std::string::npos);
}

}  // namespace
}  // namespace rawtexel::texunit
