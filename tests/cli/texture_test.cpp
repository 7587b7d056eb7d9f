// What is inside texture files, and their texels as images.
#include "cli/command.h"
#include "scenes/image_io.h"
#include "tests/cli/program_runner.h"
#include "tests/cli/texture_files.h"
#include "texunit/srgb.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

namespace rawtexel::cli {
namespace {

using test::code_of;
using test::FileFormat;
using test::run;
using test::TemporaryFolder;
using test::why_not_failed;
using Json = nlohmann::json;

Json info(const std::string& texture, const std::vector<std::string>& more = {}) {
    std::vector<std::string> words{"texture", "info", texture, "--json"};
    words.insert(words.end(), more.begin(), more.end());
    const test::Outcome outcome = run(words);
    EXPECT_EQ(outcome.code, kDone) << outcome.err;
    return Json::parse(outcome.out);
}

/// The image that decode writes, as codes from 0 to 1 or as floats.
shading::Image decoded(const std::string& texture, const std::string& image, const std::vector<std::string>& more = {}) {
    std::vector<std::string> words{"texture", "decode", texture, "-o", image};
    words.insert(words.end(), more.begin(), more.end());
    const test::Outcome outcome = run(words);
    EXPECT_EQ(outcome.code, kDone) << outcome.err;
    EXPECT_EQ(outcome.out, "Saved: " + image + "\n");
    return scenes::read_image(image, false);
}

int code(const shading::Image& image, int x, int y, int c) { return int(std::lround(image.pixel(x, y)[c] * 255.0f)); }

/// Every pixel of `image` is the texel of that level and slice of a file of test::write_dds.
void expect_codes(const shading::Image& image, int level, int slice) {
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int c = 0; c < image.channels; ++c)
                ASSERT_EQ(code(image, x, y, c), code_of(level, slice, x, y, c)) << "texel " << x << ',' << y << " channel " << c;
}

TEST(TextureInfo, TellsWhatTheFileHolds) {
    const TemporaryFolder folder;
    const texunit::Shape shape{.width = 13, .height = 6, .layers = 2, .levels = 3};
    const Json array = info(test::write_dds(folder, "array.dds", shape, FileFormat::Rgba8Srgb));
    EXPECT_EQ(array["container"], "dds");
    EXPECT_EQ(array["format"], "rgba8-srgb");
    EXPECT_EQ(array["color_space"], "srgb");
    EXPECT_EQ(array["width"], 13);
    EXPECT_EQ(array["height"], 6);
    EXPECT_EQ(array["depth"], 1);
    EXPECT_EQ(array["layers"], 2);
    EXPECT_EQ(array["faces"], 1);
    EXPECT_EQ(array["levels"], 3);
    EXPECT_EQ(array["levels_full"], 4);
    EXPECT_EQ(array["stored_bytes"], 2 * 4 * (13 * 6 + 6 * 3 + 3 * 1));
    EXPECT_EQ(array["file_bytes"], 148 + int(array["stored_bytes"]));
    EXPECT_EQ(array["per_level"][1], Json({{"level", 1}, {"width", 6}, {"height", 3}, {"depth", 1}, {"bytes", 2 * 4 * 6 * 3}}));

    const Json blocks = info(test::write_dds(folder, "bc1.dds", shape, FileFormat::Bc1Unorm));
    EXPECT_EQ(blocks["format"], "bc1-rgba-unorm");
    EXPECT_EQ(blocks["color_space"], "linear");
    EXPECT_EQ(blocks["per_level"][0]["bytes"], 2 * 8 * 4 * 2);
    EXPECT_EQ(blocks["per_level"][2]["bytes"], 2 * 8);

    const texunit::Shape cubes{.width = 8, .height = 8, .layers = 12, .levels = 1, .cube = true};
    const Json cube = info(test::write_dds(folder, "cube.dds", cubes, FileFormat::R8Unorm));
    EXPECT_EQ(cube["layers"], 2);
    EXPECT_EQ(cube["faces"], 6);
    EXPECT_EQ(cube["stored_bytes"], 12 * 64);

    const texunit::Shape deep{.width = 8, .height = 8, .depth = 5, .levels = 2};
    const Json volume = info(test::write_dds(folder, "volume.dds", deep, FileFormat::Rgba32Float));
    EXPECT_EQ(volume["depth"], 5);
    EXPECT_EQ(volume["per_level"][1], Json({{"level", 1}, {"width", 4}, {"height", 4}, {"depth", 2}, {"bytes", 16 * 4 * 4 * 2}}));
}

TEST(TextureInfo, ImagesDoNotDeclareAColorSpace) {
    const TemporaryFolder folder;
    scenes::write_8bit(folder / "a.png", 4, 2, 3, std::vector<uint8_t>(24, 9), {});
    const Json silent = info(folder / "a.png");
    EXPECT_EQ(silent["container"], "image");
    EXPECT_TRUE(silent["color_space"].is_null());
    EXPECT_EQ(silent["format"], "rgba8-unorm");
    EXPECT_EQ(info(folder / "a.png", {"--color-space", "srgb"})["color_space"], "srgb");
    EXPECT_EQ(info(folder / "a.png", {"--color-space", "linear"})["color_space"], "linear");
}

TEST(TextureInfo, IsReadableToo) {
    const TemporaryFolder folder;
    const texunit::Shape shape{.width = 8, .height = 8, .layers = 6, .levels = 2, .cube = true};
    const test::Outcome outcome = run({"texture", "info", test::write_dds(folder, "cube.dds", shape, FileFormat::Bc1Unorm)});
    EXPECT_EQ(outcome.code, kDone);
    for (const char* part : {"cube.dds: dds, 388 bytes", "bc1-rgba-unorm: colour", "linear", "8x8, a cube map of 6 faces",
                             "2 in the file, 4 in a full pyramid", "240 bytes", "4x4"})
        EXPECT_NE(outcome.out.find(part), std::string::npos) << part << " in\n" << outcome.out;
}

TEST(TextureDecode, GivesBackTheBitsOfAnImage) {
    const TemporaryFolder folder;
    std::vector<uint8_t> codes;
    for (int i = 0; i < 64 * 64; ++i)
        for (int c = 0; c < 4; ++c) codes.push_back(c == 0 ? uint8_t(i) : code_of(0, 0, i, 0, c));
    scenes::write_8bit(folder / "in.png", 64, 64, 4, codes, {});
    for (const std::string color_space : {"linear", "srgb"}) {
        const shading::Image out = decoded(folder / "in.png", folder / "out.png", {"--color-space", color_space});
        ASSERT_EQ(out.channels, 4);
        for (size_t i = 0; i < codes.size(); ++i)
            ASSERT_EQ(int(std::lround(out.values[i] * 255.0f)), codes[i]) << color_space << ", sample " << i;
    }
}

TEST(TextureDecode, FindsEveryLevelLayerFaceAndSlice) {
    const TemporaryFolder folder;
    const std::string image = folder / "out.png";
    const std::string array = test::write_dds(folder, "a.dds", {.width = 9, .height = 5, .layers = 3, .levels = 4}, FileFormat::Rgba8Unorm);
    expect_codes(decoded(array, image), 0, 0);
    expect_codes(decoded(array, image, {"--level", "2", "--layer", "1"}), 2, 1);
    expect_codes(decoded(array, image, {"--layer", "2"}), 0, 2);
    EXPECT_EQ(decoded(array, image, {"--level", "1"}).width, 4);

    const texunit::Shape cubes{.width = 4, .height = 4, .layers = 12, .levels = 2, .cube = true};
    const std::string cube = test::write_dds(folder, "c.dds", cubes, FileFormat::Rgba8Srgb);
    expect_codes(decoded(cube, image, {"--face", "5"}), 0, 5);
    expect_codes(decoded(cube, image, {"--face", "2", "--layer", "1", "--level", "1"}), 1, 8);

    const std::string volume = test::write_dds(folder, "v.dds", {.width = 8, .height = 4, .depth = 6, .levels = 3}, FileFormat::Rgba8Unorm);
    expect_codes(decoded(volume, image, {"--slice", "4"}), 0, 4);
    expect_codes(decoded(volume, image, {"--slice", "2", "--level", "1"}), 1, 1);
    // The last slice of an odd level has no coarser one of its own.
    expect_codes(decoded(volume, image, {"--slice", "5", "--level", "2"}), 2, 0);
}

TEST(TextureDecode, MakesLevelsThatTheFileLacks) {
    const TemporaryFolder folder;
    scenes::write_8bit(folder / "in.png", 2, 2, 1, std::vector<uint8_t>{10, 20, 30, 41}, {});
    // The mean is 25.25: rounded as the source's own codes, or kept.
    EXPECT_EQ(code(decoded(folder / "in.png", folder / "out.png", {"--level", "1"}), 0, 0, 0), 25);
    EXPECT_EQ(decoded(folder / "in.png", folder / "out.exr", {"--level", "1"}).values[0], float(25 / 255.0));
    EXPECT_EQ(decoded(folder / "in.png", folder / "out.exr", {"--level", "1", "--mip-storage", "float"}).values[0], float(25.25 / 255));
    EXPECT_EQ(code(decoded(folder / "in.png", folder / "out.png", {"--level", "1", "--color-space", "srgb"}), 0, 0, 0),
              texunit::encode_srgb8(float((texunit::srgb_to_linear(10 / 255.0) + texunit::srgb_to_linear(20 / 255.0) +
                                           texunit::srgb_to_linear(30 / 255.0) + texunit::srgb_to_linear(41 / 255.0)) /
                                          4)));
}

TEST(TextureDecode, GivesFloatFormatsLinearValues) {
    const TemporaryFolder folder;
    const std::string floats = test::write_dds(folder, "f.dds", {.width = 5, .height = 3}, FileFormat::Rgba32Float);
    const shading::Image image = decoded(floats, folder / "out.exr");
    ASSERT_EQ(image.channels, 4);
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 5; ++x)
            for (int c = 0; c < 4; ++c) ASSERT_EQ(image.pixel(x, y)[c], float(code_of(0, 0, x, y, c)) / 255.0f) << x << ',' << y;
    const std::string srgb = test::write_dds(folder, "s.dds", {.width = 5, .height = 3}, FileFormat::Rgba8Srgb);
    EXPECT_EQ(decoded(srgb, folder / "out.exr").pixel(3, 2)[1], float(texunit::srgb_to_linear(code_of(0, 0, 3, 2, 1) / 255.0)));
    // Signed values too.
    const std::string snorm = test::write_dds(folder, "n.dds", {.width = 5, .height = 3}, FileFormat::Rgba8Snorm);
    EXPECT_EQ(decoded(snorm, folder / "out.exr").pixel(2, 1)[0], float(std::max(int8_t(code_of(0, 0, 2, 1, 0)) / 127.0, -1.0)));
}

