// From planes in the order of waves to rows of pixels.
#pragma once

#include "shading/pixel_rect.h"

#include <cstddef>

namespace rawtexel::shading {

/// Planes of a tile: wave after wave, row by row; a channel each, `stride` floats apart.
struct WavePlaneSet {
    const float* values;
    size_t stride;
    size_t waves_x;  ///< waves in a row of the tile
    int channels;    ///< 1 to 4
};

/// The pixels of `rect`, which is of the tile and as wide as whole waves, to `out`, rows of interleaved channels that are `out_stride`
/// floats apart, each value times `factor`. Dispatches to the instruction set in use.
void interleave_waves(const WavePlaneSet& planes, const PixelRect& rect, float factor, float* out, size_t out_stride);

}  // namespace rawtexel::shading
