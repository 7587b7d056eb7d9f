// One frame's geometry: transformed, clipped, culled, set up in fixed point and binned to tiles, once for all samples.
#pragma once

#include "raster/sample_grid.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace rawtexel::raster {

/// Runs body(i) for i in [0, count) in any order, perhaps in parallel, and returns when all are done; rethrows the first exception.
using ParallelFor = std::function<void(int64_t count, const std::function<void(int64_t)>& body)>;
/// One after the other on the calling thread.
void serial_for(int64_t count, const std::function<void(int64_t)>& body);

/// Whose coverage is settled by geometry alone, and whose needs texels: drawn after all opaque geometry.
enum class CoverageClass : uint8_t { Opaque, Masked, Blended };
enum class CullMode : uint8_t { None, Back };

/// One indexed triangle list with one transform. The memory is the caller's and outlives the frame.
struct Draw {
    const glm::vec3* positions = nullptr;     ///< object space
    uint32_t vertex_count = 0;
    const uint32_t* indices = nullptr;        ///< 3 per triangle, each < vertex_count (asserted)
    uint32_t triangle_count = 0;
    glm::mat4 clip_from_object{1.0f};         ///< reversed depth: z_clip/w_clip is 1 at the near plane and falls to 0 far away
    uint32_t first_triangle_id = 0;           ///< scene-order id of the first triangle; ids of a frame are distinct
    CoverageClass coverage = CoverageClass::Opaque;
    CullMode cull = CullMode::Back;
    bool front_is_clockwise = false;          ///< true when the transform mirrors (odd negative scale)
};

struct FrameOptions {
    int width = 0, height = 0;                ///< pixels of the whole frame, 1..16384
    int crop_x = 0, crop_y = 0, crop_width = 0, crop_height = 0;   ///< only tiles that touch it are binned; zero extents mean the whole frame
    int tile_size = 64;                       ///< pixels, a multiple of 8
    /// Farthest a sample point lies from its pixel's centre along one axis, pixels. Conservative tests are widened by it.
    float filter_radius = 0.0f;
};

struct FrameCounts {
    uint64_t triangles = 0, culled_frustum = 0, culled_backface = 0, culled_degenerate = 0, culled_small = 0;
    uint64_t culled_nonfinite = 0;            ///< a vertex was NaN or infinite after the transform
    uint64_t clipped = 0;                     ///< triangles that a plane cut
    uint64_t binned = 0;                      ///< triangles (after clipping) that reached a bin
    uint64_t tiles = 0, tiles_empty = 0, hiz_rejected = 0;
    FrameCounts& operator+=(const FrameCounts&);
};

/// A plane f(x, y) = c + a*x + b*y over pixel coordinates (x right, y down, pixel (0,0) spans [0,1)).
struct Plane {
    double a = 0, b = 0, c = 0;
    double at(double x, double y) const { return c + (a * x + b * y); }
};

/// A triangle ready for coverage and interpolation.
struct SetupTriangle {
    int32_t x[3], y[3];       ///< snapped screen positions, 1/256 pixel, winding made positive (see visibility)
    /// Barycentrics over w of the *unclipped* triangle: bary_over_w[i](x,y) = b_i/w. Their sum is 1/w. Pieces of one clipped triangle share them.
    Plane bary_over_w[3];
    Plane depth;              ///< z_clip/w_clip: 1 near, falling with distance
    uint32_t triangle_id;     ///< scene order
    uint32_t draw;            ///< index into the draws
    uint32_t primitive;       ///< triangle within the draw; its vertices are indices[3*primitive + i], matching bary_over_w[i]
    CoverageClass coverage;
    bool front_facing;
};

inline constexpr uint32_t kNoTriangle = 0xFFFFFFFFu;

/// The same draws give the same frame for any number of threads.
class Frame {
  public:
    Frame(const FrameOptions& options, std::span<const Draw> draws, const ParallelFor& parallel_for = serial_for);

    const FrameOptions& options() const { return options_; }
    const FrameCounts& counts() const { return counts_; }
    int tiles_x() const { return tiles_x_; }
    int tiles_y() const { return tiles_y_; }
    const SetupTriangle& triangle(uint32_t setup_index) const { return triangles_[setup_index]; }
    uint32_t triangle_count() const { return uint32_t(triangles_.size()); }
    /// Setup indices of the triangles that may touch a sample of the tile: opaque first, then masked and blended, each in scene order.
    std::span<const uint32_t> bin(int tile_x, int tile_y) const;

  private:
    FrameOptions options_;
    FrameCounts counts_;
    int tiles_x_ = 0, tiles_y_ = 0;
    std::vector<SetupTriangle> triangles_;
    std::vector<uint32_t> bin_start_, bin_entries_;
};

}  // namespace rawtexel::raster
