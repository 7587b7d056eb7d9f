// Real files. RAWTEXEL_CORPUS names the folder that holds them; what needs it is skipped where it is unset, and dds_test, ktx2_test and
// bc7_test check the same on generated files.
#include "tests/reference/texunit/bc_bc6h.h"
#include "tests/reference/texunit/bc_bc7.h"
#include "tests/texunit/container_writer.h"

#include "texunit/containers.h"
#include "texunit/srgb.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
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

TEST_F(ContainerCorpus, OpensEveryFileButTheBrokenOnes) {
    int opened = 0, broken = 0;
    for (const char* folder : {"bc", "volumes"}) {
        for (const auto& path : files(folder)) {
            if (path.parent_path().filename() == "broken") {
                ++broken;
                try {
                    open_any(path);
                    ADD_FAILURE() << path << " was opened";
                } catch (const TextureError& error) {
                    const std::string message = error.what();
                    EXPECT_NE(message.find(path.string()), std::string::npos) << message;
                    EXPECT_NE(message.find("truncated"), std::string::npos) << message;
                }
                continue;
            }
            ++opened;
            uint64_t blocks = 0;
            const auto source = open_any(path);
            ASSERT_NO_THROW(each_block(*source, [&](int, int, int, int, const Bytes&) { ++blocks; })) << path;
            EXPECT_GT(blocks, 0u) << path;
        }
    }
    EXPECT_GE(opened, 50);
    EXPECT_GE(broken, 5);
}

TEST_F(ContainerCorpus, HasTheFormatsThatItsFilesAreNamedFor) {
    const std::map<std::string, std::string> formats = {
        {"dds_a8.dds", "rgba8-unorm"},
        {"dds_abgr8.dds", "rgba8-unorm"},
        {"dds_bc1.dds", "bc1-rgba-unorm"},
        {"dds_bc2.dds", "bc2-unorm"},
        {"dds_bc3.dds", "bc3-unorm"},
        {"dds_bc3rxgb.dds", "rgba16-unorm"},
        {"dds_bc4.dds", "bc4-unorm"},
        {"dds_bc5.dds", "bc5-unorm"},
        {"dds_bc6hu.dds", "bc6h-ufloat"},
        {"dds_bc7.dds", "bc7-unorm"},
        {"dds_dxgi_bc1_srgb.dds", "bc1-rgba-srgb"},
        {"dds_dxgi_bc7_srgb.dds", "bc7-srgb"},
        {"dds_dxgi_bgrx8_srgb.dds", "rgba8-srgb"},
        {"dds_dxgi_r16.dds", "r16-unorm"},
        {"dds_dxgi_rgb10a2.dds", "rgba16-unorm"},
        {"dds_l8a8.dds", "rgba8-unorm"},
        {"dds_rgb332.dds", "rgba16-unorm"},
        {"dds_rgba4.dds", "rgba8-unorm"},
        {"dds_rgb8.dds", "rgba8-unorm"},
        {"lythwood_room_1k_bc6h_signed.dds", "bc6h-sfloat"},
        {"2d_rgba32_linear.ktx2", "rgba32-float"},
        {"2d_bc1.ktx2", "bc1-rgb-srgb"},
        {"2d_rgba8.ktx2", "rgba8-srgb"},
        {"Ryfjallet_cubemap_bc7.ktx2", "bc7-srgb"},
    };
    size_t found = 0;
    for (const auto& path : files("bc")) {
        const auto expected = formats.find(path.filename());
        if (expected == formats.end()) continue;
        ++found;
        EXPECT_EQ(info(open_any(path)->format()).name, expected->second) << path;
    }
    EXPECT_EQ(found, formats.size());
}

TEST_F(ContainerCorpus, DecodesBc6hAndBc7AsTheReferenceDoes) {
    int files_checked = 0;
    for (const auto& path : files("bc")) {
        if (path.parent_path().filename() == "broken" || path.extension() != ".dds") continue;
        const auto source = open_any(path);
        const Format format = source->format();
        const bool bc7 = with_srgb(format, false) == Format::BC7Unorm, bc6h = format == Format::BC6HUfloat || format == Format::BC6HSfloat;
        if (!bc7 && !bc6h) continue;
        ++files_checked;
        const Shape shape = source->shape();
        std::ifstream file(path, std::ios::binary);
        file.seekg(148);
        // The first level's blocks that hold no texel outside of the image.
        for (int y = 0; 4 * y < shape.height; ++y) {
            for (int x = 0; 4 * x < shape.width; ++x) {
                reference::Block16 block;
                ASSERT_TRUE(file.read(reinterpret_cast<char*>(block.data()), 16)) << path;
                if (4 * x + 4 > shape.width || 4 * y + 4 > shape.height) continue;
                Bytes got(128), expected(128);
                source->decode_block(0, 0, x, y, got.data());
                if (bc7) {
                    const auto texels = reference::evaluate_bc7(reference::take_apart_bc7(block));
                    std::memcpy(expected.data(), texels.data(), 64);
                } else {
                    const auto texels = reference::evaluate_bc6h(reference::take_apart_bc6h(block), format == Format::BC6HSfloat);
                    for (size_t i = 0; i < 16; ++i) {
                        const uint16_t halves[4] = {texels[i][0], texels[i][1], texels[i][2], 0x3C00};
                        std::memcpy(expected.data() + 8 * i, halves, 8);
                    }
                }
                ASSERT_TRUE(got == expected) << path << " block " << x << ", " << y;
            }
        }
    }
    EXPECT_GE(files_checked, 5);
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