TEST(TextureDecode, WritesSignAndAlphaOfFloatsOrRefuses) {
    const TemporaryFolder folder;
    const texunit::Shape shape{.width = 5, .height = 3};
    const std::string snorm = test::write_dds(folder, "n.dds", shape, FileFormat::Rgba8Snorm);
    const std::string floats = test::write_dds(folder, "f.dds", shape, FileFormat::Rgba32Float);
    for (const std::string& texture : {snorm, floats}) {
        const shading::Image exr = decoded(texture, folder / "o.exr"), tif = decoded(texture, folder / "o.tif");
        EXPECT_EQ(exr.channels, 4);
        EXPECT_EQ(tif.channels, 4);
        EXPECT_EQ(tif.values, exr.values) << texture;
        for (const char* name : {"o.hdr", "o.rgbe"})
            EXPECT_EQ(why_not_failed(run({"texture", "decode", texture, "-o", folder / name}), kWrongUsage, "a format that can is '.exr'"),
                      "");
    }
    const shading::Image negative = decoded(snorm, folder / "o.tif");
    EXPECT_LT(std::ranges::min(negative.values), 0.0f);
    EXPECT_EQ(folder.entries(), (std::vector<std::string>{"f.dds", "n.dds", "o.exr", "o.tif"}));
}

