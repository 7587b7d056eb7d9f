// Ordered dithers of the software renderers: the numbers of a draw come from the pixel's place, and a few pixels together come close to the
// bilinear filter. One texel a lookup, the same in every frame.
#pragma once

#include "texunit/draw.h"

namespace rawtexel::texunit {

enum class Dither : uint8_t {
    None,
    /// Unreal's software renderer: offsets of 2x2 pixels, after which the coordinate is rounded down. They average 3/8 of a texel, so the
    /// picture lies 1/8 of a texel off towards the smaller coordinates.
    Unreal,
    /// Star Trek 25th Anniversary: eight thresholds, above which a coordinate's fraction is rounded up. Which pixel takes which is not
    /// documented; here they are the pixels of a 4x2 block, row by row, for columns and of a 2x4 block, column by column, for rows: each
    /// axis meets all eight, and the two of a pixel differ.
    StarTrek,
};

/// Numbers x and y of a bilinear draw for the 8x4 pixels right of and below (x, y) of the frame; the others are 0.
void dither_numbers(Dither dither, int x, int y, DrawNumbers& numbers);

}  // namespace rawtexel::texunit
