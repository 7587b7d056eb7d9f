#include "texunit/sampler.h"

#include "texunit/fetch_log.h"
#include "texunit/simd.h"

#include <gtest/gtest.h>

namespace rawtexel::texunit {
namespace {

TEST(Sampler, PrintsAndParsesOneSpelling) {
    for (const Wrap wrap : {Wrap::Repeat, Wrap::MirroredRepeat, Wrap::ClampToEdge, Wrap::ClampToBorder, Wrap::MirrorOnce})
        EXPECT_EQ(parse_wrap(to_string(wrap)), wrap);
    for (const LodRule rule : {LodRule::D3d, LodRule::Exact}) EXPECT_EQ(parse_lod_rule(to_string(rule)), rule);
    for (const Precision precision : {Precision::Exact, Precision::Gpu}) EXPECT_EQ(parse_precision(to_string(precision)), precision);
    for (const MipMode mode : {MipMode::None, MipMode::Nearest, MipMode::Linear}) EXPECT_EQ(parse_mip_mode(to_string(mode)), mode);
    EXPECT_EQ(to_string(Wrap::MirroredRepeat), "mirror");
    EXPECT_EQ(to_string(MipMode::None), "none");
    EXPECT_EQ(parse_wrap("mirrored"), std::nullopt);
    EXPECT_EQ(parse_mip_mode("Linear"), std::nullopt);
}

TEST(Simd, ChoosesEverySetItSaysIsAvailable) {
    const std::vector<Simd> available = available_simd();
    ASSERT_FALSE(available.empty());
    EXPECT_EQ(available.front(), Simd::Scalar);
    for (const Simd simd : available) {
        EXPECT_TRUE(choose_simd(simd));
        EXPECT_EQ(chosen_simd(), simd);
        EXPECT_EQ(parse_simd(to_string(simd)), simd);
    }
    EXPECT_TRUE(choose_simd(Simd::Auto));
    EXPECT_EQ(chosen_simd(), available.back()) << "auto is the best there is";
    EXPECT_EQ(parse_simd("auto"), Simd::Auto);
    EXPECT_EQ(parse_simd("sse5"), std::nullopt);
}

TEST(FetchCounts, AddUp) {
    FetchCounts sum{1, 20, 300, {100, 200}};
    sum += {4, 50, 600, {0, 1, 599}};
    EXPECT_EQ(sum, (FetchCounts{5, 70, 900, {100, 201, 599}}));
}

}  // namespace
}  // namespace rawtexel::texunit