/// What decode or mips says on stderr.
std::string warned(const std::string& action, const std::string& texture, const std::string& image) {
    const test::Outcome outcome = run({"texture", action, texture, "-o", image});
    EXPECT_EQ(outcome.code, kDone) << outcome.err;
    return outcome.err;
}

TEST(TextureDecode, WarnsInOneLineOfAlphaThatIsLost) {
    const TemporaryFolder folder;
    const std::string texture = test::write_dds(folder, "t.dds", {.width = 4, .height = 4}, FileFormat::Rgba8Unorm);
    for (const char* action : {"decode", "mips"})
        for (const char* name : {"o.jpg", "o.hdr", "o.ppm"})
            EXPECT_EQ(
                warned(action, texture, folder / name),
                "rawtexel: warning: " + (folder / name) + ": the format has no alpha, which the texels have; one that does is '.png'\n");
    for (const char* name : {"o.png", "o.tif", "o.exr", "o.tga", "o.webp"}) EXPECT_EQ(warned("decode", texture, folder / name), "");
    // Nothing is lost of what is opaque.
    const std::string two = test::write_dds(folder, "2.dds", {.width = 4, .height = 4}, FileFormat::Rg8Unorm);
    scenes::write_8bit(folder / "opaque.png", 2, 2, 3, std::vector<uint8_t>(12, 100), {});
    for (const std::string& opaque : {two, folder / "opaque.png"}) EXPECT_EQ(warned("mips", opaque, folder / "o.jpg"), "");
}

