#include "cli/command.h"
#include "scenes/image_io.h"
#include "tests/cli/program_runner.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <sstream>

namespace rawtexel::cli {
namespace {

using test::run;
using test::TemporaryFolder;
using test::why_not_failed;
using Json = nlohmann::ordered_json;
using Words = std::vector<std::string>;

Words with(Words words, const Words& more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

/// A small frame, silent, without the sky whose prefiltering would take most of the time.
const Words kFrame{"--size", "72x40", "--progress", "never", "--light", "0.2,-0.3,-1,3", "--environment", "none"};

/// profile.json of it.
Json profile(const std::string& folder, const std::string& scene, const Words& more = {}) {
    const test::Outcome outcome = run(with(with({"profile", scene, "-o", folder}, kFrame), more));
    EXPECT_EQ(outcome.code, kDone) << outcome.err;
    return Json::parse(test::read_file(folder + "/profile.json"));
}

uint64_t sum(const Json& bins) {
    uint64_t total = 0;
    for (const Json& bin : bins) total += bin.get<uint64_t>();
    return total;
}

uint64_t moment(const Json& bins) {
    uint64_t total = 0;
    for (size_t i = 0; i < bins.size(); ++i) total += i * bins[i].get<uint64_t>();
    return total;
}

std::vector<std::vector<std::string>> read_csv(const std::string& path) {
    std::istringstream file(test::read_file(path));
    std::vector<std::vector<std::string>> lines;
    for (std::string line; std::getline(file, line);) {
        std::vector<std::string>& fields = lines.emplace_back(1);
        for (const char c : line)
            if (c == ',')
                fields.emplace_back();
            else
                fields.back() += c;
    }
    return lines;
}

TEST(Profile, WritesItsFilesAndNothingElse) {
    const TemporaryFolder folder;
    profile(folder / "out", "magnify");
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder / "out")) names.push_back(entry.path().filename());
    std::ranges::sort(names);
    EXPECT_EQ(names, (Words{"counts.exr", "heat-anisotropy.png", "heat-blocks_first.png", "heat-l1_miss.png", "heat-l2_miss.png",
                            "heat-level.png", "heat-lines_first.png", "heat-lines_pixel.png", "heat-samples.png",
                            "heat-texels_requested.png", "index.html", "profile.json", "render.png", "textures.csv"}));
    EXPECT_EQ(folder.entries(), Words{"out"});
}

TEST(Profile, CountsWhatRenderCounts) {
    const TemporaryFolder folder;
    const Words cache{"--cache", "l1=4K:4", "--fetch-model", "forward"};
    const Json json = profile(folder / "out", "font", with(cache, {"--trace", folder / "p.zst"}));
    const Words render_words{"render",   "font",           "-o",      folder / "r.png", "--stats", folder / "r.json",
                             "--counts", folder / "r.exr", "--trace", folder / "r.zst"};
    ASSERT_EQ(run(with(with(render_words, kFrame), cache)).code, kDone);
    const Json render = Json::parse(test::read_file(folder / "r.json"));
    for (const char* key : {"lookup", "image", "geometry", "fetches", "texture", "textures"}) EXPECT_EQ(json[key], render[key]) << key;
    EXPECT_EQ(test::read_file(folder / "p.zst"), test::read_file(folder / "r.zst"));
    EXPECT_EQ(scenes::read_image(folder / "out/counts.exr", false).values, scenes::read_image(folder / "r.exr", false).values);
    EXPECT_EQ(scenes::read_image(folder / "out/render.png", false).values, scenes::read_image(folder / "r.png", false).values);
}

TEST(Profile, TheSameCommandGivesTheSameButForTimes) {
    const TemporaryFolder folder;
    const auto without_times = [&] {
        Json json = profile(folder / "out", "metal-edge", {"--spp", "2", "--compare-with", "--filter nearest --mip nearest"});
        for (const char* key : {"frame_s", "time_s"}) {
            EXPECT_EQ(json.erase(key), 1u);
            EXPECT_EQ(json["compare_with"][0].erase(key), 1u);
        }
        return json;
    };
    const Json first = without_times();
    EXPECT_EQ(first, without_times());
    EXPECT_FALSE(first["memory_bytes"].contains("peak_rss"));
    EXPECT_GT(first["memory_bytes"]["textures_decoded"], 0);
}

TEST(Profile, HistogramsHoldEveryLookupOnce) {
    const TemporaryFolder folder;
    const std::pair<std::string, Words> cases[] = {
        {"magnify", {"--aniso", "16", "--spp", "2"}},
        {"font", {"--fetch-model", "quad"}},
        {"metal-edge", {"--order", "after"}},
        {"triplanar", {"--estimator", "reservoir", "--blend", "all"}},
        {"magnify", {"--estimator", "reservoir", "--filter", "lanczos2", "--taps", "3"}},
        {"metal-edge", {"--estimator", "reservoir", "--random", "per-map"}},
    };
    for (const auto& [scene, more] : cases) {
        const Json json = profile(folder / "out", scene, more);
        const Json texture = json["texture"], histograms = json["histograms"];
        for (const char* kind : {"level", "anisotropy", "texels"})
            EXPECT_EQ(sum(histograms[kind]), texture["lookups"].get<uint64_t>()) << scene << " " << kind;
        EXPECT_EQ(moment(histograms["texels"]), texture["texels_requested"].get<uint64_t>()) << scene;
        EXPECT_GT(texture["lookups"], 0) << scene;
    }
}

TEST(Profile, HistogramsTellKernelsLevelsAndRatios) {
    const TemporaryFolder folder;
    const std::string quad = test::write_quad(folder);
    const auto histograms = [&](const Words& more) {
        return profile(folder / "out", quad, with({"--mip", "nearest"}, more))["histograms"];
    };
    for (const auto& [kernel, texels] : {std::pair{"nearest", 1u}, {"bilinear", 4u}, {"quadratic", 9u}}) {
        const Json bins = histograms({"--filter", kernel})["texels"];
        ASSERT_EQ(bins.size(), texels + 1) << kernel;
        EXPECT_EQ(bins[texels], sum(bins)) << kernel;
    }
    // A further bias of a level moves every lookup by a level.
    const Json plain = histograms({"--lod-bias", "0.25"})["level"], biased = histograms({"--lod-bias", "1.25"})["level"];
    ASSERT_EQ(biased.size(), plain.size() + 4) << plain << biased;
    for (size_t i = 0; i < biased.size(); ++i) EXPECT_EQ(biased[i], i < 4 ? Json(0) : plain[i - 4]) << i;
    EXPECT_EQ(histograms({})["anisotropy"].size(), 2u);
    const Json stretched = profile(folder / "out", "plane", {"--aniso", "8"})["histograms"]["anisotropy"];
    ASSERT_EQ(stretched.size(), 9u) << stretched;
    EXPECT_GT(stretched[8], 0);
}

TEST(Profile, ModelsAreThoseOfRender) {
    const TemporaryFolder folder;
    const Json json = profile(folder / "out", "shadow");
    for (const std::string model : {"visible", "forward", "quad"}) {
        const Words words{"render",          "shadow",        "-o",  folder / "r.png", "--stats",
                          folder / "r.json", "--fetch-model", model, "--cache",        "line=64"};
        ASSERT_EQ(run(with(words, kFrame)).code, kDone);
        Json render = Json::parse(test::read_file(folder / "r.json"))["texture"];
        render.erase("performed");
        EXPECT_EQ(json["models"][model], render) << model;
    }
    EXPECT_NE(json["models"]["visible"], json["models"]["forward"]);
    EXPECT_NE(json["models"]["quad"], json["models"]["forward"]);
}

TEST(Profile, SettingsBesideAreThoseOfTheirOwnProfile) {
    const TemporaryFolder folder;
    const Json both = profile(folder / "a", "magnify",
                              {"--filter", "bilinear", "--compare-with", "--filter 'gaussian:0.8' --spp 2", "--compare-with=--mip none"});
    ASSERT_EQ(both["compare_with"].size(), 2u);
    EXPECT_EQ(both["compare_with"][0]["options"], "--filter 'gaussian:0.8' --spp 2");
    const Json first = profile(folder / "b", "magnify", {"--filter", "gaussian:0.8", "--spp", "2"});
    const Json second = profile(folder / "c", "magnify", {"--filter", "bilinear", "--mip", "none"});
    for (const char* key : {"lookup", "image", "texture", "textures", "histograms", "memory_bytes", "fetches"}) {
        EXPECT_EQ(both["compare_with"][0][key], first[key]) << key;
        EXPECT_EQ(both["compare_with"][1][key], second[key]) << key;
    }
}

TEST(Profile, SettingsBesideHaveTheirOwnPolicies) {
    const TemporaryFolder folder;
    test::write_file(folder / "policy.json", R"({"textures": {"inlay color": {"filter": "nearest", "mip": "none"}}})");
    const Json both = profile(folder / "a", "metal-edge", {"--compare-with", "--policy '" + folder / "policy.json" + "'"});
    const Json own = profile(folder / "b", "metal-edge", {"--policy", folder / "policy.json"});
    EXPECT_EQ(both["compare_with"][0]["texture"], own["texture"]);
    EXPECT_NE(both["texture"], own["texture"]);
    EXPECT_EQ(why_not_failed(run({"profile", "metal-edge", "-o", folder / "a", "--compare-with", "--policy " + folder / "a/profile.json"}),
                             kWrongUsage, "would replace a file that is read"),
              "");
}

TEST(Profile, TableOfTexturesSumsToTheTotals) {
    const TemporaryFolder folder;
    const Json json = profile(folder / "out", "metal-edge");
    const auto lines = read_csv(folder / "out/textures.csv");
    const std::vector<std::string>& columns = lines[0];
    const auto column = [&](const std::string& name) { return size_t(std::ranges::find(columns, name) - columns.begin()); };
    for (const std::string name : {"texels_requested", "texels_unique", "blocks_touched", "lines_64", "bytes_decoded", "bytes_stored"}) {
        uint64_t levels = 0, textures = 0;
        for (size_t i = 1; i + 1 < lines.size(); ++i) {
            ASSERT_EQ(lines[i].size(), columns.size()) << i;
            (lines[i][column("level")] == "all" ? textures : levels) += std::stoull(lines[i][column(name)]);
        }
        EXPECT_EQ(levels, textures) << name;
        EXPECT_EQ(std::to_string(textures), lines.back()[column(name)]) << name;
        EXPECT_EQ(textures, json["texture"][name].get<uint64_t>()) << name;
        EXPECT_GT(textures, 0u) << name;
    }
    const auto number = [&](const char* name) { return std::stoull(lines.back()[column(name)]); };
    EXPECT_EQ(number("l1_hits") + number("l1_misses"), number("texels_requested"));
}

TEST(Profile, HeatMapsLieAboveTheirLegend) {
    const TemporaryFolder folder;
    profile(folder / "out", "magnify");
    const shading::Image map = scenes::read_image(folder / "out/heat-level.png", false);
    EXPECT_EQ(map.width, 360);
    EXPECT_EQ(map.height, 40 + 48);
    ASSERT_EQ(run({"profile", "magnify", "-o", folder / "out", "--size", "400x30", "--crop", "10,5,390,20", "--environment", "none"}).code,
              kDone);
    EXPECT_EQ(scenes::read_image(folder / "out/heat-level.png", false).width, 390);
    EXPECT_EQ(scenes::read_image(folder / "out/render.png", false).width, 390);
}

TEST(Profile, WhatMakesNoProfileIsWrongUsage) {
    const TemporaryFolder folder;
    const auto fails = [&](const Words& more, const std::string& part) {
        return why_not_failed(run(with({"profile", "plane", "--size", "8x8"}, more)), kWrongUsage, part);
    };
    EXPECT_EQ(fails({}, "-o DIR is missing"), "");
    const Words out{"-o", folder / "out"};
    EXPECT_EQ(fails(with(out, {"--reference", "0.1"}), "--reference makes an image"), "");
    EXPECT_EQ(fails(with(out, {"--frames", "3"}), "unknown option '--frames'"), "");
    EXPECT_EQ(fails(with(out, {"--compare-with", "--size 3x3"}), "unknown option '--size'"), "");
    EXPECT_EQ(fails(with(out, {"--compare-with", "--filter bspline --filter nearest"}), "given more than once"), "");
    EXPECT_EQ(fails(with(out, {"--compare-with", "--reference 0.1"}), "--reference makes an image"), "");
    EXPECT_EQ(fails(with(out, {"--compare-with", "--filter 'bspline"}), "has no end"), "");
    EXPECT_EQ(fails(with(out, {"--compare-with", " "}), "no options"), "");
    EXPECT_EQ(fails(with(out, {"--compare-with"}), "a value is missing"), "");
    EXPECT_EQ(fails(with(out, {"--compare-wiht", "--spp 2"}), "nearest is '--compare-with'"), "");
    EXPECT_EQ(fails(with(out, {"--trace", folder / "out/render.png"}), "is the file that -o writes"), "");
    EXPECT_TRUE(folder.entries().empty());
}

TEST(Profile, AFolderThatCannotBeIsExitCode4) {
    const TemporaryFolder folder;
    test::write_file(folder / "file", "not a folder");
    for (const std::string place : {"file", "missing/out"})
        EXPECT_EQ(why_not_failed(run({"profile", "plane", "-o", folder / place}), kCannotWrite, place), "");
    EXPECT_EQ(why_not_failed(run({"profile", "missing.gltf", "-o", folder / "new"}), kBadInput, "missing.gltf"), "");
    EXPECT_EQ(folder.entries(), Words{"file"});
}

}  // namespace
}  // namespace rawtexel::cli
