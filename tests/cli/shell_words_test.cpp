#include "cli/shell_words.h"

#include "cli/run_record.h"
#include "cli/usage_error.h"

#include <gtest/gtest.h>

namespace rawtexel::cli {
namespace {

using Words = std::vector<std::string>;

TEST(ShellWords, AreThoseOfAShell) {
    EXPECT_EQ(shell_words("--filter bspline\t--spp  2\n"), (Words{"--filter", "bspline", "--spp", "2"}));
    EXPECT_EQ(shell_words(R"(a'b c'd "e \"f\" \g" \  '')"), (Words{"ab cd", "e \"f\" \\g", " ", ""}));
    EXPECT_EQ(shell_words("  "), Words{});
    EXPECT_THROW(shell_words("a 'b"), UsageError);
    EXPECT_THROW(shell_words("a \"b'"), UsageError);
}

TEST(ShellWords, ReadBackWhatIsQuoted) {
    const Words words{"plain", "two words", "it's", "", "\"", "back\\slash", "$HOME", "tab\there", "--a=b"};
    EXPECT_EQ(shell_words(shell_quoted(words)), words);
}

}  // namespace
}  // namespace rawtexel::cli
