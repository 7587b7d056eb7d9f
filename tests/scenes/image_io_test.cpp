// Images in and out: every kind of pixel, limits, damage, and files that appear whole or not at all.
#include "scenes/image_io.h"

#include "scenes/output_file.h"
#include "tests/scenes/gltf_fixture.h"
#include "tests/scenes/png_parts.h"
#include "texunit/memory_source.h"
#include "texunit/srgb.h"
#include "texunit/texture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <thread>
#include <unistd.h>

namespace rawtexel::scenes {
namespace {

using texunit::Format;
using Texel = std::array<float, 4>;

std::unique_ptr<texunit::Texture> texture_of(std::vector<std::byte> encoded, bool srgb) {
    return std::make_unique<texunit::Texture>("image", open_image(texunit::open_memory("image", std::move(encoded)), srgb));
}

/// The message of the InputError that opening throws, "" when there is none.
std::string open_error(std::vector<std::byte> encoded) {
    try {
        open_image(texunit::open_memory("image", std::move(encoded)), false);
        return "";
    } catch (const InputError& error) {
        return error.what();
    }
}

/// The message of the TextureError that the first texel throws, "" when there is none.
std::string pixel_error(std::vector<std::byte> encoded) {
    try {
        texture_of(std::move(encoded), false)->texel(0, 0, 0, 0);
        return "";
    } catch (const texunit::TextureError& error) {
        return error.what();
    }
}

std::vector<std::byte> whole_file(const std::string& path) {
    std::ifstream stream(path, std::ios::binary);
    const std::string text((std::istreambuf_iterator<char>(stream)), {});
    return bytes_of(text);
}

/// Codes of a smooth image, which JPEG keeps nearly as they are.
std::vector<uint8_t> smooth_codes(int width, int height, int channels) {
    std::vector<uint8_t> codes;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < channels; ++c) codes.push_back(uint8_t(40 + 2 * x + 3 * y + 20 * c));
    return codes;
}

TEST(OpenImage, EightBitChannelsBecomeRgba) {
    const std::vector<uint8_t> codes = {10, 20, 30, 40};
    const auto first_texel = [&](int channels, bool srgb) {
        const auto pixels = std::as_bytes(std::span(codes).first(size_t(channels)));
        return texture_of(encode_png(1, 1, channels, 8, pixels), srgb)->texel(0, 0, 0, 0);
    };
    const auto u = [](int code) { return float(code) / 255.0f; };
    const auto s = [](int code) { return texunit::srgb8_table()[code]; };
    EXPECT_EQ(first_texel(1, false), (Texel{u(10), u(10), u(10), 1}));
    EXPECT_EQ(first_texel(2, false), (Texel{u(10), u(10), u(10), u(20)}));
    EXPECT_EQ(first_texel(3, false), (Texel{u(10), u(20), u(30), 1}));
    EXPECT_EQ(first_texel(4, false), (Texel{u(10), u(20), u(30), u(40)}));
    EXPECT_EQ(first_texel(4, true), (Texel{s(10), s(20), s(30), u(40)}));
    EXPECT_EQ(first_texel(2, true), (Texel{s(10), s(10), s(10), u(20)}));
}

TEST(OpenImage, SixteenBitDataKeepsItsCodesAndColourIsDecodedToFloat) {
    std::vector<uint16_t> codes;
    for (int i = 0; i < 256; ++i)
        codes.insert(codes.end(), {uint16_t(i * 257), uint16_t(i * 251 + 3), uint16_t(65535 - i), uint16_t(i * 7)});
    const auto png = encode_png(16, 16, 4, 16, std::as_bytes(std::span(codes)));
    const auto data = texture_of(png, false), colour = texture_of(png, true);
    EXPECT_EQ(data->format(), Format::RGBA16Unorm);
    EXPECT_EQ(colour->format(), Format::RGBA32Float);
    for (int i = 0; i < 256; ++i)
        for (int c = 0; c < 4; ++c) {
            const double code = double(codes[size_t(4 * i + c)]) / 65535.0;
            const size_t channel = size_t(c);
            EXPECT_FLOAT_EQ(data->texel(0, 0, i % 16, i / 16)[channel], float(code)) << i << " " << c;
            const float expected = c == 3 ? float(code) : float(texunit::srgb_to_linear(code));
            EXPECT_FLOAT_EQ(colour->texel(0, 0, i % 16, i / 16)[channel], expected) << i << " " << c;
        }
}

TEST(OpenImage, FloatImagesAreLinearWhateverTheyAreUsedFor) {
    TemporaryFolder folder;
    shading::Image image(3, 2, 3);
    for (size_t i = 0; i < image.values.size(); ++i) image.values[i] = 0.25f * float(i) + 0.125f;
    for (const char* name : {"image.exr", "image.tif"}) {
        write_float(folder / name, image, {}, {});
        for (const bool srgb : {false, true}) {
            texunit::Texture texture(name, open_image(folder / name, srgb));
            EXPECT_EQ(texture.format(), Format::RGBA32Float) << name;
            for (int y = 0; y < 2; ++y)
                for (int x = 0; x < 3; ++x) {
                    const float* p = image.pixel(x, y);
                    EXPECT_EQ(texture.texel(0, 0, x, y), (Texel{p[0], p[1], p[2], 1})) << name << " " << x << " " << y;
                }
        }
    }
}

TEST(OpenImage, TransparentTexelsKeepTheirColour) {
    const std::vector<uint8_t> codes = {200, 100, 50, 0, 200, 100, 50, 1};
    const auto texture = texture_of(encode_png(2, 1, 4, 8, std::as_bytes(std::span(codes))), false);
    for (const int x : {0, 1}) EXPECT_EQ(texture->texel(0, 0, x, 0)[0], 200.0f / 255.0f) << x;
}

TEST(OpenImage, PalettesAndTheirTransparencyAreExpanded) {
    PngParts png;
    png.header(2, 1, 8, 3);
    png.chunk("PLTE", {255, 0, 0, 0, 128, 0});
    png.chunk("tRNS", {255, 64});
    png.pixels({0, 1, 0});  // filter byte, then the indices 1 and 0
    png.end();
    const auto texture = texture_of(png.bytes(), false);
    EXPECT_EQ(texture->texel(0, 0, 0, 0), (Texel{0, 128.0f / 255.0f, 0, 64.0f / 255.0f}));
    EXPECT_EQ(texture->texel(0, 0, 1, 0), (Texel{1, 0, 0, 1}));
}

TEST(OpenImage, GammaAndProfilesPlayNoPartAndAreNotComplainedOf) {
    PngParts png;
    png.header(1, 1, 8, 2);
    png.chunk("gAMA", {0, 0, 0x80, 0});
    png.chunk("iCCP", {'x', 0, 0, 1, 2, 3});  // no profile at all
    png.pixels({0, 100, 150, 200});
    png.end();
    testing::internal::CaptureStderr();
    const auto texel = texture_of(png.bytes(), false)->texel(0, 0, 0, 0);
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    EXPECT_EQ(texel, (Texel{100.0f / 255.0f, 150.0f / 255.0f, 200.0f / 255.0f, 1}));
}

TEST(OpenImage, ExtentsOutsideTheLimitsAreRefusedAtOnce) {
    const auto with_extents = [](uint32_t width, uint32_t height) {
        PngParts png;
        png.header(width, height, 8, 0);
        png.chunk("IDAT", std::vector<uint8_t>(64));
        return open_error(png.bytes());
    };
    testing::internal::CaptureStderr();
    EXPECT_TRUE(says(with_extents(65536, 1), "image of 65536 x 1 pixels (allowed are 1 to 16384"));
    EXPECT_TRUE(says(with_extents(1, 16385), "image of 1 x 16385 pixels"));
    EXPECT_EQ(with_extents(16384, 1), "");
    EXPECT_NE(with_extents(0, 4), "");
    EXPECT_NE(with_extents(4, 0), "");
    EXPECT_TRUE(says(with_extents(16384, 16384), "truncated image"));  // 268 million pixels in a hundred bytes
    EXPECT_NE(with_extents(0xffffffff, 1), "");
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(OpenImage, WhatIsNoImageIsRefusedWithOneLine) {
    for (const char* text :
         {"", "x", "this is a text", "\x89PNG\r\n\x1a\n", "\xff\xd8\xff", "BM", "#?RADIANCE\n", "P6 nonsense", "\x76\x2f\x31\x01"}) {
        testing::internal::CaptureStderr();
        const std::string message = open_error(bytes_of(text));
        EXPECT_EQ(testing::internal::GetCapturedStderr(), "") << text;
        EXPECT_TRUE(says(message, "image: ")) << text;
        EXPECT_EQ(message.find('\n'), message.npos) << message;
    }
}

TEST(OpenImage, MissingFilesFoldersAndEmptyFilesAreNamed) {
    TemporaryFolder folder;
    for (const std::string& path : {folder / "none.png", folder.path(), folder.write("empty.png", "")}) {
        try {
            open_image(path, false);
            ADD_FAILURE() << path;
        } catch (const InputError& error) {
            EXPECT_TRUE(says(error.what(), path));
        }
    }
}

TEST(OpenImage, PngCutOffAnywhereIsAnErrorAtOnceOrWhenSampled) {
    const std::vector<std::byte> png = test_png(16, 16);
    testing::internal::CaptureStderr();
    for (size_t length = 0; length < png.size(); ++length) {
        const std::vector<std::byte> cut(png.begin(), png.begin() + std::ptrdiff_t(length));
        if (open_error(cut).empty()) {
            EXPECT_TRUE(says(pixel_error(cut), "damaged PNG")) << length;
        }
    }
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(OpenImage, ChangedPngBytesAreFoundByTheirChecksums) {
    const std::vector<std::byte> png = test_png(16, 16);
    testing::internal::CaptureStderr();
    for (size_t at = 0; at < png.size(); ++at) {
        std::vector<std::byte> changed = png;
        changed[at] ^= std::byte{0x10};
        EXPECT_FALSE(open_error(changed).empty() && pixel_error(changed).empty()) << at;
    }
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(OpenImage, JpegCutOffAnywhereIsAnErrorAtOnceOrWhenSampled) {
    TemporaryFolder folder;
    write_8bit(folder / "image.jpg", 32, 32, 3, smooth_codes(32, 32, 3), {});
    const std::vector<std::byte> jpeg = whole_file(folder / "image.jpg");
    EXPECT_EQ(pixel_error(jpeg), "");
    testing::internal::CaptureStderr();
    for (size_t length = 0; length + 2 <= jpeg.size(); length += 5) {
        const std::vector<std::byte> cut(jpeg.begin(), jpeg.begin() + std::ptrdiff_t(length));
        if (open_error(cut).empty()) {
            EXPECT_TRUE(says(pixel_error(cut), "damaged image")) << length;
        }
    }
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(OpenImage, CutOffFloatImagesAreErrors) {
    TemporaryFolder folder;
    const shading::Image image(40, 40, 3);
    for (const char* name : {"image.exr", "image.hdr", "image.tif"}) {
        write_float(folder / name, image, {}, {});
        std::vector<std::byte> bytes = whole_file(folder / name);
        bytes.resize(bytes.size() * 2 / 3);
        EXPECT_FALSE(open_error(bytes).empty() && pixel_error(bytes).empty()) << name;
    }
}

TEST(OpenImage, ManyThreadsReadTheSameTexelsAndDecodeOnce) {
    const auto texture = texture_of(test_png(64, 64), false);
    std::vector<std::thread> threads;
    std::array<std::vector<Texel>, 8> seen;
    for (auto& texels : seen)
        threads.emplace_back([&] {
            for (int i = 0; i < 64 * 64; ++i) texels.push_back(texture->texel(0, 0, i % 64, i / 64));
        });
    for (std::thread& thread : threads) thread.join();
    for (const auto& texels : seen) EXPECT_EQ(texels, seen[0]);
}

TEST(OpenImage, DamageIsReportedToEveryThreadAndEveryBlock) {
    std::vector<std::byte> png = test_png(64, 64);
    png.resize(png.size() - 30);
    const auto texture = texture_of(png, false);
    std::array<int, 8> errors{};
    std::vector<std::thread> threads;
    for (int& count : errors)
        threads.emplace_back([&count, &texture] {
            for (int block = 0; block < 16; ++block) try {
                    texture->texel(0, 0, 4 * block, 4 * block);
                } catch (const texunit::TextureError&) {
                    ++count;
                }
        });
    for (std::thread& thread : threads) thread.join();
    for (const int count : errors) EXPECT_EQ(count, 16);
}

TEST(ReadImage, KeepsItsChannelsAndDecodesColourButNotAlpha) {
    TemporaryFolder folder;
    const std::vector<uint8_t> codes = {10, 20, 30, 40, 50, 60, 70, 80};
    for (int channels = 1; channels <= 4; ++channels) {
        const int width = 8 / channels;
        const auto used = std::span(codes).first(size_t(width * channels));
        write_8bit(folder / "image.png", width, 1, channels, used, {});
        const shading::Image encoded = read_image(folder / "image.png", false), linear = read_image(folder / "image.png", true);
        ASSERT_EQ(encoded.channels, channels);
        ASSERT_EQ(encoded.width, width);
        for (size_t i = 0; i < used.size(); ++i) {
            const bool alpha = channels % 2 == 0 && int(i % size_t(channels)) == channels - 1;
            EXPECT_EQ(encoded.values[i], float(used[i]) / 255.0f) << channels << " " << i;
            EXPECT_EQ(linear.values[i], alpha ? float(used[i]) / 255.0f : texunit::srgb8_table()[used[i]]) << channels << " " << i;
        }
    }
}

TEST(ReadImage, DamageIsAnInputError) {
    TemporaryFolder folder;
    std::vector<std::byte> png = test_png(32, 32);
    png.resize(png.size() - 20);
    const std::string path = folder.write("cut.png", png);
    EXPECT_THROW(read_image(path, false), InputError);
    EXPECT_THROW(read_image(folder / "none.hdr", false), InputError);
}

TEST(ReadImage, FilesAreWhatTheirNamesSay) {
    const TemporaryFolder folder;
    const shading::Image image(4, 2, 3);
    write_float(folder / "image.exr", image, {}, {});
    std::filesystem::rename(folder / "image.exr", folder / "claims.hdr");
    std::string message;
    try {
        read_image(folder / "claims.hdr", false);
    } catch (const InputError& error) {
        message = error.what();
    }
    EXPECT_EQ(message, folder / "claims.hdr" + ": is OpenEXR (declared: .hdr, which is Radiance HDR)");
    std::filesystem::rename(folder / "claims.hdr", folder / "claims.nothing");
    EXPECT_EQ(read_image(folder / "claims.nothing", false).width, 4);
}

TEST(WriteImage, EightBitFilesComeBackAsTheyWere) {
    TemporaryFolder folder;
    for (const char* name : {"a.png", "a.tif", "a.bmp"}) {
        const std::vector<uint8_t> codes = smooth_codes(7, 5, 3);
        write_8bit(folder / name, 7, 5, 3, codes, {});
        const shading::Image image = read_image(folder / name, false);
        ASSERT_EQ(image.values.size(), codes.size()) << name;
        for (size_t i = 0; i < codes.size(); ++i) EXPECT_EQ(image.values[i], float(codes[i]) / 255.0f) << name << " " << i;
    }
}

TEST(WriteImage, JpegIsCloseAndDropsAlpha) {
    TemporaryFolder folder;
    const std::vector<uint8_t> codes = smooth_codes(16, 16, 4);
    write_8bit(folder / "a.jpg", 16, 16, 4, codes, {});
    const shading::Image image = read_image(folder / "a.jpg", false);
    ASSERT_EQ(image.channels, 3);
    for (int i = 0; i < 256; ++i)
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(image.values[size_t(3 * i + c)] * 255.0f, codes[size_t(4 * i + c)], 4.0f) << i << " " << c;
}

TEST(WriteImage, FloatFilesComeBackAsTheyWere) {
    TemporaryFolder folder;
    shading::Image image(5, 3, 4);
    for (size_t i = 0; i < image.values.size(); ++i) image.values[i] = 100.0f / float(i + 1) - 3.0f;
    for (const char* name : {"a.exr", "a.tif"}) {
        write_float(folder / name, image, {}, {});
        const shading::Image back = read_image(folder / name, true);
        EXPECT_EQ(back.channels, 4) << name;
        EXPECT_EQ(back.values, image.values) << name;
    }
}

TEST(WriteImage, RadianceFilesKeepColourToTheirPrecision) {
    TemporaryFolder folder;
    shading::Image image(9, 4, 4);
    for (size_t i = 0; i < image.values.size(); ++i) image.values[i] = 0.5f + 0.01f * float(i);
    write_float(folder / "a.hdr", image, {}, {});
    const shading::Image back = read_image(folder / "a.hdr", true);
    ASSERT_EQ(back.channels, 3);
    for (int i = 0; i < 36; ++i)
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(back.values[size_t(3 * i + c)], image.values[size_t(4 * i + c)], 0.01f) << i << " " << c;
}

TEST(WriteImage, LayersStandInOneOpenExrFileUnderTheirNames) {
    TemporaryFolder folder;
    const shading::Image image(4, 4, 3);
    shading::Layer depth{"depth", {"Z"}, shading::Image(4, 4, 1)}, normal{"normal", {"X", "Y", "Z"}, shading::Image(4, 4, 3)};
    std::ranges::fill(depth.image.values, 7.5f);
    const std::vector<shading::Layer> layers = {depth, normal};
    write_float(folder / "a.exr", image, layers, {});
    const shading::Image back = read_image(folder / "a.exr", false);
    EXPECT_EQ(back.channels, 7);
    EXPECT_EQ(std::ranges::count(back.values, 7.5f), 16);
    const auto bytes = whole_file(folder / "a.exr");
    const std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    for (const char* channel : {"depth.Z", "normal.X", "normal.Y", "normal.Z"}) EXPECT_NE(text.find(channel), text.npos) << channel;
    EXPECT_THROW(write_float(folder / "a.hdr", image, layers, {}), OutputError);
}

TEST(WriteImage, MetadataStandsInTheFile) {
    TemporaryFolder folder;
    const Metadata metadata = {{"Software", "rawtexel 9.9"}, {"rawtexel:command", "render plane -o x.png"}, {"rawtexel:spp", "64"}};
    write_8bit(folder / "a.png", 2, 2, 3, std::vector<uint8_t>(12), metadata);
    write_float(folder / "a.exr", shading::Image(2, 2, 3), {}, metadata);
    for (const char* name : {"a.png", "a.exr"}) {
        const auto bytes = whole_file(folder / name);
        const std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
        for (const auto& [key, value] : metadata) EXPECT_NE(text.find(value), text.npos) << name << " " << key;
        EXPECT_NE(text.find("rawtexel:spp"), text.npos) << name;
    }
}

TEST(WriteImage, WhatCannotBeWrittenIsOneLineAndLeavesNothing) {
    TemporaryFolder folder;
    const std::vector<uint8_t> codes(12);
    const auto error = [&](const std::string& path) -> std::string {
        try {
            write_8bit(path, 2, 2, 3, codes, {});
            return "";
        } catch (const OutputError& failure) {
            return failure.what();
        }
    };
    EXPECT_TRUE(says(error(folder / "none/a.png"), folder / "none/a.png" + ": cannot be written"));
    EXPECT_TRUE(says(error(folder / "a.unknown"), "no image format goes with this name"));
    EXPECT_TRUE(says(error(folder / "png"), "no image format goes with this name"));
    std::vector<std::string> before = folder.entries();
    EXPECT_TRUE(before.empty());
    folder.write("taken.png/inside", "x");
    EXPECT_TRUE(says(error(folder / "taken.png"), "cannot be written"));
    EXPECT_EQ(folder.entries(), std::vector<std::string>{"taken.png"});
    EXPECT_NE(error("/proc/rawtexel-test.png"), "");
}

TEST(WriteImage, ReadOnlyFoldersAreRefused) {
    if (::geteuid() == 0) GTEST_SKIP() << "the superuser may write everywhere";
    TemporaryFolder folder;
    std::filesystem::permissions(folder.path(), std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
    EXPECT_THROW(write_8bit(folder / "a.png", 2, 2, 3, std::vector<uint8_t>(12), {}), OutputError);
    std::filesystem::permissions(folder.path(), std::filesystem::perms::owner_all);
    EXPECT_TRUE(folder.entries().empty());
}

TEST(WriteImage, FilesAreReplacedWholeAndNothingElseIsLeft) {
    TemporaryFolder folder;
    folder.write("a.png", "what was there before");
    write_8bit(folder / "a.png", 2, 2, 3, std::vector<uint8_t>(12, 5), {});
    EXPECT_EQ(read_image(folder / "a.png", false).values, std::vector<float>(12, 5.0f / 255.0f));
    EXPECT_EQ(folder.entries(), std::vector<std::string>{"a.png"});
}

TEST(EncodePng, HoldsEveryChannelCountAndDepth) {
    for (int channels = 1; channels <= 4; ++channels)
        for (const int bits : {8, 16}) {
            std::vector<std::byte> pixels(size_t(3 * 2 * channels * bits / 8));
            for (size_t i = 0; i < pixels.size(); ++i) pixels[i] = std::byte(i * 31 & 0xff);
            const auto texture = texture_of(encode_png(3, 2, channels, bits, pixels), false);
            EXPECT_EQ(texture->shape().width, 3);
            EXPECT_EQ(texture->shape().height, 2);
            uint16_t code = uint16_t(pixels[0]);
            if (bits == 16) std::memcpy(&code, pixels.data(), 2);
            EXPECT_FLOAT_EQ(texture->texel(0, 0, 0, 0)[0], float(code) / (bits == 8 ? 255.0f : 65535.0f)) << channels << " " << bits;
        }
}

TEST(Formats, AreToldByTheExtension) {
    for (const char* name : {"a.exr", "b/c.HDR", "x.tif", "x.tiff", "x.pfm"}) EXPECT_TRUE(is_float_format(name)) << name;
    for (const char* name : {"a.png", "a.jpg", "exr", "a.exr/b", ""}) EXPECT_FALSE(is_float_format(name)) << name;
    for (const char* name : {"a.png", "a.jpg", "a.jpeg", "a.exr", "a.hdr", "a.tif", "a.bmp", "a.ppm"})
        EXPECT_TRUE(is_writable_format(name)) << name;
    for (const char* name : {"a.xyz", "a", "png", "", "a.glb", "a.pfm"}) EXPECT_FALSE(is_writable_format(name)) << name;
    for (const char* name : {"a.png", "a.EXR", "a.tif", "a.tga"}) EXPECT_TRUE(stores_alpha(name)) << name;
    for (const char* name : {"a.jpg", "a.hdr", "a.ppm", "a.pfm", "a"}) EXPECT_FALSE(stores_alpha(name)) << name;
}

}  // namespace
}  // namespace rawtexel::scenes
