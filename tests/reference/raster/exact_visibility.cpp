#include "tests/reference/raster/exact_visibility.h"

#include "tests/reference/raster/exact_coverage.h"

#include <algorithm>

namespace rawtexel::reference {

float depth_at(const raster::SetupTriangle& triangle, int64_t sample_x, int64_t sample_y) {
    const double x = double(sample_x - 2 * int64_t{triangle.x[0]}) / 512.0, y = double(sample_y - 2 * int64_t{triangle.y[0]}) / 512.0;
    const double depth = triangle.depth_at_origin + (triangle.depth_dx * x + triangle.depth_dy * y);
    return std::clamp(float(depth), triangle.depth_min, triangle.depth_max);
}

Winner winner_at(const raster::Frame& frame, int x, int y, const raster::SampleOffset& offset, const Covering& covering) {
    Winner winner;
    uint32_t winner_id = raster::kNoTriangle;
    const int64_t sample_x = int64_t{x} * 512 + offset.x, sample_y = int64_t{y} * 512 + offset.y;
    frame.for_each_triangle([&](uint32_t i, const raster::SetupTriangle& triangle) {
        if (!covers(snapped(triangle), sample_x, sample_y)) return;
        const float depth = depth_at(triangle, sample_x, sample_y);
        if (depth < winner.depth || (depth == winner.depth && triangle.triangle_id >= winner_id)) return;
        if (triangle.coverage != raster::CoverageClass::Opaque && !covering(triangle, x, y)) return;
        winner = {i, depth};
        winner_id = triangle.triangle_id;
    });
    return winner;
}

}  // namespace rawtexel::reference
