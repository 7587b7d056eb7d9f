// Random frames of mixed draws, for tests that hold one way of drawing them against another.
#pragma once

#include "tests/raster/drawing.h"

#include <vector>

namespace rawtexel::raster::testing {

/// Owns what its draws point to; so it stays where it is.
struct MixedScene {
    explicit MixedScene(uint32_t seed, int triangles_per_draw = 60);
    MixedScene(const MixedScene&) = delete;
    MixedScene& operator=(const MixedScene&) = delete;

    std::vector<Mesh> meshes;
    /// Opaque, masked and blended draws of triangles of all sizes, some cut by the near plane, some repeated in the same place with their
    /// vertices in another order; ids in the order of the draws.
    std::vector<Draw> draws;
};

/// Whether a masked or blended triangle covers a pixel: even chances, by hash of both.
bool covers_by_hash(const SetupTriangle& triangle, int x, int y);
/// The same as a policy.
uint32_t cover_by_hash(const CandidateWave& wave);

}  // namespace rawtexel::raster::testing
