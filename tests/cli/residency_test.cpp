#include "cli/residency.h"

#include "cli/reports/colour_map.h"

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <random>
#include <set>

namespace rawtexel::cli {
namespace {

/// A texture of any shape whose texels nobody reads.
class UnreadSource final : public texunit::TexelSource {
  public:
    explicit UnreadSource(const texunit::Shape& shape) : shape_(shape) {}
    texunit::Format format() const override { return texunit::Format::RGBA8Unorm; }
    texunit::Shape shape() const override { return shape_; }
    uint64_t stored_bytes() const override { return 0; }
    void decode_block(int, int, int, int, std::byte*) override { ADD_FAILURE() << "a texel was read"; }

  private:
    texunit::Shape shape_;
};

shading::Scene scene_of(const texunit::Shape& shape) {
    shading::Scene scene;
    scene.textures.push_back(
        {std::make_shared<texunit::Texture>("texture", std::make_unique<UnreadSource>(shape)), "", "", false, nullptr});
    return scene;
}

TEST(Residency, HoldsTheTexelsTouchedOfEveryBlock) {
    for (const texunit::Shape& shape : {texunit::Shape{.width = 37, .height = 70},
                                        {.width = 16, .height = 16, .layers = 6, .cube = true},
                                        {.width = 9, .height = 20, .depth = 5},
                                        {.width = 1, .height = 1}}) {
        const shading::Scene scene = scene_of(shape);
        shading::FrameFetches fetches{shading::TextureSet(scene)};
        const texunit::Texture& texture = *scene.textures[0].texture;
        const texunit::LevelTable& table = texture.levels();
        std::map<std::array<int, 3>, std::set<std::pair<int, int>>> expected;  // level, row of blocks, column: texels
        std::mt19937 random(5);
        for (int n = 0; n < 400; ++n) {
            const int level = int(random() % uint32_t(table.levels)), slice = int(random() % uint32_t(slice_count(shape, level)));
            const int x = int(random() % uint32_t(table.width[size_t(level)])), y = int(random() % uint32_t(table.height[size_t(level)]));
            fetches.touched.bits(0).mark(texel_index(table, texture.texel_layout().storage, level, slice, x, y));
            const int rows = (table.height[size_t(level)] + 3) / 4;
            expected[{level, slice * rows + y / 4, x / 4}].insert({x, y});
        }
        const std::vector<LevelResidency> levels = residency(fetches, 0);
        ASSERT_EQ(levels.size(), size_t(table.levels));
        size_t found = 0;
        for (size_t level = 0; level < levels.size(); ++level) {
            ASSERT_EQ(levels[level].touched.size(), size_t(levels[level].width) * size_t(levels[level].height));
            for (size_t i = 0; i < levels[level].touched.size(); ++i) {
                const std::array<int, 3> place{int(level), int(i) / levels[level].width, int(i) % levels[level].width};
                const auto block = expected.find(place);
                EXPECT_EQ(levels[level].touched[i], block == expected.end() ? 0 : block->second.size())
                    << shape.width << "x" << shape.height << " level " << level << " block " << place[2] << ", " << place[1];
                found += levels[level].touched[i] > 0;
            }
            EXPECT_EQ(levels[level].blocks_touched(), fetches.measure()[0][level].blocks_touched) << level;
        }
        EXPECT_EQ(found, expected.size());
    }
}

TEST(Residency, PictureHasTheLevelsBesideEachOther) {
    const std::vector<LevelResidency> levels{{4, 2, std::vector<uint8_t>(8, 16)}, {2, 1, {0, 8}}, {1, 1, {16}}};
    const ResidencyPicture picture = draw_residency(levels);
    ASSERT_EQ(picture.width, 4 + 1 + 2);
    ASSERT_EQ(picture.height, 4);
    const auto at = [&](int x, int y) {
        const uint8_t* code = picture.codes.data() + (y * picture.width + x) * 4;
        return std::array<uint8_t, 4>{code[0], code[1], code[2], code[3]};
    };
    const auto colour = [](double value) {
        const Rgb8 rgb = magma(value);
        return std::array<uint8_t, 4>{rgb[0], rgb[1], rgb[2], 255};
    };
    EXPECT_EQ(at(0, 0), colour(1.0));
    EXPECT_EQ(at(3, 1), colour(1.0));
    EXPECT_EQ(at(5, 0), colour(0.0));
    EXPECT_EQ(at(6, 0), colour(0.5));
    EXPECT_EQ(at(5, 2), colour(1.0));
    EXPECT_EQ(at(4, 0)[3], 0);
    EXPECT_EQ(at(0, 2)[3], 0);
    EXPECT_EQ(at(5, 1)[3], 0);
}

}  // namespace
}  // namespace rawtexel::cli
