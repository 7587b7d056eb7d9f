// BC1 to BC3 with colours rounded as vendors do: exhaustive over endpoints, against formulas written apart; and the way from a file.
#include "texunit/bc_rounding.h"

#include "texunit/block_codec.h"
#include "texunit/containers.h"
#include "texunit/srgb.h"
#include "texunit/texture.h"

#include "tests/reference/texunit/bc_bc1_to_5.h"
#include "tests/reference/texunit/bc_rounding.h"
#include "tests/texunit/container_writer.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

namespace rawtexel::texunit {
namespace {

using reference::Rounding;

constexpr std::pair<BcRounding, Rounding> kPolicies[] = {
    {BcRounding::Ideal8, Rounding::Ideal8}, {BcRounding::Nvidia, Rounding::Nvidia}, {BcRounding::Amd, Rounding::Amd}};
constexpr int kShift[] = {11, 5, 0}, kWidth[] = {5, 6, 5};

using Block = std::array<std::byte, 16>;

/// Eight bytes of opaque alpha, then colour with the indices 0 1 2 3 along every row; BC1 is the second half.
Block block_of(uint32_t first, uint32_t second) {
    Block block;
    block.fill(std::byte{0xFF});
    const uint64_t colour = first | (second << 16) | (uint64_t{0xE4E4E4E4} << 32);
    std::memcpy(block.data() + 8, &colour, 8);
    return block;
}

/// The fields of the first four texels of a block, which are the four colours.
class Colours {
  public:
    Colours(Format format, BcRounding rounding, const Block& block) : layout_(layout(format, rounding)) {
        const std::byte* const at = block.data() + (info(format).bytes_per_block == 8 ? 8 : 0);
        decode_block(format, at, texels_.data(), rounding);
    }
    int field(int colour, int channel) const {
        uint64_t word = 0;
        const auto bytes = size_t(bytes_per_texel(layout_.storage));
        std::memcpy(&word, texels_.data() + size_t(colour) * bytes, bytes);
        return int(uint32_t(word >> layout_.shift[channel]) & layout_.mask[channel]);
    }
    int denominator(int channel) const { return layout_.denominator[channel]; }

