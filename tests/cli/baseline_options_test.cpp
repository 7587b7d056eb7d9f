// Rendering as others do, from words to what is refused beside it.
#include "cli/baseline_options.h"

#include "cli/command.h"
#include "cli/filtering_options.h"
#include "cli/footprint_options.h"
#include "tests/cli/option_group.h"
#include "tests/cli/program_runner.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace rawtexel::cli {
namespace {

LookupOptions parsed(const std::vector<std::string>& words) {
    const auto declare = [](CommandLine& line, LookupOptions& lookup) {
        declare_lookup_options(line, lookup);
        declare_footprint_options(line, lookup.footprint);
        declare_filtering_options(line, lookup.filtering);
        declare_baseline_option(line, lookup.filtering);
    };
    const LookupOptions lookup = test::parsed_options<LookupOptions>(declare, words);
    check_baseline(lookup);
    return lookup;
}
std::string complaint(std::vector<std::string> words, const std::string& baseline) {
    words.insert(words.end(), {"--baseline", baseline});
    return test::complaint_of(parsed, words);
}

TEST(BaselineOptions, EveryOneIsTakenAndPrinted) {
    for (const shading::BaselineInfo& info : shading::all_baselines()) {
        const LookupOptions lookup = parsed({"--baseline", std::string(info.name)});
        EXPECT_EQ(lookup.filtering.baseline, info.baseline);
        const auto choices = print_choices(lookup);
        EXPECT_NE(std::ranges::find(choices, std::pair<std::string, std::string>("baseline", info.name)), choices.end()) << info.name;
    }
    EXPECT_NE(complaint({}, "toxvig").find("toksvig"), std::string::npos);
}

TEST(BaselineOptions, ContradictionsAreRefused) {
    const std::pair<std::vector<std::string>, std::string> refused[] = {
        {{"--estimator", "reservoir"}, "lean"}, {{"--taps", "2"}, "ue-dither"},         {{"--random", "per-map"}, "ue-dither"},
        {{"--order", "after"}, "toksvig"},      {{"--order", "after"}, "moonray"},      {{"--order", "before"}, "startrek-dither"},
        {{"--filter", "bspline"}, "moonray"},   {{"--filter", "nearest"}, "ue-dither"}, {{"--mip", "linear"}, "ue-dither"},
        {{"--mip", "none"}, "oiio-stochastic"}, {{"--aniso", "8"}, "oiio-stochastic"},  {{"--ewa"}, "moonray"},
    };
    for (const auto& [words, baseline] : refused) {
        const std::string found = complaint(words, baseline);
        EXPECT_EQ(found.find("--baseline " + baseline), 0u) << words[0] << ": " << found;
        EXPECT_EQ(complaint(words, "none"), "");
    }
    const std::pair<std::vector<std::string>, std::string> taken[] = {
        {{"--estimator", "all"}, "clean"},        {{"--order", "after"}, "ue-dither"},    {{"--order", "before"}, "lean"},
        {{"--filter", "bilinear"}, "moonray"},    {{"--aniso", "8"}, "toksvig"},          {{"--filter", "bspline"}, "oiio-stochastic"},
        {{"--noise", "blue"}, "oiio-stochastic"}, {{"--mip", "none"}, "startrek-dither"}, {{"--lod-bias", "-1"}, "moonray"},
    };
    for (const auto& [words, baseline] : taken) EXPECT_EQ(complaint(words, baseline), "") << words[0];
}

TEST(BaselineOptions, ReachTheProgram) {
    const test::Outcome listed = test::run({"list", "baselines"});
    EXPECT_EQ(listed.code, kDone);
    for (const shading::BaselineInfo& info : shading::all_baselines()) EXPECT_NE(listed.out.find(info.name), std::string::npos);
    const test::Outcome refused = test::run({"render", "bumps", "-o", "unwritten.exr", "--baseline", "lean", "--order", "after"});
    EXPECT_EQ(test::why_not_failed(refused, 2, "--baseline lean"), "");
}

TEST(BaselineOptions, PixelsAreExplainedToTheBit) {
    // explain ends with 1 where its sum is not the rendered pixel.
    for (const char* baseline : {"lean", "ue-dither", "oiio-stochastic"})
        EXPECT_EQ(test::run({"explain", "bumps", "--size", "64x36", "--pixel", "20,30", "--spp", "2", "--baseline", baseline}).code, kDone)
            << baseline;
}

}  // namespace
}  // namespace rawtexel::cli
