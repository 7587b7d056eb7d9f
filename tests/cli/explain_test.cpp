// One pixel, explained: what it is made of adds up to what `render` makes of it.
#include "cli/command.h"
#include "scenes/image_io.h"
#include "tests/cli/program_runner.h"
#include "texunit/random.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace rawtexel::cli {
namespace {

using test::run;
using test::TemporaryFolder;
using test::why_not_failed;
using Json = nlohmann::json;
using Words = std::vector<std::string>;

Words joined(Words words, const Words& more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

/// Noise of four channels, each of its own.
std::vector<uint8_t> noise_texels(int extent) {
    std::vector<uint8_t> texels;
    uint32_t state = 1;
    for (int i = 0; i < extent * extent * 4; ++i) {
        state = state * 1664525u + 1013904223u;
        texels.push_back(uint8_t(state >> 24));
    }
    return texels;
}

constexpr const char* kStackJson = R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1, 2]}],
"nodes": [{"mesh": 0}, {"mesh": 1, "translation": [0.2, 0.1, 0.6]}, {"mesh": 2, "translation": [0, -0.3, 0.9]}],
"meshes": [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2}, "indices": 3, "material": 0}]},
           {"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2}, "indices": 3, "material": 1}]},
           {"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2}, "indices": 3, "material": 2}]}],
"materials": [{"name": "wall", "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}, "metallicRoughnessTexture": {"index": 1},
                               "metallicFactor": 0.5}, "emissiveTexture": {"index": 1}, "emissiveFactor": [0.2, 0.1, 0.05]},
              {"name": "leaf", "alphaMode": "MASK", "doubleSided": true, "pbrMetallicRoughness": {"baseColorTexture": {"index": 1}}},
              {"name": "glass", "alphaMode": "BLEND", "doubleSided": true, "extensions": {"KHR_materials_unlit": {}},
               "pbrMetallicRoughness": {"baseColorFactor": [1, 0.5, 0.25, 0.75], "baseColorTexture": {"index": 1}}}],
"extensionsUsed": ["KHR_materials_unlit"],
"textures": [{"source": 0}, {"source": 1}], "images": [{"uri": "texture.png"}, {"uri": "noise.png"}],
"buffers": [{"uri": "quad.bin", "byteLength": 140}],
"bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 48},
                {"buffer": 0, "byteOffset": 96, "byteLength": 32}, {"buffer": 0, "byteOffset": 128, "byteLength": 12}],
"accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [-1, -1, 0], "max": [1, 1, 0]},
              {"bufferView": 1, "componentType": 5126, "count": 4, "type": "VEC3"},
              {"bufferView": 2, "componentType": 5126, "count": 4, "type": "VEC2"},
              {"bufferView": 3, "componentType": 5123, "count": 6, "type": "SCALAR"}]})";

/// From the front a BLEND quad without light, a MASK quad and a lit opaque one, before nothing: FOLDER/stack.gltf.
std::string write_stack(const TemporaryFolder& folder) {
    test::write_quad(folder);
    scenes::write_8bit(folder / "noise.png", 32, 32, 4, noise_texels(32), {});
    test::write_file(folder / "stack.gltf", kStackJson);
    return folder / "stack.gltf";
}

/// The options of a frame that is small and quickly lit, and `more`.
Words frame_words(const Words& more) {
    const Words frame{"--size",         "40x30",     "--environment", "none",         "--light",
                      "-0.3,-1,-0.8,3", "--ambient", "0.1",           "--background", "0.1,0.2,0.4"};
    const bool shadows_said = std::ranges::find(more, "--shadows") != more.end();
    return joined(joined(frame, more), shadows_said ? Words{} : Words{"--shadows", "off"});
}

Json explain(const std::string& scene, int x, int y, const Words& more) {
    const Words words = joined({"explain", scene, "--json", "--pixel", std::to_string(x) + "," + std::to_string(y)}, frame_words(more));
    const test::Outcome outcome = run(words);
    EXPECT_EQ(outcome.code, kDone) << outcome.err;
    return Json::parse(outcome.out);
}

using Radiance = std::array<float, 3>;

Radiance radiance_of(const Json& json) { return {json[0].get<float>(), json[1].get<float>(), json[2].get<float>()}; }