TEST(TextureDecode, PngHolds16BitCodes) {
    const TemporaryFolder folder;
    const std::string wide = test::write_dds(folder, "w.dds", {.width = 6, .height = 6}, FileFormat::Rgba16Unorm);
    const shading::Image png = decoded(wide, folder / "out.png"), bmp = decoded(wide, folder / "out.bmp");
    for (int y = 0; y < 6; ++y)
        for (int x = 0; x < 6; ++x)
            for (int c = 0; c < 3; ++c) {
                const int wide_code = test::wide_code_of(0, 0, x, y, c);
                ASSERT_EQ(std::lround(png.pixel(x, y)[c] * 65535.0f), wide_code) << x << ',' << y;
                ASSERT_EQ(code(bmp, x, y, c), std::lround(wide_code / 257.0)) << x << ',' << y;
            }
}

TEST(TextureDecode, OneChannelIsGreyAndTwoAreRedAndGreen) {
    const TemporaryFolder folder;
    const std::string one = test::write_dds(folder, "1.dds", {.width = 4, .height = 4}, FileFormat::R8Unorm);
    EXPECT_EQ(decoded(one, folder / "1.png").channels, 1);
    expect_codes(scenes::read_image(folder / "1.png", false), 0, 0);
    const shading::Image two = decoded(test::write_dds(folder, "2.dds", {.width = 4, .height = 4}, FileFormat::Rg8Unorm), folder / "2.png");
    ASSERT_EQ(two.channels, 3);
    EXPECT_EQ(code(two, 2, 3, 0), code_of(0, 0, 2, 3, 0));
    EXPECT_EQ(code(two, 2, 3, 1), code_of(0, 0, 2, 3, 1));
    EXPECT_EQ(code(two, 2, 3, 2), 0);
}

TEST(TextureMips, WritesOneImageALevel) {
    const TemporaryFolder folder;
    const std::string array = test::write_dds(folder, "a.dds", {.width = 9, .height = 5, .layers = 2, .levels = 2}, FileFormat::Rgba8Unorm);
    const test::Outcome outcome = run({"texture", "mips", array, "-o", folder / "m.png", "--layer", "1"});
    ASSERT_EQ(outcome.code, kDone) << outcome.err;
    EXPECT_EQ(folder.entries(), (std::vector<std::string>{"a.dds", "m.level0.png", "m.level1.png", "m.level2.png", "m.level3.png"}));
    expect_codes(scenes::read_image(folder / "m.level0.png", false), 0, 1);
    expect_codes(scenes::read_image(folder / "m.level1.png", false), 1, 1);
    const shading::Image made = scenes::read_image(folder / "m.level2.png", false);
    ASSERT_EQ(made.width * made.height, 2);
    for (int x = 0; x < 2; ++x) {
        double sum = 0;
        for (int i = 0; i < 4; ++i) sum += code_of(1, 1, 2 * x + i % 2, i / 2, 0);
        EXPECT_EQ(code(made, x, 0, 0), int(std::floor(sum / 4 + 0.5)));
    }
    const std::string volume = test::write_dds(folder, "v.dds", {.width = 4, .height = 4, .depth = 8, .levels = 4}, FileFormat::Rgba8Unorm);
    ASSERT_EQ(run({"texture", "mips", volume, "-o", folder / "v.png", "--slice", "7"}).code, kDone);
    for (int level = 0; level < 4; ++level)
        expect_codes(scenes::read_image(folder / ("v.level" + std::to_string(level) + ".png"), false), level, 7 >> level);
}

