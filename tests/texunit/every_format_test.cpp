// Each format from stored bytes to samples and generated levels.
#include "texunit/block_codec.h"
#include "texunit/memory_source.h"
#include "texunit/sample.h"
#include "texunit/texture.h"

#include "tests/texunit/container_writer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <memory>
#include <random>
#include <string>
#include <utility>

namespace rawtexel::texunit {
namespace {

/// Level 0 of random texels or blocks, as a file holds them.
class StoredSource final : public TexelSource {
  public:
    StoredSource(Format format, int width, int height) : format_(format), shape_{.width = width, .height = height} {
        const FormatInfo& about = info(format);
        units_ = test_files::random_image(shape_, about.block_extent, about.bytes_per_block, uint64_t(format) + 1).slices[0][0];
        // Floats that are numbers, and not so far apart that one hides the others.
        for (size_t at = 0; layout(format).storage == StorageClass::Half4 && !about.block_compressed && at < units_.size(); at += 2)
            units_[at + 1] = (units_[at + 1] & std::byte{0x83}) | std::byte{0x38};
        for (size_t at = 0; layout(format).storage == StorageClass::Float4 && at < units_.size(); at += 4)
            units_[at + 3] = (units_[at + 3] & std::byte{0x80}) | std::byte{0x3F};
    }

    Format format() const override { return format_; }
    Shape shape() const override { return shape_; }
    uint64_t stored_bytes() const override { return units_.size(); }

    void decode_block(int, int, int block_x, int block_y, std::byte* texels) override {
        const auto bytes = size_t(info(format_).bytes_per_block);
        if (const BlockDecoder decode = block_decoder(format_)) {
            decode(units_.data() + (size_t(block_y) * size_t((shape_.width + 3) / 4) + size_t(block_x)) * bytes, texels);
        } else {
            store_block(format_, units_.data(), shape_.width, shape_.height, size_t(shape_.width) * bytes, block_x, block_y, texels);
        }
    }

  private:
    Format format_;
    Shape shape_;
    test_files::Bytes units_;
};

class EveryFormat : public ::testing::TestWithParam<Format> {};

constexpr int kExtent = 32;

/// All lanes at the centre of one texel, `step` texels apart from the next pixel.
WaveCoordinates at_centre(int x, int y, float step) {
    WaveCoordinates at{};
    for (int i = 0; i < kWaveLanes; ++i) {
        at.u[i] = (float(x) + 0.5f) / kExtent, at.v[i] = (float(y) + 0.5f) / kExtent;
        at.dudx[i] = at.dvdy[i] = step / kExtent;
    }
    return at;
}

TEST_P(EveryFormat, GivesItsTexelsToEveryLookup) {
    Texture texture("stored", std::make_unique<StoredSource>(GetParam(), kExtent, kExtent));
    const int channels = info(GetParam()).channels;
    bool varies = false;
    for (int n = 0; n < 64; ++n) {
        const int x = (7 * n) % kExtent, y = (11 * n) % kExtent;
        const std::array<float, 4> texel = texture.texel(0, 0, x, y);
        varies |= texel != texture.texel(0, 0, 0, 0);
        for (size_t c = size_t(channels); c < 4; ++c) EXPECT_EQ(texel[c], c == 3 ? 1.0f : 0.0f) << "missing channel " << c;
        for (const Kernel kernel : {Kernel::Nearest, Kernel::Bilinear}) {
            WaveColor colour;
            sample_wave(texture, {.magnify = kernel, .minify = kernel, .mip = MipMode::None}, at_centre(x, y, 1), kWaveFull, colour);
            for (size_t c = 0; c < 4; ++c) ASSERT_EQ(colour.channel[c].lane[n % kWaveLanes], texel[c]) << x << ',' << y << " channel " << c;
        }
    }
    EXPECT_TRUE(varies) << "a constant texture proves nothing";
}

TEST_P(EveryFormat, HasLevelsThatAreTheMeanOfTheirParents) {
    for (const MipStorage storage : {MipStorage::Source, MipStorage::Float}) {
        Texture texture("stored", std::make_unique<StoredSource>(GetParam(), kExtent, kExtent), {.mip_storage = storage});
        ASSERT_EQ(texture.shape().levels, 6);
        for (int level = 1; level < 6; ++level) {
            const std::array<float, 4> got = texture.texel(level, 0, 0, 0);
            std::array<double, 4> mean{}, largest{};
            for (const auto& [x, y] : {std::pair{0, 0}, {1, 0}, {0, 1}, {1, 1}}) {
                const std::array<float, 4> parent = texture.texel(level - 1, 0, x, y);
                for (size_t c = 0; c < 4; ++c) mean[c] += parent[c] / 4.0, largest[c] = std::max(largest[c], std::abs(double(parent[c])));
            }
            for (size_t c = 0; c < 4; ++c) {
                // Half a code where levels are rounded: of 1-bit alpha as of 16-bit floats. sRGB codes are at most 1/110 apart.
                const TexelLayout& stored = layout(GetParam());
                const double code = storage == MipStorage::Float ? largest[c] * 0x1p-22
                                    : stored.denominator[c] == 0 ? largest[c] * 0x1p-10
                                    : stored.table[c]            ? 1.0 / 110
                                                                 : 1.0 / stored.denominator[c];
                EXPECT_NEAR(got[c], mean[c], 0.5 * code + largest[c] * 0x1p-23) << "level " << level << " channel " << c;
            }
        }
        WaveColor colour;
        sample_wave(texture, {.magnify = Kernel::Bilinear, .minify = Kernel::Bilinear, .mip = MipMode::Linear}, at_centre(3, 5, 5.7f),
                    kWaveFull, colour);
        for (const float value : colour.channel[0].lane) EXPECT_TRUE(std::isfinite(value)) << value;
    }
}

std::string test_name(const ::testing::TestParamInfo<Format>& format) {
    std::string name(info(format.param).name);
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
}

std::vector<Format> every_format() {
    std::vector<Format> formats;
    for (const FormatInfo& about : all_formats()) formats.push_back(about.format);
    return formats;
}

INSTANTIATE_TEST_SUITE_P(All, EveryFormat, ::testing::ValuesIn(every_format()), test_name);

TEST(Formats, AreAllThatATextureUnitIsAskedFor) {
    std::string names;
    for (const FormatInfo& about : all_formats()) names += std::string(about.name) + ' ';
    for (const char* channels : {"r", "rg", "rgba"}) {
        for (const char* encoding : {"8-unorm", "8-snorm", "8-srgb", "16-unorm", "16-half", "32-float"})
            EXPECT_NE(names.find(std::string(channels) + encoding + ' '), std::string::npos) << channels << encoding;
    }
    for (const char* block :
         {"bc1-rgb-unorm", "bc1-rgb-srgb", "bc1-rgba-unorm", "bc1-rgba-srgb", "bc2-unorm", "bc2-srgb", "bc3-unorm", "bc3-srgb", "bc4-unorm",
          "bc4-snorm", "bc5-unorm", "bc5-snorm", "bc6h-ufloat", "bc6h-sfloat", "bc7-unorm", "bc7-srgb"})
        EXPECT_NE(names.find(std::string(block) + ' '), std::string::npos) << block;
}

}  // namespace
}  // namespace rawtexel::texunit