/// Every lookup that a sample asked for.
std::vector<Json> lookups_of(const Json& sample) {
    std::vector<Json> lookups;
    for (const Json& candidate : sample["let_through"]) lookups.insert(lookups.end(), candidate["maps"].begin(), candidate["maps"].end());
    if (!sample["surface"].is_null()) lookups.insert(lookups.end(), sample["surface"]["maps"].begin(), sample["surface"]["maps"].end());
    return lookups;
}

class ExplainTest : public testing::Test {
  protected:
    TemporaryFolder folder_;
    std::string scene_ = write_stack(folder_);
};

TEST_F(ExplainTest, SumsToTheRenderedPixelBitForBit) {
    const std::vector<Words> ways{
        {"--spp", "1"},
        {"--spp", "3", "--filter", "bspline", "--seed", "7"},
        {"--spp", "16", "--pixel-jitter", "pixel", "--pixel-filter", "gaussian", "--aniso", "8"},
        {"--spp", "37", "--footprint", "sample", "--derivatives", "quad", "--precision", "gpu"},
        {"--spp", "5", "--ewa", "--pixel-filter", "tent", "--shadows", "on"},
        {"--spp", "4", "--simd", "scalar", "--filter", "lanczos3", "--mip", "nearest"},
        {"--spp", "2", "--crop", "8,6,25,20", "--tile-size", "32", "--peer-shading"},
        {"--spp", "6", "--estimator", "reservoir", "--filter", "catmull-rom"},
        {"--spp", "3", "--order", "after"},
        {"--spp", "3", "--estimator", "jitter", "--taps", "4", "--random", "per-map", "--noise", "stbn"},
        {"--spp", "3", "--estimator", "reservoir", "--taps", "3", "--order", "before"},
    };
    int surfaces = 0, backgrounds = 0;
    for (const Words& way : ways) {
        // The whole frame, on all threads.
        Words plain = way;
        if (const auto crop = std::ranges::find(plain, "--crop"); crop != plain.end()) plain.erase(crop, crop + 2);
        const std::string image = folder_ / "frame.exr";
        ASSERT_EQ(run(joined({"render", scene_, "-o", image}, frame_words(plain))).code, kDone);
        const shading::Image frame = scenes::read_image(image, false);
        for (const auto& [x, y] : {std::pair{20, 14}, {11, 9}, {27, 20}, {31, 8}}) {
            const Json json = explain(scene_, x, y, way);
            const std::string what = testing::PrintToString(way) + " at " + std::to_string(x) + "," + std::to_string(y);
            const float* pixel = frame.pixel(x, y);
            EXPECT_EQ(radiance_of(json["mean"]), (Radiance{pixel[0], pixel[1], pixel[2]})) << what;
            EXPECT_EQ(json["rendered"], json["mean"]) << what;
            ASSERT_EQ(json["samples"].size(), json["spp"].get<size_t>()) << what;
            for (const Json& sample : json["samples"]) ++(sample["surface"].is_null() ? backgrounds : surfaces);
        }
    }
    EXPECT_GT(surfaces, 50);
    EXPECT_GT(backgrounds, 10);
}

/// The radiance of a sample from its taps: those of positive weight as far as they cover, then the others.
Radiance sum_of_taps(const Json& surface) {
    const bool mask = surface.value("alpha_mode", "") == "MASK";
    Radiance positive{}, negative{};
    float weights = 0, covered = 0;
    for (const Json& tap : surface["taps"]) {
        const float weight = tap["weight"].get<float>(), above = std::max(weight, 0.0f), below = std::min(weight, 0.0f);
        float share = above;
        if (tap.contains("alpha"))
            share = above * (mask ? float(tap["alpha"].get<float>() >= 0.5f) : std::clamp(tap["alpha"].get<float>(), 0.0f, 1.0f));
        const Radiance radiance = radiance_of(tap["radiance"]);
        weights += above, covered += share;
        for (size_t c = 0; c < 3; ++c) positive[c] += share * radiance[c], negative[c] += below * radiance[c];
    }
    Radiance sum;
    for (size_t c = 0; c < 3; ++c) sum[c] = positive[c] * (covered > 0 ? weights / covered : 1.0f) + negative[c];
    return sum;
}

