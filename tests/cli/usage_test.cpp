// What the program says of itself, and of words it does not know.
#include "cli/command.h"
#include "cli/counters.h"
#include "cli/version.h"
#include "scenes/builtin.h"
#include "tests/cli/program_runner.h"
#include "texunit/format.h"
#include "texunit/kernel.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>

namespace rawtexel::cli {
namespace {

using test::run;
using test::run_built;
using test::why_not_failed;

TEST(Usage, WrongWordsAreExitCode2WithTheNearestSpelling) {
    const std::initializer_list<std::pair<std::vector<std::string>, const char*>> cases{
        {{"rendr", "plane", "-o", "x.png"}, "the nearest is 'render'"},
        {{"proflie", "plane"}, "unknown command 'proflie', the nearest is 'profile'"},
        {{"render", "plane", "-o", "x.png", "--fliter", "nearest"}, "the nearest is '--filter'"},
        {{"render", "plane", "-o", "x.png", "--filter", "bilinaer"}, "the nearest is 'bilinear'"},
        {{"render", "plane", "-o", "x.png", "--aov", "dept"}, "the nearest is 'depth'"},
        {{"render", "plane", "-o", "x.png", "--aov", "depth"}, "'.exr'"},
        {{"render", "plane", "-o", "x.exr", "--aov", "depth,depth"}, "named twice"},
        {{"render", "plane", "-o", "x.pmg"}, "'.png'"},
        {{"render", "plane", "-o", "x"}, "'.png'"},
        {{"render", "plane"}, "-o FILE is missing"},
        {{"render", "-o", "x.png"}, "missing argument SCENE"},
        {{"render", "plane", "spheres", "-o", "x.png"}, "unexpected argument 'spheres'"},
        {{"render", "plane", "-o", "x.png", "--repeat", "0"}, "--repeat"},
        {{"render", "--scenario", "{}"}, "--scenario"},
        {{"render", "plane", "--scenario", R"({"scenario":{"model":"a"}})"}, "--scenario"},
        {{"compare", "a.png"}, "missing argument"},
        {{"compare", "a.png", "b.png", "--max-rms", "1"}, "'--max-rmse'"},
        {{"compare", "a.png", "b.png", "--max-rmse", "-1"}, "--max-rmse"},
        {{"compare", "a.png", "b.png", "-o", "d.xyz"}, "-o"},
        {{"render", "plane", "-o", "x.png", "--reference", "0.1", "--repeat", "2"}, "--repeat cannot go with it"},
        {{"render", "plane", "-o", "x.png", "--reference", "0.1", "--count"}, "--count, --cache"},
        {{"render", "plane", "-o", "x.exr", "--reference", "0.1", "--aov", "spp"}, "--aov cannot go with it"},
        {{"render", "plane", "-o", "x.png", "--reference", "0.1", "--baseline", "lean"}, "--baseline"},
        {{"render", "plane", "-o", "x.png", "--reference", "0.1", "--shadow-taps", "one"}, "--shadow-taps"},
        {{"render", "plane", "-o", "x.png", "--reference", "0.1", "--mip", "none"}, "--mip"},
        {{"render", "plane", "-o", "x.png", "--texture-jitter", "affin"}, "the nearest is 'affine'"},
        {{"render", "plane", "-o", "x.png", "--texture-jitter", "affine"}, "with --mip none"},
        {{"render", "plane", "-o", "x.png", "--texture-jitter", "affine", "--mip", "none", "--aniso", "4"},
         "not allowed with --aniso, --ewa"},
        {{"render", "plane", "-o", "x.png", "--texture-jitter", "affine", "--mip", "none", "--lod-rule", "d3d"}, "--lod-*"},
        {{"render", "plane", "-o", "x.png", "--shadow-taps", "one", "--shadows", "off"}, "there are no shadows"},
        {{"render", "plane", "-o", "x.png", "--estimator", "reservoir", "--signed-numbers", "common"}, "no kernel draws a texel"},
        {{"render", "plane", "-o", "x.png", "--reference", "0.1", "--texture-jitter", "affine"}, "--texture-jitter"},
        {{"render", "plane", "-o", "x.png", "--policy", "p.json", "--stats", "p.json"}, "p.json"},
        {{"sample", "a.png", "--uv", "0,0", "--ewa", "--hybrid-bias", "1"}, "--hybrid-bias"},
        {{"render", "plane", "-o", "x.png", "--order", "before", "--estimator", "reservoir"}, "that is --order after"},
        {{"render", "plane", "-o", "x.png", "--ewa", "--estimator", "abs-weight"}, "ellipse has no negative weights"},
        {{"render", "plane", "-o", "x.png", "--filter", "lanczos2", "--estimator", "jitter"}, "reservoir draws it"},
        {{"list"}, "missing argument"},
        {{"list", "scene"}, "the nearest is 'scenes'"},
        {{"list", "suits"}, "nearest is 'suites'"},
        {{"export", "plane", "-o", "x.gltf"}, ".glb"},
        {{"export", "plane"}, "-o FILE.glb is missing"},
        {{}, "no command given"},
        {{"--verison"}, "'--version'"},
        {{"--size", "1x1"}, "unknown command '1x1'"},
        {{"render", "a\nb", "-o", "x.p\nng"}, "-o"},
        {{"render", "", "-o", "x.png"}, "an argument is empty"},
        {{"help", "rendr"}, "unknown command 'rendr', the nearest is 'render'"},
        {{"help", "render", "list"}, "unexpected argument 'list'"},
        {{"hlep"}, "the nearest is 'help'"},
    };
    for (const auto& [words, part] : cases) EXPECT_EQ(why_not_failed(run(words), kWrongUsage, part), "");
}

TEST(Usage, TheShellSeesTheSame) {
    EXPECT_EQ(why_not_failed(run_built({"render", "plane", "-o", "x.png", "--fliter", "nearest"}), 2, "'--filter'"), "");
    EXPECT_EQ(why_not_failed(run_built({"render", "plane", "-o", "/proc/nowhere/x.png"}), 4, "/proc/nowhere/x.png"), "");
    EXPECT_EQ(why_not_failed(run_built({"render", "no-such-scene.glb", "-o", "/tmp/rawtexel-never-written.png"}), 3, "no-such-scene.glb"),
              "");
    const test::Outcome version = run_built({"--version"});
    EXPECT_EQ(version.code, 0);
    EXPECT_EQ(version.out, "rawtexel " + std::string(cli::version()) + "\n");
    EXPECT_EQ(version.err, "");
}

TEST(Usage, AFullStandardOutputIsExitCode4) {
    const int status = std::system((std::string(RAWTEXEL_PROGRAM) + " list scenes > /dev/full 2> /dev/null").c_str());
    EXPECT_EQ(WEXITSTATUS(status), 4);
}

TEST(Usage, HelpIsComplete) {
    const test::Outcome whole = run({"--help"});
    EXPECT_EQ(whole.code, 0);
    for (const char* part : {"render", "compare", "explain", "sample", "texture", "list", "export", "--version", "Exit codes"})
        EXPECT_NE(whole.out.find(part), std::string::npos) << part;
    const std::initializer_list<std::pair<const char*, std::vector<const char*>>> commands{
        {"render", {"--size",         "--crop",         "--camera",      "--orbit",         "--eye",         "--target",
                    "--fov",          "--light",        "--ambient",     "--shadows",       "--environment", "--environment-reflections",
                    "--background",   "--peer-shading", "--filter",      "--mip",           "--aniso",       "--ewa",
                    "--lod-rule",     "--lod-bias",     "--derivatives", "--footprint",     "--spp",         "--pixel-filter",
                    "--pixel-jitter", "--seed",         "--mip-storage", "--exposure",      "--tonemap",     "--transfer",
                    "--frames",       "--camera-path",  "--accumulate",  "--history-clamp", "--frames-out",  "--flicker",
                    "--aov",          "--count",        "--stats",       "--repeat",        "--threads",     "--tile-size",
                    "--simd",         "--progress",     "--scenario",    "-o,--output",     "SCENE",         "--help"}},
        {"compare", {"-o,--output", "--json", "--csv", "--max-rmse", "--min-psnr", "IMAGE", "REFERENCE"}},
        {"explain", {"SCENE", "--pixel", "--sample", "--json", "--size", "--camera", "--filter", "--spp", "--exposure", "--threads"}},
        {"sample", {"TEXTURE",   "--uv",      "--uvw",         "--direction", "--ddx",         "--ddy",         "--lod",
                    "--layer",   "--filter",  "--mip",         "--precision", "--mip-storage", "--bc-rounding", "--max-texture-bytes",
                    "--wrap",    "--border",  "--color-space", "--aniso",     "--ewa",         "--lod-rule",    "--lod-bias",
                    "--min-lod", "--max-lod", "--json"}},
        {"texture",
         {"info|decode|mips FILE", "-o,--output", "--json", "--level", "--layer", "--face", "--slice", "--color-space", "--mip-storage",
          "--bc-rounding", "--max-texture-bytes"}},
        {"list", {"scenes", "filters", "formats", "counters", "--json"}},
        {"export", {"SCENE", "-o,--output"}}};
    for (const auto& [command, parts] : commands)
        for (const std::vector<std::string>& words : {std::vector<std::string>{command, "--help"}, {command, "-h"}, {"--help", command}}) {
            const test::Outcome outcome = run(words);
            EXPECT_EQ(outcome.code, 0);
            for (const char* part : parts) EXPECT_NE(outcome.out.find(part), std::string::npos) << command << " " << part;
        }
}

TEST(Usage, HelpIsACommandToo) {
    for (const std::string command : {"render", "compare", "explain", "sample", "texture", "list", "export"})
        EXPECT_EQ(run({"help", command}).out, run({command, "--help"}).out) << command;
    for (const std::vector<std::string>& words : {std::vector<std::string>{"help"}, {"help", "help"}, {"help", "--help"}})
        EXPECT_EQ(run(words).out, run({"--help"}).out);
}

TEST(Usage, TheVersionIsToldAfterACommandToo) {
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{"--version"}, {"render", "--version"}, {"list", "scenes", "--version"}}) {
        const test::Outcome outcome = run(words);
        EXPECT_EQ(outcome.code, 0);
        EXPECT_EQ(outcome.out, "rawtexel " + std::string(version()) + "\n");
    }
    EXPECT_NE(run({"render", "--help"}).out.find("--version"), std::string::npos);
}

