// Planes, layers and shadow tests, asked for on the command line.
#include "cli/command.h"
#include "tests/cli/program_runner.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace rawtexel::cli {
namespace {

using test::run;
using test::TemporaryFolder;
using Json = nlohmann::json;
using Words = std::vector<std::string>;

/// texels_requested of every texture of the standing stones.
std::vector<uint64_t> stone_texels(const Words& more) {
    const TemporaryFolder folder;
    Words words{"render",  "triplanar", "-o",      folder / "a.png", "--progress",    "never", "--size",  "48x32",
                "--spp",   "2",         "--light", "0.2,-0.3,-1,3",  "--environment", "none",  "--stats", folder / "stats.json",
                "--cache", "l1=1K:2"};
    words.insert(words.end(), more.begin(), more.end());
    const test::Outcome outcome = run(words);
    EXPECT_EQ(outcome.code, kDone) << outcome.err;
    std::vector<uint64_t> texels;
    const Json stats = Json::parse(test::read_file(folder / "stats.json"));
    for (const Json& texture : stats["textures"])
        if (texture["name"].get<std::string>().starts_with("mossy rock")) texels.push_back(texture["texels_requested"]);
    return texels;
}

TEST(Blend, ADrawnPlaneDemandsExactlyAThird) {
    const std::vector<uint64_t> all = stone_texels({"--estimator", "reservoir", "--blend", "all"});
    const std::vector<uint64_t> drawn = stone_texels({"--estimator", "reservoir"});
    ASSERT_EQ(all.size(), 3u);
    ASSERT_EQ(drawn.size(), 3u);
    for (size_t i = 0; i < all.size(); ++i) {
        EXPECT_GT(drawn[i], 0u);
        EXPECT_EQ(all[i], 3 * drawn[i]);
    }
    const Words bilinear{"--filter", "bilinear", "--mip", "none"};
    Words one = bilinear;
    one.insert(one.end(), {"--blend", "draw"});
    const std::vector<uint64_t> planes = stone_texels(bilinear), plane = stone_texels(one);
    for (size_t i = 0; i < all.size(); ++i) EXPECT_EQ(planes[i], 3 * plane[i]);
}

TEST(Blend, DrawsNothingWhereNothingIsBlended) {
    const TemporaryFolder folder;
    for (const std::string scene : {"bumps", "layers", "triplanar"}) {
        const test::Outcome outcome = run({"render", scene, "-o", folder / "a.png", "--size", "16x9", "--blend", "draw"});
        EXPECT_EQ(outcome.code, scene == "bumps" ? kWrongUsage : kDone) << scene << outcome.err;
    }
}

TEST(Blend, WordsThatAreNoneAreRefused) {
    for (const Words& words : {Words{"--blend", "some"}, Words{"--shadow-taps", "two"}}) {
        const TemporaryFolder folder;
        Words all{"render", "font", "-o", folder / "a.png", "--size", "16x9"};
        all.insert(all.end(), words.begin(), words.end());
        const test::Outcome outcome = run(all);
        EXPECT_EQ(outcome.code, kWrongUsage) << words[0];
        EXPECT_NE(outcome.err.find(words[0]), std::string::npos) << outcome.err;
    }
}

}  // namespace
}  // namespace rawtexel::cli