TEST_F(ExplainTest, TapsAddUpToTheSample) {
    int taps = 0;
    for (const Words& way : {Words{"--estimator", "reservoir", "--filter", "lanczos3", "--spp", "8"},
                             {"--order", "after", "--spp", "2"},
                             {"--estimator", "jitter", "--taps", "3", "--spp", "4"}}) {
        for (const auto& [x, y] : {std::pair{20, 14}, {16, 18}, {24, 12}}) {
            const Json json = explain(scene_, x, y, way);
            for (const Json& sample : json["samples"]) {
                if (sample["surface"].is_null()) continue;
                // A surface without maps is shaded once.
                if (!sample["surface"].contains("taps")) continue;
                taps += int(sample["surface"]["taps"].size());
                EXPECT_EQ(sum_of_taps(sample["surface"]), radiance_of(sample["radiance"])) << sample["surface"].dump(1);
            }
        }
    }
    EXPECT_GT(taps, 60);
}

/// Planes and layers: blended light adds up from the branches, what is blended first adds up from the light, and every way to the pixel.
TEST(ExplainBranches, PlanesAndLayersAddUpToTheSample) {
    struct Place {
        const char* scene;
        int x, y;
    };
    int blended = 0, lit = 0, drawn = 0, masks = 0;
    for (const Place& place : {Place{"triplanar", 58, 30}, {"layers", 48, 40}}) {
        for (const Words& way : {Words{},
                                 {"--order", "after"},
                                 {"--estimator", "reservoir", "--blend", "all"},
                                 {"--estimator", "reservoir"},
                                 {"--blend", "draw"},
                                 {"--estimator", "reservoir", "--taps", "2", "--order", "before"}}) {
            const std::string what = std::string(place.scene) + " " + testing::PrintToString(way);
            const Words words = joined(
                {"explain", place.scene, "--json", "--size", "96x54", "--pixel", std::to_string(place.x) + "," + std::to_string(place.y)},
                way);
            const test::Outcome outcome = run(words);
            ASSERT_EQ(outcome.code, kDone) << outcome.err;
            const Json json = Json::parse(outcome.out);
            EXPECT_EQ(json["rendered"], json["mean"]) << what;
            const Json& sample = json["samples"][0];
            ASSERT_FALSE(sample["surface"].is_null()) << what;
            const Json& surface = sample["surface"];
            for (const Json& lookup : surface["maps"]) masks += lookup["map"] == "layers.mask";
            const bool blends = surface.contains("branches");
            if (!blends) {
                ++drawn;
                if (surface.contains("taps")) {
                    EXPECT_EQ(sum_of_taps(surface), radiance_of(sample["radiance"])) << what;
                }
            } else if (surface["branches"][0].contains("radiance")) {
                Radiance sum{};
                for (const Json& branch : surface["branches"]) {
                    const float weight = branch["weight"].get<float>();
                    const Radiance radiance = radiance_of(branch["radiance"]);
                    for (size_t c = 0; c < 3; ++c) sum[c] += weight * radiance[c];
                    if (branch.contains("taps")) {
                        EXPECT_EQ(sum_of_taps(branch), radiance) << what;
                    }
                }
                EXPECT_EQ(sum, radiance_of(sample["radiance"])) << what;
                ++lit;
            }
            if (surface.contains("light")) {
                Radiance sum{};
                for (const Json& term : surface["light"]) {
                    const Radiance radiance = radiance_of(term["radiance"]);
                    for (size_t c = 0; c < 3; ++c) sum[c] += radiance[c];
                }
                EXPECT_EQ(sum, radiance_of(sample["radiance"])) << what;
                blended += blends;
            }
        }
    }
    EXPECT_EQ(blended, 2);
    EXPECT_EQ(lit, 4);
    EXPECT_EQ(drawn, 6);
    EXPECT_EQ(masks, 6);
}

