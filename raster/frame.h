// One frame's geometry: transformed, clipped, culled, set up in fixed point and binned to tiles, once for all samples.
#pragma once

#include "raster/mesh_clusters.h"
#include "raster/sample_grid.h"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
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
    const glm::vec3* positions = nullptr;  ///< object space
    uint32_t vertex_count = 0;
    const uint32_t* indices = nullptr;  ///< 3 per triangle, each < vertex_count (asserted)
    uint32_t triangle_count = 0;
    /// make_clusters() of these positions and indices. Null: made for this frame alone, which takes longer than drawing them.
    const MeshClusters* clusters = nullptr;
    /// Clip space as Vulkan's but y up: x_clip/w_clip is -1 at the left and 1 at the right, y_clip/w_clip 1 at the top and -1 at the
    /// bottom. Reversed depth: z_clip/w_clip is 1 at the near plane and falls to 0 far away. Visible is 0 <= z_clip <= w_clip.
    glm::mat4 clip_from_object{1.0f};
    uint32_t first_triangle_id = 0;  ///< scene-order id of the first triangle; ids of a frame are distinct
    CoverageClass coverage = CoverageClass::Opaque;
    CullMode cull = CullMode::Back;
    /// Front faces are counter-clockwise as seen on the screen; clockwise when the transform mirrors (odd negative scale).
    bool front_is_clockwise = false;
};

/// Work that is left out where it cannot change what is seen; each can be turned off.
struct RasterSkips {
    bool clusters = true;   ///< tests of whole clusters, before their vertices are transformed
    bool frustum = true;    ///< of clusters and of triangles that lie outside of the view
    bool backface = true;   ///< of clusters and of triangles that face away, before they are set up
    bool occlusion = true;  ///< of clusters behind what large opaque clusters cover
    bool hiz = true;        ///< of what lies behind all of an 8x8 block
};

struct FrameOptions {
    int width = 0, height = 0;  ///< pixels of the whole frame, 1..16384
    /// Only tiles that touch it are binned; zero extents mean the whole frame.
    int crop_x = 0, crop_y = 0, crop_width = 0, crop_height = 0;
    int tile_size = 64;  ///< pixels, a multiple of 8; tiles are aligned to the whole frame whatever the crop
    /// Farthest a sample point lies from its pixel's centre along one axis, pixels. Conservative tests are widened by it.
    float filter_radius = 0.0f;
    /// The offsets that the frame's samples have; nullopt: all within filter_radius.
    std::optional<OffsetRange> reach = std::nullopt;
    /// Opaque triangles are drawn in scene order, as whoever counts overdraw wants them, and not the nearest clusters first.
    bool scene_order = false;
    RasterSkips skips = {};
};

/// Every triangle has exactly one fate: it is binned, or culled for one of seven reasons.
struct FrameCounts {
    uint64_t triangles = 0;
    uint64_t culled_frustum = 0;  ///< outside the view volume, or reaching no sample point of a tile that touches the crop
    uint64_t culled_backface = 0;
    uint64_t culled_degenerate = 0;       ///< no area once snapped
    uint64_t culled_small = 0;            ///< between the points that the pixel filter may sample
    uint64_t culled_unsampled = 0;        ///< between the points that this frame samples
    uint64_t culled_occluded = 0;         ///< in clusters behind what large opaque clusters cover
    uint64_t culled_nonfinite = 0;        ///< a vertex was NaN or infinite after the transform
    uint64_t binned = 0;                  ///< reached a bin, whole or in pieces
    uint64_t clipped = 0;                 ///< triangles that a plane cut and that something was left of; not a fate
    uint64_t tiles = 0, tiles_empty = 0;  ///< of the tiles that touch the crop
    uint64_t hiz_rejected = 0;            ///< 8x8 blocks of triangles that the tile's depth hid (summed by who draws the tiles)
    FrameCounts& operator+=(const FrameCounts&);
};

/// A plane f(x, y) = c + (a*x + b*y) over pixel coordinates (x right, y down, pixel (0,0) spans [0,1)).
struct Plane {
    double a = 0, b = 0, c = 0;
    double at(double x, double y) const { return c + (a * x + b * y); }
};

