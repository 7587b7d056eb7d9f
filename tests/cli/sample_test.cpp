// One lookup, from words to taps.
#include "cli/command.h"
#include "scenes/image_io.h"
#include "tests/cli/program_runner.h"
#include "tests/cli/sampled_lookup.h"
#include "tests/cli/texture_files.h"
#include "texunit/srgb.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

namespace rawtexel::cli {
namespace {

using test::code_of;
using test::expect_adds_up;
using test::FileFormat;
using test::keys_of;
using test::run;
using test::sample;
using test::sample_words;
using test::TemporaryFolder;
using test::why_not_failed;
using Json = nlohmann::json;

std::string at_file(const std::string& path) { return std::string("@").append(path); }

TEST(Sample, TellsEveryTapOfALookup) {
    const TemporaryFolder folder;
    const std::string texture = test::write_dds(folder, "t.dds", {.width = 16, .height = 8, .levels = 5}, FileFormat::Rgba8Unorm);
    // 0.25 texels right of the centre of column 3, in the middle between rows 4 and 5.
    const Json lookup = sample(texture, {"--uv", "0.234375,0.625"});
    EXPECT_EQ(keys_of(lookup), (std::set<std::string>{"lod", "anisotropy", "precision", "taps", "result"}));
    EXPECT_EQ(lookup["lod"], 0.0);
    EXPECT_EQ(lookup["anisotropy"], 1.0);
    EXPECT_EQ(lookup["precision"], "exact");
    ASSERT_EQ(lookup["taps"].size(), 4u);
    const std::array<std::array<int, 2>, 4> places{{{3, 4}, {4, 4}, {3, 5}, {4, 5}}};
    for (size_t i = 0; i < 4; ++i) {
        const Json& tap = lookup["taps"][i];
        EXPECT_EQ(keys_of(tap), (std::set<std::string>{"level", "x", "y", "weight", "value"}));
        EXPECT_EQ(tap["level"], 0);
        EXPECT_EQ(tap["x"], places[i][0]);
        EXPECT_EQ(tap["y"], places[i][1]);
        EXPECT_EQ(tap["weight"], i % 2 == 0 ? 0.375 : 0.125);
        for (int c = 0; c < 4; ++c)
            EXPECT_EQ(float(tap["value"][size_t(c)]), float(code_of(0, 0, places[i][0], places[i][1], c) / 255.0)) << i << ' ' << c;
    }
    expect_adds_up(lookup, "bilinear");
}

TEST(Sample, AddsUpForEveryKernelWrapAndShape) {
    const TemporaryFolder folder;
    const auto [flat, array, volume, cube] = test::write_shapes(folder);
    const std::vector<std::string> wraps{"repeat", "mirror,clamp", "clamp", "border", "mirror-once,repeat"};
    size_t n = 0;
    for (const char* filter : {"nearest", "bilinear", "quadratic", "bspline", "mitchell", "mitchell:2,-1", "catmull-rom", "lanczos2",
                               "lanczos3", "gaussian", "gaussian:1.5", "gaussian-point"}) {
        const auto options = [&](std::vector<std::string> place) {
            place.insert(place.end(), {"--filter", filter});
            // Cube maps have no edges.
            if (place[0] == "--direction") return place;
            const std::string& wrap = wraps[n++ % wraps.size()];
            place.insert(place.end(), {"--wrap", wrap});
            if (wrap == "border") place.insert(place.end(), {"--border", "0.5,1,2,0.25"});
            return place;
        };
        expect_adds_up(sample(flat, options({"--uv", "-0.07,1.31", "--ddx", "0.11,0.02", "--ddy", "-0.01,0.3"})), filter);
        expect_adds_up(sample(flat, options({"--uv", "0.93,0.11", "--ddx", "0.4,0.1", "--ddy", "0,0.1", "--aniso", "8"})), filter);
        expect_adds_up(sample(array, options({"--uv", "0.4,0.9", "--lod", "0.7", "--layer", "2"})), filter);
        expect_adds_up(sample(volume, options({"--uvw", "0.3,0.99,0.02", "--lod", "0.4"})), filter);
        expect_adds_up(sample(cube, options({"--direction", "-1,0.98,0.3", "--lod", "0.4", "--layer", "1"})), filter);
    }
    expect_adds_up(sample(flat, {"--uv", "0.3,0.6", "--ddx", "0.4,0.1", "--ddy", "0,0.1", "--ewa"}), "ewa");
}

TEST(Sample, LeavesOutTapsOfWeightZero) {
    const TemporaryFolder folder;
    const std::string texture = test::write_dds(folder, "t.dds", {.width = 8, .height = 8}, FileFormat::Rgba8Unorm);
    // At a texel's centre bilinear and Catmull-Rom read that texel alone; a whole level of detail reads one level.
    for (const char* filter : {"bilinear", "catmull-rom", "nearest"}) {
        const Json lookup = sample(texture, {"--uv", "0.3125,0.8125", "--filter", filter, "--lod", "0"});
        ASSERT_EQ(lookup["taps"].size(), 1u) << filter;
        EXPECT_EQ(lookup["taps"][0]["x"], 2);
        EXPECT_EQ(lookup["taps"][0]["y"], 6);
        EXPECT_EQ(lookup["taps"][0]["weight"], 1.0);
        EXPECT_EQ(lookup["taps"][0]["value"], lookup["result"]);
    }
}

TEST(Sample, TakesALevelOfDetailAsItIs) {
    const TemporaryFolder folder;
    const std::string texture = test::write_dds(folder, "t.dds", {.width = 16, .height = 16, .levels = 5}, FileFormat::Rgba8Unorm);
    const auto weights = [&](const std::string& lod, const std::vector<std::string>& more) {
        std::vector<std::string> words{"--uv", "0.5,0.5", "--filter", "nearest", "--lod", lod};
        words.insert(words.end(), more.begin(), more.end());
        std::array<double, 5> of_level{};
        const Json lookup = sample(texture, words);
        for (const Json& tap : lookup["taps"]) of_level[tap["level"]] += double(tap["weight"]);
        return of_level;
    };
    EXPECT_EQ(weights("1.25", {}), (std::array<double, 5>{0, 0.75, 0.25, 0, 0}));
    EXPECT_EQ(weights("2", {}), (std::array<double, 5>{0, 0, 1, 0, 0}));
    EXPECT_EQ(weights("-3", {}), (std::array<double, 5>{1, 0, 0, 0, 0}));
    EXPECT_EQ(weights("77", {}), (std::array<double, 5>{0, 0, 0, 0, 1}));
    EXPECT_EQ(weights("1.25", {"--lod-bias", "1.5"}), (std::array<double, 5>{0, 0, 0.25, 0.75, 0})) << "2.75";
    EXPECT_EQ(weights("1.25", {"--mip", "nearest"}), (std::array<double, 5>{0, 1, 0, 0, 0}));
    EXPECT_EQ(weights("1.25", {"--max-lod", "0.5"}), (std::array<double, 5>{0.5, 0.5, 0, 0, 0}));
    EXPECT_EQ(weights("1.25", {"--min-lod", "3"}), (std::array<double, 5>{0, 0, 0, 1, 0}));
    EXPECT_EQ(weights("1.001", {"--precision", "gpu"}), (std::array<double, 5>{0, 1, 0, 0, 0})) << "to 1/256";
}

TEST(Sample, TakesLevelAndRatioFromDerivatives) {
    const TemporaryFolder folder;
    const std::string texture = test::write_dds(folder, "t.dds", {.width = 64, .height = 32, .levels = 7}, FileFormat::Rgba8Unorm);
    // Four texels to the right, one down.
    const std::vector<std::string> derivatives{"--uv", "0.4,0.4", "--ddx", "0.0625,0", "--ddy", "0,0.03125"};
    EXPECT_NEAR(double(sample(texture, derivatives)["lod"]), 2, 1e-6);
    std::vector<std::string> probes = derivatives;
    probes.insert(probes.end(), {"--aniso", "16"});
    const Json anisotropic = sample(texture, probes);
    EXPECT_NEAR(double(anisotropic["lod"]), 0, 1e-6);
    EXPECT_NEAR(double(anisotropic["anisotropy"]), 4, 1e-6);
    EXPECT_GE(anisotropic["taps"].size(), 4u * 2);
    std::vector<std::string> biased = derivatives;
    biased.insert(biased.end(), {"--lod-bias", "-0.5"});
    EXPECT_NEAR(double(sample(texture, biased)["lod"]), 1.5, 1e-6);
}

TEST(Sample, WrapsEachAxisAndTakesTheBorder) {
    const TemporaryFolder folder;
    const std::string texture = test::write_dds(folder, "t.dds", {.width = 8, .height = 8}, FileFormat::Rgba8Unorm);
    const auto texel = [&](const std::string& wrap) {
        const Json tap = sample(texture, {"--uv", "1.06,-0.3", "--filter", "nearest", "--wrap", wrap})["taps"][0];
        return std::array<int, 2>{tap["x"], tap["y"]};
    };
    EXPECT_EQ(texel("repeat"), (std::array{0, 5}));
    EXPECT_EQ(texel("mirror"), (std::array{7, 2}));
    EXPECT_EQ(texel("clamp"), (std::array{7, 0}));
    EXPECT_EQ(texel("repeat,clamp"), (std::array{0, 0}));
    EXPECT_EQ(texel("clamp,mirror"), (std::array{7, 2}));
    EXPECT_EQ(texel("mirror-once"), (std::array{7, 2}));
    const Json border = sample(texture, {"--uv", "1.06,-0.3", "--filter", "nearest", "--wrap", "border", "--border", "0.25,-1,7,1"});
    EXPECT_EQ(border["result"], Json({0.25, -1.0, 7.0, 1.0}));
    EXPECT_EQ(border["taps"][0]["border"], true);
    EXPECT_TRUE(border["taps"][0]["x"].is_null() && border["taps"][0]["y"].is_null());
}

TEST(Sample, NamesLayersFacesAndSlices) {
    const TemporaryFolder folder;
    const auto taps = [&](const texunit::Shape& shape, const std::vector<std::string>& place) {
        std::vector<std::string> words = place;
        words.insert(words.end(), {"--filter", "nearest", "--mip", "none"});
        return sample(test::write_dds(folder, "t.dds", shape, FileFormat::Rgba8Unorm), words)["taps"][0];
    };
    const Json layer = taps({.width = 4, .height = 4, .layers = 3}, {"--uv", "0.4,0.9", "--layer", "2"});
    EXPECT_EQ(layer["layer"], 2);
    EXPECT_EQ(float(layer["value"][0]), float(code_of(0, 2, 1, 3, 0) / 255.0));
    const Json slice = taps({.width = 4, .height = 4, .depth = 4}, {"--uvw", "0.4,0.9,0.6"});
    EXPECT_EQ(slice["z"], 2);
    EXPECT_EQ(float(slice["value"][1]), float(code_of(0, 2, 1, 3, 1) / 255.0));
    // Down at the floor: face -y; s along +x, t towards -z.
    const Json face = taps({.width = 4, .height = 4, .layers = 6, .cube = true}, {"--direction", "0.6,-1,0.1"});
    EXPECT_EQ(face["face"], 3);
    EXPECT_FALSE(face.contains("layer"));
    EXPECT_EQ(float(face["value"][2]), float(code_of(0, 3, 3, 1, 2) / 255.0));
    const Json cube = taps({.width = 4, .height = 4, .layers = 12, .cube = true}, {"--direction", "0.6,-1,0.1", "--layer", "1"});
    EXPECT_EQ(cube["face"], 3);
    EXPECT_EQ(cube["layer"], 1);
    EXPECT_EQ(float(cube["value"][2]), float(code_of(0, 9, 3, 1, 2) / 255.0));
}

TEST(Sample, QuantisesFractionsInGpuPrecision) {
    const TemporaryFolder folder;
    const std::string texture = test::write_dds(folder, "t.dds", {.width = 8, .height = 8}, FileFormat::Rgba8Unorm);
    const auto odd_weights = [&](const char* precision) {
        const Json lookup = sample(texture, {"--uv", "0.3333,0.3125", "--precision", precision});
        EXPECT_EQ(lookup["precision"], precision);
        return std::ranges::count_if(lookup["taps"], [](const Json& tap) { return std::fmod(double(tap["weight"]) * 256, 1) != 0; });
    };
    EXPECT_EQ(odd_weights("gpu"), 0);
    EXPECT_EQ(odd_weights("exact"), 2);
}

TEST(Sample, ReadsCodesInTheColorSpaceAskedFor) {
    const TemporaryFolder folder;
    scenes::write_8bit(folder / "grey.png", 1, 1, 3, std::vector<uint8_t>{188, 10, 255}, {});
    const auto red = [&](const std::string& texture, const std::vector<std::string>& more) {
        std::vector<std::string> words{"--uv", "0.5,0.5"};
        words.insert(words.end(), more.begin(), more.end());
        return float(sample(texture, words)["result"][0]);
    };
    const auto linear = [](int code) { return float(code / 255.0); };
    const auto decoded = [](int code) { return float(texunit::srgb_to_linear(code / 255.0)); };
    EXPECT_EQ(red(folder / "grey.png", {}), linear(188));
    EXPECT_EQ(red(folder / "grey.png", {"--color-space", "linear"}), linear(188));
    EXPECT_EQ(red(folder / "grey.png", {"--color-space", "srgb"}), decoded(188));
    // Containers declare theirs.
    const std::string srgb = test::write_dds(folder, "srgb.dds", {}, FileFormat::Rgba8Srgb);
    EXPECT_EQ(red(srgb, {}), decoded(code_of(0, 0, 0, 0, 0)));
    EXPECT_EQ(red(srgb, {"--color-space", "linear"}), linear(code_of(0, 0, 0, 0, 0)));
    const std::string unorm = test::write_dds(folder, "unorm.dds", {}, FileFormat::Rgba8Unorm);
    EXPECT_EQ(red(unorm, {"--color-space", "srgb"}), decoded(code_of(0, 0, 0, 0, 0)));
}

TEST(Sample, TakesManyLookupsFromAFile) {
    const TemporaryFolder folder;
    const std::string texture = test::write_dds(folder, "t.dds", {.width = 16, .height = 16, .levels = 5}, FileFormat::Rgba8Unorm);
    const std::string places = folder.write("places.txt", "0.1 0.2\n\n\t0.5 0.5 0.25 0.1 0 0.125 \r\n-1e-3 7");
    const test::Outcome outcome = run({"sample", texture, "--uv", at_file(places), "--aniso", "4"});
    ASSERT_EQ(outcome.code, kDone) << outcome.err;
    std::istringstream lines(outcome.out);
    std::vector<std::string> found;
    for (std::string line; std::getline(lines, line);) found.push_back(line);
    ASSERT_EQ(found.size(), 3u) << outcome.out;
    EXPECT_EQ(Json::parse(found[0]), sample(texture, {"--uv", "0.1,0.2", "--aniso", "4"}));
    EXPECT_EQ(Json::parse(found[1]), sample(texture, {"--uv", "0.5,0.5", "--ddx", "0.25,0.1", "--ddy", "0,0.125", "--aniso", "4"}));
    EXPECT_EQ(Json::parse(found[2]), sample(texture, {"--uv", "-1e-3,7", "--aniso", "4"}));
    // Lines without derivatives take those of the options.
    const test::Outcome wide =
        run({"sample", texture, "--uv", at_file(places), "--ddx", "0.5,0", "--ddy", "0,0.5", "--aniso", "4", "--json"});
    std::istringstream wide_lines(wide.out);
    std::string first, second;
    std::getline(wide_lines, first);
    std::getline(wide_lines, second);
    EXPECT_EQ(Json::parse(first)["lod"], 3.0);
    EXPECT_EQ(Json::parse(second), Json::parse(found[1]));
}

TEST(Sample, TellsPeopleThePrecisionTheLevelsAndTheTaps) {
    const TemporaryFolder folder;
    const std::string texture = test::write_dds(folder, "t.dds", {.width = 16, .height = 16, .levels = 2}, FileFormat::Rgba8Unorm);
    const test::Outcome outcome = run({"sample", texture, "--uv", "0.3,0.3", "--lod", "1.25"});
    ASSERT_EQ(outcome.code, kDone) << outcome.err;
    for (const char* part :
         {"rgba8-unorm, 16x16, 5 levels, 2 of them in the file", "Sampler: bilinear, mip linear, wrap repeat,repeat",
          "Precision: exact (fractions of texels and levels are not quantised)", "Coordinates: 0.3,0.3", "Level of detail: 1.25",
          "level 1, 8x8 texels: weight 0.75 in 4 taps", "level 2, 4x4 texels: weight 0.25 in 4 taps", "weight", "alpha", "sum", "result"})
        EXPECT_NE(outcome.out.find(part), std::string::npos) << part << " in\n" << outcome.out;
    const std::string single = test::write_dds(folder, "1.dds", {}, FileFormat::Rgba8Unorm);
    EXPECT_NE(run({"sample", single, "--uv", "0.3,0.3"}).out.find("rgba8-unorm, 1x1, 1 level\n"), std::string::npos);
    EXPECT_NE(run({"sample", texture, "--uv", "0.3,0.3", "--precision", "gpu"})
                  .out.find("Precision: gpu (fractions of texels and levels in steps of 1/256)"),
              std::string::npos);
}

TEST(Sample, WrongUsageIsExitCode2) {
    const TemporaryFolder folder;
    const std::string flat = test::write_dds(folder, "flat.dds", {.width = 4, .height = 4, .layers = 2}, FileFormat::Rgba8Unorm);
    const std::string volume = test::write_dds(folder, "volume.dds", {.width = 4, .height = 4, .depth = 2}, FileFormat::Rgba8Unorm);
    const std::string cube =
        test::write_dds(folder, "cube.dds", {.width = 4, .height = 4, .layers = 6, .cube = true}, FileFormat::Rgba8Unorm);
    const std::initializer_list<std::tuple<std::string, std::vector<std::string>, const char*>> cases{
        {flat, {}, "--uv U,V is missing"},
        {flat, {"--uv", "0.5"}, "--uv: '0.5' is not U,V"},
        {flat, {"--uv", "@"}, "--uv: '@' names no file"},
        {flat, {"--uv", "0.5,0.5,0.5"}, "is not U,V"},
        {flat, {"--uv", "0.5,nan"}, "is not U,V"},
        {flat, {"--uv", "0.5,0.5", "--uvw", "0,0,0"}, "--uv and --uvw exclude each other"},
        {flat, {"--uvw", "0,0,0"}, "is flat (allowed: --uv U,V)"},
        {volume, {"--uv", "0,0"}, "is a volume (allowed: --uvw U,V,W)"},
        {cube, {"--uv", "0,0"}, "is a cube map (allowed: --direction X,Y,Z)"},
        {volume, {"--uvw", "0,0,0", "--ddx", "1,0,0", "--ddy", "0,1,0", "--aniso", "4"}, "--aniso: "},
        {cube, {"--direction", "0,0,1", "--ewa"}, "--ewa: "},
        {flat, {"--uv", "0,0", "--layer", "2"}, "has no layer 2 (0 to 1)"},
        {cube, {"--direction", "0,0,1", "--layer", "1"}, "has no layer 1 (0 to 0)"},
        {flat, {"--uv", "0,0", "--ddx", "1,0"}, "--ddx without --ddy"},
        {flat, {"--uv", "0,0", "--ddx", "1,0,0", "--ddy", "0,1"}, "--ddx: '1,0,0' is not U,V"},
        {flat, {"--uv", "0,0", "--lod", "1", "--ddx", "1,0", "--ddy", "0,1"}, "--lod and --ddx exclude each other"},
        {flat, {"--uv", "0,0", "--lod", "1", "--ewa"}, "--lod and --ewa exclude each other"},
        {flat, {"--uv", "0,0", "--lod", "1", "--aniso", "4"}, "--lod and --aniso exclude each other"},
        {flat, {"--uv", "0,0", "--aniso", "4:0.25", "--ewa"}, "--aniso and --ewa exclude each other"},
        {cube, {"--direction", "0,0,1", "--wrap", "clamp"}, "--wrap: "},
        {cube, {"--direction", "0,0,1", "--border", "1,1,1,1"}, "is a cube map, which has no edges"},
        {flat, {"--uv", "0,0", "--border", "1,1,1,1"}, "--border without --wrap border"},
        {flat, {"--uv", "0,0", "--wrap", "clamp,repeat", "--border", "1,1,1,1"}, "--border without --wrap border"},
        {volume, {"--uvw", "0,0,0", "--wrap", "clamp", "--border", "1,1,1,1"}, "--border without --wrap border"},
        {flat, {"--uv", "0,0", "--wrap", "clamp,clamp,clamp"}, "is flat (allowed: S[,T])"},
        {flat, {"--uv", "0,0", "--lod", "1", "--mip", "none"}, "--lod: --mip none reads level 0"},
        {flat, {"--uv", "0,0", "--min-lod", "1", "--mip", "none"}, "--min-lod: --mip none reads level 0"},
        {flat, {"--uv", "0,0", "--lod", "1", "--lod-rule", "exact"}, "--lod and --lod-rule exclude each other"},
        {flat, {"--uv", "0,0", "--lod", "1", "--lod-rule", "d3d"}, "--lod and --lod-rule exclude each other"},
        {flat, {"--uv", "0,0", "--ewa", "--max-lod", "2"}, "--max-lod: --ewa reads level 0"},
        {flat, {"--uv", "0,0", "--ewa", "--filter", "bspline"}, "--filter: --ewa has kernel"},
        {cube, {"--direction", "0,0,0"}, "--direction: 0,0,0 is no direction"},
        {cube, {"--direction", "-0,0,0e9"}, "--direction: 0,0,0 is no direction"},
        {flat, {"--uv", "0,0", "--wrap", "repaet"}, "the nearest is 'repeat'"},
        {flat, {"--uv", "0,0", "--wrap", "repeat,repeat,repeat,repeat"}, "is not S[,T[,R]]"},
        {flat, {"--uv", "0,0", "--border", "1,2,3"}, "is not R,G,B,A"},
        {flat, {"--uv", "0,0", "--filter", "gaussian:99"}, "with SIGMA from 0.02 to 16"},
        {flat, {"--uv", "0,0", "--color-space", "rgb"}, "the nearest is 'srgb'"},
        {flat, {"--uv", "0,0", "--derivatives", "quad"}, "unknown option '--derivatives'"}};
    for (const auto& [texture, more, part] : cases) EXPECT_EQ(why_not_failed(run(sample_words(texture, more)), kWrongUsage, part), "");
    EXPECT_EQ(why_not_failed(run({"sample", "--uv", "0,0"}), kWrongUsage, "missing argument TEXTURE"), "");
}

TEST(Sample, TakesABorderOfAnyAxisThatHasOne) {
    const TemporaryFolder folder;
    const std::string flat = test::write_dds(folder, "flat.dds", {.width = 4, .height = 4}, FileFormat::Rgba8Unorm);
    const std::string volume = test::write_dds(folder, "v.dds", {.width = 4, .height = 4, .depth = 4}, FileFormat::Rgba8Unorm);
    const Json colour({0.25, 0.5, 0.75, 1.0});
    const auto result = [&](const std::string& texture, const std::vector<std::string>& more) {
        std::vector<std::string> words{"--border", "0.25,0.5,0.75,1"};
        words.insert(words.end(), more.begin(), more.end());
        const Json lookup = sample(texture, words);
        return lookup["result"];
    };
    EXPECT_EQ(result(flat, {"--uv", "1.5,0.5", "--wrap", "border,clamp"}), colour);
    EXPECT_EQ(result(flat, {"--uv", "0.5,1.5", "--wrap", "clamp,border"}), colour);
    EXPECT_EQ(result(volume, {"--uvw", "0.5,0.5,1.5", "--wrap", "clamp,clamp,border"}), colour);
}

TEST(Sample, BadInputIsExitCode3) {
    const TemporaryFolder folder;
    const std::string flat = test::write_dds(folder, "flat.dds", {.width = 4, .height = 4}, FileFormat::Rgba8Unorm);
    folder.write("short.dds", test::read_file(flat).substr(0, 150));
    folder.write("text.png", "no image at all");
    for (const std::string name : {"short.dds", "text.png", "missing.png", "missing.dds"})
        EXPECT_EQ(why_not_failed(run({"sample", folder / name, "--uv", "0,0"}), kBadInput, name), "");
    EXPECT_EQ(why_not_failed(run({"sample", folder.path(), "--uv", "0,0"}), kBadInput, folder.path()), "");
    EXPECT_EQ(why_not_failed(run({"sample", flat, "--uv", "0,0", "--max-texture-bytes", "63"}), kBadInput, "at most 63"), "");
    const std::initializer_list<std::pair<const char*, const char*>> files{
        {"0.5 0.5\n0.5 x\n", "places: line 2: 'x' is not a number"},
        {"0.5 0.5 1\n", "places: line 1: 3 numbers (allowed: 2 coordinates, or these and 4 derivatives)"},
        {"\n\n0.5 inf\n", "places: line 3: 'inf' is not a number"},
        {"\n \n", "places: no lookups"}};
    for (const auto& [text, part] : files) {
        const std::string places = folder.write("places", std::string_view(text));
        EXPECT_EQ(why_not_failed(run({"sample", flat, "--uv", at_file(places)}), kBadInput, part), "");
    }
    const std::string cube = test::write_dds(folder, "c.dds", {.width = 4, .height = 4, .layers = 6, .cube = true}, FileFormat::Rgba8Unorm);
    const std::string directions = folder.write("directions", "0 0 1\n0 1e-30 0\n0 0 1 0 0 0 0 0 0\n0 0 0 1 0 0 0 1 0\n");
    EXPECT_EQ(
        why_not_failed(run({"sample", cube, "--direction", at_file(directions)}), kBadInput, "directions: line 4: 0,0,0 is no direction"),
        "");
    const std::string places = folder.write("places", "0 0 1 0 0 1\n");
    EXPECT_EQ(why_not_failed(run({"sample", flat, "--uv", at_file(places), "--lod", "1"}), kBadInput, "which --lod takes the place of"),
              "");
    EXPECT_EQ(why_not_failed(run({"sample", flat, "--uv", at_file(folder / "none")}), kBadInput, "none"), "");
}

}  // namespace
}  // namespace rawtexel::cli
