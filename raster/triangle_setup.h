// From three transformed vertices that a plane parts to pieces ready for coverage: cull, clip, snap, planes.
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

/// Where a triangle comes from, and how its draw wants it.
struct TriangleOrigin {
    uint32_t triangle_id, draw, primitive;
    CoverageClass coverage;
    CullMode cull;
    bool front_is_clockwise;
};

/// Sets up triangles that a plane cuts, one at a time; whole ones go by raster/cluster_setup.h.
class ClippedSetup {
  public:
    /// `early`: leave out what lies outside of the view before it is clipped.
    ClippedSetup(const TileGrid& grid, bool early, FrameCounts& counts) : grid_(grid), early_(early), counts_(counts) {}

    /// Decides the fate of a triangle of finite vertices and counts it; appends the pieces that are left of it. `planes`: those of the
    /// clip planes that some vertex is outside of.
    void add(const std::array<ScreenVertex, 3>& corners, uint32_t planes, const TriangleOrigin& origin);

    /// Pieces, of all triangles added; their planes are to be linked once the vectors have stopped growing.
    std::vector<SetupTriangle>& pieces() { return pieces_; }
    std::vector<std::array<Plane, 3>>& planes() { return planes_; }
    /// By piece: which of the planes are its own.
    const std::vector<uint32_t>& plane_of_piece() const { return plane_of_piece_; }

  private:
    /// The counter that the triangle ends in.
    using Fate = uint64_t FrameCounts::*;
    /// The corners in their canonical order.
    struct Ordered {
        std::array<ScreenVertex, 3> vertex;
        std::array<uint8_t, 3> corner;
        bool odd;  ///< the order turns the other way than the corners do
    };

    Fate classify(const std::array<ScreenVertex, 3>& corners, uint32_t planes, const TriangleOrigin& origin);
    Fate add_polygon(std::span<const ScreenVertex> polygon, const Ordered& ordered, const TriangleOrigin& origin);
    void add_pieces(std::span<const ScreenVertex> polygon, const SnappedPolygon& snapped, const HomogeneousPlanes& planes,
                    const SetupTriangle& common);
    void keep_planes(const HomogeneousPlanes& planes, const Ordered& ordered);
    bool reaches_a_tile(size_t first_piece) const;
    static Ordered order(const std::array<ScreenVertex, 3>& corners);
    bool outside_samples(const std::array<ScreenVertex, 3>& corners) const;

    const TileGrid& grid_;
    bool early_;
    FrameCounts& counts_;
    std::vector<SetupTriangle> pieces_;
    std::vector<std::array<Plane, 3>> planes_;
    std::vector<uint32_t> plane_of_piece_;
};

}  // namespace rawtexel::raster