TEST(Usage, TheCommandMayComeLast) {
    const test::Outcome outcome = run({"--json", "scenes", "list"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    // "list" is here the value of an option, "compare" the command.
    EXPECT_EQ(why_not_failed(run({"--csv", "list", "compare", "a.png"}), kWrongUsage, "missing argument IMAGE"), "");
}

TEST(List, NamesEverythingOneALine) {
    const std::initializer_list<std::pair<const char*, size_t>> subjects{{"scenes", scenes::builtin_scenes().size()},
                                                                         {"filters", texunit::all_kernels().size() + 1},
                                                                         {"formats", texunit::all_formats().size()},
                                                                         {"counters", all_counters().size()}};
    for (const auto& [subject, count] : subjects) {
        const test::Outcome lines = run({"list", subject}), json = run({"list", subject, "--json"});
        EXPECT_EQ(lines.code, 0);
        EXPECT_EQ(size_t(std::ranges::count(lines.out, '\n')), count) << subject;
        const nlohmann::json array = nlohmann::json::parse(json.out);
        ASSERT_EQ(array.size(), count) << subject;
        for (const auto& entry : array) {
            EXPECT_FALSE(entry.at("name").get<std::string>().empty());
            EXPECT_FALSE(entry.at("description").get<std::string>().empty());
            EXPECT_NE(lines.out.find(entry.at("name").get<std::string>()), std::string::npos);
        }
    }
}

TEST(List, HoldsTheScenesOfTheGallery) {
    const std::string out = run({"list", "scenes"}).out;
    for (const char* scene :
         {"plane", "spheres", "magnify", "metal-edge", "bumps", "foliage", "triplanar", "layers", "font", "shadow", "courtyard"})
        EXPECT_NE(out.find(scene), std::string::npos) << scene;
}

}  // namespace
}  // namespace rawtexel::cli
