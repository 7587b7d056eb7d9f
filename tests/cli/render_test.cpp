// `rawtexel render` from words to files.
#include "cli/command.h"
#include "cli/version.h"
#include "scenes/image_io.h"
#include "tests/cli/program_runner.h"
#include "texunit/simd.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <iterator>
#include <sstream>

namespace rawtexel::cli {
namespace {

using test::run;
using test::run_built;
using test::TemporaryFolder;
using test::why_not_failed;
using Json = nlohmann::json;
using Words = std::vector<std::string>;

/// A small frame, silent, without the sky whose prefiltering would take most of the time.
Words render_words(const std::string& scene, const std::string& output, const Words& more = {}) {
    Words words{"render", scene, "-o", output, "--progress", "never"};
    const auto add_default = [&](const char* option, const char* value) {
        if (std::ranges::find(more, option) == more.end()) words.insert(words.end(), {option, value});
    };
    add_default("--size", "72x56");
    add_default("--light", "0.2,-0.3,-1,3");
    add_default("--environment", "none");
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

std::string why_not_rendered(const Words& words) {
    const test::Outcome outcome = run(words);
    return outcome.code == kDone ? "" : "exit code " + std::to_string(outcome.code) + ": " + outcome.err;
}

std::vector<uint32_t> bits(const shading::Image& image) {
    std::vector<uint32_t> result;
    for (const float value : image.values) result.push_back(std::bit_cast<uint32_t>(value));
    return result;
}

shading::Image rendered(const TemporaryFolder& folder, const std::string& scene, const Words& more, const std::string& name = "image.exr") {
    EXPECT_EQ(why_not_rendered(render_words(scene, folder / name, more)), "");
    return scenes::read_image(folder / name, false);
}

TEST(Render, SaysWhatItSavedAndTheCamera) {
    const TemporaryFolder folder;
    const std::string scene = test::write_quad(folder);
    const test::Outcome outcome = run(render_words(scene, folder / "a.png"));
    ASSERT_EQ(outcome.code, kDone) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    EXPECT_NE(outcome.out.find("Saved: " + folder / "a.png\n"), std::string::npos) << outcome.out;
    ASSERT_TRUE(outcome.out.starts_with("Camera: --eye ")) << outcome.out;
    // What is printed, pasted, gives the same image.
    std::istringstream line(outcome.out.substr(8, outcome.out.find('\n') - 8));
    const Words camera{std::istream_iterator<std::string>(line), {}};
    ASSERT_EQ(why_not_rendered(render_words(scene, folder / "b.png", camera)), "");
    EXPECT_EQ(bits(scenes::read_image(folder / "a.png", false)), bits(scenes::read_image(folder / "b.png", false)));
}

TEST(Render, TheImageShowsTheQuad) {
    const TemporaryFolder folder;
    const shading::Image image =
        rendered(folder, test::write_quad(folder),
                 {"--eye", "0,0,2", "--target", "0,0,0", "--light", "0,0,-1,3", "--environment", "none", "--background", "0,0,8"});
    ASSERT_EQ(image.width, 72);
    ASSERT_EQ(image.height, 56);
    ASSERT_EQ(image.channels, 3);
    const float* corner = image.pixel(0, 28);
    EXPECT_EQ(corner[2], 8.0f);  // background left of the quad
    // The texture's red rises from left to right, its blue from top to bottom.
    EXPECT_LT(image.pixel(20, 28)[0], image.pixel(52, 28)[0]);
    EXPECT_LT(image.pixel(36, 12)[2], image.pixel(36, 44)[2]);
}

TEST(Render, TheOrderOfWordsDoesNotMatter) {
    const TemporaryFolder folder;
    const std::string scene = test::write_quad(folder);
    const std::vector<Words> orders{
        {"render", scene, "-o", folder / "a.png", "--size", "40x30", "--ambient", "1", "--environment", "none"},
        {"render", "--ambient", "1", "--environment", "none", "-o", folder / "b.png", "--size", "40x30", scene},
        {"--size", "40x30", "-o", folder / "c.png", "render", "--environment", "none", "--ambient", "1", scene}};
    for (const Words& words : orders) ASSERT_EQ(why_not_rendered(words), "");
    const auto first = bits(scenes::read_image(folder / "a.png", false));
    EXPECT_EQ(first, bits(scenes::read_image(folder / "b.png", false)));
    EXPECT_EQ(first, bits(scenes::read_image(folder / "c.png", false)));
}

TEST(Render, ThreadsTilesAndInstructionSetsDoNotChangeTheVisibleBits) {
    const TemporaryFolder folder;
    const std::string scene = test::write_quad(folder);
    const Words options{"--size", "150x90", "--spp", "3", "--orbit", "20,30", "--pixel-filter", "gaussian"};
    const auto with = [&](const Words& more) {
        Words all = options;
        all.insert(all.end(), more.begin(), more.end());
        return bits(rendered(folder, scene, all));
    };
    const std::vector<uint32_t> first = with({"--threads", "1", "--tile-size", "64"});
    for (const Words& more : {Words{"--threads", "2"}, {"--threads", "3", "--tile-size", "32"}, {"--threads", "2", "--tile-size", "128"}})
        EXPECT_EQ(with(more), first) << more[1];
    const auto png = [&](const Words& more) {
        Words all = options;
        all.insert(all.end(), more.begin(), more.end());
        return bits(rendered(folder, scene, all, "image.png"));
    };
    EXPECT_EQ(png({"--threads", "1"}), png({"--threads", "2", "--tile-size", "32"}));
}

TEST(Render, ACropHasTheBitsOfTheWhole) {
    const TemporaryFolder folder;
    const std::string scene = test::write_quad(folder);
    const Words options{"--size", "150x90", "--spp", "2", "--pixel-filter", "tent"};
    const shading::Image whole = rendered(folder, scene, options);
    for (const auto& [x, y, width, height] :
         {std::array{0, 0, 150, 90}, {13, 7, 100, 60}, {64, 64, 1, 1}, {149, 89, 1, 1}, {0, 50, 70, 17}}) {
        std::ostringstream crop;
        crop << x << ',' << y << ',' << width << ',' << height;
        Words all = options;
        all.insert(all.end(), {"--crop", crop.str()});
        const shading::Image part = rendered(folder, scene, all);
        ASSERT_EQ(part.width, width);
        ASSERT_EQ(part.height, height);
        for (int row = 0; row < height; ++row)
            for (int column = 0; column < width; ++column)
                for (int c = 0; c < 3; ++c)
                    ASSERT_EQ(std::bit_cast<uint32_t>(part.pixel(column, row)[c]),
                              std::bit_cast<uint32_t>(whole.pixel(x + column, y + row)[c]))
                        << crop.str() << " at " << column << "," << row;
    }
}

TEST(Render, ASceneWithoutLightsStandsUnderTheSky) {
    const TemporaryFolder folder;
    const std::string scene = test::write_quad(folder);
    ASSERT_EQ(why_not_rendered({"render", scene, "-o", folder / "silent.exr", "--size", "40x30"}), "");
    const auto silent = bits(scenes::read_image(folder / "silent.exr", false));
    ASSERT_EQ(why_not_rendered({"render", scene, "-o", folder / "sky.exr", "--size", "40x30", "--environment", "sky"}), "");
    EXPECT_EQ(bits(scenes::read_image(folder / "sky.exr", false)), silent);
    ASSERT_EQ(why_not_rendered({"render", scene, "-o", folder / "dark.exr", "--size", "40x30", "--environment", "none"}), "");
    for (const float value : scenes::read_image(folder / "dark.exr", false).values) ASSERT_EQ(value, 0.0f);
}

TEST(Render, SeedsChangeThePixelJitter) {
    const TemporaryFolder folder;
    const std::string scene = test::write_quad(folder);
    const auto zero = bits(rendered(folder, scene, {"--pixel-jitter", "pixel"}));
    EXPECT_EQ(zero, bits(rendered(folder, scene, {"--pixel-jitter", "pixel", "--seed", "0"})));
    EXPECT_NE(zero, bits(rendered(folder, scene, {"--pixel-jitter", "pixel", "--seed", "1"})));
}

TEST(Render, FiltersReplaceTheScenes) {
    const TemporaryFolder folder;
    const std::string scene = test::write_quad(folder);
    const auto silent = bits(rendered(folder, scene, {}));
    EXPECT_EQ(silent, bits(rendered(folder, scene, {"--filter", "scene", "--mip", "scene"})));
    EXPECT_NE(silent, bits(rendered(folder, scene, {"--filter", "nearest"})));
    EXPECT_NE(silent, bits(rendered(folder, scene, {"--mip", "none"})));
}

TEST(Render, FloatFormatsHoldRadianceAndOthersDisplayValues) {
    const TemporaryFolder folder;
    const std::string scene = test::write_quad(folder);
    const Words flat{"--background", "0.5,2,0", "--eye", "0,0,-5", "--target", "0,0,-9", "--environment", "none"};  // looks away
    const shading::Image linear = rendered(folder, scene, flat);
    EXPECT_EQ(linear.pixel(3, 3)[0], 0.5f);
    EXPECT_EQ(linear.pixel(3, 3)[1], 2.0f);
    Words none = flat;
    none.insert(none.end(), {"--tonemap", "none", "--transfer", "linear", "--exposure", "-1"});
    const shading::Image codes = rendered(folder, scene, none, "image.png");
    EXPECT_NEAR(codes.pixel(3, 3)[0], 0.25f, 0.5f / 255);
    EXPECT_NEAR(codes.pixel(3, 3)[1], 1.0f, 1e-6f);
    const test::Outcome warned = run(render_words(scene, folder / "x.exr", none));
    EXPECT_EQ(warned.code, kDone);
    EXPECT_TRUE(warned.err.starts_with("rawtexel: warning: ")) << warned.err;
}

TEST(Render, ImagesSayHowTheyWereMade) {
    const TemporaryFolder folder;
    const std::string scene = test::write_quad(folder);
    for (const std::string name : {"a.png", "a.exr"}) {
        const Words words = render_words(scene, folder / name, {"--count", "--seed", "77", "--filter", "bilinear"});
        ASSERT_EQ(why_not_rendered(words), "");
        const std::string bytes = test::read_file(folder / name);
        for (const std::string& part : {std::string("rawtexel:command"), "rawtexel render " + scene, std::string("rawtexel:seed"),
                                        std::string("77"), std::string("rawtexel:spp"), std::string("--eye "), std::string("bilinear"),
                                        std::string("rawtexel:taps"), std::string("rawtexel:texels_requested"), std::string(version())})
            EXPECT_NE(bytes.find(part), std::string::npos) << name << ": " << part;
    }
}

TEST(Render, StatsHoldWhatWasCountedAndTimed) {
    const TemporaryFolder folder;
    const std::string scene = test::write_quad(folder);
    ASSERT_EQ(
        why_not_rendered(render_words(scene, folder / "a.png", {"--stats", folder / "s.json", "--count", "--repeat", "3", "--spp", "2"})),
        "");
    const Json json = Json::parse(test::read_file(folder / "s.json"));
    EXPECT_EQ(json["scene"], scene);
    EXPECT_TRUE(json["command"].get<std::string>().starts_with("rawtexel render "));
    EXPECT_EQ(json["frame_s"]["n"], 3);
    EXPECT_GT(json["frame_s"]["min"], 0.0);
    EXPECT_LE(json["frame_s"]["min"], json["frame_s"]["median"]);
    EXPECT_EQ(json["image"]["width"], 72);
    EXPECT_EQ(json["image"]["spp"], 2);
    EXPECT_GT(json["image"]["samples_shaded"], 0);
    EXPECT_EQ(json["geometry"]["triangles"], 2);
    EXPECT_EQ(json["texture"]["lookups"], json["image"]["samples_shaded"]);  // one map
    EXPECT_GE(json["texture"]["texels_requested"], json["texture"]["lookups"]);
    EXPECT_EQ(json["textures"][0]["width"], 64);
    EXPECT_EQ(json["textures"][0]["levels"], 7);
    EXPECT_GT(json["texture"]["performed"]["blocks_decoded"], 0);
    // Counters are the first frame's: the same without repeats.
    ASSERT_EQ(why_not_rendered(render_words(scene, folder / "a.png", {"--stats", folder / "t.json", "--count", "--spp", "2"})), "");
    const Json once = Json::parse(test::read_file(folder / "t.json"));
    EXPECT_EQ(once["texture"], json["texture"]);
    ASSERT_EQ(why_not_rendered(render_words(scene, folder / "a.png", {"--stats", folder / "u.json"})), "");
    EXPECT_FALSE(Json::parse(test::read_file(folder / "u.json"))["texture"].contains("taps"));
}

TEST(Render, NearestWithoutLevelsReadsOneTexelALookup) {
    const TemporaryFolder folder;
    const std::string scene = test::write_quad(folder);
    ASSERT_EQ(why_not_rendered(
                  render_words(scene, folder / "a.png", {"--stats", folder / "s.json", "--count", "--filter", "nearest", "--mip", "none"})),
              "");
    const Json texture = Json::parse(test::read_file(folder / "s.json"))["texture"];
    EXPECT_EQ(texture["taps"], texture["lookups"]);
    EXPECT_EQ(texture["texels_requested"], texture["lookups"]);
    EXPECT_EQ(texture["texels_per_sample"], 1.0);
}

TEST(Render, LayersComeIntoTheExr) {
    const TemporaryFolder folder;
    const std::string scene = test::write_quad(folder);
    ASSERT_EQ(why_not_rendered(render_words(scene, folder / "a.exr", {"--aov", "depth,normal,albedo,uv,lod,material,texels,spp"})), "");
    const std::string header = test::read_file(folder / "a.exr").substr(0, 4000);
    for (const char* layer : {"depth.", "normal.", "albedo.", "uv.", "lod.", "material.", "texels.", "spp."})
        EXPECT_NE(header.find(layer), std::string::npos) << layer;
}

TEST(Render, ScenariosOfFidelityToolsRender) {
    const TemporaryFolder folder;
    const std::string scene = test::write_quad(folder);
    shading::Image sky(16, 8, 3);
    std::ranges::fill(sky.values, 0.5f);
    scenes::write_float(folder / "sky.hdr", sky, {}, {});
    const Json scenario{{"scenario",
                         {{"lighting", folder / "sky.hdr"},
                          {"dimensions", {{"width", 50}, {"height", 40}}},
                          {"target", {{"x", 0}, {"y", 0}, {"z", 0}}},
                          {"orbit", {{"theta", 0}, {"phi", 90}, {"radius", 3}}},
                          {"verticalFoV", 45},
                          {"renderSkybox", false},
                          {"name", "quad"},
                          {"model", scene}}},
                        {"outputFile", folder / "out.png"}};
    const test::Outcome outcome = run({"render", "--scenario", scenario.dump()});
    ASSERT_EQ(outcome.code, kDone) << outcome.err;
    EXPECT_NE(outcome.out.find("--eye 0,"), std::string::npos) << outcome.out;
    const shading::Image image = scenes::read_image(folder / "out.png", false);
    EXPECT_EQ(image.width, 50);
    EXPECT_EQ(image.height, 40);
    EXPECT_EQ(image.pixel(0, 0)[1], 1.0f);  // white beside the model
    EXPECT_LT(image.pixel(25, 20)[2], 1.0f);
    Json missing = scenario;
    missing["scenario"]["model"] = folder / "missing.glb";
    EXPECT_EQ(why_not_failed(run({"render", "--scenario", missing.dump()}), kBadInput, "missing.glb"), "");
}

TEST(Render, EdgesOfAScenarioAreMixedWithWhiteAsDisplayed) {
    const TemporaryFolder folder;
    const std::string scene = test::write_quad(folder);
    // A dark quad: without lights and under no sky it is black. At this distance its edge is in the middle of a pixel.
    const auto words = [&](const char* output, const char* spp) {
        const Json scenario{{"scenario",
                             {{"dimensions", {{"width", 40}, {"height", 40}}},
                              {"target", {{"x", 0}, {"y", 0}, {"z", 0}}},
                              {"orbit", {{"theta", 0}, {"phi", 90}, {"radius", 3.863}}},
                              {"verticalFoV", 45},
                              {"renderSkybox", false},
                              {"model", scene}}},
                            {"outputFile", folder / output}};
        return Words{"render", "--scenario", scenario.dump(), "--environment", "none", "--spp", spp, "--progress", "never"};
    };
    const auto check = [&](const char* output, float white) {
        EXPECT_EQ(why_not_rendered(words(output, "16")), "");
        const shading::Image image = scenes::read_image(folder / output, false);
        // Along a row from outside to inside: white, then a mix in steps of a sixteenth, then black.
        EXPECT_EQ(image.pixel(0, 20)[0], white);
        EXPECT_EQ(image.pixel(20, 20)[0], 0.0f);
        int mixed = 0;
        for (int x = 0; x < 20; ++x) {
            const float value = image.pixel(x, 20)[0];
            mixed += value > 0.0f && value < white;
            EXPECT_NEAR(value * 16.0f, std::round(value * 16.0f), 16.5f / 255.0f) << output << " " << x;
        }
        EXPECT_GE(mixed, 1) << output;
    };
    check("out.png", 1.0f);
    check("out.exr", 1.0f);
}

TEST(Render, ProgressIsPlainLinesWhereThereIsNoTerminal) {
    const TemporaryFolder folder;
    const std::string scene = test::write_quad(folder);
    const test::Outcome outcome =
        run({"render", scene, "-o", folder / "a.png", "--size", "300x300", "--environment", "none", "--progress", "always"});
    ASSERT_EQ(outcome.code, kDone);
    EXPECT_TRUE(outcome.err.starts_with("rawtexel: loading\nrawtexel: preparing light\nrawtexel: rendering\nrawtexel: ")) << outcome.err;
    EXPECT_TRUE(outcome.err.ends_with("100 % after 0:00\n")) << outcome.err;
    EXPECT_EQ(outcome.err.find('\r'), std::string::npos);
}

TEST(Render, AnUnavailableInstructionSetIsNotSilentlyReplaced) {
    const TemporaryFolder folder;
    const std::string scene = test::write_quad(folder);
    for (const texunit::Simd simd : {texunit::Simd::Scalar, texunit::Simd::Sse4, texunit::Simd::Avx2, texunit::Simd::Avx3}) {
        const auto available = texunit::available_simd();
        const bool there = std::ranges::find(available, simd) != available.end();
        const test::Outcome outcome = run(render_words(scene, folder / "a.png", {"--simd", std::string(to_string(simd))}));
        EXPECT_EQ(outcome.code, there ? kDone : kWrongUsage) << to_string(simd) << outcome.err;
    }
    texunit::choose_simd(texunit::Simd::Auto);
}

TEST(Render, MetadataTellsWhatMadeTheImage) {
    const TemporaryFolder folder;
    const std::string scene = test::write_quad(folder);
    const Words more{"--exposure", "1.5",    "--tonemap", "reinhard",      "--transfer", "sqrt",   "--pixel-jitter",
                     "pixel",      "--crop", "8,4,20,10", "--mip-storage", "float",      "--count"};
    ASSERT_EQ(why_not_rendered(render_words(scene, folder / "a.png", more)), "");
    const std::string png = test::read_file(folder / "a.png");
    const auto holds = [](const std::string& bytes, const std::string& key, const std::string& value) {
        const size_t at = bytes.find("rawtexel:" + key);
        return at != bytes.npos && bytes.substr(at, key.size() + value.size() + 40).find(value) != bytes.npos;
    };
    for (const auto& [key, value] : {std::pair{"exposure", "1.5"},
                                     {"tonemap", "reinhard"},
                                     {"transfer", "sqrt"},
                                     {"pixel-jitter", "pixel"},
                                     {"crop", "8,4,20,10"},
                                     {"mip-storage", "float"},
                                     {"lookups", ""}})
        EXPECT_TRUE(holds(png, key, value)) << key;
    ASSERT_EQ(why_not_rendered(render_words(scene, folder / "a.exr")), "");
    const std::string exr = test::read_file(folder / "a.exr");
    EXPECT_TRUE(holds(exr, "mip-storage", "source"));
    for (const char* key : {"exposure", "tonemap", "transfer", "crop", "lookups"})
        EXPECT_EQ(exr.find(std::string("rawtexel:") + key), exr.npos) << key;
}

TEST(Render, ACropLiesWhereItBelongsInItsOpenExr) {
    const TemporaryFolder folder;
    const std::string scene = test::write_quad(folder);
    ASSERT_EQ(why_not_rendered(render_words(scene, folder / "a.exr", {"--crop", "8,4,20,10"})), "");
    const std::string exr = test::read_file(folder / "a.exr");
    // An attribute: name, type, size, then xMin, yMin, xMax, yMax as 32-bit integers.
    const auto window = [&](const std::string& name) {
        const size_t at = exr.find(name + '\0' + "box2i" + '\0') + name.size() + 1 + 6 + 4;
        std::array<int32_t, 4> box{};
        std::memcpy(box.data(), exr.data() + at, sizeof box);
        return box;
    };
    EXPECT_EQ(window("dataWindow"), (std::array<int32_t, 4>{8, 4, 27, 13}));
    EXPECT_EQ(window("displayWindow"), (std::array<int32_t, 4>{0, 0, 71, 55}));
}

// --- what goes wrong

TEST(RenderErrors, NoFileOfASceneIsOverwrittenAndNoOutputTwice) {
    const TemporaryFolder folder;
    const std::string scene = test::write_quad(folder);
    scenes::write_8bit(folder / "sky.png", 4, 2, 3, std::vector<uint8_t>(24, 99), {});
    const std::string texture = test::read_file(folder / "texture.png"), sky = test::read_file(folder / "sky.png");
    EXPECT_EQ(why_not_failed(run(render_words(scene, folder / "a.png", {"--stats", folder / "a.png"})), kWrongUsage,
                             "--stats: '" + folder / "a.png"),
              "");
    EXPECT_EQ(why_not_failed(run(render_words(scene, folder / "texture.png")), kWrongUsage, "would replace a file that is read"), "");
    EXPECT_EQ(why_not_failed(run(render_words(scene, folder / "sky.png", {"--environment", folder / "sky.png"})), kWrongUsage, "sky.png"),
              "");
    EXPECT_EQ(
        why_not_failed(run(render_words(scene, folder / "a.png", {"--stats", scene})), kWrongUsage, "would replace a file that is read"),
        "");
    EXPECT_EQ(why_not_failed(run({"export", folder / "q.glb", "-o", folder / "q.glb"}), kWrongUsage, "q.glb"), "");
    EXPECT_EQ(test::read_file(folder / "texture.png"), texture);
    EXPECT_EQ(test::read_file(folder / "sky.png"), sky);
    EXPECT_EQ(folder.entries(), (std::vector<std::string>{"quad.bin", "quad.gltf", "sky.png", "texture.png"}));
}

TEST(RenderErrors, ScenesTooLargeForSinglePrecisionAreExitCode3) {
    const TemporaryFolder folder;
    const std::string scene = test::write_quad(folder);
    Json json = Json::parse(test::read_file(scene));
    json["nodes"][0]["scale"] = {1e30, 1e30, 1e30};
    test::write_file(scene, json.dump());
    EXPECT_EQ(why_not_failed(run(render_words(scene, folder / "a.exr")), kBadInput, "the scene reaches 1e+30 metres (allowed: below 1e15)"),
              "");
    // What is allowed is drawn in numbers.
    json["nodes"][0]["scale"] = {9e14, 9e14, 9e14};
    test::write_file(scene, json.dump());
    for (const char* environment : {"none", "sky"})
        for (const float value : rendered(folder, scene, {"--environment", environment}).values)
            ASSERT_TRUE(std::isfinite(value)) << environment;
}

TEST(RenderErrors, OutputThatCannotBeWrittenIsExitCode4BeforeTheRender) {
    const TemporaryFolder folder;
    const std::string scene = test::write_quad(folder);
    const std::vector<std::string> before = folder.entries();
    for (const std::string& place :
         {folder / "missing/a.png", scene + "/a.png", folder.path() + "/../missing/a.exr", std::string("/proc/a.png")})
        EXPECT_EQ(why_not_failed(run(render_words(scene, place)), kCannotWrite, place), "");
    // The output is looked at before the scene, which is missing too.
    EXPECT_EQ(why_not_failed(run(render_words(folder / "none.gltf", folder / "missing/a.png")), kCannotWrite, "missing/a.png"), "");
    std::filesystem::create_directory(folder / "folder.png");
    EXPECT_EQ(why_not_failed(run(render_words(scene, folder / "folder.png")), kCannotWrite, "folder.png"), "");
    EXPECT_EQ(
        why_not_failed(run(render_words(scene, folder / "a.png", {"--stats", folder / "missing/s.json"})), kCannotWrite, "missing/s.json"),
        "");
    std::filesystem::remove(folder / "folder.png");
    EXPECT_EQ(folder.entries(), before);
}

TEST(RenderErrors, ScenesThatCannotBeReadAreExitCode3) {
    const TemporaryFolder folder;
    const std::string scene = test::write_quad(folder), whole = test::read_file(scene);
    test::write_file(folder / "empty.gltf", "");
    test::write_file(folder / "empty.glb", "");
    test::write_file(folder / "half.gltf", whole.substr(0, whole.size() / 2));
    test::write_file(folder / "noise.glb", std::string(1000, '\x5a'));
    test::write_file(folder / "magic.glb", std::string("glTF\x02\0\0\0\xff\xff\xff\x7f", 12));
    for (const std::string bad : {"missing.gltf", "missing.glb", "empty.gltf", "empty.glb", "half.gltf", "noise.glb", "magic.glb"})
        EXPECT_EQ(why_not_failed(run(render_words(folder / bad, folder / "a.png")), kBadInput, bad), "") << bad;
    EXPECT_EQ(why_not_failed(run(render_words(folder.path(), folder / "a.png")), kBadInput, folder.path()), "");
    EXPECT_EQ(why_not_failed(run(render_words("plan", folder / "a.png")), kBadInput, "plane"), "");
    EXPECT_FALSE(std::filesystem::exists(folder / "a.png"));
}

TEST(RenderErrors, EveryFileOfASceneMustBeThere) {
    const TemporaryFolder folder;
    const std::string scene = test::write_quad(folder);
    const std::string bin = test::read_file(folder / "quad.bin"), png = test::read_file(folder / "texture.png");
    const auto fails_with = [&](const std::string& file) {
        return why_not_failed(run(render_words(scene, folder / "a.png")), kBadInput, file);
    };
    std::filesystem::remove(folder / "texture.png");
    EXPECT_EQ(fails_with("texture.png"), "");
    for (const std::string& bytes : {std::string(), std::string("no image"), png.substr(0, 20), png.substr(0, png.size() / 2)}) {
        test::write_file(folder / "texture.png", bytes);
        EXPECT_EQ(fails_with("texture.png"), "") << bytes.size() << " bytes";
    }
    // 65536 wide: the header alone tells.
    std::string wide = png;
    wide.replace(16, 4, std::string("\0\1\0\0", 4));
    test::write_file(folder / "texture.png", wide);
    EXPECT_EQ(fails_with("texture.png"), "");
    test::write_file(folder / "texture.png", png);
    for (const std::string& bytes : {std::string(), bin.substr(0, 100)}) {
        test::write_file(folder / "quad.bin", bytes);
        EXPECT_EQ(fails_with("quad.bin"), "") << bytes.size() << " bytes";
    }
    std::filesystem::remove(folder / "quad.bin");
    EXPECT_EQ(fails_with("quad.bin"), "");
    EXPECT_EQ(folder.entries(), (std::vector<std::string>{"quad.gltf", "texture.png"}));
}

TEST(RenderErrors, EnvironmentsThatCannotBeReadAreExitCode3) {
    const TemporaryFolder folder;
    const std::string scene = test::write_quad(folder);
    test::write_file(folder / "empty.hdr", "");
    test::write_file(folder / "text.hdr", "this is no image");
    for (const std::string bad : {"missing.hdr", "empty.hdr", "text.hdr", "quad.bin"})
        EXPECT_EQ(why_not_failed(run(render_words(scene, folder / "a.png", {"--environment", folder / bad})), kBadInput, bad), "");
}

TEST(RenderErrors, UnknownCamerasNameThoseThereAre) {
    const TemporaryFolder folder;
    EXPECT_EQ(why_not_failed(run(render_words(test::write_quad(folder), folder / "a.png", {"--camera", "front"})), kWrongUsage, "front"),
              "");
}

TEST(RenderErrors, NoFileIsLeftWhenARenderFails) {
    const TemporaryFolder folder;
    const std::string scene = test::write_quad(folder);
    // Whole header, half the pixels: found while the frame is drawn.
    const std::string png = test::read_file(folder / "texture.png");
    test::write_file(folder / "texture.png", png.substr(0, png.size() - 200));
    test::write_file(folder / "a.png", "what was there before");
    const std::vector<std::string> before = folder.entries();
    EXPECT_EQ(why_not_failed(run_built(render_words(scene, folder / "a.png", {"--stats", folder / "s.json"})), kBadInput, "texture.png"),
              "");
    EXPECT_EQ(folder.entries(), before);
    EXPECT_EQ(test::read_file(folder / "a.png"), "what was there before");
}

// --- export

TEST(Export, TheExportedSceneRendersTheSame) {
    const TemporaryFolder folder;
    const std::string scene = test::write_quad(folder);
    const test::Outcome outcome = run({"export", scene, "-o", folder / "quad.glb"});
    ASSERT_EQ(outcome.code, kDone) << outcome.err;
    EXPECT_EQ(outcome.out, "Saved: " + folder / "quad.glb\n");
    EXPECT_EQ(bits(rendered(folder, scene, {})), bits(rendered(folder, folder / "quad.glb", {}, "b.exr")));
}

TEST(Export, OutputThatCannotBeWrittenIsExitCode4) {
    const TemporaryFolder folder;
    EXPECT_EQ(why_not_failed(run({"export", "magnify", "-o", folder / "missing/x.glb"}), kCannotWrite, "missing/x.glb"), "");
    EXPECT_EQ(why_not_failed(run({"export", folder / "none.gltf", "-o", folder / "x.glb"}), kBadInput, "none.gltf"), "");
    EXPECT_TRUE(folder.entries().empty());
}

// --- real files

TEST(RenderCorpus, EveryFileRendersOrFailsInOneLine) {
    const char* corpus = std::getenv("RAWTEXEL_CORPUS");
    if (!corpus) GTEST_SKIP() << "RAWTEXEL_CORPUS is not set: real glTF files are not rendered";
    const TemporaryFolder folder;
    int rendered_files = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(std::filesystem::path(corpus) / "gltf")) {
        const std::string extension = entry.path().extension();
        if (extension != ".gltf" && extension != ".glb") continue;
        const test::Outcome outcome = run(render_words(entry.path(), folder / "a.png", {"--size", "64x48"}));
        EXPECT_EQ(outcome.code, kDone) << entry.path() << ": " << outcome.err;
        ++rendered_files;
    }
    EXPECT_GT(rendered_files, 0);
}

}  // namespace
}  // namespace rawtexel::cli
