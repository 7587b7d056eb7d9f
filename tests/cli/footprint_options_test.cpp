#include "cli/footprint_options.h"

#include "cli/usage_error.h"

#include "tests/cli/option_group.h"

#include <gtest/gtest.h>

#include <vector>

namespace rawtexel::cli {
namespace {

shading::FootprintOptions parsed(const std::vector<std::string>& words) {
    const auto declare = [](CommandLine& line, shading::FootprintOptions& footprint) { declare_footprint_options(line, footprint); };
    return test::parsed_options<shading::FootprintOptions>(declare, words);
}

std::string complaint(const std::vector<std::string>& words) { return test::complaint_of(parsed, words); }

TEST(FootprintOptions, EveryOneReachesItsMember) {
    EXPECT_EQ(parsed({}), shading::FootprintOptions{});
    const shading::FootprintOptions all =
        parsed({"--aniso", "16:0.25", "--lod-rule", "exact", "--lod-bias", "-1.5", "--derivatives", "quad", "--footprint", "sample"});
    EXPECT_EQ(all.probes, 16);
    EXPECT_EQ(all.probe_variance, 0.25f);
    EXPECT_EQ(all.lod_rule, texunit::LodRule::Exact);
    EXPECT_EQ(all.lod_bias, -1.5f);
    EXPECT_EQ(all.derivatives, shading::Derivatives::Quad);
    EXPECT_EQ(all.area, shading::FootprintArea::Sample);
    EXPECT_EQ(print_anisotropy(all), "16:0.25");
    EXPECT_EQ(parsed({"--ewa:0.5"}).ellipse, 0.5f);
    EXPECT_EQ(parsed({"--ewa"}).ellipse, 1.0f / 6);
    EXPECT_EQ(print_anisotropy(parsed({"--aniso", "64"})), "64");
}

TEST(FootprintOptions, TakeTheWholeRangeOfVariances) {
    EXPECT_EQ(parsed({"--aniso", "1:0.001"}).probe_variance, 0.001f);
    EXPECT_EQ(parsed({"--aniso", "64:4"}).probe_variance, 4.0f);
    EXPECT_EQ(parsed({"--ewa:0.001"}).ellipse, 0.001f);
    EXPECT_EQ(parsed({"--ewa:4"}).ellipse, 4.0f);
    for (const char* beyond : {"0", "0.0009", "4.001", "-1"}) {
        EXPECT_NE(complaint({"--aniso", std::string("16:").append(beyond)}).find("0.001 to 4"), std::string::npos) << beyond;
        EXPECT_NE(complaint({std::string("--ewa:").append(beyond)}).find("0.001 to 4"), std::string::npos) << beyond;
    }
}

TEST(FootprintOptions, AreProbesOrTheEllipse) {
    const std::initializer_list<std::vector<std::string>> both{
        {"--aniso", "16:0.25", "--ewa"}, {"--ewa:0.5", "--aniso", "16:0.25"}, {"--ewa", "--aniso", "16"}, {"--aniso", "1", "--ewa:0.5"}};
    for (const auto& words : both)
        EXPECT_NE(complaint(words).find("--aniso and --ewa exclude each other"), std::string::npos) << words[0] << ' ' << complaint(words);
}

TEST(FootprintOptions, SayWhatIsWrongAndWhatIsAllowed) {
    EXPECT_NE(complaint({"--aniso", "65"}).find("64"), std::string::npos) << complaint({"--aniso", "65"});
    EXPECT_NE(complaint({"--aniso", "16:0"}).find("0.001"), std::string::npos) << complaint({"--aniso", "16:0"});
    EXPECT_NE(complaint({"--aniso", "16:"}), "");
    EXPECT_NE(complaint({"--ewa:x"}).find("--ewa"), std::string::npos) << complaint({"--ewa:x"});
    EXPECT_NE(complaint({"--ewa", "--ewa:0.2"}).find("more than once"), std::string::npos);
    EXPECT_NE(complaint({"--ewaa"}).find("'--ewa'"), std::string::npos) << complaint({"--ewaa"});
    EXPECT_NE(complaint({"--lod-rule", "d3"}).find("'d3d'"), std::string::npos);
    EXPECT_NE(complaint({"--lod-bias", "17"}).find("16"), std::string::npos);
}

}  // namespace
}  // namespace rawtexel::cli
