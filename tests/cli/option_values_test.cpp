#include "cli/option_values.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <random>

namespace rawtexel::cli {
namespace {

TEST(OptionValues, PrintedNumbersReadBackBitForBit) {
    std::mt19937 random(1);
    for (int i = 0; i < 100000; ++i) {
        const float value = std::bit_cast<float>(uint32_t(random()));
        if (!std::isfinite(value)) continue;
        const float back = parse_number("--x", print_number(value));
        ASSERT_EQ(std::bit_cast<uint32_t>(back), std::bit_cast<uint32_t>(value)) << print_number(value);
    }
}

TEST(OptionValues, PrintedVectorsReadBack) {
    const glm::vec3 value(-0.1f, 1e-30f, 12345.678f);
    EXPECT_EQ(parse_vector("--eye", print_vector(value)), value);
}

TEST(OptionValues, NumbersAreReadWholeOrNotAtAll) {
    for (const char* text : {"", " ", "1 ", " 1", "1x", "x", "0x10", "nan", "inf", "-inf", "1e999", "+1", "1,2", "--1"})
        EXPECT_THROW(parse_number("--x", text), UsageError) << '"' << text << '"';
    for (const char* text : {"", "1.0", "1e3", "99999999999999999999", "- 1"})
        EXPECT_THROW(parse_integer("--x", text, -1000, 1000), UsageError) << '"' << text << '"';
}

TEST(OptionValues, RangesIncludeTheirEnds) {
    EXPECT_EQ(parse_integer("--x", "1", 1, 4), 1);
    EXPECT_EQ(parse_integer("--x", "4", 1, 4), 4);
    EXPECT_THROW(parse_integer("--x", "0", 1, 4), UsageError);
    EXPECT_THROW(parse_integer("--x", "5", 1, 4), UsageError);
    EXPECT_EQ(parse_number("--x", "-64", {-64, 64}), -64.0f);
    EXPECT_THROW(parse_number("--x", "64.001", {-64, 64}), UsageError);
    EXPECT_EQ(parse_vector("--x", "0,1,2", "X,Y,Z", {0, 2}), glm::vec3(0, 1, 2));
    EXPECT_THROW(parse_vector("--x", "0,1,3", "X,Y,Z", {0, 2}), UsageError);
}

TEST(OptionValues, BytesTakeTheUnitsOfPowersOf1024) {
    EXPECT_EQ(parse_bytes("--x", "123"), 123u);
    EXPECT_EQ(parse_bytes("--x", "3K"), 3072u);
    EXPECT_EQ(parse_bytes("--x", "7M"), uint64_t{7} << 20);
    EXPECT_EQ(parse_bytes("--x", "1024G"), uint64_t{1} << 40);
    for (const char* text : {"", "0", "-1", "K", "1k", "1.5M", "1T", "1GB", "1025G", "99999999999999999999"})
        EXPECT_THROW(parse_bytes("--x", text), UsageError) << '"' << text << '"';
}

TEST(OptionValues, RangesReadWell) {
    EXPECT_EQ(print(NumberRange{-1e15f, 1e15f}), "-1e15 to 1e15");
    EXPECT_EQ(print(NumberRange{1e-6f, 1e10f}), "1e-6 to 1e10");
    EXPECT_EQ(print(NumberRange{0.01f, 179.0f}), "0.01 to 179");
    EXPECT_EQ(print(NumberRange{.lowest = 0.0f}), "at least 0");
    EXPECT_EQ(print(NumberRange{}), "any number");
}

TEST(OptionValues, ListsHaveTheirLength) {
    EXPECT_EQ(parse_numbers("--x", "1,2", "A,B[,C]", 2, 3).size(), 2u);
    EXPECT_EQ(parse_numbers("--x", "1,2,-.5", "A,B[,C]", 2, 3)[2], -0.5f);
    for (const char* text : {"1", "1,2,3,4", "1,,2", ",1,2", "1,2,"})
        EXPECT_THROW(parse_numbers("--x", text, "A,B[,C]", 2, 3), UsageError) << text;
}

TEST(OptionValues, ErrorsNameOptionTextAndWhatIsAllowed) {
    try {
        parse_integer("--spp", "zero", 1, 16);
        FAIL();
    } catch (const UsageError& error) {
        EXPECT_STREQ(error.what(), "--spp: 'zero' is not a whole number from 1 to 16");
    }
    try {
        parse_word("--shadows", "onn", {"on", "off"});
        FAIL();
    } catch (const UsageError& error) {
        EXPECT_STREQ(error.what(), "--shadows: unknown value 'onn', the nearest is 'on' (on off)");
    }
}

}  // namespace
}  // namespace rawtexel::cli
