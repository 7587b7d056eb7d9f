// The winner at one sample point, by looking at every triangle of the frame.
#pragma once

#include "raster/visibility.h"

#include <functional>

namespace rawtexel::reference {

struct Winner {
    uint32_t setup_index = raster::kNoTriangle;
    float depth = 0.0f;
};

/// Depth of a triangle at a sample point, 1/512 pixel, by the formula of SetupTriangle.
float depth_at(const raster::SetupTriangle& triangle, int64_t sample_x, int64_t sample_y);

/// Whether a triangle that needs texels covers the pixel.
using Covering = std::function<bool(const raster::SetupTriangle&, int x, int y)>;

/// Greatest depth value, then smallest id, over all covering triangles of the frame.
Winner winner_at(const raster::Frame& frame, int x, int y, const raster::SampleOffset& offset, const Covering& covering);

}  // namespace rawtexel::reference
