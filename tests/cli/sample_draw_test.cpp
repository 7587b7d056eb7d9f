// One lookup drawn, from words to taps and the numbers that chose them.
#include "cli/command.h"
#include "tests/cli/program_runner.h"
#include "tests/cli/sampled_lookup.h"
#include "tests/cli/texture_files.h"
#include "texunit/random.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <cmath>
#include <sstream>

namespace rawtexel::cli {
namespace {

using test::FileFormat;
using test::Json;
using test::keys_of;
using test::run;
using test::sample;
using test::sample_words;
using test::TemporaryFolder;
using test::why_not_failed;
using texunit::Dimension;

std::vector<std::string> with(std::vector<std::string> words, const std::vector<std::string>& more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

TEST(SampleDraw, TellsTheTexelAndTheNumbersThatChoseIt) {
    const TemporaryFolder folder;
    const std::string texture = test::write_dds(folder, "t.dds", {.width = 16, .height = 8, .levels = 5}, FileFormat::Rgba8Unorm);
    // 0.25 texels right of the centre of column 3, in the middle between rows 4 and 5, a quarter of the way to level 1.
    const std::vector<std::string> place{"--uv", "0.234375,0.625", "--mip", "linear"};
    const Json all = sample(texture, place);
    int second_columns = 0, second_rows = 0;
    for (uint32_t n = 0; n < 32; ++n) {
        const Json lookup =
            sample(texture, with(place, {"--estimator", "reservoir", "--pixel", "7,5", "--sample", std::to_string(n), "--seed", "9"}));
        EXPECT_EQ(keys_of(lookup), (std::set<std::string>{"lod", "anisotropy", "precision", "estimator", "taps", "result"}));
        EXPECT_EQ(lookup["lod"], all["lod"]);
        EXPECT_EQ(lookup["estimator"], "reservoir");
        ASSERT_EQ(lookup["taps"].size(), 1u);
        const Json tap = lookup["taps"][0], random = tap["random"];
        EXPECT_EQ(keys_of(tap), (std::set<std::string>{"level", "x", "y", "weight", "value", "draw", "random"}));
        EXPECT_EQ(keys_of(random), (std::set<std::string>{"x", "y", "level"}));
        const auto number = [&](Dimension dimension) {
            return texunit::random_float({.x = 7, .y = 5, .sample = n, .dimension = dimension, .seed = 9});
        };
        EXPECT_EQ(float(random["x"]), number(Dimension::TapX));
        EXPECT_EQ(float(random["y"]), number(Dimension::TapY));
        EXPECT_EQ(float(random["level"]), number(Dimension::Level));
        EXPECT_EQ(tap["x"], double(random["x"]) < 0.75 ? 3 : 4) << random["x"];
        EXPECT_EQ(tap["y"], double(random["y"]) < 0.5 ? 4 : 5) << random["y"];
        EXPECT_EQ(tap["weight"], 1.0);
        EXPECT_EQ(tap["value"], lookup["result"]);
        second_columns += tap["x"] == 4, second_rows += tap["y"] == 5;
    }
    EXPECT_GT(second_columns, 0);
    EXPECT_GT(second_rows, 0);
}

TEST(SampleDraw, AveragesToWhatAllTapsMakeInEveryShape) {
    const TemporaryFolder folder;
    const auto [flat, array, volume, cube] = test::write_shapes(folder);
    const std::pair<const std::string*, std::vector<std::string>> places[] = {
        {&flat, {"--uv", "-0.07,1.31", "--ddx", "0.11,0.02", "--ddy", "-0.01,0.3", "--wrap", "border", "--border", "0.5,1,2,0.25"}},
        {&flat, {"--uv", "0.93,0.11", "--ddx", "0.4,0.1", "--ddy", "0,0.1", "--aniso", "8"}},
        {&array, {"--uv", "0.4,0.9", "--lod", "0.7", "--layer", "2"}},
        {&volume, {"--uvw", "0.3,0.99,0.02", "--lod", "0.4"}},
        {&cube, {"--direction", "-1,0.98,0.97", "--lod", "0.4", "--layer", "1"}}};
    constexpr int kDraws = 1024;
    for (const auto& [texture, place] : places) {
        for (const auto& [filter, estimator] : {std::pair{"bspline", "reservoir"},
                                                {"gaussian", "jitter"},
                                                {"mitchell:0,0", "jitter"},
                                                {"lanczos2", "reservoir"},
                                                {"catmull-rom", "abs-weight"}}) {
            const std::vector<std::string> words = with(place, {"--filter", filter});
            const Json all = sample(*texture, words);
            const Json drawn = sample(*texture, with(words, {"--estimator", estimator, "--taps", std::to_string(kDraws)}));
            const std::string what = *texture + ' ' + filter + ' ' + estimator;
            if (std::string(estimator) != "abs-weight") test::expect_adds_up(drawn, what);
            for (size_t c = 0; c < 4; ++c) {
                std::vector<double> values(kDraws);
                for (const Json& tap : drawn["taps"]) values[tap["draw"]] += double(tap["weight"]) * double(tap["value"][c]) * kDraws;
                double squares = 0;
                const double truth = all["result"][c];
                for (const double value : values) squares += (value - truth) * (value - truth);
                // 100 means, each within five and a half standard deviations.
                EXPECT_LE(std::abs(double(drawn["result"][c]) - truth), 5.6 * std::sqrt(squares) / kDraws + 1e-5) << what << ' ' << c;
            }
        }
    }
}

TEST(SampleDraw, NamesEveryRoleThatDecides) {
    const TemporaryFolder folder;
    const std::string flat = test::write_dds(folder, "flat.dds", {.width = 16, .height = 16, .levels = 5}, FileFormat::Rgba8Unorm);
    const std::string volume = test::write_dds(folder, "volume.dds", {.width = 8, .height = 8, .depth = 8}, FileFormat::Rgba8Unorm);
    const auto roles = [](const std::string& texture, const std::vector<std::string>& words) {
        const Json lookup = sample(texture, with(words, {"--estimator", "reservoir"}));
        return keys_of(lookup["taps"][0]["random"]);
    };
    const std::vector<std::string> place{"--uv", "0.3,0.3", "--ddx", "0.3,0", "--ddy", "0,0.1"};
    using Roles = std::set<std::string>;
    EXPECT_EQ(roles(flat, with(place, {"--mip", "none"})), (Roles{"x", "y"}));
    EXPECT_EQ(roles(flat, place), (Roles{"x", "y", "level"}));
    EXPECT_EQ(roles(flat, with(place, {"--aniso", "4"})), (Roles{"x", "y", "level", "probe"}));
    EXPECT_EQ(roles(flat, with(place, {"--mip", "none", "--filter", "lanczos3"})), (Roles{"x", "y", "sign"}));
    EXPECT_EQ(roles(flat, with(place, {"--ewa"})), (Roles{"x", "y"}));
    EXPECT_EQ(roles(flat, with(place, {"--ewa", "--hybrid-bias", "1"})), (Roles{"x", "y", "level"}));
    EXPECT_EQ(roles(volume, {"--uvw", "0.3,0.3,0.3", "--mip", "none"}), (Roles{"x", "y", "z"}));
    // The second tap, of negative weight, has numbers of its own but for the level's; or all the same.
    for (const bool common : {false, true}) {
        const Json lookup = sample(flat, {"--uv", "0.3,0.3", "--filter", "lanczos3", "--estimator", "reservoir", "--signed-numbers",
                                          common ? "common" : "independent"});
        ASSERT_EQ(lookup["taps"].size(), 2u);
        const Json first = lookup["taps"][0]["random"], second = lookup["taps"][1]["random"];
        EXPECT_GT(double(lookup["taps"][0]["weight"]), 1);
        EXPECT_LT(double(lookup["taps"][1]["weight"]), 0);
        for (const char* role : {"x", "y", "sign"}) EXPECT_EQ(first[role] == second[role], common) << role;
        EXPECT_EQ(first["level"], second["level"]);
    }
}

TEST(SampleDraw, DrawsOtherNumbersForOtherAddressesAndNoises) {
    const TemporaryFolder folder;
    const std::string texture = test::write_dds(folder, "t.dds", {.width = 8, .height = 8}, FileFormat::Rgba8Unorm);
    const std::vector<std::string> base{"--uv", "0.3,0.3", "--estimator", "reservoir"};
    std::set<double> numbers;
    for (const std::vector<std::string>& more : std::vector<std::vector<std::string>>{{},
                                                                                      {"--seed", "1"},
                                                                                      {"--pixel", "1,0"},
                                                                                      {"--pixel", "0,1"},
                                                                                      {"--sample", "1"},
                                                                                      {"--noise", "sobol"},
                                                                                      {"--noise", "r2", "--sample", "1"},
                                                                                      {"--noise", "blue"},
                                                                                      {"--noise", "stbn"}})
        numbers.insert(double(sample(texture, with(base, more))["taps"][0]["random"]["x"]));
    EXPECT_EQ(numbers.size(), 9u);
    // Draws of a sample are numbered through; lines of a file are samples in turn.
    const Json two = sample(texture, with(base, {"--taps", "2", "--sample", "3"}));
    const Json sixth = sample(texture, with(base, {"--sample", "6"})), seventh = sample(texture, with(base, {"--sample", "7"}));
    EXPECT_EQ(two["taps"][0]["random"], sixth["taps"][0]["random"]);
    EXPECT_EQ(two["taps"][1]["random"], seventh["taps"][0]["random"]);
    EXPECT_EQ(two["taps"][1]["draw"], 1);
    const std::string places = folder.write("places.txt", "0.3 0.3\n0.3 0.3\n");
    const test::Outcome outcome = run({"sample", texture, "--uv", "@" + places, "--estimator", "reservoir", "--sample", "6"});
    std::istringstream lines(outcome.out);
    std::string first, second;
    std::getline(lines, first);
    std::getline(lines, second);
    EXPECT_EQ(Json::parse(first), sixth);
    EXPECT_EQ(Json::parse(second), seventh);
}

TEST(SampleDraw, TellsPeopleTheEstimatorAndTheNumbers) {
    const TemporaryFolder folder;
    const std::string texture = test::write_dds(folder, "t.dds", {.width = 16, .height = 16}, FileFormat::Rgba8Unorm);
    const test::Outcome outcome = run({"sample", texture, "--uv", "0.3,0.3", "--filter", "catmull-rom", "--estimator", "reservoir"});
    ASSERT_EQ(outcome.code, kDone) << outcome.err;
    for (const char* part : {", drawn by reservoir", "Draw 0: random numbers x 0.", "Draw 0, negative weight: random numbers x 0.",
                             ", sign 0.", "in 2 taps", "sum", "result"})
        EXPECT_NE(outcome.out.find(part), std::string::npos) << part << " in\n" << outcome.out;
}

TEST(SampleDraw, WrongUsageIsExitCode2) {
    const TemporaryFolder folder;
    const std::string flat = test::write_dds(folder, "flat.dds", {.width = 4, .height = 4}, FileFormat::Rgba8Unorm);
    const std::string cube =
        test::write_dds(folder, "cube.dds", {.width = 4, .height = 4, .layers = 6, .cube = true}, FileFormat::Rgba8Unorm);
    const std::vector<std::string> place{"--uv", "0.5,0.5"}, derived = with(place, {"--ddx", "1,0", "--ddy", "0,1"});
    const std::initializer_list<std::pair<std::vector<std::string>, const char*>> cases{
        {{"--taps", "4"}, "--taps: --estimator all weighs every tap and draws no numbers"},
        {{"--noise", "white"}, "--noise: --estimator all"},
        {{"--seed", "0"}, "--seed: --estimator all"},
        {{"--pixel", "1,1"}, "--pixel: --estimator all"},
        {{"--sample", "1"}, "--sample: --estimator all"},
        {{"--signed-numbers", "independent"}, "--signed-numbers: --estimator all"},
        {{"--estimator", "resevoir"}, "the nearest is 'reservoir'"},
        {{"--estimator", "jitter", "--filter", "catmull-rom"}, "jitter cannot draw catmull-rom, its negative lobes"},
        {{"--estimator", "jitter", "--filter", "gaussian-point"}, "jitter cannot draw gaussian-point"},
        {{"--estimator", "jitter", "--filter", "mitchell:2.5,0"}, "it is no density convolved with the texel's box"},
        {{"--estimator", "reservoir", "--taps", "0"}, "--taps: '0'"},
        {{"--estimator", "reservoir", "--pixel", "1"}, "--pixel: '1' is not X,Y"},
        {{"--estimator", "reservoir", "--signed-numbers", "common"}, "draws one texel of bilinear"},
        {{"--estimator", "reservoir", "--signed-numbers", "independent"}, "draws one texel of bilinear"},
        {{"--estimator", "abs-weight", "--filter", "lanczos2", "--signed-numbers", "common"}, "abs-weight draws one texel of lanczos2"}};
    for (const auto& [more, part] : cases) EXPECT_EQ(why_not_failed(run(sample_words(flat, with(place, more))), kWrongUsage, part), "");
    EXPECT_EQ(why_not_failed(run(sample_words(flat, with(derived, {"--estimator", "abs-weight", "--ewa"}))), kWrongUsage,
                             "the ellipse of --ewa has no negative weights"),
              "");
    EXPECT_EQ(why_not_failed(run(sample_words(flat, with(derived, {"--estimator", "jitter", "--ewa", "--signed-numbers", "common"}))),
                             kWrongUsage, "the ellipse of --ewa has no negative weights"),
              "");
    EXPECT_EQ(why_not_failed(run(sample_words(cube, {"--direction", "0,0,1", "--ewa", "--estimator", "jitter"})), kWrongUsage, "--ewa: "),
              "");
}

}  // namespace
}  // namespace rawtexel::cli
