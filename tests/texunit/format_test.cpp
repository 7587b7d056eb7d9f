#include "texunit/format.h"

#include "texunit/srgb.h"
#include "texunit/texel_source.h"

#include "tests/stress/worst_case.h"
#include "tests/stress_scale.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <set>
#include <string>

namespace rawtexel::texunit {
namespace {

TEST(Formats, HaveDistinctNamesAndAreListedInOrder) {
    std::set<std::string> names;
    int index = 0;
    for (const FormatInfo& about : all_formats()) {
        EXPECT_EQ(int(about.format), index++);
        EXPECT_TRUE(names.insert(std::string(about.name)).second) << about.name;
        EXPECT_FALSE(about.description.empty()) << about.name;
        EXPECT_EQ(about.srgb, about.name.find("srgb") != std::string_view::npos) << about.name;
        EXPECT_EQ(about.block_compressed, about.name.starts_with("bc")) << about.name;
        EXPECT_EQ(about.block_extent, about.block_compressed ? 4 : 1) << about.name;
    }
    EXPECT_EQ(index, kFormatCount);
}

TEST(Formats, ChangeOnlyTheTransferFunctionBetweenLinearAndSrgb) {
    int pairs = 0;
    for (const FormatInfo& about : all_formats()) {
        const Format linear = with_srgb(about.format, false), encoded = with_srgb(about.format, true);
        EXPECT_FALSE(info(linear).srgb) << about.name;
        EXPECT_EQ(info(linear).bytes_per_block, info(encoded).bytes_per_block) << about.name;
        EXPECT_EQ(info(linear).channels, info(encoded).channels) << about.name;
        EXPECT_EQ(layout(linear).storage, layout(encoded).storage) << about.name;
        EXPECT_EQ(about.srgb ? encoded : linear, about.format) << about.name;
        if (linear == encoded) continue;
        ++pairs;
        for (int c = 0; c < 4; ++c) {
            EXPECT_EQ(layout(linear).mask[c], layout(encoded).mask[c]) << about.name;
            EXPECT_EQ(layout(linear).shift[c], layout(encoded).shift[c]) << about.name;
        }
    }
    EXPECT_EQ(pairs, 16);
}

TEST(Formats, StoredBytesRoundBlocksUp) {
    for (const FormatInfo& about : all_formats()) {
        for (int height = 1; height <= 9; ++height) {
            for (int width = 1; width <= 9; ++width) {
                uint64_t units = 0;
                for (int y = 0; y < height; y += about.block_extent) {
                    for (int x = 0; x < width; x += about.block_extent) ++units;
                }
                EXPECT_EQ(stored_bytes(about.format, width, height), units * uint64_t(about.bytes_per_block))
                    << about.name << ' ' << width << 'x' << height;
            }
        }
    }
    EXPECT_EQ(stored_bytes(Format::RGBA32Float, 1 << 20, 1 << 20), uint64_t{1} << 44);
}

TEST(Layouts, FieldsDoNotOverlapAndFitTheirWord) {
    for (const FormatInfo& about : all_formats()) {
        const TexelLayout& l = layout(about.format);
        if (l.storage == StorageClass::Half4 || l.storage == StorageClass::Float4) continue;
        const int word_bits = 8 * bytes_per_texel(l.storage);
        uint64_t used = 0;
        for (int c = 0; c < 4; ++c) {
            const uint64_t field = uint64_t{l.mask[c]} << l.shift[c];
            EXPECT_EQ(field >> l.shift[c], l.mask[c]);
            EXPECT_EQ(used & field, 0u) << about.name << " channel " << c;
            if (word_bits < 64) {
                EXPECT_EQ(field >> word_bits, 0u) << about.name << " channel " << c;
            }
            used |= field;
            EXPECT_EQ(l.mask[c] != 0, c < about.channels) << about.name << " channel " << c;
            EXPECT_LE(uint32_t(l.denominator[c]), l.mask[c]) << about.name << " channel " << c;
            EXPECT_EQ(l.bias[c], c == 3 && about.channels < 4 ? 1.0f : 0.0f) << about.name << " channel " << c;
            EXPECT_EQ(l.table[c] != nullptr, about.srgb && c < std::min(about.channels, 3)) << about.name << " channel " << c;
        }
    }
}

/// The documented evaluation, each operation rounded to float.
float evaluate(const TexelLayout& l, int c, int field) {
    const float high = float(field) * l.scale_hi[c];
    const float low = float(field) * l.scale_lo[c];
    return std::max(high + low, -1.0f) + l.bias[c];
}

TEST(Layouts, ScaleEveryFieldToTheCorrectlyRoundedQuotient) {
    for (const FormatInfo& about : all_formats()) {
        const TexelLayout& l = layout(about.format);
        for (int c = 0; c < 4; ++c) {
            const int denominator = l.denominator[c];
            if (denominator == 0) continue;
            for (int field = l.is_signed ? -denominator : 0; field <= denominator; ++field) {
                ASSERT_EQ(double(float(field) * l.scale_hi[c]), double(field) * double(l.scale_hi[c])) << about.name << " field " << field;
                ASSERT_EQ(evaluate(l, c, field), float(double(field) / denominator))
                    << about.name << " channel " << c << " field " << field;
            }
        }
    }
    EXPECT_EQ(evaluate(layout(Format::R8Snorm), 0, -128), -1.0f);
}

TEST(Layouts, MissingChannelsAreZeroAndMissingAlphaOne) {
    const TexelLayout& l = layout(Format::R8Unorm);
    EXPECT_EQ(evaluate(l, 1, 0), 0.0f);
    EXPECT_EQ(evaluate(l, 2, 0), 0.0f);
    EXPECT_EQ(evaluate(l, 3, 0), 1.0f);
}

TEST(Layouts, SrgbTablesLineariseTheExactFieldAndNeverReachBeyondTheMask) {
    uint64_t fields = 0;
    double worst = 0;
    for (const FormatInfo& about : all_formats()) {
        const TexelLayout& l = layout(about.format);
        for (int c = 0; c < 3; ++c) {
            if (!l.table[c]) continue;
            for (uint32_t field = 0; field <= l.mask[c]; ++field) {
                const long double encoded = std::min<long double>(1, (long double)(field) / l.denominator[c]);
                const long double linear = encoded <= 0.04045L ? encoded / 12.92L : std::pow((encoded + 0.055L) / 1.055L, 2.4L);
                ++fields;
                if (linear > 0) worst = std::max(worst, double(std::abs((l.table[c][field] - linear) / linear)));
                ASSERT_NEAR(l.table[c][field], double(linear), double(linear) * 0x1p-24 + 1e-30) << about.name << " field " << field;
            }
            EXPECT_EQ(l.table[c][0], 0.0f);
            EXPECT_EQ(l.table[c][l.denominator[c]], 1.0f);
        }
    }
    tell_tested(fields, "sRGB fields");
    tell_worst_case("linear_off_by_of_its_value", worst);
}

TEST(Srgb, EveryCodeSurvivesDecodingAndEncoding) {
    double worst = 0;
    for (int code = 0; code < 256; ++code) {
        EXPECT_EQ(int(encode_srgb8(srgb8_table()[code])), code);
        worst = std::max(worst, std::abs(linear_to_srgb(srgb8_table()[code]) * 255 - code));
        EXPECT_NEAR(linear_to_srgb(srgb8_table()[code]), code / 255.0, 1e-7) << code;
    }
    tell_worst_case("round_trip_off_in_codes", worst);
}

TEST(Srgb, EncodingPicksTheNearestCode) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> uniform(0.0f, 1.0f);
    const int numbers = 100000 * stress_scale();
    double worst = 0;
    for (int i = 0; i < numbers; ++i) {
        const float linear = i % 2 ? uniform(random) : std::pow(uniform(random), 6.0f);
        const double scaled = linear_to_srgb(linear) * 255;
        ASSERT_LE(std::abs(int(encode_srgb8(linear)) - scaled), 0.5 + 1e-9) << linear;
        worst = std::max(worst, std::abs(int(encode_srgb8(linear)) - scaled));
    }
    tell_tested(uint64_t(numbers), "colours");
    tell_worst_case("off_in_codes", worst);
}

TEST(Srgb, EncodingClampsAndTakesNotANumberAsZero) {
    EXPECT_EQ(encode_srgb8(-1.0f), 0);
    EXPECT_EQ(encode_srgb8(2.0f), 255);
    EXPECT_EQ(encode_srgb8(std::numeric_limits<float>::infinity()), 255);
    EXPECT_EQ(encode_srgb8(std::numeric_limits<float>::quiet_NaN()), 0);
    EXPECT_EQ(linear_to_srgb(std::numeric_limits<double>::quiet_NaN()), 0.0);
}

TEST(Pyramid, FullLevelCountReachesOneTexel) {
    EXPECT_EQ(full_level_count(1, 1), 1);
    for (int extent : {1, 2, 3, 4, 5, 7, 8, 9, 1023, 1024, 1025, kMaxExtent}) {
        const int levels = full_level_count(1, extent);
        EXPECT_EQ(level_extent(extent, levels - 1), 1) << extent;
        if (levels > 1) {
            EXPECT_GT(level_extent(extent, levels - 2), 1) << extent;
        }
        EXPECT_EQ(full_level_count(extent, 1), levels);
        EXPECT_EQ(full_level_count(1, 1, extent), levels);
    }
    EXPECT_EQ(full_level_count(kMaxExtent, 1), kMaxLevels);
}

}  // namespace
}  // namespace rawtexel::texunit
