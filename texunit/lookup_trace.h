// One lookup, taken apart: its level of detail, every tap with its weight and value, and the result. For tools that explain.
#pragma once

#include "texunit/sample.h"

#include <array>
#include <vector>

namespace rawtexel::texunit {

/// A texel that a lookup weighs.
struct TracedTap {
    int level = 0;
    int slice = 0;                 ///< array layer, 6*cube + face, or depth slice
    int x = 0, y = 0;              ///< texel of that level and slice; without meaning for a border
    double weight = 0;             ///< product over axes, level and probe; never 0
    bool border = false;           ///< takes the border colour instead of a texel
    std::array<float, 4> value{};  ///< linear RGBA
};

struct LookupTrace {
    float lod = 0;                  ///< lambda clamped to the levels there are
    float anisotropy = 1;           ///< ratio of the footprint's axes, at most the sampler's probes; of an ellipse at most 64
    std::vector<TracedTap> taps;    ///< the finer level before the coarser; in a level by probe, slice, row and column
    std::array<float, 4> result{};  ///< linear RGBA: bit-equal to what the wave functions of texunit/sample.h return
};

/// A lookup of one lane.
struct LaneCoordinates {
    float u = 0, v = 0;
    float dudx = 0, dvdx = 0, dudy = 0, dvdy = 0;
};
struct LaneCoordinates3 {
    std::array<float, 3> position{};
    std::array<float, 3> dx{}, dy{};
};

/// What sample_wave does for one lane; `layer` of an array. Runs the same code, which tells of its taps (texunit/fetch_log.h). Throws
/// TextureError as it does.
LookupTrace trace_lookup(Texture& texture, const SamplerState& sampler, const LaneCoordinates& at, float layer = 0);
LookupTrace trace_volume_lookup(Texture& texture, const SamplerState& sampler, const LaneCoordinates3& at);
LookupTrace trace_cube_lookup(Texture& texture, const SamplerState& sampler, const LaneCoordinates3& direction, float cube = 0);

}  // namespace rawtexel::texunit
