// Which values a tile keeps of every sample, each in its own plane of floats.
#pragma once

#include "shading/aov.h"

#include <span>

namespace rawtexel::shading {

/// Plane numbers; -1: not kept. Layers of surface properties are means over the samples that saw a surface.
struct TilePlanes {
    explicit TilePlanes(std::span<const Aov> aovs = {}, bool coverage = false);

    static constexpr int kRadiance = 0;  ///< three planes
    int count = 3;                       ///< of the planes that are summed
    int hits = -1;                       ///< 1 where the sample saw a surface
    int depth = -1;
    int normal = -1;  ///< three planes
    int albedo = -1;  ///< three planes
    int uv = -1;      ///< two planes

    int first_sample_count = 0;  ///< of the planes that show the first sample
    int lod = -1, material = -1;
};

}  // namespace rawtexel::shading
