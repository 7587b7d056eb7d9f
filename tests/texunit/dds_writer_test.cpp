// What is written as DDS reads back as it was.
#include "texunit/dds_writer.h"

#include "texunit/containers.h"

#include "tests/texunit/container_writer.h"
#include "tests/texunit/hashed_source.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <memory>

namespace rawtexel::texunit {
namespace {

std::unique_ptr<Texture> reopened(Texture& texture) {
    return std::make_unique<Texture>("written", open_dds(open_memory("written", encode_dds(texture))));
}

/// The format's own channels of every texel of every level and slice within `bound` of what they were; 0: the same bits.
void expect_same(Texture& texture, Texture& written, double bound, std::string_view what) {
    ASSERT_EQ(written.shape(), texture.shape()) << what;
    const auto channels = size_t(info(texture.format()).channels);
    EXPECT_EQ(written.source_levels(), texture.shape().levels) << what;
    for (int level = 0; level < texture.shape().levels; ++level) {
        for (int slice = 0; slice < slice_count(texture.shape(), level); ++slice) {
            for (int y = 0; y < level_extent(texture.shape().height, level); ++y) {
                for (int x = 0; x < level_extent(texture.shape().width, level); ++x) {
                    const auto expected = texture.texel(level, slice, x, y), found = written.texel(level, slice, x, y);
                    for (size_t c = 0; c < channels; ++c) {
                        if (bound == 0)
                            ASSERT_EQ(std::bit_cast<uint32_t>(found[c]), std::bit_cast<uint32_t>(expected[c]))
                                << what << " level " << level << " slice " << slice << " texel " << x << ',' << y << " channel " << c;
                        else
                            ASSERT_NEAR(found[c], expected[c], bound) << what << " level " << level << " texel " << x << ',' << y;
                    }
                }
            }
        }
    }
}

std::unique_ptr<Texture> hashed(Format format, const Shape& shape) {
    return std::make_unique<Texture>("hashed", std::make_unique<HashedSource>(format, shape));
}

/// Codes of formats that are not written as they are, rounded to nearest.
double rounding_of(Format format) {
    switch (dds_format(format)) {
        case Format::RGBA8Unorm: return format == Format::RGBA8Unorm || format == Format::BC7Unorm ? 0 : 0.501 / 255;
        // A linear value moves by at most the slope of the curve at 1 times half a code.
        case Format::RGBA8Srgb: return format == Format::BC7Srgb || !info(format).block_compressed ? 0 : 2.3 * 0.5 / 255;
        case Format::R16Unorm:
        case Format::RG16Unorm: return info(format).block_compressed ? 0.501 / 65535 : 0;
        default: return 0;
    }
}

TEST(DdsWriter, EveryFormatReadsBack) {
    for (const FormatInfo& about : all_formats()) {
        const auto texture = hashed(about.format, {.width = 13, .height = 6});
        const auto written = reopened(*texture);
        EXPECT_EQ(written->format(), dds_format(about.format));
        expect_same(*texture, *written, rounding_of(about.format), about.name);
        if (HasFatalFailure()) return;
    }
}

TEST(DdsWriter, EveryShapeReadsBack) {
    for (const Shape& shape :
         {Shape{.width = 1, .height = 1}, Shape{.width = 7, .height = 19, .layers = 3},
          Shape{.width = 8, .height = 8, .layers = 6, .cube = true}, Shape{.width = 5, .height = 5, .layers = 12, .cube = true},
          Shape{.width = 9, .height = 4, .depth = 6}, Shape{.width = 4, .height = 4, .levels = 3}}) {
        const auto texture = hashed(Format::RGBA8Srgb, shape);
        expect_same(*texture, *reopened(*texture), 0, "shape");
        if (HasFatalFailure()) return;
    }
}

/// Held against files that another writer made.
TEST(DdsWriter, PutsTexelsWhereTheFileHadThem) {
    constexpr size_t kHeader = 148;
    for (const Shape& shape :
         {Shape{.width = 7, .height = 19, .layers = 3, .levels = 5}, Shape{.width = 9, .height = 4, .depth = 6, .levels = 4},
          Shape{.width = 8, .height = 8, .layers = 12, .levels = 4, .cube = true}}) {
        for (const auto& [dxgi, unit_bytes] : {std::pair{28u, 4}, {29u, 4}, {49u, 2}, {61u, 1}, {11u, 8}, {56u, 2}}) {
            const test_files::Bytes file = test_files::write_dds(test_files::random_image(shape, 1, unit_bytes, dxgi), dxgi);
            Texture texture("file", open_dds(open_memory("file", file)));
            const std::vector<std::byte> written = encode_dds(texture);
            ASSERT_EQ(written.size(), file.size()) << dxgi;
            EXPECT_TRUE(std::equal(file.begin() + kHeader, file.end(), written.begin() + kHeader)) << "texels of DXGI_FORMAT " << dxgi;
            constexpr size_t kExtension = 128;
            EXPECT_TRUE(std::equal(file.begin() + kExtension, file.begin() + kHeader, written.begin() + kExtension)) << dxgi;
        }
    }
}

}  // namespace
}  // namespace rawtexel::texunit