  private:
    const TexelLayout& layout_;
    alignas(16) std::array<std::byte, 128> texels_{};
};

TEST(BcRounding, SpellingsReadBack) {
    std::string all;
    for (const BcRounding rounding : kBcRoundings) {
        EXPECT_EQ(parse_bc_rounding(to_string(rounding)), rounding);
        all += std::string(to_string(rounding)) + ' ';
    }
    EXPECT_EQ(all, "exact ideal8 nvidia amd ");
    EXPECT_FALSE(parse_bc_rounding("intel"));
}

TEST(BcRounding, ConcernsBc1ToBc3AndNeverTheStorageClass) {
    for (const FormatInfo& about : all_formats()) {
        const std::string_view name = about.name;
        EXPECT_EQ(has_bc_rounding(about.format), name.starts_with("bc1") || name.starts_with("bc2") || name.starts_with("bc3")) << name;
        for (const auto& [rounding, unused] : kPolicies) {
            EXPECT_EQ(layout(about.format, rounding).storage, layout(about.format).storage) << name;
            EXPECT_EQ(block_decoder(about.format, rounding) == block_decoder(about.format), !has_bc_rounding(about.format)) << name;
        }
    }
}

/// All four colours of one endpoint pair, in every format that has them.
void expect_formulas(BcRounding rounding, Rounding policy, uint32_t first, uint32_t second) {
    const Block block = block_of(first, second);
    for (const Format format : {Format::BC1RgbUnorm, Format::BC1RgbaUnorm, Format::BC2Unorm, Format::BC3Unorm}) {
        const Colours colours(format, rounding, block);
        const bool bc1 = info(format).bytes_per_block == 8, four = !bc1 || first > second;
        for (int index = 0; index < 4; ++index) {
            for (int c = 0; c < 3; ++c) {
                const int mask = (1 << kWidth[c]) - 1, a = int(first >> kShift[c]) & mask, b = int(second >> kShift[c]) & mask;
                ASSERT_EQ(colours.field(index, c), reference::rounded_colour(policy, kWidth[c], a, b, four, index))
                    << to_string(rounding) << ' ' << info(format).name << " channel " << c << " endpoints " << a << ' ' << b << " colour "
                    << index;
                ASSERT_EQ(colours.denominator(c), 255);
            }
            if (format == Format::BC1RgbUnorm) continue;
            const bool transparent = bc1 && !four && index == 3;
            ASSERT_EQ(colours.field(index, 3), transparent ? 0 : colours.denominator(3)) << info(format).name << " colour " << index;
        }
    }
}

TEST(BcRounding, EqualsTheFormulasForEveryEndpointPairOfEveryChannel) {
    for (const auto& [rounding, policy] : kPolicies) {
        for (int c = 0; c < 3; ++c) {
            const uint32_t codes = 1u << kWidth[c], others = 0xFFFF & ~((codes - 1) << kShift[c]);
            for (uint32_t first = 0; first < codes; ++first) {
                for (uint32_t second = 0; second < codes; ++second) {
                    // The other channels put the endpoints in either order.
                    expect_formulas(rounding, policy, first << kShift[c], (second << kShift[c]) | others);
                    expect_formulas(rounding, policy, (first << kShift[c]) | others, second << kShift[c]);
                    if (HasFatalFailure()) return;
                }
            }
        }
    }
}

/// What rounding does to the colour of two thirds and one third, over all endpoint pairs of one channel.
struct ThirdsError {
    double largest = 0;  // in 1/255
    int pairs = 0;       // that differ from the exact colour rounded to nearest
};

ThirdsError thirds_error(BcRounding rounding, int channel) {
    ThirdsError error;
    const int codes = 1 << kWidth[channel];
    for (int a = 0; a < codes; ++a) {
        for (int b = 0; b < codes; ++b) {
            const Block block = block_of(uint32_t(a) << kShift[channel], uint32_t(b) << kShift[channel]);
            const double exact = (2.0 * a + b) / (3 * (codes - 1)) * 255;
            const Colours colours(Format::BC2Unorm, rounding, block);
            const double code = std::nearbyint(255.0 * colours.field(2, channel) / colours.denominator(channel));
            error.largest = std::max(error.largest, std::abs(code - exact));
            error.pairs += code != std::nearbyint(exact);
        }
    }
    return error;
}

TEST(BcRounding, HasTheKnownWorstErrors) {
    struct Known {
        BcRounding rounding;
        double red, green;
        int red_pairs, green_pairs;
    };
    for (const Known& known : {Known{BcRounding::Exact, 0.48, 0.49, 0, 0}, Known{BcRounding::Ideal8, 1.19, 1.37, 344, 1427},
                               Known{BcRounding::Nvidia, 0.74, 5.40, 128, 3326}, Known{BcRounding::Amd, 1.97, 1.89, 534, 2110}}) {
        const ThirdsError red = thirds_error(known.rounding, 0), green = thirds_error(known.rounding, 1),
                          blue = thirds_error(known.rounding, 2);
        EXPECT_NEAR(red.largest, known.red, 0.0051) << to_string(known.rounding);
        EXPECT_NEAR(green.largest, known.green, 0.0051) << to_string(known.rounding);
        EXPECT_EQ(red.pairs, known.red_pairs) << to_string(known.rounding);
        EXPECT_EQ(green.pairs, known.green_pairs) << to_string(known.rounding);
        EXPECT_EQ(blue.largest, red.largest) << to_string(known.rounding);
    }
}

std::array<int, 3> codes_of_third_colour(BcRounding rounding, uint32_t first, uint32_t second) {
    const Colours colours(Format::BC1RgbUnorm, rounding, block_of(first, second));
    std::array<int, 3> codes;
    for (int c = 0; c < 3; ++c) codes[size_t(c)] = int(std::nearbyint(255.0 * colours.field(2, c) / colours.denominator(c)));
    return codes;
}

TEST(BcRounding, TurnsGreysGreenWhereHardwareDoes) {
    // Two blocks whose third colour is the grey 47: thirds between neighbours, and between a light and a dark green.
    using Codes = std::array<int, 3>;
    const uint32_t near[] = {6u << 11 | 12u << 5 | 6u, 5u << 11 | 11u << 5 | 5u},
                   far[] = {6u << 11 | 16u << 5 | 6u, 5u << 11 | 3u << 5 | 5u};
    EXPECT_EQ(codes_of_third_colour(BcRounding::Exact, near[0], near[1]), (Codes{47, 47, 47}));
    EXPECT_EQ(codes_of_third_colour(BcRounding::Ideal8, near[0], near[1]), (Codes{46, 46, 46}));
    EXPECT_EQ(codes_of_third_colour(BcRounding::Nvidia, near[0], near[1]), (Codes{46, 47, 46}));
    EXPECT_EQ(codes_of_third_colour(BcRounding::Amd, near[0], near[1]), (Codes{46, 47, 46}));
    EXPECT_EQ(codes_of_third_colour(BcRounding::Exact, far[0], far[1]), (Codes{47, 47, 47}));
    EXPECT_EQ(codes_of_third_colour(BcRounding::Nvidia, far[0], far[1]), (Codes{46, 48, 46}));
    EXPECT_EQ(codes_of_third_colour(BcRounding::Amd, far[0], far[1]), (Codes{46, 48, 46}));
}

/// A texture file and the format it is read as.
struct FileCase {
    const char* name;
    test_files::Bytes bytes;
    Format format;
};

std::vector<FileCase> files() {
    using enum Format;
    const Shape shape{.width = 22, .height = 13, .levels = 3};
    const auto eight = test_files::random_image(shape, 4, 8, 1), sixteen = test_files::random_image(shape, 4, 16, 2);
    return {
        {"DXT1", write_legacy_dds(eight, {.flags = 4, .four_cc = test_files::four_cc("DXT1")}), BC1RgbaUnorm},
        {"DXT3", write_legacy_dds(sixteen, {.flags = 4, .four_cc = test_files::four_cc("DXT3")}), BC2Unorm},
        {"DXT5", write_legacy_dds(sixteen, {.flags = 4, .four_cc = test_files::four_cc("DXT5")}), BC3Unorm},
        {"DX10 BC1 sRGB", write_dds(eight, 72), BC1RgbaSrgb},
        {"DX10 BC3 sRGB", write_dds(sixteen, 78), BC3Srgb},
        {"KTX2 BC1 RGB sRGB", write_ktx2(eight, 132), BC1RgbSrgb},
        {"KTX2 BC2", write_ktx2(sixteen, 135, 2), BC2Unorm},
    };
}

std::unique_ptr<TexelSource> open(const test_files::Bytes& bytes, BcRounding rounding) {
    auto memory = open_memory("file", bytes);
    const ContainerOptions options{.bc_rounding = rounding};
    return container_kind(*memory) == ContainerKind::Dds ? open_dds(memory, options) : open_ktx2(memory, options);
}

/// Value of a channel by what the fields of the layout mean, in double.
double meaning(const TexelLayout& l, const std::byte* texel, int c) {
    if (l.mask[c] == 0) return c == 3;
    uint64_t word = 0;
    std::memcpy(&word, texel, size_t(bytes_per_texel(l.storage)));
    const double value = double(uint32_t(word >> l.shift[c]) & l.mask[c]) / l.denominator[c];
    return l.table[c] ? srgb_to_linear(value) : value;
}

TEST(BcRounding, ReachesTexturesFromEveryContainerAndKeepsTheFormat) {
    for (const FileCase& file : files()) {
        for (const auto& [rounding, unused] : kPolicies) {
            SCOPED_TRACE(std::string(file.name) + ' ' + std::string(to_string(rounding)));
            const auto exact = open(file.bytes, BcRounding::Exact), source = open(file.bytes, rounding);
            EXPECT_EQ(source->format(), file.format);
            EXPECT_EQ(source->bc_rounding(), rounding);
            EXPECT_EQ(source->stored_bytes(), exact->stored_bytes());
            std::array<std::byte, 128> block;
            source->decode_block(0, 0, 1, 1, block.data());

            Texture texture(file.name, open(file.bytes, rounding)), precise(file.name, open(file.bytes, BcRounding::Exact));
            const TexelLayout& l = layout(file.format, rounding);
            double largest = 0;
            for (int texel = 0; texel < 16; ++texel) {
                const int x = 4 + texel % 4, y = 4 + texel / 4;
                const auto value = texture.texel(0, 0, x, y), wanted = precise.texel(0, 0, x, y);
                for (int c = 0; c < 4; ++c) {
                    const std::byte* const at = block.data() + size_t(texel * bytes_per_texel(l.storage));
                    EXPECT_NEAR(value[size_t(c)], meaning(l, at, c), 1e-7) << "texel " << texel << " channel " << c;
                    largest = std::max(largest, std::abs(double(value[size_t(c)]) - double(wanted[size_t(c)])));
                }
                EXPECT_EQ(value[3], wanted[3]) << "alpha is not rounded";
            }
            EXPECT_GT(largest, 0) << "nothing was rounded";
            EXPECT_LT(largest, 12.0 / 255);
            // Levels made here work from rounded texels.
            EXPECT_GE(texture.texel(4, 0, 0, 0)[3], 0.0f);
        }
    }
}

TEST(BcRounding, SurvivesTheChangeOfTransferFunction) {
    const auto file = files()[0];
    const auto source = reinterpret_srgb(open(file.bytes, BcRounding::Amd), true);
    EXPECT_EQ(source->format(), Format::BC1RgbaSrgb);
    EXPECT_EQ(source->bc_rounding(), BcRounding::Amd);
    EXPECT_EQ(layout(source->format(), source->bc_rounding()).table[0], srgb8_table());
}

TEST(BcRounding, RoundsTheColoursOfRxgbToo) {
    const auto image = test_files::random_image({.width = 8, .height = 8}, 4, 16, 3);
    const auto bytes = write_legacy_dds(image, {.flags = 4, .four_cc = test_files::four_cc("RXGB")});
    Texture exact("exact", open(bytes, BcRounding::Exact)), rounded("rounded", open(bytes, BcRounding::Nvidia));
    EXPECT_EQ(exact.format(), rounded.format());
    double largest = 0;
    for (int i = 0; i < 64; ++i) {
        const auto a = exact.texel(0, 0, i % 8, i / 8), b = rounded.texel(0, 0, i % 8, i / 8);
        EXPECT_EQ(a[0], b[0]) << "red comes from the alpha block";
        largest = std::max({largest, std::abs(double(a[1]) - double(b[1])), std::abs(double(a[2]) - double(b[2]))});
    }
    EXPECT_GT(largest, 0);
    EXPECT_LT(largest, 6.0 / 255);
}

TEST(BcRounding, LeavesOtherFormatsAlone) {
    const auto image = test_files::random_image({.width = 8, .height = 8}, 4, 16, 4);
    const auto bytes = write_dds(image, 98);
    EXPECT_EQ(open(bytes, BcRounding::Amd)->bc_rounding(), BcRounding::Exact);
    Texture exact("exact", open(bytes, BcRounding::Exact)), rounded("rounded", open(bytes, BcRounding::Amd));
    for (int i = 0; i < 64; ++i) EXPECT_EQ(exact.texel(0, 0, i % 8, i / 8), rounded.texel(0, 0, i % 8, i / 8));
}

}  // namespace
}  // namespace rawtexel::texunit