TEST(TextureMips, TellsWhatAChosenLayerMeans) {
    EXPECT_NE(run({"texture", "--help"}).out.find("mips writes every level of that layer, face or slice"), std::string::npos);
}

TEST(TextureMips, WritesTheWholePyramidIntoOneDds) {
    const TemporaryFolder folder;
    scenes::write_8bit(folder / "in.png", 3, 3, 4, std::vector<uint8_t>(36, 100), {});
    const std::string cube =
        test::write_dds(folder, "cube.dds", {.width = 8, .height = 8, .layers = 6, .cube = true}, FileFormat::Rgba8Unorm);
    const test::Outcome outcome = run({"texture", "mips", cube, "-o", folder / "all.dds"});
    ASSERT_EQ(outcome.code, kDone) << outcome.err;
    EXPECT_EQ(outcome.out, "Saved: " + (folder / "all.dds") + "\n");
    const Json told = info(folder / "all.dds");
    EXPECT_EQ(told["levels"], 4);
    EXPECT_EQ(told["faces"], 6);
    expect_codes(decoded(folder / "all.dds", folder / "o.png", {"--face", "4"}), 0, 4);
    const shading::PixelValues made = decoded(cube, folder / "o.exr", {"--face", "4", "--level", "2"}).values;
    EXPECT_EQ(decoded(folder / "all.dds", folder / "o.exr", {"--face", "4", "--level", "2"}).values, made);
    ASSERT_EQ(run({"texture", "mips", folder / "in.png", "-o", folder / "srgb.dds", "--color-space", "srgb"}).code, kDone);
    EXPECT_EQ(info(folder / "srgb.dds")["format"], "rgba8-srgb");
}

TEST(TextureCommand, WrongUsageIsExitCode2) {
    const TemporaryFolder folder;
    const std::string flat = test::write_dds(folder, "t.dds", {.width = 4, .height = 4}, FileFormat::Rgba8Unorm);
    const std::string floats = test::write_dds(folder, "f.dds", {.width = 4, .height = 4}, FileFormat::Rgba32Float);
    const std::string snorm = test::write_dds(folder, "n.dds", {.width = 4, .height = 4}, FileFormat::Rgba8Snorm);
    const std::string out = folder / "o.png";
    const std::initializer_list<std::pair<std::vector<std::string>, const char*>> cases{
        {{"texture"}, "missing argument"},
        {{"texture", "info"}, "missing argument"},
        {{"texture", "inof", flat}, "the nearest is 'info'"},
        {{"texture", "info", flat, "-o", out}, "texture info takes no -o"},
        {{"texture", "info", flat, "--face", "1"}, "texture info takes no --layer, --face or --slice"},
        {{"texture", "decode", flat}, "-o IMAGE is missing"},
        {{"texture", "info", flat, "--mip-storage", "float"}, "texture info takes no --mip-storage or --bc-rounding"},
        {{"texture", "info", flat, "--bc-rounding", "amd"}, "texture info takes no --mip-storage or --bc-rounding"},
        {{"texture", "decode", flat, "-o", out, "--json"}, "texture decode takes no --json"},
        {{"texture", "mips", flat, "-o", out, "--level", "1"}, "texture mips takes no --level"},
        {{"texture", "decode", flat, "-o", folder / "o.pgn"}, "'.png'"},
        {{"texture", "decode", flat, "-o", out, "--level", "3"}, "--level: there is no 3 (levels of the pyramid: 0 to 2)"},
        {{"texture", "decode", flat, "-o", out, "--level", "-1"}, "--level"},
        {{"texture", "decode", flat, "-o", out, "--layer", "1"}, "--layer: there is no 1 (layers of the array: 0 to 0)"},
        {{"texture", "decode", flat, "-o", out, "--face", "0"}, "--face: the texture is no cube map"},
        {{"texture", "decode", flat, "-o", out, "--slice", "0"}, "--slice: the texture is no volume"},
        {{"texture", "decode", floats, "-o", out}, "cannot hold the texels, which are rgba32-float; a format that can is '.exr'"},
        {{"texture", "mips", snorm, "-o", out}, "cannot hold the texels, which are rgba8-snorm; a format that can is '.exr'"},
        {{"texture", "decode", flat, "-o", flat}, "-o"},
        {{"texture", "mips", flat, "-o", flat}, "would replace a file that is read"},
        {{"texture", "mips", flat, "-o", folder / "o.dds", "--layer", "0"}, "-o: a .dds file holds every layer, face and slice"},
    };
    for (const auto& [words, part] : cases) EXPECT_EQ(why_not_failed(run(words), kWrongUsage, part), "");
    // An input is never replaced.
    scenes::write_8bit(folder / "a.level1.png", 8, 8, 1, std::vector<uint8_t>(64, 7), {});
    const std::string before = test::read_file(folder / "a.level1.png");
    EXPECT_EQ(
        why_not_failed(run({"texture", "mips", folder / "a.level1.png", "-o", folder / "a.png"}), kWrongUsage, "would replace a file"), "");
    EXPECT_EQ(test::read_file(folder / "a.level1.png"), before);
    EXPECT_EQ(folder.entries(), (std::vector<std::string>{"a.level1.png", "f.dds", "n.dds", "t.dds"}));
}

