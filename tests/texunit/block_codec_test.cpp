// BC1 to BC5: exact fractions, exhaustive over endpoints.
#include "texunit/block_codec.h"

#include "tests/reference/texunit/bc_bc1_to_5.h"
#include "tests/texunit/every_simd.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <random>

namespace rawtexel::texunit {
namespace {

using reference::ColourRule;
using reference::Fraction;

/// A decoded block, with its fields as fractions.
class Decoded {
  public:
    Decoded(Format format, const std::byte* block) : layout_(layout(format)) { decode_block(format, block, texels_.data()); }

    Fraction operator()(int channel, int texel) const {
        uint64_t word = 0;
        const auto bytes = size_t(bytes_per_texel(layout_.storage));
        std::memcpy(&word, texels_.data() + size_t(texel) * bytes, bytes);
        const uint32_t field = uint32_t(word >> layout_.shift[channel]) & layout_.mask[channel];
        if (layout_.mask[channel] == 0) return {channel == 3, 1};
        const bool negative = layout_.is_signed && field > layout_.mask[channel] / 2;
        return {int64_t(field) - (negative ? int64_t(layout_.mask[channel]) + 1 : 0), layout_.denominator[channel]};
    }

  private:
    const TexelLayout& layout_;
    alignas(16) std::array<std::byte, 256> texels_{};
};

std::array<std::byte, 8> colour_block(uint32_t first, uint32_t second, uint32_t indices) {
    std::array<std::byte, 8> block;
    const uint64_t bits = first | (second << 16) | (uint64_t{indices} << 32);
    std::memcpy(block.data(), &bits, 8);
    return block;
}

std::array<std::byte, 8> value_block(uint32_t first, uint32_t second, uint64_t indices) {
    std::array<std::byte, 8> block;
    const uint64_t bits = first | (second << 8) | (indices << 16);
    std::memcpy(block.data(), &bits, 8);
    return block;
}

/// Two 8-byte halves, the second with the colour.
std::array<std::byte, 16> joined(const std::array<std::byte, 8>& first, const std::array<std::byte, 8>& second) {
    std::array<std::byte, 16> block;
    std::memcpy(block.data(), first.data(), 8);
    std::memcpy(block.data() + 8, second.data(), 8);
    return block;
}

constexpr uint32_t kEveryColourIndex = 0xE4E4E4E4;     // 0 1 2 3 along every row
constexpr uint64_t kEveryValueIndex = 0xFAC688FAC688;  // 0 1 2 3 / 4 5 6 7 / 0 1 …

void expect_colour(const Decoded& decoded, const std::byte* block, ColourRule rule, bool has_alpha, const char* format) {
    for (int texel = 0; texel < 16; ++texel) {
        for (int channel = 0; channel < 3; ++channel) {
            const Fraction expected = reference::evaluate_colour(block, rule, channel, texel), got = decoded(channel, texel);
            uint64_t bits;
            std::memcpy(&bits, block, 8);
            ASSERT_EQ(got, expected) << format << " block " << std::hex << bits << std::dec << " texel " << texel << " channel " << channel
                                     << ": " << got.numerator << '/' << got.denominator << " instead of " << expected.numerator << '/'
                                     << expected.denominator;
        }
        if (has_alpha) {
            ASSERT_EQ(decoded(3, texel), reference::evaluate_colour(block, rule, 3, texel)) << format << " texel " << texel;
        } else {
            ASSERT_EQ(decoded(3, texel), (Fraction{1, 1})) << format << " texel " << texel;
        }
    }
}

void expect_bc1_to_3_here(uint32_t first, uint32_t second, uint32_t indices) {
    const auto block = colour_block(first, second, indices);
    expect_colour(Decoded(Format::BC1RgbUnorm, block.data()), block.data(), ColourRule::Bc1, false, "BC1 RGB");
    expect_colour(Decoded(Format::BC1RgbaUnorm, block.data()), block.data(), ColourRule::Bc1, true, "BC1 RGBA");
    const auto opaque2 = joined(value_block(0xFF, 0xFF, 0xFFFFFFFFFFFF), block), opaque3 = joined(value_block(0xFF, 0, 0), block);
    expect_colour(Decoded(Format::BC2Unorm, opaque2.data()), block.data(), ColourRule::AlwaysFourColours, false, "BC2");
    expect_colour(Decoded(Format::BC3Unorm, opaque3.data()), block.data(), ColourRule::AlwaysFourColours, false, "BC3");
}

void expect_bc1_to_3(uint32_t first, uint32_t second, uint32_t indices) {
    on_every_simd([&] { expect_bc1_to_3_here(first, second, indices); });
}

TEST(ColourBlocks, AreExactForEveryEndpointPairOfEveryChannel) {
    static constexpr int shift[] = {11, 5, 0}, width[] = {5, 6, 5};
    for (int channel = 0; channel < 3; ++channel) {
        const uint32_t codes = 1u << width[channel], others = 0xFFFF & ~((codes - 1) << shift[channel]);
        for (uint32_t first = 0; first < codes; ++first) {
            for (uint32_t second = 0; second < codes; ++second) {
                // The other channels, at their extremes, put the endpoints in either order.
                for (const auto& [rest1, rest2] : {std::pair{0u, 0u}, {others, 0u}, {0u, others}, {others, others}}) {
                    expect_bc1_to_3((first << shift[channel]) | rest1, (second << shift[channel]) | rest2, kEveryColourIndex);
                    if (HasFatalFailure()) return;
                }
            }
        }
    }
}

TEST(ColourBlocks, AreExactForRandomBlocks) {
    std::mt19937_64 random(2);
    for (int i = 0; i < 20000 && !HasFatalFailure(); ++i) {
        const uint64_t bits = random();
        expect_bc1_to_3(bits & 0xFFFF, (bits >> 16) & 0xFFFF, uint32_t(bits >> 32));
    }
}

TEST(ColourBlocks, GreyThatLooksGreenOnOtherDecodersStaysExact) {
    // RGB 47, 47, 47 between 5:6:5 neighbours, the classic bug report: thirds must not be rounded to 8 bits.
    const auto block = colour_block(0x3186, 0x2965, 0xAAAAAAAA);
    const Decoded decoded(Format::BC1RgbUnorm, block.data());
    EXPECT_EQ(decoded(0, 0), (Fraction{2 * 6 + 5, 3 * 31}));
    EXPECT_EQ(decoded(1, 0), (Fraction{2 * 12 + 11, 3 * 63}));
    EXPECT_EQ(decoded(2, 0), (Fraction{2 * 6 + 5, 3 * 31}));
}

TEST(ColourBlocks, DifferByFormatInWhatTheFourthOfThreeColoursIs) {
    const auto block = colour_block(0x1234, 0x1234, 0xFFFFFFFF);
    EXPECT_EQ(Decoded(Format::BC1RgbUnorm, block.data())(3, 0), (Fraction{1, 1}));
    EXPECT_EQ(Decoded(Format::BC1RgbaUnorm, block.data())(3, 0), (Fraction{0, 1}));
    const auto bc3 = joined(value_block(0xFF, 0xFF, 0), block);
    EXPECT_EQ(Decoded(Format::BC3Unorm, bc3.data())(0, 0), (Fraction{0x1234 >> 11, 31}));
}

TEST(ColourBlocks, KeepExplicitAlpha) {
    std::mt19937_64 random(3);
    for (int i = 0; i < 2000; ++i) {
        const uint64_t bits = random();
        std::array<std::byte, 8> alpha;
        std::memcpy(alpha.data(), &bits, 8);
        const auto block = joined(alpha, colour_block(uint32_t(random()) & 0xFFFF, uint32_t(random()) & 0xFFFF, uint32_t(random())));
        on_every_simd([&] {
            const Decoded decoded(Format::BC2Unorm, block.data());
            for (int texel = 0; texel < 16; ++texel) {
                ASSERT_EQ(decoded(3, texel), reference::evaluate_explicit_alpha(block.data(), texel))
                    << std::hex << bits << " texel " << texel;
            }
        });
    }
}

TEST(ValueBlocks, AreExactForEveryEndpointPairAndIndex) {
    on_every_simd([] {
        for (uint32_t first = 0; first < 256; ++first) {
            for (uint32_t second = 0; second < 256; ++second) {
                const auto block = value_block(first, second, kEveryValueIndex);
                const Decoded positive(Format::BC4Unorm, block.data()), with_sign(Format::BC4Snorm, block.data());
                for (int texel = 0; texel < 16; ++texel) {
                    ASSERT_EQ(positive(0, texel), reference::evaluate_unsigned_value(block.data(), texel))
                        << first << ' ' << second << " texel " << texel;
                    ASSERT_EQ(with_sign(0, texel), reference::evaluate_signed_value(block.data(), texel))
                        << first << ' ' << second << " texel " << texel;
                }
            }
        }
    });
}

TEST(ValueBlocks, OfEveryFormatAgree) {
    std::mt19937_64 random(4);
    const auto expect_agreement = [](const std::byte* block) {
        const Decoded bc5(Format::BC5Unorm, block), bc5s(Format::BC5Snorm, block), bc3(Format::BC3Unorm, block);
        for (int texel = 0; texel < 16; ++texel) {
            ASSERT_EQ(bc5(0, texel), reference::evaluate_unsigned_value(block, texel));
            ASSERT_EQ(bc5(1, texel), reference::evaluate_unsigned_value(block + 8, texel));
            ASSERT_EQ(bc5s(0, texel), reference::evaluate_signed_value(block, texel));
            ASSERT_EQ(bc5s(1, texel), reference::evaluate_signed_value(block + 8, texel));
            ASSERT_EQ(bc3(3, texel), reference::evaluate_unsigned_value(block, texel));
            ASSERT_EQ(bc5(2, texel), (Fraction{0, 1}));
            ASSERT_EQ(bc5(3, texel), (Fraction{1, 1}));
        }
    };
    for (int i = 0; i < 20000 && !HasFatalFailure(); ++i) {
        std::array<std::byte, 16> block;
        const uint64_t bits[2] = {random(), random()};
        std::memcpy(block.data(), bits, 16);
        on_every_simd([&] { expect_agreement(block.data()); });
    }
}

TEST(ValueBlocks, CompareSignedEndpointsBeforeMinus128BecomesMinus127) {
    // -127 > -128 as codes: eight values, all of them -1; with the codes clamped first the last index would be +1.
    const auto block = value_block(0x81, 0x80, kEveryValueIndex);
    const Decoded decoded(Format::BC4Snorm, block.data());
    for (int texel = 0; texel < 16; ++texel) EXPECT_EQ(decoded(0, texel), (Fraction{-1, 1})) << "texel " << texel;
    const auto equal = value_block(0x80, 0x80, kEveryValueIndex);
    EXPECT_EQ(Decoded(Format::BC4Snorm, equal.data())(0, 7), (Fraction{1, 1}));
}

TEST(BlockCodec, DecodesEveryBlockFormatAndNoOther) {
    for (const FormatInfo& about : all_formats()) {
        EXPECT_EQ(block_decoder(about.format) != nullptr, about.block_compressed) << about.name;
        if (about.block_compressed) {
            EXPECT_EQ(block_decoder(with_srgb(about.format, true)), block_decoder(with_srgb(about.format, false))) << about.name;
        }
    }
}

TEST(BlockCodec, WritesNoMoreThanSixteenTexels) {
    const std::array<std::byte, 16> block{};
    for (const FormatInfo& about : all_formats()) {
        if (!about.block_compressed) continue;
        on_every_simd([&] {
            std::array<std::byte, 16 * 16 + 16> texels;
            texels.fill(std::byte{0xA5});
            decode_block(about.format, block.data(), texels.data());
            const auto bytes = size_t(16 * bytes_per_texel(layout(about.format).storage));
            for (size_t i = bytes; i < texels.size(); ++i) ASSERT_EQ(texels[i], std::byte{0xA5}) << about.name << " byte " << i;
        });
    }
}

}  // namespace
}  // namespace rawtexel::texunit
