// From three transformed vertices to triangles ready for coverage: cull, clip, snap, planes.
#pragma once

#include "raster/clip.h"
#include "raster/frame.h"
#include "raster/tile_grid.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace rawtexel::raster {

/// What one run of consecutive triangles became.
struct SetupBatch {
    /// The planes that triangle `triangle` of the batch shall point to, once the planes have found their place in memory.
    struct PlaneLink {
        uint32_t triangle, planes;
    };
    std::vector<SetupTriangle> triangles;
    std::vector<std::array<Plane, 3>> piece_planes;
    std::vector<PlaneLink> links;
    FrameCounts counts;
};

/// Where a triangle comes from, and how its draw wants it.
struct TriangleOrigin {
    uint32_t triangle_id, draw, primitive;
    CoverageClass coverage;
    CullMode cull;
    bool front_is_clockwise;
};

class TriangleSetup {
  public:
    TriangleSetup(const TileGrid& grid, SetupBatch& batch) : grid_(grid), batch_(batch) {}

    /// Decides the triangle's one fate and counts it; appends what is left of it to the batch.
    void add(const std::array<ScreenVertex, 3>& corners, const TriangleOrigin& origin);

  private:
    enum class Fate { Frustum, Backface, Degenerate, Small, Nonfinite, Binned };
    /// The corners in their canonical order.
    struct Ordered {
        std::array<ScreenVertex, 3> vertex;
        std::array<uint8_t, 3> corner;
        bool odd;                           ///< the order turns the other way than the corners do
    };

    Fate classify(const std::array<ScreenVertex, 3>& corners, const TriangleOrigin& origin);
    Fate add_polygon(std::span<const ScreenVertex> polygon, const Ordered& ordered, const TriangleOrigin& origin, bool whole);
    static Ordered order(const std::array<ScreenVertex, 3>& corners);
    bool outside_samples(const std::array<ScreenVertex, 3>& corners) const;
    void count(Fate fate);

    const TileGrid& grid_;
    SetupBatch& batch_;
};

}  // namespace rawtexel::raster
