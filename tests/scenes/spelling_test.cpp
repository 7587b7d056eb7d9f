#include "scenes/spelling.h"

#include <gtest/gtest.h>

#include <array>

namespace rawtexel::scenes {
namespace {

TEST(SceneSpelling, DistanceCountsEditsAndSwaps) {
    EXPECT_EQ(spelling_distance("", ""), 0);
    EXPECT_EQ(spelling_distance("plane", "plane"), 0);
    EXPECT_EQ(spelling_distance("plane", "plan"), 1);
    EXPECT_EQ(spelling_distance("plane", "planet"), 1);
    EXPECT_EQ(spelling_distance("plane", "plaen"), 1);
    EXPECT_EQ(spelling_distance("plane", "place"), 1);
    EXPECT_EQ(spelling_distance("", "abc"), 3);
    EXPECT_EQ(spelling_distance("kitten", "sitting"), 3);
}

TEST(SceneSpelling, DistanceIsSymmetric) {
    for (const auto& [a, b] : {std::pair{"metal-edge", "metl-egde"}, std::pair{"bumps", "bups"}, std::pair{"x", ""}})
        EXPECT_EQ(spelling_distance(a, b), spelling_distance(b, a)) << a << " " << b;
}

TEST(SceneSpelling, TheNearestCandidateIsFound) {
    constexpr std::array<std::string_view, 3> kNames = {"plane", "spheres", "magnify"};
    EXPECT_EQ(nearest_spelling("shperes", kNames), "spheres");
    EXPECT_EQ(nearest_spelling("plain", kNames), "plane");
    EXPECT_EQ(nearest_spelling("x", {}), "");
}

TEST(SceneSpelling, LinesAreJoinedAndControlCharactersDropped) {
    EXPECT_EQ(one_line("  a\n\n b\tc\r\n"), "a b c");
    EXPECT_EQ(one_line("\x1b[31mred"), "[31mred");
    EXPECT_EQ(one_line("\n"), "");
}

}  // namespace
}  // namespace rawtexel::scenes
