// A rectangle of pixels.
#pragma once

namespace rawtexel::shading {

/// Pixels of the frame, [x0, x1) x [y0, y1).
struct PixelRect {
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
};

}  // namespace rawtexel::shading
