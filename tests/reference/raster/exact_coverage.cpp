#include "tests/reference/raster/exact_coverage.h"

namespace rawtexel::reference {

namespace {

using Int = __int128;

int sign(Int value) { return value > 0 ? 1 : value < 0 ? -1 : 0; }

/// On which side of the line from (ax, ay) to (bx, by) the point lies once it is nudged by (h, h^2), h > 0 as small as need be. Never 0 for
/// two different points.
int side(Int ax, Int ay, Int bx, Int by, Int px, Int py) {
    const Int dx = bx - ax, dy = by - ay;
    const int exact = sign(dx * (py - ay) - dy * (px - ax));
    if (exact != 0) return exact;
    const int to_the_right = sign(-dy);
    return to_the_right != 0 ? to_the_right : sign(dx);
}

}  // namespace

SnappedTriangle snapped(const raster::SetupTriangle& triangle) {
    SnappedTriangle result;
    for (int i = 0; i < 3; ++i) {
        result.x[i] = triangle.x[i];
        result.y[i] = triangle.y[i];
    }
    return result;
}

bool covers(const SnappedTriangle& t, int64_t sample_x, int64_t sample_y) {
    int sides = 0;
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3;
        sides += side(2 * Int{t.x[i]}, 2 * Int{t.y[i]}, 2 * Int{t.x[j]}, 2 * Int{t.y[j]}, sample_x, sample_y);
    }
    return sides == 3 || sides == -3;
}

}  // namespace rawtexel::reference