TEST(TextureCommand, BadInputIsExitCode3AndBadOutputExitCode4) {
    const TemporaryFolder folder;
    const std::string flat = test::write_dds(folder, "t.dds", {.width = 4, .height = 4}, FileFormat::Rgba8Unorm);
    folder.write("short.dds", test::read_file(flat).substr(0, 160));
    folder.write("half.png", "\x89PNG\r\n\x1a\n");
    for (const std::string name : {"short.dds", "half.png", "missing.ktx2"}) {
        EXPECT_EQ(why_not_failed(run({"texture", "info", folder / name}), kBadInput, name), "");
        EXPECT_EQ(why_not_failed(run({"texture", "decode", folder / name, "-o", folder / "o.png"}), kBadInput, name), "");
    }
    for (const char* action : {"decode", "mips"})
        EXPECT_EQ(why_not_failed(run({"texture", action, flat, "-o", folder / "nowhere/o.png"}), kCannotWrite, "nowhere"), "");
    EXPECT_EQ(folder.entries(), (std::vector<std::string>{"half.png", "short.dds", "t.dds"}));
}

TEST(TextureCorpus, EveryFileIsToldOfDecodedAndSampledOrRefused) {
    const char* const corpus = std::getenv("RAWTEXEL_CORPUS");
    if (corpus == nullptr) GTEST_SKIP() << "RAWTEXEL_CORPUS is not set: the program opens no real DDS and KTX2 files";
    const TemporaryFolder folder;
    int read = 0, refused = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(std::filesystem::path(corpus) / "bc")) {
        const std::string path = entry.path().string();
        if (!path.ends_with(".dds") && !path.ends_with(".ktx2")) continue;
        const test::Outcome told = run({"texture", "info", path, "--json"});
        if (told.code != kDone) {
            EXPECT_EQ(why_not_failed(told, kBadInput, path), "");
            ++refused;
            continue;
        }
        const Json json = Json::parse(told.out);
        uint64_t bytes = 0;
        for (const Json& level : json["per_level"]) bytes += uint64_t(level["bytes"]);
        EXPECT_EQ(bytes, uint64_t(json["stored_bytes"])) << path;
        const test::Outcome written = run({"texture", "decode", path, "-o", folder / "o.exr"});
        EXPECT_EQ(written.code, kDone) << written.err;
        const std::vector<std::string> place = json["faces"] == 6 ? std::vector<std::string>{"--direction", "0.3,-0.4,1"}
                                                                  : std::vector<std::string>{json["depth"] > 1 ? "--uvw" : "--uv",
                                                                                             json["depth"] > 1 ? "0.3,0.6,0.5" : "0.3,0.6"};
        const test::Outcome sampled = run({"sample", path, place[0], place[1], "--filter", "bspline", "--lod", "0.5", "--json"});
        EXPECT_EQ(sampled.code, kDone) << sampled.err;
        EXPECT_GE(Json::parse(sampled.out)["taps"].size(), 1u);
        ++read;
    }
    EXPECT_GT(read, 40);
    EXPECT_GT(refused, 3);
}

}  // namespace
}  // namespace rawtexel::cli
