// What `rawtexel render` counts, from words to files.
#include "cli/command.h"
#include "tests/cli/program_runner.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <cstdint>
#include <filesystem>
#include <regex>
#include <string>
#include <vector>

namespace rawtexel::cli {
namespace {

using test::run;
using test::TemporaryFolder;
using Json = nlohmann::json;
using Words = std::vector<std::string>;

/// A small frame, silent, without the sky whose prefiltering would take most of the time.
Words render_words(const std::string& scene, const std::string& output, const Words& more) {
    Words words{"render", scene,   "-o",      output,          "--progress",    "never",
                "--size", "72x56", "--light", "0.2,-0.3,-1,3", "--environment", "none"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

Json stats_of(const Words& words, const TemporaryFolder& folder) {
    Words all = words;
    all.insert(all.end(), {"--stats", folder / "stats.json"});
    const test::Outcome outcome = run(all);
    EXPECT_EQ(outcome.code, kDone) << outcome.err;
    return Json::parse(test::read_file(folder / "stats.json"));
}

TEST(Fetches, CountEveryLineAndWhatACacheWouldHold) {
    const TemporaryFolder folder;
    const std::string scene = test::write_quad(folder);
    const Json json = stats_of(render_words(scene, folder / "a.png", {"--cache", "l1=1K:2,l2=4K:4"}), folder);
    const Json& texture = json["texture"];
    const Json& cache = texture["cache"];
    EXPECT_EQ(cache["l1_hits"].get<uint64_t>() + cache["l1_misses"].get<uint64_t>(), texture["texels_requested"].get<uint64_t>());
    EXPECT_EQ(cache["l2_hits"].get<uint64_t>() + cache["l2_misses"].get<uint64_t>(), cache["l1_misses"].get<uint64_t>());
    EXPECT_GT(texture["texels_unique"], 0);
    // Totals are sums over textures, and those over levels.
    for (const char* key : {"lookups", "taps", "texels_requested", "texels_unique", "blocks_touched", "lines_64", "bytes_stored"}) {
        uint64_t sum = 0;
        for (const Json& one : json["textures"]) sum += one[key].get<uint64_t>();
        EXPECT_EQ(sum, texture[key].get<uint64_t>()) << key;
    }
    for (const Json& one : json["textures"]) {
        for (const char* key : {"texels_requested", "texels_unique", "blocks_touched", "lines_64"}) {
            uint64_t sum = 0;
            for (const Json& level : one["per_level"]) sum += level[key].get<uint64_t>();
            EXPECT_EQ(sum, one[key].get<uint64_t>()) << key;
        }
    }
}

TEST(Fetches, GrowWithTheModel) {
    const TemporaryFolder folder;
    std::vector<uint64_t> lookups;
    for (const char* model : {"visible", "forward", "quad"}) {
        const Words words = render_words("foliage", folder / "a.png", {"--count", "--shadows", "off", "--fetch-model", model});
        lookups.push_back(stats_of(words, folder)["texture"]["lookups"].get<uint64_t>());
    }
    EXPECT_LT(lookups[0], lookups[1]);
    EXPECT_LT(lookups[1], lookups[2]);
}

TEST(Fetches, AreCountedPixelByPixelAndTracedOneByOne) {
    const TemporaryFolder folder;
    const std::string scene = test::write_quad(folder);
    const Words files{"--counts", folder / "counts.exr", "--trace", folder / "trace.zst", "--aov", "lines"};
    const Json json = stats_of(render_words(scene, folder / "a.exr", files), folder);
    EXPECT_GT(json["texture"]["texels_requested"], 0);
    const std::string header = test::read_file(folder / "counts.exr").substr(0, 6000);
    for (const char* layer : {"texels_requested.", "lines_pixel.", "lines_first.", "blocks_first.", "level.", "anisotropy.", "samples."})
        EXPECT_NE(header.find(layer), std::string::npos) << layer;
    EXPECT_EQ(header.find("l1_miss."), std::string::npos) << "no cache was asked for";
    EXPECT_NE(test::read_file(folder / "a.exr").substr(0, 4000).find("lines."), std::string::npos);
    EXPECT_GT(std::filesystem::file_size(folder / "trace.zst"), 100u);
}

TEST(Fetches, AreToldInPrintWithTheirUnit) {
    const TemporaryFolder folder;
    const std::string scene = test::write_quad(folder);
    // From afar each lookup of the ellipse reads most of 64x64 texels.
    const std::string near = run(render_words(scene, folder / "a.png", {"--count"})).out;
    const std::string far = run(render_words(scene, folder / "a.png", {"--count", "--ewa:4", "--eye", "0,0,40"})).out;
    EXPECT_TRUE(std::regex_search(near, std::regex(R"( texels \([0-9.]+ texels per shaded sample\)\n)"))) << near;
    EXPECT_TRUE(std::regex_search(far, std::regex(R"( texels \([0-9.]+ ktexels per shaded sample\)\n)"))) << far;
}

TEST(Fetches, WithBadCachesAndFilesAreRefused) {
    const TemporaryFolder folder;
    const auto refused = [&](const Words& more) { return run(render_words("plane", folder / "a.png", more)); };
    EXPECT_EQ(refused({"--cache", "line=65"}).code, kWrongUsage);
    EXPECT_NE(refused({"--cache", "lines=64"}).err.find("unknown field 'lines'"), std::string::npos);
    EXPECT_EQ(refused({"--fetch-model", "quads"}).code, kWrongUsage);
    EXPECT_EQ(refused({"--counts", folder / "counts.png"}).code, kWrongUsage);
    EXPECT_EQ(refused({"--trace", folder / "a.png"}).code, kWrongUsage) << "two outputs in one file";
    EXPECT_EQ(refused({"--trace", folder / "missing/a.zst"}).code, kCannotWrite);
    EXPECT_TRUE(std::filesystem::is_empty(folder / ""));
}

}  // namespace
}  // namespace rawtexel::cli
