// One drawn lookup, taken apart: which texels with which numbers, and the value that they make. For tools that explain; what a lookup
// weighs altogether is texunit/lookup_trace.h's.
#pragma once

#include "texunit/lookup_trace.h"
#include "texunit/noise.h"
#include "texunit/random.h"

#include <optional>
#include <vector>

namespace rawtexel::texunit {

/// The numbers that a lookup draws with.
struct DrawSource {
    RandomAddress address{};  ///< of the first draw; draw n has sample address.sample + n. Dimension is not looked at
    Noise noise = Noise::White;
    int draws = 1;                ///< averaged, at least 1
    bool common_numbers = false;  ///< texels of negative weights are drawn with the numbers of the positive ones
};

/// The numbers that a sampler looks at to draw a texel; empty for roles that it never does.
struct RoleNumbers {
    float x = 0, y = 0;
    std::optional<float> z;      ///< of volumes and cube maps
    std::optional<float> level;  ///< between levels, or of drawn ellipses with a bias
    std::optional<float> probe;  ///< where it takes several probes
    std::optional<float> sign;   ///< of kernels with negative lobes, but for abs-weight
};

struct DrawnTap {
    int draw = 0;  ///< 0 .. draws - 1
    TracedTap tap;
    RoleNumbers numbers;
};

struct DrawTrace {
    std::vector<DrawnTap> taps;     ///< draw by draw; of a kernel with negative lobes the positive one first
    std::array<float, 4> result{};  ///< linear RGBA: the taps' weighted sum, in float and in their order
};

/// Draws as sampler.estimator says, which is not All and does not refuse the kernel. `layer` of an array. Throws TextureError as lookups
/// do.
DrawTrace trace_draws(Texture& texture, const SamplerState& sampler, const LaneCoordinates& at, const DrawSource& source, float layer = 0);
DrawTrace trace_volume_draws(Texture& texture, const SamplerState& sampler, const LaneCoordinates3& at, const DrawSource& source);
DrawTrace trace_cube_draws(Texture& texture, const SamplerState& sampler, const LaneCoordinates3& direction, const DrawSource& source,
                           float cube = 0);

}  // namespace rawtexel::texunit
