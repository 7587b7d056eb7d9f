#include "scenes/message_text.h"

#include "scenes/utf8.h"

#include <gtest/gtest.h>

#include <cmath>

namespace rawtexel::scenes {
namespace {

TEST(MessageText, LinesAreJoinedAndControlCharactersDropped) {
    EXPECT_EQ(one_line("  a\n\n b\tc\r\n"), "a b c");
    EXPECT_EQ(one_line("\x1b[31mred"), "[31mred");
    EXPECT_EQ(one_line("\n"), "");
}

TEST(MessageText, WhatIsNoUtf8IsEscaped) {
    EXPECT_EQ(one_line("na\u00efve \u65e5 \U0001f600"), "na\u00efve \u65e5 \U0001f600");
    EXPECT_EQ(one_line("n\xff\xfe.gltf"), "n\\xff\\xfe.gltf");
    EXPECT_EQ(one_line("\xc3"), "\\xc3");                    // cut off
    EXPECT_EQ(one_line("\xc0\xaf"), "\\xc0\\xaf");           // longer than need be
    EXPECT_EQ(one_line("\xed\xa0\x80"), "\\xed\\xa0\\x80");  // a surrogate
}

TEST(MessageText, EveryCharacterIsUtf8AsItIsEncoded) {
    for (uint32_t code = 0; code < 0x110000; ++code) {
        const auto bits = [&](int shift, uint32_t mask, uint32_t lead) { return char(lead | (code >> shift & mask)); };
        const std::string text = code < 0x80    ? std::string{char(code)}
                                 : code < 0x800 ? std::string{bits(6, 0x1f, 0xc0), bits(0, 0x3f, 0x80)}
                                 : code < 0x10000
                                     ? std::string{bits(12, 0x0f, 0xe0), bits(6, 0x3f, 0x80), bits(0, 0x3f, 0x80)}
                                     : std::string{bits(18, 7, 0xf0), bits(12, 0x3f, 0x80), bits(6, 0x3f, 0x80), bits(0, 0x3f, 0x80)};
        const bool surrogate = code >= 0xd800 && code < 0xe000;
        ASSERT_EQ(find_invalid_utf8(text), surrogate ? 0 : text.npos) << code;
    }
}

TEST(MessageText, LongTextIsCutAtACharacter) {
    EXPECT_EQ(shortened("short"), "short");
    EXPECT_EQ(shortened(std::string(40, 'x')), std::string(40, 'x'));
    EXPECT_EQ(shortened(std::string(41, 'x')), std::string(40, 'x') + "...");
    std::string accents;
    for (int i = 0; i < 30; ++i) accents += "x\u00e9";
    EXPECT_EQ(find_invalid_utf8(shortened(accents)), std::string::npos) << shortened(accents);
    EXPECT_LE(shortened(accents).size(), 41u + 3u);
}

TEST(MessageText, NumbersAreShort) {
    EXPECT_EQ(print_short(0.1), "0.1");
    EXPECT_EQ(print_short(double(0.1f)), "0.1");
    EXPECT_EQ(print_short(1e30), "1e+30");
    EXPECT_EQ(print_short(100.0), "100");
    EXPECT_EQ(print_short(INFINITY), "inf");
}

}  // namespace
}  // namespace rawtexel::scenes
