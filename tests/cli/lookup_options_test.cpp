// How lookups are chosen, from words to pixels.
#include "cli/lookup_options.h"

#include "cli/command.h"
#include "scenes/image_io.h"
#include "tests/cli/program_runner.h"

#include "tests/cli/option_group.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <set>

namespace rawtexel::cli {
namespace {

using test::run;
using test::TemporaryFolder;

LookupOptions parsed(const std::vector<std::string>& words) { return test::parsed_options<LookupOptions>(declare_lookup_options, words); }

std::string complaint(const std::vector<std::string>& words) { return test::complaint_of(parsed, words); }

const std::vector<std::string> kFilters{
    "scene",       "nearest",  "bilinear", "quadratic", "bspline",      "mitchell",       "mitchell:0.5,-0.25",
    "catmull-rom", "lanczos2", "lanczos3", "gaussian",  "gaussian:0.8", "gaussian-point", "gaussian-point:1.25"};

TEST(LookupOptions, EveryOneReachesItsMember) {
    const LookupOptions defaults = parsed({});
    EXPECT_FALSE(defaults.filter || defaults.mip);
    EXPECT_EQ(defaults.precision, texunit::Precision::Exact);
    const LookupOptions all =
        parsed({"--filter", "mitchell:0,0.75", "--mip", "nearest", "--precision", "gpu", "--mip-storage", "float", "--bc-rounding", "amd"});
    EXPECT_EQ(all.filter, texunit::Kernel::mitchell(0, 0.75f));
    EXPECT_EQ(all.mip, texunit::MipMode::Nearest);
    EXPECT_EQ(all.precision, texunit::Precision::Gpu);
    EXPECT_EQ(all.mip_storage, texunit::MipStorage::Float);
    EXPECT_EQ(all.files.bc_rounding, texunit::BcRounding::Amd);
}

TEST(LookupOptions, FiltersPrintAsTheyAreRead) {
    for (const std::string& text : kFilters) EXPECT_EQ(print_filter(parse_filter(text)), text);
}

TEST(LookupOptions, EveryKernelThereIsIsListedAndTaken) {
    std::set<std::string> listed;
    for (const texunit::KernelInfo& kernel : texunit::all_kernels()) {
        listed.emplace(kernel.name);
        EXPECT_EQ(parse_filter(kernel.name)->kind, kernel.kind) << kernel.name;
    }
    for (const std::string& text : kFilters) {
        if (text == "scene") continue;
        EXPECT_TRUE(listed.contains(text.substr(0, text.find(':')))) << text;
    }
}

TEST(LookupOptions, SayWhatIsWrongAndWhatIsAllowed) {
    const std::initializer_list<std::pair<std::vector<std::string>, const char*>> cases{
        {{"--filter", "bilinaer"},
         "--filter: unknown value 'bilinaer', the nearest is 'bilinear' (scene nearest bilinear quadratic bspline "
         "mitchell catmull-rom lanczos2 lanczos3 gaussian gaussian-point)"},
        {{"--filter", "lancsoz3:1"}, "--filter: unknown value 'lancsoz3', the nearest is 'lanczos3'"},
        {{"--filter", "scene:1"}, "unknown value 'scene'"},
        {{"--filter", "gaussian:17"}, "--filter: 'gaussian:17' is not gaussian[:SIGMA] with SIGMA from 0.02 to 16"},
        {{"--filter", "gaussian-point:0"}, "--filter: 'gaussian-point:0' is not gaussian-point[:SIGMA] with SIGMA from 0.02 to 16"},
        {{"--filter", "gaussian:"}, "with SIGMA from"},
        {{"--filter", "gaussian:nan"}, "with SIGMA from"},
        {{"--filter", "mitchell:1"}, "--filter: 'mitchell:1' is not mitchell[:B,C] with B and C from -10 to 10"},
        {{"--filter", "mitchell:0,11"}, "with B and C from -10 to 10"},
        {{"--filter", "bilinear:2"}, "--filter: 'bilinear:2' has parameters (allowed: bilinear alone)"},
        {{"--precision", "gpus"}, "--precision: unknown value 'gpus', the nearest is 'gpu' (exact gpu)"},
        {{"--mip", "liner"}, "--mip: unknown value 'liner', the nearest is 'linear' (scene linear nearest none)"}};
    for (const auto& [words, part] : cases) EXPECT_NE(complaint(words).find(part), std::string::npos) << complaint(words);
}

TEST(LookupOptions, ChoicesAreToldAsTheyAreSpelled) {
    LookupOptions lookup = parsed({"--filter", "gaussian:0.8", "--precision", "gpu", "--bc-rounding", "nvidia"});
    lookup.footprint = {.probes = 8, .probe_variance = 0.25f, .lod_rule = texunit::LodRule::Exact, .lod_bias = -0.5f};
    lookup.filtering.estimator = texunit::Estimator::Reservoir;
    lookup.filtering.taps = 3;
    lookup.filtering.noise = texunit::Noise::Stbn;
    std::string told;
    for (const auto& [name, choice] : print_choices(lookup)) told += name + "=" + choice + " ";
    EXPECT_EQ(
        told,
        "filter=gaussian:0.8 mip=scene aniso=8:0.25 ewa=none lod-rule=exact lod-bias=-0.5 derivatives=analytic footprint=pixel "
        "hybrid-bias=none estimator=reservoir draws=3 order=after random=shared blend=draw shadow-taps=all "
        "texture-jitter=none noise=stbn signed-numbers=independent baseline=none precision=gpu mip-storage=source bc-rounding=nvidia ");
}

/// The quad's image at 40x40 pixels, some 0.6 pixels a texel, its edges out of sight.
shading::Image render_quad(const TemporaryFolder& folder, const std::vector<std::string>& more) {
    std::vector<std::string> words{
        "render",  folder / "quad.gltf", "-o", folder / "quad.exr", "--size",   "40x40",         "--eye", "0,0,0.4",    "--fov",
        "60",      "--ambient",          "1",  "--light",           "0,0,-1,0", "--environment", "none",  "--progress", "never",
        "--stats", folder / "stats.json"};
    words.insert(words.end(), more.begin(), more.end());
    const test::Outcome outcome = run(words);
    EXPECT_EQ(outcome.code, kDone) << outcome.err;
    return scenes::read_image(folder / "quad.exr", false);
}

float largest_difference(const shading::Image& a, const shading::Image& b) {
    float largest = 0;
    for (size_t i = 0; i < a.values.size(); ++i) largest = std::max(largest, std::abs(a.values[i] - b.values[i]));
    return largest;
}

TEST(LookupOptions, EveryFilterShowsInARender) {
    const TemporaryFolder folder;
    test::write_quad(folder);
    const shading::Image scene = render_quad(folder, {});
    std::vector<shading::Image> images;
    for (const std::string& filter : kFilters) {
        images.push_back(render_quad(folder, {"--filter", filter}));
        const nlohmann::json stats = nlohmann::json::parse(test::read_file(folder / "stats.json"));
        EXPECT_EQ(stats["lookup"]["filter"], filter);
        EXPECT_EQ(largest_difference(images.back(), scene) == 0, filter == "scene" || filter == "bilinear") << filter;
        for (size_t other = 3; other + 1 < images.size(); ++other)
            EXPECT_GT(largest_difference(images.back(), images[other]), 1e-4f) << filter << " and " << kFilters[other];
    }
}

TEST(LookupOptions, ANoiseIsRefusedWhereNothingDraws) {
    const TemporaryFolder folder;
    test::write_quad(folder);
    const auto with = [&](const std::vector<std::string>& more) {
        std::vector<std::string> words{
            "render", folder / "quad.gltf", "-o", folder / "noise.exr", "--size", "8x8", "--environment", "none", "--noise", "blue"};
        words.insert(words.end(), more.begin(), more.end());
        return run(words);
    };
    for (const std::vector<std::string>& more : {std::vector<std::string>{}, {"--baseline", "ue-dither"}})
        EXPECT_EQ(test::why_not_failed(with(more), kWrongUsage, "noise blue: nothing draws"), "");
    for (const std::vector<std::string>& more : {std::vector<std::string>{"--estimator", "reservoir"},
                                                 {"--texture-jitter", "affine", "--mip", "none"},
                                                 {"--shadow-taps", "one"},
                                                 {"--baseline", "oiio-stochastic"}})
        EXPECT_EQ(with(more).code, kDone) << more[1];
}

TEST(LookupOptions, GpuPrecisionReachesEveryLookupOfARender) {
    const TemporaryFolder folder;
    test::write_quad(folder);
    const shading::Image exact = render_quad(folder, {"--precision", "exact"});
    EXPECT_EQ(largest_difference(exact, render_quad(folder, {})), 0);
    const shading::Image gpu = render_quad(folder, {"--precision", "gpu"});
    EXPECT_EQ(nlohmann::json::parse(test::read_file(folder / "stats.json"))["lookup"]["precision"], "gpu");
    // A fraction rounded to 1/256 moves a colour by at most 1/512 of what neighbours differ by, along each axis.
    EXPECT_GT(largest_difference(exact, gpu), 1e-4f);
    EXPECT_LT(largest_difference(exact, gpu), 2.0f / 512);
}

}  // namespace
}  // namespace rawtexel::cli