TEST_F(ExplainTest, AddsUpAtEveryStep) {
    int lit = 0, unlit = 0;
    for (const auto& [x, y] : {std::pair{20, 14}, {16, 18}, {24, 12}}) {
        const Json json = explain(scene_, x, y, {"--spp", "9", "--aniso", "4", "--filter", "catmull-rom"});
        for (const Json& sample : json["samples"]) {
            EXPECT_EQ(sample["weight"], 1.0 / 9);
            // Taps to values.
            for (const Json& lookup : lookups_of(sample)) {
                std::array<double, 4> sum{};
                for (const Json& tap : lookup["taps"])
                    for (size_t c = 0; c < 4; ++c) sum[c] += tap["weight"].get<double>() * tap["value"][c].get<double>();
                for (size_t c = 0; c < 4; ++c) EXPECT_NEAR(lookup["result"][c].get<double>(), sum[c], 1e-5) << lookup["map"];
            }
            const Json& surface = sample["surface"];
            if (surface.is_null()) continue;
            // Values to base colour: the factor of glass is 1, 0.5, 0.25; that of the others is white.
            const std::array<float, 3> factor = surface["material_name"] == "glass" ? Radiance{1, 0.5f, 0.25f} : Radiance{1, 1, 1};
            for (size_t c = 0; c < 3; ++c)
                EXPECT_EQ(surface["base_color"][c].get<float>(), std::max(0.0f, factor[c] * surface["maps"][0]["result"][c].get<float>()));
            // Base colour or light to radiance.
            if (!surface.contains("light")) {
                EXPECT_EQ(surface["base_color"], sample["radiance"]);
                ++unlit;
                continue;
            }
            Radiance sum = radiance_of(surface["light"][0]["radiance"]);
            for (size_t i = 1; i < surface["light"].size(); ++i)
                for (size_t c = 0; c < 3; ++c) sum[c] += surface["light"][i]["radiance"][c].get<float>();
            EXPECT_EQ(sum, radiance_of(sample["radiance"])) << surface["light"];
            ++lit;
        }
    }
    EXPECT_GT(lit, 5);
    EXPECT_GT(unlit, 5);
}

TEST_F(ExplainTest, SaysWhyAlphaLetsThroughOrCovers) {
    int mask[2] = {}, blend[2] = {};
    const auto check = [&](const Json& surface) {
        const float alpha = surface["alpha"].get<float>();
        const float factor = surface["material_name"] == "glass" ? 0.75f : 1.0f;
        EXPECT_EQ(alpha, surface["maps"][0]["result"][3].get<float>() * factor);
        const bool covers = surface["covers"];
        if (surface["alpha_mode"] == "MASK") {
            EXPECT_EQ(covers, alpha >= surface["cutoff"].get<float>());
            ++mask[covers];
        } else {
            EXPECT_EQ(covers, surface["random"]["number"].get<float>() < alpha);
            EXPECT_EQ(surface["random"]["surface"].get<uint32_t>(), 1 + surface["triangle"].get<uint32_t>());
            ++blend[covers];
        }
    };
    for (int x = 14; x < 30; x += 2) {
        const Json json = explain(scene_, x, 15, {"--spp", "8", "--pixel-filter", "tent"});
        for (const Json& sample : json["samples"]) {
            for (const Json& candidate : sample["let_through"]) {
                EXPECT_EQ(candidate["covers"], false);
                check(candidate);
            }
            if (!sample["surface"].is_null() && sample["surface"].contains("alpha")) {
                EXPECT_EQ(sample["surface"]["covers"], true);
                check(sample["surface"]);
            }
        }
    }
    for (const int count : {mask[0], mask[1], blend[0], blend[1]}) EXPECT_GT(count, 3);
}

TEST_F(ExplainTest, ASampleAloneIsTheSameSample) {
    for (const char* area : {"pixel", "sample"}) {
        const Words options{"--spp", "7", "--footprint", area, "--pixel-jitter", "pixel"};
        const Json all = explain(scene_, 20, 14, options);
        for (const int n : {0, 4, 6}) {
            const Json one = explain(scene_, 20, 14, joined(options, {"--sample", std::to_string(n)}));
            ASSERT_EQ(one["samples"].size(), 1u);
            EXPECT_EQ(one["samples"][0], all["samples"][size_t(n)]) << area;
            EXPECT_FALSE(one.contains("mean"));
        }
    }
    // Beyond --spp it is that of the shortest render that has it.
    EXPECT_EQ(explain(scene_, 20, 14, {"--sample", "4"}), explain(scene_, 20, 14, {"--sample", "4", "--spp", "5"}));
}

