#include "cli/residency.h"

#include "cli/reports/colour_map.h"

#include <algorithm>
#include <bit>

namespace rawtexel::cli {

uint64_t LevelResidency::blocks_touched() const {
    return uint64_t(std::ranges::count_if(touched, [](uint8_t texels) { return texels > 0; }));
}

std::vector<LevelResidency> residency(const shading::FrameFetches& fetches, size_t index) {
    const texunit::Texture& texture = *fetches.textures[index];
    const texunit::LevelTable& table = texture.levels();
    const texunit::Shape& shape = texture.shape();
    const auto blocks = [](int32_t texels) { return (texels + 3) / 4; };
    std::vector<LevelResidency> levels;
    std::vector<int> rows;  // of one slice
    for (size_t level = 0; level < size_t(table.levels); ++level) {
        const int slices = slice_count(shape, int(level));
        rows.push_back(blocks(table.height[level]));
        LevelResidency& one = levels.emplace_back();
        one.width = blocks(table.width[level]);
        one.height = rows.back() * slices;
        one.touched.resize(size_t(one.width) * size_t(one.height));
    }
    fetches.touched.for_each_group(index, [&](int32_t first, uint32_t bits) {
        for (const int32_t half : {0, 16}) {
            const int texels = std::popcount(bits >> half & 0xffffu);
            if (texels == 0) continue;
            const texunit::BlockPosition at =
                locate_block(table, texture.texel_layout().storage, (first + half) / texunit::kTexelsPerBlock);
            LevelResidency& level = levels[size_t(at.level)];
            level.touched[size_t(at.slice * rows[size_t(at.level)] + at.y) * size_t(level.width) + size_t(at.x)] = uint8_t(texels);
        }
    });
    return levels;
}

ResidencyPicture draw_residency(const std::vector<LevelResidency>& levels) {
    constexpr int kGap = 1;
    ResidencyPicture picture;
    int right = 0, below = 0;
    for (size_t i = 1; i < levels.size(); ++i) {
        right = std::max(right, levels[i].width);
        below += levels[i].height + kGap;
    }
    picture.width = levels[0].width + (right > 0 ? right + kGap : 0);
    picture.height = std::max(levels[0].height, below);
    picture.codes.resize(size_t(picture.width) * size_t(picture.height) * 4);
    int x0 = 0, y0 = 0;
    for (size_t i = 0; i < levels.size(); ++i) {
        const LevelResidency& level = levels[i];
        for (int y = 0; y < level.height; ++y)
            for (int x = 0; x < level.width; ++x) {
                const Rgb8 colour = magma(level.touched[size_t(y) * size_t(level.width) + size_t(x)] / 16.0);
                uint8_t* code = picture.codes.data() + (size_t(y0 + y) * size_t(picture.width) + size_t(x0 + x)) * 4;
                std::ranges::copy(colour, code);
                code[3] = 255;
            }
        y0 = i == 0 ? 0 : y0 + level.height + kGap;
        x0 = levels[0].width + kGap;
    }
    return picture;
}

}  // namespace rawtexel::cli
