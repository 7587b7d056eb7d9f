#include "scenes/spelling.h"

#include <gtest/gtest.h>

#include <vector>

namespace rawtexel::scenes {
namespace {

const std::vector<std::string> kWords{"nearest", "bilinear", "scene", "--size", "--spp", "--seed", "--camera", "--count", "--crop"};

TEST(Spelling, DistanceCountsEditsAndSwaps) {
    EXPECT_EQ(spelling_distance("", ""), 0);
    EXPECT_EQ(spelling_distance("plane", "plane"), 0);
    EXPECT_EQ(spelling_distance("plane", "plan"), 1);
    EXPECT_EQ(spelling_distance("plane", "planet"), 1);
    EXPECT_EQ(spelling_distance("plane", "plaen"), 1);
    EXPECT_EQ(spelling_distance("plane", "place"), 1);
    EXPECT_EQ(spelling_distance("", "abc"), 3);
    EXPECT_EQ(spelling_distance("kitten", "sitting"), 3);
}

TEST(Spelling, DistanceIsSymmetric) {
    for (const auto& [a, b] : {std::pair{"metal-edge", "metl-egde"}, std::pair{"bumps", "bups"}, std::pair{"x", ""}})
        EXPECT_EQ(spelling_distance(a, b), spelling_distance(b, a)) << a << " " << b;
}

TEST(Spelling, ACorrectWordIsItsOwnNearest) {
    for (const std::string& word : kWords) EXPECT_EQ(nearest_spelling(word, kWords), word);
}

TEST(Spelling, EverySingleEditOfALongWordLeadsBack) {
    const std::string word = "bilinear";
    for (size_t i = 0; i < word.size(); ++i) {
        std::string removed = word, doubled = word, replaced = word, swapped = word;
        removed.erase(i, 1);
        doubled.insert(i, 1, word[i]);
        replaced[i] = '?';
        if (i + 1 < word.size()) std::swap(swapped[i], swapped[i + 1]);
        for (const std::string& typo : {removed, doubled, replaced, swapped}) EXPECT_EQ(nearest_spelling(typo, kWords), word) << typo;
    }
}

TEST(Spelling, ASwapOfNeighboursIsOneEdit) {
    // One swap from "ab", two substitutions from "bb" would be the same distance if a swap cost two.
    EXPECT_EQ(nearest_spelling("ba", std::vector<std::string>{"xy", "ab"}), "ab");
    EXPECT_EQ(nearest_spelling("baaa", std::vector<std::string>{"bccc", "abaa"}), "abaa");
}

TEST(Spelling, CaseIsIgnored) { EXPECT_EQ(nearest_spelling("BILINEAR", kWords), "bilinear"); }

TEST(Spelling, AnAbbreviationMeansTheWordItBegins) {
    EXPECT_EQ(nearest_spelling("--cam", kWords), "--camera");
    EXPECT_EQ(nearest_spelling("near", kWords), "nearest");
    EXPECT_EQ(nearest_spelling("ac", std::vector<std::string>{"ab", "acdef"}), "acdef");  // nearer than one edit
}

TEST(Spelling, TheFirstOfEqualsWins) { EXPECT_EQ(nearest_spelling("a", std::vector<std::string>{"b", "c"}), "b"); }

TEST(Spelling, WithoutCandidatesThereIsNone) { EXPECT_EQ(nearest_spelling("a", {}), ""); }

}  // namespace
}  // namespace rawtexel::scenes