TEST_F(ExplainTest, AsksForAsManyTapsAsRenderCounts) {
    for (const auto& [x, y] : {std::pair{20, 14}, {23, 17}, {27, 20}}) {
        const Words options{"--spp", "6", "--aniso", "2"};
        size_t lookups = 0, taps = 0;
        const Json json = explain(scene_, x, y, options);
        for (const Json& sample : json["samples"])
            for (const Json& lookup : lookups_of(sample)) ++lookups, taps += lookup["taps"].size();
        const Words files{"render", scene_, "-o", folder_ / "pixel.exr", "--count", "--stats", folder_ / "stats.json"};
        const Words crop{"--crop", std::to_string(x) + "," + std::to_string(y) + ",1,1"};
        ASSERT_EQ(run(joined(files, frame_words(joined(options, crop)))).code, kDone);
        const Json counted = Json::parse(test::read_file(folder_ / "stats.json"))["texture"];
        EXPECT_EQ(counted["lookups"].get<size_t>(), lookups);
        EXPECT_EQ(counted["taps"].get<size_t>(), taps);
        EXPECT_GT(taps, 0u);
    }
}

TEST(ExplainNumbers, AreThoseOfTheirAddresses) {
    using texunit::Dimension;
    const auto random_of = [](const char* scene, const char* pixel, const Words& more) {
        const test::Outcome outcome = run(
            joined({"explain", scene, "--json", "--size", "96x54", "--pixel", pixel, "--sample", "3", "--spp", "4", "--seed", "5"}, more));
        EXPECT_EQ(outcome.code, kDone) << outcome.err;
        const Json json = Json::parse(outcome.out);
        return json["samples"][0]["surface"].value("numbers", Json());
    };
    const auto expect = [](const Json& random, const char* name, uint32_t x, uint32_t y, Dimension dimension) {
        const float number = texunit::random_float({.x = x, .y = y, .sample = 3, .dimension = dimension, .seed = 5});
        EXPECT_EQ(random.value(name, -1.0f), number) << name;
    };
    const Json stone = random_of("triplanar", "58,30",
                                 {"--estimator", "reservoir", "--shadow-taps", "one", "--mip", "none", "--texture-jitter", "perspective"});
    EXPECT_EQ(stone.size(), 5u) << stone;
    expect(stone, "plane", 58, 30, Dimension::Plane);
    expect(stone, "light", 58, 30, Dimension::Light);
    expect(stone, "light y", 58, 30, Dimension::LightY);
    expect(stone, "texture x", 58, 30, Dimension::TextureX);
    expect(stone, "texture y", 58, 30, Dimension::TextureY);
    const Json ground = random_of("layers", "48,40", {"--blend", "draw"});
    EXPECT_EQ(ground.size(), 1u) << ground;
    expect(ground, "layer", 48, 40, Dimension::Layer);
    const Json level = random_of("plane", "48,40", {"--baseline", "oiio-stochastic"});
    EXPECT_EQ(level.size(), 1u) << level;
    expect(level, "level", 48, 40, Dimension::Level);
    EXPECT_TRUE(random_of("plane", "48,40", {}).is_null());
}

TEST_F(ExplainTest, TellsTheNumberThatCoversBesideOthers) {
    const Json json = explain(scene_, 20, 14, {"--spp", "16", "--mip", "none", "--texture-jitter", "affine"});
    int blended = 0;
    for (const Json& sample : json["samples"]) {
        const Json& surface = sample["surface"];
        EXPECT_EQ(surface["numbers"].size(), 2u) << surface;
        if (surface.value("alpha_mode", "") != "BLEND") continue;
        ++blended;
        EXPECT_EQ(surface["random"]["dimension"], "coverage") << surface;
    }
    EXPECT_GT(blended, 0);
}

TEST_F(ExplainTest, TellsHundredsOfSamples) {
    // More than are gathered at once.
    const Json json = explain(scene_, 31, 8, {"--spp", "300"});
    ASSERT_EQ(json["samples"].size(), 300u);
    for (size_t n = 0; n < 300; ++n) EXPECT_EQ(json["samples"][n]["sample"], n);
    EXPECT_EQ(json["mean"], json["rendered"]);
}

TEST_F(ExplainTest, TellsWhereTheSampleLies) {
    const Json frame = explain(scene_, 20, 14, {"--spp", "2"});
    EXPECT_EQ(frame["samples"][0]["offset"], (Json{0.5, 0.5}));
    EXPECT_EQ(frame["samples"][0]["sequence_shift"], (Json{0.0, 0.0}));
    EXPECT_NE(frame["samples"][1]["offset"], (Json{0.5, 0.5}));
    const Json pixel = explain(scene_, 20, 14, {"--pixel-jitter", "pixel"});
    EXPECT_NE(pixel["samples"][0]["sequence_shift"], (Json{0.0, 0.0}));
    EXPECT_NE(pixel["samples"][0]["offset"], explain(scene_, 21, 14, {"--pixel-jitter", "pixel"})["samples"][0]["offset"]);
}

