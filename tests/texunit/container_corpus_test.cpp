// Real files. RAWTEXEL_CORPUS names the folder that holds them; what needs it is skipped where it is unset, and dds_test, ktx2_test and
// bc7_test check the same on generated files.
#include "tests/reference/texunit/texture_file.h"
#include "tests/texunit/container_writer.h"

#include "texunit/containers.h"
#include "texunit/srgb.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace rawtexel::texunit {
namespace {

using test_files::Bytes;

class ContainerCorpus : public ::testing::Test {
  protected:
    void SetUp() override {
        const char* folder = std::getenv("RAWTEXEL_CORPUS");
        if (!folder) GTEST_SKIP() << "RAWTEXEL_CORPUS is not set: real DDS and KTX2 files are not checked";
        root_ = folder;
    }

    /// Texture files below `folder`, sorted.
    std::vector<std::filesystem::path> files(const char* folder) const {
        std::vector<std::filesystem::path> found;
        for (const auto& entry : std::filesystem::recursive_directory_iterator(root_ / folder)) {
            const std::string extension = entry.path().extension();
            if (extension == ".dds" || extension == ".ktx2") found.push_back(entry.path());
        }
        std::sort(found.begin(), found.end());
        return found;
    }

    std::filesystem::path root_;
};

std::unique_ptr<TexelSource> open_any(const std::filesystem::path& path) {
    auto bytes = open_file(path);
    return container_kind(*bytes) == ContainerKind::Ktx2 ? open_ktx2(std::move(bytes)) : open_dds(std::move(bytes));
}

template <class Visit>
void each_block(TexelSource& source, Visit visit) {
    const Shape shape = source.shape();
    Bytes texels(256);
    for (int level = 0; level < shape.levels; ++level) {
        const int slices = shape.depth > 1 ? level_extent(shape.depth, level) : shape.layers;
        for (int slice = 0; slice < slices; ++slice) {
            for (int y = 0; 4 * y < level_extent(shape.height, level); ++y) {
                for (int x = 0; 4 * x < level_extent(shape.width, level); ++x) {
                    source.decode_block(level, slice, x, y, texels.data());
                    visit(level, slice, x, y, texels);
                }
            }
        }
    }
}

/// What is known of a file: its format, extents, layers and levels; or the part of the message that refuses it.
struct Known {
    const char* format = nullptr;
    int width = 0, height = 0, depth = 1, layers = 1, levels = 1;
    const char* refusal = nullptr;
};

const std::map<std::string, Known>& known_files() {
    static const std::map<std::string, Known> known = {
        {"bc/bcdec/dice_bc3.dds", {"bc3-unorm", 800, 600}},
        {"bc/bcdec/dice_bc4.dds", {"bc4-unorm", 800, 600}},
        {"bc/bcdec/dice_bc5.dds", {"bc5-unorm", 800, 600}},
        {"bc/bcdec/dice_bc7.dds", {"bc7-unorm", 800, 600}},
        {"bc/bcdec/kodim23_bc1.dds", {"bc1-rgba-unorm", 768, 512}},
        {"bc/bcdec/lythwood_room_1k_bc6h_signed.dds", {"bc6h-sfloat", 1024, 512}},
        {"bc/bcdec/testcard_bc2.dds", {"bc2-unorm", 256, 256}},
        {"bc/bevy/Ryfjallet_cubemap_bc7.ktx2", {"bc7-srgb", 512, 512, 1, 6}},
        {"bc/gltft/2d_bc1.ktx2", {"bc1-rgb-srgb", 40, 40, 1, 1, 6}},
        {"bc/gltft/2d_bc7.ktx2", {"bc7-srgb", 40, 40, 1, 1, 6}},
        {"bc/gltft/2d_rgba16_linear.ktx2", {"rgba16-half", 40, 40, 1, 1, 6}},
        {"bc/gltft/2d_rgba32_linear.ktx2", {"rgba32-float", 40, 40, 1, 1, 6}},
        {"bc/gltft/2d_rgba8.ktx2", {"rgba8-srgb", 40, 40, 1, 1, 6}},
        {"bc/oiio/dds_a8.dds", {"rgba8-unorm", 24, 20}},
        {"bc/oiio/dds_abgr8.dds", {"rgba8-unorm", 24, 20}},
        {"bc/oiio/dds_bc1.dds", {"bc1-rgba-unorm", 16, 8}},
        {"bc/oiio/dds_bc1_mips.dds", {"bc1-rgba-unorm", 16, 8, 1, 1, 5}},
        {"bc/oiio/dds_bc2.dds", {"bc2-unorm", 16, 8}},
        {"bc/oiio/dds_bc3.dds", {"bc3-unorm", 16, 8}},
        {"bc/oiio/dds_bc3nm.dds", {"bc3-unorm", 24, 20}},
        {"bc/oiio/dds_bc3rxgb.dds", {"rgba16-unorm", 24, 20}},
        {"bc/oiio/dds_bc3ycocg.dds", {"bc3-unorm", 24, 20}},
        {"bc/oiio/dds_bc4.dds", {"bc4-unorm", 16, 8}},
        {"bc/oiio/dds_bc5.dds", {"bc5-unorm", 16, 8}},
        {"bc/oiio/dds_bc6hu.dds", {"bc6h-ufloat", 16, 8}},
        {"bc/oiio/dds_bc6hu_hdr.dds", {"bc6h-ufloat", 128, 64}},
        {"bc/oiio/dds_bc7.dds", {"bc7-unorm", 16, 8}},
        {"bc/oiio/dds_bgr8.dds", {"rgba8-unorm", 16, 8}},
        {"bc/oiio/dds_dxgi_bc1_srgb.dds", {"bc1-rgba-srgb", 16, 8}},
        {"bc/oiio/dds_dxgi_bc2_srgb.dds", {"bc2-srgb", 16, 8}},
        {"bc/oiio/dds_dxgi_bc3_srgb.dds", {"bc3-srgb", 16, 8}},
        {"bc/oiio/dds_dxgi_bc7_srgb.dds", {"bc7-srgb", 16, 8}},
        {"bc/oiio/dds_dxgi_bgra8_srgb.dds", {"rgba8-srgb", 16, 8}},
        {"bc/oiio/dds_dxgi_bgrx8_srgb.dds", {"rgba8-srgb", 16, 8}},
        {"bc/oiio/dds_dxgi_r16.dds", {"r16-unorm", 16, 8}},
        {"bc/oiio/dds_dxgi_rgb10a2.dds", {"rgba16-unorm", 16, 8}},
        {"bc/oiio/dds_dxgi_rgba8_srgb.dds", {"rgba8-srgb", 16, 8}},
        {"bc/oiio/dds_l8.dds", {"rgba8-unorm", 24, 20}},
        {"bc/oiio/dds_l8a8.dds", {"rgba8-unorm", 24, 20}},
        {"bc/oiio/dds_npot_bc3.dds", {"bc3-unorm", 13, 7}},
        {"bc/oiio/dds_npot_bc3_mips.dds", {"bc3-unorm", 13, 7, 1, 1, 4}},
        {"bc/oiio/dds_npot_rgba8.dds", {"rgba8-unorm", 13, 7}},
        {"bc/oiio/dds_npot_rgba8_mips.dds", {"rgba8-unorm", 13, 7, 1, 1, 4}},
        {"bc/oiio/dds_r5g6b5.dds", {"rgba16-unorm", 16, 8}},
        {"bc/oiio/dds_rgb10a2.dds", {"rgba16-unorm", 24, 20}},
        {"bc/oiio/dds_rgb332.dds", {"rgba16-unorm", 24, 20}},
        {"bc/oiio/dds_rgb5a1.dds", {"rgba16-unorm", 24, 20}},
        {"bc/oiio/dds_rgb8.dds", {"rgba8-unorm", 16, 8}},
        {"bc/oiio/dds_rgba4.dds", {"rgba8-unorm", 16, 8}},
        {"bc/oiio/dds_rgba8.dds", {"rgba8-unorm", 16, 8}},
        {"bc/oiio/dds_rgba8_mips.dds", {"rgba8-unorm", 16, 8, 1, 1, 5}},
        {"bc/oiio/sample-DXT1.dds", {"bc1-rgba-unorm", 123, 456}},
        {"bc/playcanvas/helipad.dds", {"rgba8-unorm", 128, 128, 1, 6, 6}},
        {"bc/playcanvas/playcanvas.dds", {"bc1-rgba-unorm", 720, 720}},
        {"volumes/bunny.ktx2", {"r32-float", 64, 64, 64}},
        {"bc/oiio/broken/dds_8bytes.dds", {.refusal = "truncated: a DDS header needs 128 bytes, the file has 8"}},
        {"bc/oiio/broken/dds_bc3_just_header.dds", {.refusal = "need 480 bytes of texels, the file has 0"}},
        {"bc/oiio/broken/dds_bc3_no_full_header.dds", {.refusal = "truncated: a DDS header needs 128 bytes, the file has 118"}},
        {"bc/oiio/broken/dds_bc7_just_header.dds", {.refusal = "need 480 bytes of texels, the file has 0"}},
        {"bc/oiio/broken/dds_bc7_not_enough_data.dds", {.refusal = "need 480 bytes of texels, the file has 240"}},
    };
    return known;
}

void expect_known(const std::filesystem::path& path, const Known& known) {
    try {
        const auto source = open_any(path);
        ASSERT_EQ(known.refusal, nullptr) << path << " was opened";
        const Shape shape = source->shape();
        EXPECT_EQ(info(source->format()).name, known.format) << path;
        EXPECT_EQ(shape, (Shape{.width = known.width,
                                .height = known.height,
                                .depth = known.depth,
                                .layers = known.layers,
                                .levels = known.levels,
                                .cube = known.layers == 6}))
            << path;
        EXPECT_NO_THROW(each_block(*source, [](int, int, int, int, const Bytes&) {})) << path;
    } catch (const TextureError& error) {
        const std::string message = error.what();
        ASSERT_NE(known.refusal, nullptr) << message;
        EXPECT_TRUE(message.starts_with(path.string() + ": ")) << message;
        EXPECT_NE(message.find(known.refusal), std::string::npos) << message;
    }
}

TEST_F(ContainerCorpus, IsOpenedAsItIsKnownToBeOrRefusedForTheReasonKnown) {
    size_t found = 0;
    for (const char* folder : {"bc", "volumes"}) {
        for (const auto& path : files(folder)) {
            const auto known = known_files().find(std::filesystem::relative(path, root_).string());
            if (known == known_files().end()) {
                ADD_FAILURE() << path << " is not in the table";
                continue;
            }
            ++found;
            expect_known(path, known->second);
        }
    }
    EXPECT_EQ(found, known_files().size());
}

Bytes read_whole(const std::filesystem::path& path) {
    const auto file = open_file(path);
    Bytes bytes(file->size());
    file->read(0, bytes);
    return bytes;
}

TEST_F(ContainerCorpus, HoldsTheTexelsThatASlowReaderFinds) {
    int compared = 0;
    for (const auto& path : files("bc")) {
        if (path.parent_path().filename() == "broken") continue;
        const reference::TextureFile expected(read_whole(path));
        ASSERT_TRUE(expected.known()) << path;
        ++compared;
        const auto source = open_any(path);
        const Format format = source->format();
        // Ours are floats, and codes of 16 bits where a file's fields have widths of their own.
        const double rounding = format == Format::RGBA16Unorm ? 0.5 / 65535 : 0;
        double worst = 0;
        each_block(*source, [&](int level, int layer, int x, int y, const Bytes& texels) {
            for (int texel = 0; texel < 16; ++texel) {
                const int column = std::min(4 * x + texel % 4, expected.width(level) - 1);
                const int row = std::min(4 * y + texel / 4, expected.height(level) - 1);
                const auto got = test_files::decoded_value(format, texels.data(), texel),
                           wanted = expected.value(level, layer, column, row);
                for (size_t c = 0; c < 4; ++c) {
                    if (got[c] == wanted[c]) continue;
                    worst = std::max(worst, (std::abs(got[c] - wanted[c]) - rounding) / std::max(1e-3, std::abs(wanted[c])));
                }
            }
        });
        EXPECT_LE(worst, 0x1p-23) << path << " relative";
    }
    EXPECT_EQ(compared, 54);
}

/// Largest difference of red, green and blue in the lowest quarter of level 0, as sRGB-encoded values.
double largest_difference(const std::filesystem::path& a, const std::filesystem::path& b) {
    const auto first = open_any(a), second = open_any(b);
    EXPECT_EQ(first->shape(), second->shape());
    double worst = 0;
    Bytes other(256);
    each_block(*first, [&](int level, int slice, int x, int y, const Bytes& texels) {
        if (level != 0 || 16 * y < 3 * first->shape().height) return;
        second->decode_block(level, slice, x, y, other.data());
        for (int texel = 0; texel < 16; ++texel) {
            const auto one = test_files::decoded_value(first->format(), texels.data(), texel);
            const auto two = test_files::decoded_value(second->format(), other.data(), texel);
            for (size_t c = 0; c < 3; ++c) worst = std::max(worst, std::abs(linear_to_srgb(one[c]) - linear_to_srgb(two[c])));
        }
    });
    return worst;
}

TEST_F(ContainerCorpus, ShowsTheSameGroundInEveryFormatOfOnePicture) {
    // Each picture has its format's name written at the top of one plain colour: one for the compressed ones, one for the others.
    const auto folder = root_ / "bc/gltft";
    EXPECT_LT(largest_difference(folder / "2d_bc1.ktx2", folder / "2d_bc7.ktx2"), 6.0 / 255);
    EXPECT_LT(largest_difference(folder / "2d_rgba8.ktx2", folder / "2d_rgba16_linear.ktx2"), 1.0 / 255);
    EXPECT_LT(largest_difference(folder / "2d_rgba8.ktx2", folder / "2d_rgba32_linear.ktx2"), 1.0 / 255);
}

}  // namespace
}  // namespace rawtexel::texunit
