// The tiles of a frame that touch the pixels to render.
#pragma once

#include "shading/pixel_rect.h"

#include <cstdint>

namespace rawtexel::shading {

/// Numbered row by row.
struct TileRange {
    TileRange(const PixelRect& visible, int tile_size)
        : x0(visible.x0 / tile_size),
          y0(visible.y0 / tile_size),
          columns((visible.x1 - 1) / tile_size + 1 - x0),
          rows((visible.y1 - 1) / tile_size + 1 - y0) {}
    int64_t count() const { return int64_t(columns) * rows; }
    int x(int64_t index) const { return x0 + int(index % columns); }
    int y(int64_t index) const { return y0 + int(index / columns); }
    int x0, y0, columns, rows;
};

}  // namespace rawtexel::shading
