// What large opaque clusters hide from all samples of a frame, before anything else of it is set up.
#pragma once

#include "raster/frame.h"
#include "raster/tile_grid.h"

#include <cstdint>
#include <span>
#include <vector>

namespace rawtexel::raster {

inline constexpr int kCellPixels = 8;  ///< along a side of a cell

/// Cells of 8x8 pixels, ends included; none where first > last.
struct CellRange {
    int16_t first_x = 0, last_x = -1, first_y = 0, last_y = -1;
    int count() const { return first_x > last_x || first_y > last_y ? 0 : (last_x - first_x + 1) * (last_y - first_y + 1); }
};

/// A cluster whose vertices no plane clips.
struct Occluder {
    uint32_t draw, cluster;
    CellRange cells;
};

/// By cell a depth that is certainly nearer or as near at every sample of every pixel of the cell that this frame takes: something opaque
/// covers all of them and is no farther. 0 where there is no such depth.
class OcclusionBuffer {
  public:
    OcclusionBuffer(const FrameOptions& options, const TileGrid& grid);

    int64_t cell_count() const { return active_.count(); }  ///< of the active tiles
    /// Cells of the active tiles with a sample inside the box.
    CellRange cells_of(const SampleBox& box) const;

    /// Draws opaque clusters as the frame does, faces culled that it culls.
    void draw(std::span<const Draw> draws, std::span<const Occluder> occluders);

    /// Whether whatever lies in these cells and no nearer than `nearest` is strictly behind what was drawn.
    bool hides(const CellRange& cells, float nearest) const;

  private:
    /// A whole triangle of positive winding on the 24.8 grid.
    struct Triangle {
        int32_t x[3], y[3];
        double depth, depth_dx, depth_dy;  ///< at the first vertex; per pixel
        double slope_error;                ///< what rounding may have changed a slope by, whichever corner comes first
        double extent;                     ///< pixels
        float depth_min;
        bool border[3];  ///< edges that no other triangle of the group shares
    };
    /// What the triangles of one group, which turn the same way, do to a cell.
    struct Cell {
        float whole = 0.0f;     ///< nearest of the triangles that cover all of it by themselves
        float farthest = 1.0f;  ///< of those that touch it
        bool covered = false;   ///< its first sample is
        bool border = false;    ///< an edge that nobody shares may cross it
    };

    void gather(const Draw& draw, const Cluster& cluster, bool clockwise, std::vector<Triangle>& group);
    static void find_borders(std::vector<Triangle>& group);
    void draw_group(std::span<const Triangle> group, const CellRange& cells);
    SampleBox samples_of(int cell_x, int cell_y) const;
    static float depth_over(const Triangle& triangle, const SampleBox& samples);
    /// Of an active cell.
    size_t index(int cell_x, int cell_y) const {
        const int columns = active_.last_x - active_.first_x + 1;
        return size_t(cell_y - active_.first_y) * size_t(columns) + size_t(cell_x - active_.first_x);
    }

    const FrameOptions& options_;
    const TileGrid& grid_;
    CellRange active_;
    int64_t cells_to_test_ = 0;
    std::vector<float> depth_;  ///< of the active cells, row by row
    std::vector<Cell> cells_;   ///< likewise
};

}  // namespace rawtexel::raster
