// From three transformed vertices to triangles ready for coverage: cull, clip, snap, planes.
#pragma once

#include "raster/clip.h"
#include "raster/frame.h"
#include "raster/interpolation_planes.h"
#include "raster/tile_grid.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace rawtexel::raster {

/// A polygon's vertices on the 24.8 grid.
struct SnappedPolygon {
    explicit SnappedPolygon(std::span<const ScreenVertex> vertices);

    std::array<SnappedPosition, ClipPolygon::kCapacity> position;
    size_t size;
    int64_t doubled_area = 0;  ///< (1/256 pixel)^2, positive where the vertices turn clockwise on the screen (y down); exact
    SampleBox box;
};

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
    /// The counter that the triangle ends in.
    using Fate = uint64_t FrameCounts::*;
    /// The corners in their canonical order.
    struct Ordered {
        std::array<ScreenVertex, 3> vertex;
        std::array<uint8_t, 3> corner;
        bool odd;  ///< the order turns the other way than the corners do
    };

    Fate classify(const std::array<ScreenVertex, 3>& corners, const TriangleOrigin& origin);
    Fate add_polygon(std::span<const ScreenVertex> polygon, const Ordered& ordered, const TriangleOrigin& origin, bool whole);
    void add_whole(const SnappedPolygon& snapped, const Ordered& ordered, const SetupTriangle& common);
    void add_pieces(std::span<const ScreenVertex> polygon, const SnappedPolygon& snapped, const HomogeneousPlanes& planes,
                    const SetupTriangle& common);
    void link_planes(size_t first_triangle, const HomogeneousPlanes& planes, const Ordered& ordered);
    bool reaches_a_tile(size_t first_triangle) const;
    static Ordered order(const std::array<ScreenVertex, 3>& corners);
    bool outside_samples(const std::array<ScreenVertex, 3>& corners) const;

    const TileGrid& grid_;
    SetupBatch& batch_;
};

}  // namespace rawtexel::raster