TEST_F(ExplainTest, TellsPeopleTheSame) {
    const auto told = [&](const char* pixel, const Words& more) {
        const test::Outcome outcome = run(joined({"explain", scene_, "--pixel", pixel}, frame_words(more)));
        EXPECT_EQ(outcome.code, kDone) << outcome.err;
        return outcome.out;
    };
    const std::string text = told("20,14", {"--spp", "8", "--exposure", "1"});
    for (const char* part : {"Pixel 20,14 of 40x30, scene ",
                             "Sample 7\n",
                             "In front: triangle ",
                             "material 1 'leaf'\n",
                             "lets through",
                             "random number ",
                             "Surface: triangle ",
                             "Barycentrics: ",
                             "m along the view axis",
                             "Map: base colour\n",
                             "Level of detail: ",
                             "weight",
                             "Value: ",
                             "Base colour: ",
                             "Light, added up in this order:\n",
                             "--light: ",
                             "weight 1/8\n",
                             "\nMean: ",
                             ", the same bits\n",
                             "Displayed in 8 bits (exposure 1, aces, srgb): "})
        EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
    EXPECT_EQ(text.find("DIFFERS"), std::string::npos);

    const std::string background = told("0,0", {});
    EXPECT_NE(background.find("Background: no surface is seen\n"), std::string::npos) << background;
    EXPECT_NE(background.find("Radiance: 0.1,0.2,0.4, weight 1/1\n"), std::string::npos) << background;
}

TEST_F(ExplainTest, TellsTheCodesThatAnImageOf8BitsHolds) {
    const Words display{"--tonemap", "reinhard", "--transfer", "srgb", "--exposure", "0.5"};
    const std::string image = folder_ / "frame.png";
    ASSERT_EQ(run(joined({"render", scene_, "-o", image}, frame_words(display))).code, kDone);
    const shading::Image codes = scenes::read_image(image, false);
    const Json told = explain(scene_, 24, 11, display)["display"];
    for (int c = 0; c < 3; ++c) EXPECT_EQ(told[size_t(c)].get<float>() / 255, codes.pixel(24, 11)[c]);
}

TEST_F(ExplainTest, WrongUsageIsExitCode2) {
    const auto failed = [&](const Words& more, const char* part) {
        return why_not_failed(run(joined({"explain", scene_}, more)), kWrongUsage, part);
    };
    EXPECT_EQ(failed({}, "--pixel X,Y is missing"), "");
    EXPECT_EQ(failed({"--pixel", "3"}, "X,Y"), "");
    EXPECT_EQ(failed({"--pixel", "-1,3"}, "--pixel"), "");
    EXPECT_EQ(failed({"--pixel", "40,3", "--size", "40x30"}, "outside the image of 40x30 (0,0 to 39,29)"), "");
    EXPECT_EQ(failed({"--pixel", "3,30", "--size", "40x30"}, "outside the image"), "");
    EXPECT_EQ(failed({"--pixel", "3,3", "--crop", "4,4,9,9"}, "outside --crop 4,4,9,9"), "");
    EXPECT_EQ(failed({"--pixel", "3,3", "--sample", "-1"}, "--sample"), "");
    EXPECT_EQ(failed({"--pixel", "3,3", "--sampel", "1"}, "'--sample'"), "");
    EXPECT_EQ(why_not_failed(run({"explain", "--pixel", "3,3"}), kWrongUsage, "missing argument SCENE"), "");
    EXPECT_EQ(why_not_failed(run({"explain", folder_ / "none.glb", "--pixel", "3,3"}), kBadInput, "none.glb"), "");
}

TEST_F(ExplainTest, SaysThatCountingChangesNothing) {
    const test::Outcome outcome = run(joined({"explain", scene_, "--pixel", "20,14"}, frame_words({"--fetch-model", "quad"})));
    EXPECT_EQ(outcome.code, kDone);
    EXPECT_NE(outcome.err.find("--fetch-model"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace rawtexel::cli
