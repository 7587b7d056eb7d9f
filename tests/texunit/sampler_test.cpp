#include "texunit/sampler.h"

#include "texunit/fetch_log.h"
#include "texunit/simd.h"

#include <gtest/gtest.h>

namespace rawtexel::texunit {
namespace {

TEST(Sampler, PrintsAndParsesOneSpelling) {
    for (const Wrap wrap : {Wrap::Repeat, Wrap::MirroredRepeat, Wrap::ClampToEdge}) EXPECT_EQ(parse_wrap(to_string(wrap)), wrap);
    for (const Kernel kernel : {Kernel::Nearest, Kernel::Bilinear}) EXPECT_EQ(parse_kernel(to_string(kernel)), kernel);
    for (const MipMode mode : {MipMode::None, MipMode::Nearest, MipMode::Linear}) EXPECT_EQ(parse_mip_mode(to_string(mode)), mode);
    EXPECT_EQ(to_string(Wrap::MirroredRepeat), "mirror");
    EXPECT_EQ(to_string(Kernel::Bilinear), "bilinear");
    EXPECT_EQ(to_string(MipMode::None), "none");
    EXPECT_EQ(parse_wrap("mirrored"), std::nullopt);
    EXPECT_EQ(parse_kernel(""), std::nullopt);
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
    FetchCounts sum{1, 20, 300};
    sum += {4, 50, 600};
    EXPECT_EQ(sum, (FetchCounts{5, 70, 900}));
}

}  // namespace
}  // namespace rawtexel::texunit
