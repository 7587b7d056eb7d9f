#include "cli/command_line.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace rawtexel::cli {
namespace {

/// A command with two options, a flag and one or two words.
struct Sample {
    std::string size, output;
    bool count = false;
    std::vector<std::string> words;
    CommandLine line{"sample SCENE [MORE] -o FILE", "A command to test with."};

    Sample() {
        line.arguments("SCENE", "what to draw", 1, 2, words);
        line.option("-o,--output", "FILE", "where to", [this](const std::string& text) { output = text; });
        line.group("Image");
        line.option("--size", "WxH", "how large", [this](const std::string& text) { size = text; });
        line.flag("--count", "count things", count);
    }
    std::string error(const std::vector<std::string>& given) {
        try {
            line.parse(given);
        } catch (const UsageError& usage) {
            return usage.what();
        }
        return "";
    }
};

TEST(CommandLine, TheOrderOfWordsDoesNotMatter) {
    // Options stay beside their values; everything else may move.
    std::vector<std::vector<std::string>> groups{{"-o", "out.png"}, {"--size", "64x64"}, {"--count"}, {"scene.glb"}};
    std::ranges::sort(groups);
    int orders = 0;
    do {
        std::vector<std::string> given;
        for (const auto& group : groups) given.insert(given.end(), group.begin(), group.end());
        Sample sample;
        ASSERT_TRUE(sample.line.parse(given));
        EXPECT_EQ(sample.size, "64x64");
        EXPECT_EQ(sample.output, "out.png");
        EXPECT_TRUE(sample.count);
        EXPECT_EQ(sample.words, std::vector<std::string>{"scene.glb"});
        ++orders;
    } while (std::ranges::next_permutation(groups).found);
    EXPECT_EQ(orders, 24);
}

TEST(CommandLine, TellsWhatWasGiven) {
    Sample sample;
    bool flagged = false;
    sample.line.flag_with_value("--ewa", "S2", "an ellipse", [](const std::string&) {});
    sample.line.repeated_option("--more", "X", "again", [](const std::string&) {});
    sample.line.flag("-q,--quick", "fast", flagged);
    ASSERT_TRUE(sample.line.parse({"a", "-q", "--more", "1", "-o=b", "--ewa:0.5", "--more", "2", "--size=1x2"}));
    std::vector<std::pair<std::string, std::string>> given = sample.line.given();
    std::ranges::sort(given);
    const std::vector<std::pair<std::string, std::string>> expected{{"--ewa:0.5", ""}, {"--more", "1"}, {"--more", "2"},
                                                                    {"--output", "b"}, {"--quick", ""}, {"--size", "1x2"}};
    EXPECT_EQ(given, expected);
}

TEST(CommandLine, AnOptionTakesThePlaceOfAnother) {
    Sample sample;
    std::string list;
    sample.line.replace_option("--size", "LIST", "many sizes", [&](const std::string& text) { list = text; });
    ASSERT_TRUE(sample.line.parse({"a", "--size", "1x2,3x4", "-o", "b"}));
    EXPECT_EQ(list, "1x2,3x4");
    EXPECT_EQ(sample.size, "");
    const std::string help = sample.line.help();
    EXPECT_NE(help.find("Image:\n  --size LIST"), std::string::npos) << help;
    EXPECT_EQ(help.find("WxH"), std::string::npos) << help;
}

TEST(CommandLine, ValuesMayFollowAnEqualsSign) {
    Sample sample;
    ASSERT_TRUE(sample.line.parse({"a", "--size=1x2", "--output=b"}));
    EXPECT_EQ(sample.size, "1x2");
    EXPECT_EQ(sample.output, "b");
}

TEST(CommandLine, ShortOptionsTakeAnEqualsSignToo) {
    for (const std::string& value : {std::string("b.png"), std::string("=b"), std::string("a=b")}) {
        Sample sample;
        ASSERT_TRUE(sample.line.parse({"a", "-o=" + value}));
        EXPECT_EQ(sample.output, value);
        EXPECT_EQ(sample.words, std::vector<std::string>{"a"});
    }
    Sample value, word;
    ASSERT_TRUE(value.line.parse({"--size", "-o=1", "a"}));  // a value may look like anything
    EXPECT_EQ(value.size, "-o=1");
    ASSERT_TRUE(word.line.parse({"--", "-o=1"}));
    EXPECT_EQ(word.words, std::vector<std::string>{"-o=1"});
    EXPECT_EQ(Sample().error({"a", "-o="}), "--output: a value is missing (FILE)");
}

TEST(CommandLine, EmptyWordsAreNamed) { EXPECT_TRUE(Sample().error({""}).starts_with("an argument is empty")) << Sample().error({""}); }

TEST(CommandLine, ValuesMayBeNegativeOrLookLikeWords) {
    for (const std::string value : {"-1,2,3", "-.5,0,0", "-0.4,-1,-0.3,3", "{\"a\": [1]}", "[x]", "a b", "-"}) {
        Sample sample;
        ASSERT_TRUE(sample.line.parse({"--size", value, "scene"})) << value;
        EXPECT_EQ(sample.size, value);
    }
}

TEST(CommandLine, AfterTwoDashesEverythingIsAWord) {
    Sample sample;
    ASSERT_TRUE(sample.line.parse({"-o", "x", "--", "--size", "-h2"}));
    EXPECT_EQ(sample.words, (std::vector<std::string>{"--size", "-h2"}));
}

TEST(CommandLine, UnknownOptionsNameTheNearest) {
    EXPECT_EQ(Sample().error({"a", "--sise", "1x1"}), "unknown option '--sise', the nearest is '--size'");
    EXPECT_EQ(Sample().error({"a", "--cuont"}), "unknown option '--cuont', the nearest is '--count'");
    EXPECT_EQ(Sample().error({"a", "--siz=3"}), "unknown option '--siz', the nearest is '--size'");
    EXPECT_EQ(Sample().error({"a", "-size", "3"}), "unknown option '-size', the nearest is '--size'");
    EXPECT_EQ(Sample().error({"a", "-p"}), "unknown option '-p', the nearest is '-o'");
}

TEST(CommandLine, MissingAndRepeatedValuesAreNamed) {
    EXPECT_EQ(Sample().error({"a", "--size"}), "--size: a value is missing");
    EXPECT_EQ(Sample().error({"a", "--size", "--count"}), "--size: a value is missing (WxH)");
    EXPECT_EQ(Sample().error({"a", "--size", "1x1", "--size", "2x2"}), "--size: given more than once ('1x1' and '2x2')");
    EXPECT_EQ(Sample().error({"a", "-o", ""}), "--output: a value is missing (FILE)");
}

TEST(CommandLine, TooFewAndTooManyWordsShowTheUsage) {
    EXPECT_EQ(Sample().error({"-o", "x"}), "missing argument SCENE (usage: rawtexel sample SCENE [MORE] -o FILE)");
    EXPECT_EQ(Sample().error({"a", "b", "c"}), "unexpected argument 'c' (usage: rawtexel sample SCENE [MORE] -o FILE)");
}

TEST(CommandLine, AFlagTakesNoValue) { EXPECT_NE(Sample().error({"a", "--count=maybe"}), ""); }

TEST(CommandLine, NoErrorHasTwoLinesOrNamesTheLibrary) {
    const std::vector<std::vector<std::string>> wrong{{},
                                                      {"--size"},
                                                      {"-"},
                                                      {"--"},
                                                      {"-o"},
                                                      {"a", "---"},
                                                      {"a", "--="},
                                                      {"a", "-o", "x", "-o", "y"},
                                                      {"a", "b", "c"},
                                                      {"a", "--count=7"},
                                                      {"a", "-zzz"}};
    for (const auto& given : wrong) {
        const std::string error = Sample().error(given);
        EXPECT_EQ(error.find('\n'), std::string::npos) << error;
        EXPECT_EQ(error.find("CLI"), std::string::npos) << error;
    }
}

TEST(CommandLine, HelpNamesEverythingAndChecksNothing) {
    for (const std::string word : {"-h", "--help"}) {
        Sample sample;
        EXPECT_FALSE(sample.line.parse({"--wrong", word}));
    }
    const std::string help = Sample().line.help();
    for (const char* part : {"Usage: rawtexel sample SCENE [MORE] -o FILE", "A command to test with.", "SCENE", "what to draw",
                             "-o,--output FILE", "where to", "Image:", "--size WxH", "how large", "--count", "count things", "-h,--help"})
        EXPECT_NE(help.find(part), std::string::npos) << part << "\n" << help;
}

TEST(CommandLine, KnowsWhichOptionsTakeAValue) {
    const Sample sample;
    EXPECT_TRUE(sample.line.takes_value("--size"));
    EXPECT_TRUE(sample.line.takes_value("-o"));
    EXPECT_FALSE(sample.line.takes_value("--count"));
    EXPECT_FALSE(sample.line.takes_value("--size=1x1"));
    EXPECT_FALSE(sample.line.takes_value("scene"));
    EXPECT_FALSE(sample.line.takes_value("--unknown"));
}

TEST(CommandLine, WrappedTextKeepsItsWordsAndItsWidth) {
    const std::string text = "one two three four five sixteen seventeen";
    std::string wrapped = wrap_text(text, 12, 4);
    size_t start = 0;
    for (const size_t width : {size_t(12), size_t(16), size_t(16), size_t(16), size_t(16)}) {
        const size_t end = std::min(wrapped.find('\n', start), wrapped.size());
        EXPECT_LE(end - start, width) << wrapped;
        start = std::min(end + 1, wrapped.size());
    }
    std::erase(wrapped, '\n');
    size_t gap;
    while ((gap = wrapped.find("    ")) != std::string::npos) wrapped.erase(gap, 3);
    EXPECT_EQ(wrapped, text);
}

TEST(CommandLine, RepeatedOptionsTakeDashesAndComeInOrder) {
    std::vector<std::string> values, words;
    int size = 0;
    const auto read = [&](const std::vector<std::string>& given) {
        CommandLine line{"test", ""};
        values.clear();
        line.arguments("FILE", "", 0, 1, words);
        line.repeated_option("--with", "OPTIONS", "", [&](const std::string& text) { values.push_back(text); });
        line.option("--size", "N", "", [&](const std::string& text) { size = std::stoi(text); });
        return line.parse(given);
    };
    EXPECT_TRUE(read({"--with", "--a b", "file", "--with=-c", "--size", "3", "--with", "d"}));
    EXPECT_EQ(values, (std::vector<std::string>{"--a b", "-c", "d"}));
    EXPECT_EQ(words, std::vector<std::string>{"file"});
    EXPECT_EQ(size, 3);
    EXPECT_THROW(read({"--with"}), UsageError);
    EXPECT_THROW(read({"--with="}), UsageError);
    EXPECT_THROW(read({"--with", ""}), UsageError);
    EXPECT_TRUE(read({"--", "--with"}));
    EXPECT_EQ(words, std::vector<std::string>{"--with"});
}

}  // namespace
}  // namespace rawtexel::cli