/// A triangle ready for coverage: a whole triangle, or one piece of a triangle that a plane cut. What coverage and depth need fills the
/// first cache line.
struct alignas(64) SetupTriangle {
    /// Snapped screen positions, 1/256 pixel, ordered so that (x1-x0)(y2-y0) - (x2-x0)(y1-y0) > 0. Triangles with the same
    /// three clip positions have the same order here, and so the same depth bits, in whatever order they were given.
    int32_t x[3], y[3];
    /// z_clip/w_clip at a sample point: depth_at_origin + (depth_dx*(x - x[0]/256) + depth_dy*(y - y[0]/256)), in double, rounded to
    /// float, clamped to [depth_min, depth_max], the range of the vertices. 1 near, falling with distance.
    double depth_at_origin, depth_dx, depth_dy;
    float depth_min, depth_max;
    uint32_t triangle_id;  ///< scene order
    CoverageClass coverage;
    bool front_facing;
    float rounded_inverse_w[3];  ///< inverse_w
    uint8_t corner[3];           ///< of a whole triangle: which corner of the primitive is at x[i], y[i]
    bool compact;        ///< a whole triangle of at most kCompactExtent pixels along x and y, w at most 1 : kCompactMostW and not beyond
                         ///< kCompactInverseW
    uint32_t draw;       ///< index into the draws
    uint32_t primitive;  ///< triangle within the draw; its vertices are indices[3*primitive + corner]
    /// Of a whole triangle: 1/w of its vertices, in the order of x and y.
    std::array<double, 3> inverse_w;
    /// Of a piece: b/w of the three corners as planes, in memory of the frame. Null for a whole triangle, whose planes follow from x and y.
    const std::array<Plane, 3>* bary_over_w;
};

/// Within this many pixels edge functions at sample points are exact in 32 bits: 2 * (64 * 256) * (64 * 512) < 2^31.
inline constexpr int kCompactExtent = 64;
/// Beyond this ratio of w, slopes of weights would lose digits in single precision.
inline constexpr double kCompactMostW = 2;
/// Largest 1/w, and its inverse the least, that leaves room for products with edge functions.
inline constexpr double kCompactInverseW = 0x1p64;

inline constexpr uint32_t kNoTriangle = 0xFFFFFFFFu;

class FrameMemory;
struct SetupBatch;

/// The same draws give the same frame for any number of threads. Movable, not copyable: its triangles point into it.
class Frame {
  public:
    /// Throws std::length_error when more than some 2^31 triangles or 2^32 - 1 bin entries are left after culling.
    Frame(const FrameOptions& options, std::span<const Draw> draws, const ParallelFor& parallel_for = serial_for);
    ~Frame();
    Frame(Frame&&) noexcept;
    Frame& operator=(Frame&&) noexcept;
    Frame(const Frame&) = delete;
    Frame& operator=(const Frame&) = delete;

    const FrameOptions& options() const { return options_; }
    const FrameCounts& counts() const { return counts_; }
    uint64_t serial() const { return serial_; }  ///< not 0, and no other frame's of this process
    int tiles_x() const { return tiles_x_; }
    int tiles_y() const { return tiles_y_; }
    const SetupTriangle& triangle(uint32_t setup_index) const {
        return blocks_[setup_index / kBlockTriangles][setup_index % kBlockTriangles];
    }
    uint32_t triangle_count() const { return triangle_count_; }
    /// Calls visit(setup index, triangle) in the order of setup indices, which have gaps.
    template <class Visit>
    void for_each_triangle(Visit&& visit) const {
        for (size_t block = 0; block < blocks_.size(); ++block) {
            for (uint32_t i = 0; i < block_size_[block]; ++i) visit(uint32_t(block * kBlockTriangles + i), blocks_[block][i]);
        }
    }
    /// Setup indices of the triangles that may touch a sample of the tile: opaque first, those of near clusters before those of far ones or
    /// in scene order (FrameOptions::scene_order); then masked, then blended, in scene order.
    /// Empty for tiles that do not touch the crop.
    std::span<const uint32_t> bin(int tile_x, int tile_y) const;

  private:
    static constexpr uint32_t kBlockTriangles = 4096;

    void number_blocks(std::vector<SetupBatch>& batches, std::vector<uint32_t>& first_block);
    void fill_bins(const std::vector<SetupBatch>& batches, const std::vector<uint32_t>& first_block, const ParallelFor& parallel_for);
    void sort_bins(const ParallelFor& parallel_for);

    FrameOptions options_;
    uint64_t serial_;
    FrameCounts counts_;
    int tiles_x_ = 0, tiles_y_ = 0;
    uint32_t triangle_count_ = 0;
    uint32_t first_layered_ = 0;  ///< first setup index that is not of opaque geometry
    std::unique_ptr<FrameMemory> memory_;
    std::vector<const SetupTriangle*> blocks_;
    std::vector<uint32_t> block_size_;
    std::vector<std::vector<SetupTriangle>> overflow_;
    std::vector<std::vector<std::array<Plane, 3>>> piece_planes_;
    std::vector<uint32_t> bin_start_, bin_entries_;
};

}  // namespace rawtexel::raster
