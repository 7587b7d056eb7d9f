#include "cli/word_list.h"

#include <gtest/gtest.h>

namespace rawtexel::cli {
namespace {

TEST(WordList, SplitAndJoinAreInverse) {
    for (const std::string text : {"", "a", "a,b", ",", "a,,b", ",a", "b,,"}) EXPECT_EQ(join(split(text, ','), ","), text);
}

TEST(WordList, ThereIsOneWordMoreThanSeparators) {
    EXPECT_EQ(split("", ','), (std::vector<std::string>{""}));
    EXPECT_EQ(split(",a,", ','), (std::vector<std::string>{"", "a", ""}));
    EXPECT_EQ(join({}, ","), "");
}

}  // namespace
}  // namespace rawtexel::cli
