// From linear radiance to codes: exact rounding, known values of the curves, names.
#include "shading/display.h"

#include "shading/tone_map.h"
#include "shading/transfer.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

namespace rawtexel::shading {
namespace {

constexpr Transfer kAll[] = {Transfer::Srgb, Transfer::Sqrt, Transfer::Linear};

int code_of(float value, Transfer transfer) {
    Image image(1, 1, 1);
    image.values[0] = value;
    return encode_8bit(image, transfer)[0];
}

/// The encoded value in units of codes, in long double.
long double exact_code(float value, Transfer transfer) {
    const long double x = value;
    switch (transfer) {
        case Transfer::Srgb: return 255.0L * (x <= 0.0031308L ? 12.92L * x : 1.055L * std::pow(x, 1.0L / 2.4L) - 0.055L);
        case Transfer::Sqrt: return 255.0L * std::sqrt(x);
        case Transfer::Linear: break;
    }
    return 255.0L * x;
}

TEST(Encode8Bit, EveryCodeSurvivesARoundTrip) {
    for (const Transfer transfer : kAll)
        for (int code = 0; code < 256; ++code)
            EXPECT_EQ(code_of(float(decoded(code / 255.0, transfer)), transfer), code) << to_string(transfer);
}

TEST(Encode8Bit, RoundsToTheNearestCodeOnBothSidesOfEveryThreshold) {
    for (const Transfer transfer : kAll) {
        const CodeTable table(transfer);
        for (int code = 1; code < 256; ++code) {
            const float least = table.threshold(code), below = std::nextafter(least, 0.0f);
            EXPECT_GE(exact_code(least, transfer), code - 0.5L) << to_string(transfer) << ' ' << code;
            EXPECT_LT(exact_code(below, transfer), code - 0.5L) << to_string(transfer) << ' ' << code;
            EXPECT_EQ(code_of(least, transfer), code) << to_string(transfer);
            EXPECT_EQ(code_of(below, transfer), code - 1) << to_string(transfer);
        }
    }
}

TEST(Encode8Bit, StaysWithinHalfACodeAndNeverFalls) {
    // D3D11.3 3.2.3.5 allows 0.6 ULP for float to sRGB; exact rounding has 0.5.
    for (const Transfer transfer : kAll) {
        int last = 0;
        long double worst = 0.0L;
        for (uint32_t bits = 0; bits <= 0x3F800000u; bits += 977) {
            const float value = std::bit_cast<float>(bits);
            const int code = code_of(value, transfer);
            ASSERT_GE(code, last) << value;
            worst = std::max(worst, std::fabs(exact_code(value, transfer) - code));
            last = code;
        }
        EXPECT_LE(worst, 0.5L + 1e-6L) << to_string(transfer);
        EXPECT_EQ(last, 255);
    }
}

TEST(Encode8Bit, WhatIsNoLightIsBlackAndTooMuchIsWhite) {
    for (const Transfer transfer : kAll) {
        EXPECT_EQ(code_of(std::numeric_limits<float>::quiet_NaN(), transfer), 0);
        EXPECT_EQ(code_of(-1.0f, transfer), 0);
        EXPECT_EQ(code_of(-0.0f, transfer), 0);
        EXPECT_EQ(code_of(std::numeric_limits<float>::denorm_min(), transfer), 0);
        EXPECT_EQ(code_of(-std::numeric_limits<float>::infinity(), transfer), 0);
        EXPECT_EQ(code_of(1.0f, transfer), 255);
        EXPECT_EQ(code_of(7.0f, transfer), 255);
        EXPECT_EQ(code_of(std::numeric_limits<float>::infinity(), transfer), 255);
    }
}

TEST(Encode8Bit, KeepsTheOrderOfPixelsAndChannels) {
    Image image(2, 2, 3);
    for (size_t i = 0; i < image.values.size(); ++i) image.values[i] = float(i) / 255.0f;
    const std::vector<uint8_t> codes = encode_8bit(image, Transfer::Linear);
    ASSERT_EQ(codes.size(), 12u);
    for (size_t i = 0; i < codes.size(); ++i) EXPECT_EQ(codes[i], i);
}

TEST(ToneMap, AcesAgreesWithKnownValues) {
    EXPECT_NEAR(tone_map_aces(glm::vec3(0.0f)).x, 0.0f, 1e-3f);
    // Middle grey and white of the fit, to the digits of its constants: f(0.18) = 0.1055, f(1) = 0.6166.
    const auto curve = [](double v) { return (v * (v + 0.0245786) - 0.000090537) / (v * (0.983729 * v + 0.4329510) + 0.238081); };
    for (const double grey : {0.01, 0.18, 1.0, 10.0}) {
        const glm::vec3 mapped = tone_map_aces(glm::vec3(float(grey)));
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(mapped[c], curve(grey), 2e-4 * std::max(1.0, grey)) << "grey " << grey << " channel " << c;
    }
    // Colours desaturate: pure red leaks into the other channels when bright.
    EXPECT_GT(tone_mapped(glm::vec3(50.0f, 0.0f, 0.0f), 1.0f, ToneMap::Aces).g, 0.05f);
}

TEST(ToneMap, EveryCurveIsMonotoneAndStaysInRange) {
    for (const ToneMap tone_map : {ToneMap::Aces, ToneMap::Reinhard, ToneMap::None}) {
        float last = 0.0f;
        for (float grey = 1e-6f; grey < 1e30f; grey *= 1.07f) {
            const float mapped = tone_mapped(glm::vec3(grey), 1.0f, tone_map).y;
            ASSERT_GE(mapped, last - 1e-6f) << to_string(tone_map) << " at " << grey;
            ASSERT_LE(mapped, 1.0f);
            last = mapped;
        }
        EXPECT_GT(last, 0.99f) << to_string(tone_map);
    }
}

TEST(ToneMap, ExposureIsAFactorOfTwoPerStep) {
    Image image(1, 1, 3);
    image.values = {0.1f, 0.2f, 0.4f};
    DisplayOptions options;
    options.tone_map = ToneMap::None;
    options.exposure = 1.0f;
    EXPECT_EQ(tone_mapped(image, options).values, (std::vector<float>{0.2f, 0.4f, 0.8f}));
    options.exposure = -1.0f;
    EXPECT_EQ(tone_mapped(image, options).values, (std::vector<float>{0.05f, 0.1f, 0.2f}));
    options.tone_map = ToneMap::Reinhard;
    options.exposure = 0.0f;
    EXPECT_FLOAT_EQ(tone_mapped(image, options).values[2], 0.4f / 1.4f);
}

TEST(ToneMap, WhatIsNoLightIsBlackAndInfinityIsWhite) {
    for (const ToneMap tone_map : {ToneMap::Aces, ToneMap::Reinhard, ToneMap::None}) {
        const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
        EXPECT_LT(tone_mapped(glm::vec3(nan, -1.0f, -infinity), 1.0f, tone_map).x, 1e-3f) << to_string(tone_map);
        EXPECT_GT(tone_mapped(glm::vec3(infinity), 1.0f, tone_map).x, 0.999f) << to_string(tone_map);
    }
}

TEST(ToneMap, ChannelsAfterTheThirdAreLeftAlone) {
    Image image(1, 1, 4);
    image.values = {5.0f, 5.0f, 5.0f, 0.3f};
    EXPECT_EQ(tone_mapped(image, {}).values[3], 0.3f);
}

TEST(DisplayNames, ParseWhatTheyPrint) {
    for (const ToneMap tone_map : {ToneMap::Aces, ToneMap::Reinhard, ToneMap::None})
        EXPECT_EQ(parse_tone_map(to_string(tone_map)), tone_map);
    for (const Transfer transfer : kAll) EXPECT_EQ(parse_transfer(to_string(transfer)), transfer);
    EXPECT_EQ(parse_tone_map("filmic"), std::nullopt);
    EXPECT_EQ(parse_transfer("SRGB"), std::nullopt);
}

TEST(Encode8BitOverWhite, WholePixelsAreAsWithoutWhite) {
    Image radiance(256, 1, 3), coverage(256, 1, 1);
    for (size_t i = 0; i < radiance.values.size(); ++i) radiance.values[i] = float(i) * float(i) / 1e4f;
    std::fill(coverage.values.begin(), coverage.values.end(), 1.0f);
    for (const Transfer transfer : kAll) {
        const DisplayOptions options{0.5f, ToneMap::Aces, transfer};
        EXPECT_EQ(encode_8bit_over_white(radiance, coverage, options), encode_8bit(tone_mapped(radiance, options), transfer))
            << to_string(transfer);
    }
}

TEST(Encode8BitOverWhite, EmptyPixelsAreWhiteAndHalfOnesLieInTheMiddle) {
    for (const ToneMap tone_map : {ToneMap::Aces, ToneMap::Reinhard, ToneMap::None})
        for (const float value : {0.0f, 0.1f, 0.7f, 50.0f}) {
            Image radiance(3, 1, 3), coverage(3, 1, 1);
            coverage.values = {0.0f, 0.5f, 1.0f};
            for (int x = 0; x < 3; ++x)
                for (int c = 0; c < 3; ++c) radiance.pixel(x, 0)[c] = value * coverage.values[size_t(x)];
            const std::vector<uint8_t> codes = encode_8bit_over_white(radiance, coverage, {0.0f, tone_map, Transfer::Srgb});
            for (size_t c = 0; c < 3; ++c) {
                EXPECT_EQ(codes[c], 255);
                EXPECT_NEAR(codes[3 + c], (255.0 + codes[6 + c]) / 2.0, 1.0) << to_string(tone_map) << ' ' << value;
            }
        }
}

}  // namespace
}  // namespace rawtexel::shading
