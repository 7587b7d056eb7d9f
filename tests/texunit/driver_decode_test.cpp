// Block decoding held to an independent decoder: the OpenGL driver's, where one runs without a window (Mesa's llvmpipe on Debian). What
// needs it is skipped where there is none; bc6h_test, bc7_test and block_codec_test check the same against the decoders in
// tests/reference.
#include "tests/texunit/headless_gl.h"

#include "texunit/block_codec.h"
#include "texunit/texel_value.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <iostream>
#include <random>
#include <string>
#include <vector>

namespace rawtexel::texunit {
namespace {

constexpr int kExtent = 512, kBlocksAcross = kExtent / 4;
constexpr size_t kBlocks = size_t(kBlocksAcross) * kBlocksAcross;

/// OpenGL's numbers of the linear formats (EXT_texture_compression_s3tc, ARB_texture_compression_rgtc, ARB_texture_compression_bptc).
uint32_t gl_format(Format format) {
    switch (format) {
        using enum Format;
        case BC1RgbUnorm: return 0x83F0;
        case BC1RgbaUnorm: return 0x83F1;
        case BC2Unorm: return 0x83F2;
        case BC3Unorm: return 0x83F3;
        case BC4Unorm: return 0x8DBB;
        case BC4Snorm: return 0x8DBC;
        case BC5Unorm: return 0x8DBD;
        case BC5Snorm: return 0x8DBE;
        case BC6HUfloat: return 0x8E8F;
        case BC6HSfloat: return 0x8E8E;
        default: return 0x8E8C;  // BC7
    }
}

class DriverDecode : public ::testing::Test {
  protected:
    void SetUp() override {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
        GTEST_SKIP() << "the sanitizers would judge the OpenGL driver too";
#endif
        std::string why_not;
        gl_ = HeadlessGl::make(why_not);
        if (!gl_) GTEST_SKIP() << "no OpenGL without a window (" << why_not << "): blocks are not held to a driver";
    }

    /// Value by value: ours minus the driver's, the largest magnitude by channel. Equal infinities differ by nothing.
    std::array<double, 4> largest_difference(Format format, const std::vector<std::byte>& blocks) {
        const std::vector<float> driver = gl_->texels(gl_format(format), kExtent, kExtent, blocks);
        EXPECT_FALSE(driver.empty()) << gl_->renderer() << " refuses " << info(format).name;
        std::array<double, 4> largest{};
        if (driver.empty()) return largest;
        const TexelLayout& stored = layout(format);
        const auto block_bytes = size_t(info(format).bytes_per_block), texel_bytes = size_t(bytes_per_texel(stored.storage));
        std::array<std::byte, 16 * 8> texels;
        for (size_t block = 0; block < kBlocks; ++block) {
            decode_block(format, blocks.data() + block * block_bytes, texels.data());
            for (size_t texel = 0; texel < 16; ++texel) {
                const std::array<float, 4> ours = load_texel(stored, texels.data() + texel * texel_bytes);
                const size_t x = 4 * (block % kBlocksAcross) + texel % 4, y = 4 * (block / kBlocksAcross) + texel / 4;
                const float* const theirs = driver.data() + 4 * (y * kExtent + x);
                for (size_t c = 0; c < 4; ++c) {
                    if (ours[c] != theirs[c]) largest[c] = std::max(largest[c], std::abs(double(ours[c]) - double(theirs[c])));
                }
            }
        }
        return largest;
    }

    std::unique_ptr<HeadlessGl> gl_;
};

template <class Change>
std::vector<std::byte> random_blocks(Format format, uint64_t seed, const Change& change) {
    std::mt19937_64 random(seed);
    const auto bytes = size_t(info(format).bytes_per_block);
    std::vector<std::byte> blocks(kBlocks * bytes);
    for (std::byte& byte : blocks) byte = std::byte(random());
    for (size_t i = 0; i < kBlocks; ++i) change(i, blocks.data() + i * bytes);
    return blocks;
}

constexpr auto kAnything = [](size_t, std::byte*) {};

TEST_F(DriverDecode, EqualsBc7InEveryMode) {
    for (uint64_t seed = 1; seed <= 4; ++seed) {
        const auto blocks = random_blocks(Format::BC7Unorm, seed, [](size_t i, std::byte* block) {
            const int mode = int(i % 8);
            block[0] = (block[0] & ~std::byte((2 << mode) - 1)) | std::byte(1 << mode);
        });
        // The driver divides codes by 255 as we do, up to the last place of a float.
        for (const double difference : largest_difference(Format::BC7Unorm, blocks)) EXPECT_LT(difference, 0.01 / 255) << "seed " << seed;
    }
}

TEST_F(DriverDecode, EqualsBc6hInEveryMode) {
    static constexpr int kCodes[] = {0, 1, 2, 6, 10, 14, 18, 22, 26, 30, 3, 7, 11, 15, 19, 23, 27, 31};
    for (const Format format : {Format::BC6HUfloat, Format::BC6HSfloat}) {
        for (uint64_t seed = 1; seed <= 4; ++seed) {
            const auto blocks = random_blocks(format, seed, [](size_t i, std::byte* block) {
                const int code = kCodes[i % std::size(kCodes)];
                block[0] = (block[0] & ~std::byte(code < 2 ? 3 : 31)) | std::byte(code);
            });
            for (const double difference : largest_difference(format, blocks)) EXPECT_EQ(difference, 0) << info(format).name;
        }
    }
}

TEST_F(DriverDecode, IsWithinTwoCodesOfBc1ToBc5) {
    // Drivers round to codes of 8 bits, 255 or, signed, 127 of them to 1; ours are exact.
    using enum Format;
    for (const Format format : {BC1RgbUnorm, BC1RgbaUnorm, BC2Unorm, BC3Unorm, BC4Unorm, BC4Snorm, BC5Unorm, BC5Snorm}) {
        const double codes = layout(format).is_signed ? 127 : 255;
        const std::array<double, 4> largest = largest_difference(format, random_blocks(format, 1, kAnything));
        std::cout << info(format).name << ": at most";
        for (const double difference : largest) std::cout << ' ' << difference * codes;
        std::cout << " codes from " << gl_->renderer() << '\n';
        for (const double difference : largest) EXPECT_LE(difference, 2 / codes) << info(format).name;
    }
}

}  // namespace
}  // namespace rawtexel::texunit
