#include "texunit/kernel.h"

#include <gtest/gtest.h>

namespace rawtexel::texunit {
namespace {

TEST(Kernel, PrintsAndParsesOneSpelling) {
    const Kernel kernels[] = {Kernel::Nearest,           Kernel::Bilinear,         Kernel::Quadratic,          Kernel::BSpline,
                              Kernel::mitchell(),        Kernel::mitchell(0, 0.5), Kernel::mitchell(1.5f, -1), Kernel::CatmullRom,
                              Kernel::Lanczos2,          Kernel::Lanczos3,         Kernel::gaussian(),         Kernel::gaussian(0.3f),
                              Kernel::gaussian_point(2), Kernel::gaussian_point()};
    for (const Kernel& kernel : kernels) EXPECT_EQ(parse_kernel(to_string(kernel)), kernel) << to_string(kernel);
    EXPECT_EQ(to_string(Kernel::mitchell()), "mitchell");
    EXPECT_EQ(to_string(Kernel::mitchell(0.25f, -0.5f)), "mitchell:0.25,-0.5");
    EXPECT_EQ(to_string(Kernel::gaussian(0.3f)), "gaussian:0.3");
    EXPECT_EQ(parse_kernel("gaussian:0.5"), Kernel::gaussian());
}

TEST(Kernel, RefusesWhatIsNoKernel) {
    for (const char* text :
         {"", "Bilinear", "cubic", "gaussian:", "gaussian:0", "gaussian:nan", "gaussian:17", "gaussian:1x", "gaussian:1,2",
          "mitchell:", "mitchell:0.3", "mitchell:0.3,", "mitchell:1e9,0", "mitchell:0.3,0.3,0.3", "bilinear:1", "nearest:"})
        EXPECT_EQ(parse_kernel(text), std::nullopt) << text;
}

TEST(Kernel, KnowsItsTaps) {
    EXPECT_EQ(axis_taps(Kernel::Nearest), 1);
    EXPECT_EQ(axis_taps(Kernel::Bilinear), 2);
    EXPECT_EQ(axis_taps(Kernel::Quadratic), 3);
    EXPECT_EQ(axis_taps(Kernel::mitchell()), 4);
    EXPECT_EQ(axis_taps(Kernel::Lanczos3), 6);
    EXPECT_EQ(axis_taps(Kernel::gaussian(0.5f)), 5);
    EXPECT_LE(axis_taps(Kernel::gaussian(kMostSigma)), kMostAxisTaps);
    EXPECT_LE(axis_taps(Kernel::gaussian_point(kMostSigma)), kMostAxisTaps);
}

}  // namespace
}  // namespace rawtexel::texunit
