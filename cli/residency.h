// Which blocks of textures a frame touched, as pictures: what sampler feedback tells on a GPU.
#pragma once

#include "shading/frame_fetches.h"

#include <cstdint>
#include <vector>

namespace rawtexel::cli {

/// Texels touched of every 4x4 block of one level, 0 to 16; slices (layers, faces, depth) lie below each other.
struct LevelResidency {
    int width = 0, height = 0;  ///< blocks
    std::vector<uint8_t> touched;
    uint64_t blocks_touched() const;
};

/// Of every level of texture `index` of `fetches.textures`.
std::vector<LevelResidency> residency(const shading::FrameFetches& fetches, size_t index);

/// RGBA codes: the first level to the left, the others below each other to its right; magma from untouched to whole, transparent between.
struct ResidencyPicture {
    int width = 0, height = 0;
    std::vector<uint8_t> codes;
};
ResidencyPicture draw_residency(const std::vector<LevelResidency>& levels);

}  // namespace rawtexel::cli
