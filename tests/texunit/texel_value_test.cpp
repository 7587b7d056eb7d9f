#include "texunit/texel_value.h"

#include "texunit/half.h"
#include "texunit/srgb.h"

#include "tests/texunit/hashed_source.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>

namespace rawtexel::texunit {
namespace {

/// binary16 by its definition (IEEE 754, 3.4).
double half_value(uint16_t half) {
    const int exponent = half >> 10 & 31, mantissa = half & 1023;
    const double magnitude = exponent == 0 ? std::ldexp(mantissa, -24) : std::ldexp(1024 + mantissa, exponent - 25);
    return half & 0x8000 ? -magnitude : magnitude;
}

TEST(Half, ReadsAllFiniteValuesExactly) {
    for (uint32_t half = 0; half < 0x10000; ++half) {
        if ((half & 0x7C00) == 0x7C00) continue;
        ASSERT_EQ(half_to_float(uint16_t(half)), half_value(uint16_t(half))) << std::hex << half;
        ASSERT_EQ(float_to_half(half_to_float(uint16_t(half))), half);
    }
    EXPECT_EQ(half_to_float(0x7C00), std::numeric_limits<float>::infinity());
    EXPECT_EQ(half_to_float(0xFC00), -std::numeric_limits<float>::infinity());
    EXPECT_TRUE(std::isnan(half_to_float(0x7E00)));
    EXPECT_TRUE(std::isnan(half_to_float(0xFC01)));
}

TEST(Half, RoundsToTheNearestAndTiesToEven) {
    for (uint16_t half = 0; half < 0x7BFF; ++half) {
        const double low = half_value(half), high = half_value(uint16_t(half + 1)), middle = (low + high) / 2;
        ASSERT_EQ(float_to_half(float(middle)), half % 2 == 0 ? half : half + 1) << middle;
        ASSERT_EQ(float_to_half(std::nextafter(float(middle), 0.0f)), half) << middle;
        ASSERT_EQ(float_to_half(std::nextafter(float(middle), 1e9f)), half + 1) << middle;
        ASSERT_EQ(float_to_half(-std::nextafter(float(middle), 0.0f)), half | 0x8000) << middle;
    }
    EXPECT_EQ(float_to_half(65519.0f), 0x7BFF);
    EXPECT_EQ(float_to_half(65520.0f), 0x7C00);
    EXPECT_EQ(float_to_half(std::numeric_limits<float>::max()), 0x7C00);
    EXPECT_EQ(float_to_half(-std::numeric_limits<float>::infinity()), 0xFC00);
    EXPECT_EQ(float_to_half(0x1p-149f), 0);
    EXPECT_TRUE(std::isnan(half_to_float(float_to_half(std::numeric_limits<float>::quiet_NaN()))));
}

std::array<double, 4> widen(const std::array<float, 4>& value) { return {value[0], value[1], value[2], value[3]}; }

TEST(TexelEncoder, WritesBackEveryTexelItCanRead) {
    std::mt19937_64 random(1);
    for (const FormatInfo& about : all_formats()) {
        const TexelLayout& stored = layout(about.format);
        const TexelEncoder encoder(stored);
        for (int n = 0; n < 20000; ++n) {
            std::byte texel[16] = {}, again[16] = {};
            store_random_texel(stored, random(), texel);
            encoder.store(widen(load_texel(stored, texel)), again);
            ASSERT_EQ(std::memcmp(texel, again, size_t(bytes_per_texel(stored.storage))), 0) << about.name << " draw " << n;
        }
    }
}

TEST(TexelEncoder, RoundsToTheNearestField) {
    std::mt19937 random(2);
    std::uniform_real_distribution<double> uniform(-1.2, 1.2);
    for (const FormatInfo& about : all_formats()) {
        const TexelLayout& stored = layout(about.format);
        if (stored.storage == StorageClass::Half4 || stored.storage == StorageClass::Float4) continue;
        const TexelEncoder encoder(stored);
        for (int n = 0; n < 20000; ++n) {
            const double wanted = n == 0 ? std::numeric_limits<double>::quiet_NaN() : uniform(random);
            std::byte texel[16] = {};
            encoder.store({wanted, wanted, wanted, wanted}, texel);
            const std::array<float, 4> found = load_texel(stored, texel);
            for (size_t c = 0; c < 4; ++c) {
                if (stored.mask[c] == 0) continue;
                // Compare where rounding happens: in code space for sRGB.
                const bool srgb = stored.table[c] != nullptr;
                const double clamped = wanted == wanted ? std::clamp(wanted, stored.is_signed ? -1.0 : 0.0, 1.0) : 0;
                const double exact = (srgb ? linear_to_srgb(clamped) : clamped) * stored.denominator[c];
                const double field = (srgb ? linear_to_srgb(found[c]) : double(found[c])) * stored.denominator[c];
                ASSERT_NEAR(field, exact, 0.5 + 65535 * 0x1p-23) << about.name << " channel " << c << " value " << wanted;
            }
        }
    }
}

TEST(TexelEncoder, EncodesAll256SrgbCodesAndTheirBoundaries) {
    const TexelLayout& stored = layout(Format::RGBA8Srgb);
    const TexelEncoder encoder(stored);
    const auto code_of = [&](double linear) {
        uint8_t codes[4];
        encoder.store({linear, linear, linear, linear}, reinterpret_cast<std::byte*>(codes));
        EXPECT_EQ(codes[0], codes[1]);
        EXPECT_EQ(codes[0], codes[2]);
        EXPECT_EQ(codes[3], int(std::floor(linear * 255 + 0.5))) << "alpha is linear";
        return int(codes[0]);
    };
    for (int code = 0; code < 256; ++code) {
        EXPECT_EQ(code_of(srgb_to_linear(code / 255.0)), code);
        EXPECT_EQ(code_of(srgb8_table()[code]), code);
        if (code == 255) continue;
        EXPECT_EQ(code_of(srgb_to_linear((code + 0.4999) / 255)), code);
        EXPECT_EQ(code_of(srgb_to_linear((code + 0.5001) / 255)), code + 1);
    }
}

}  // namespace
}  // namespace rawtexel::texunit
