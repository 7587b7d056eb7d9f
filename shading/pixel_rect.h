// A rectangle of pixels.
#pragma once

#include "texunit/wave.h"

#include <algorithm>

namespace rawtexel::shading {

/// Pixels of the frame, [x0, x1) x [y0, y1).
struct PixelRect {
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
};

/// Lanes of the wave whose upper left pixel is (x, y) that lie in `rect`.
inline texunit::WaveMask lanes_inside(const PixelRect& rect, int x, int y) {
    const int first = std::clamp(rect.x0 - x, 0, texunit::kWaveWidth), last = std::clamp(rect.x1 - x, 0, texunit::kWaveWidth);
    const texunit::WaveMask columns = ((1u << last) - 1u) & ~((1u << first) - 1u);
    texunit::WaveMask mask = 0;
    for (int row = 0; row < texunit::kWaveHeight; ++row)
        if (y + row >= rect.y0 && y + row < rect.y1) mask |= columns << (texunit::kWaveWidth * row);
    return mask;
}

}  // namespace rawtexel::shading
