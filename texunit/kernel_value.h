// Reconstruction kernels in double precision, one coordinate at a time: the plain meaning of texunit/kernel_weights-inl.h.
#pragma once

#include "texunit/kernel.h"

#include <cstdint>
#include <vector>

namespace rawtexel::texunit {

struct WeightedTexel {
    int64_t texel;  ///< not wrapped
    double weight;  ///< along one axis, not 0
};

/// The taps of `kernel` at texel-space coordinate `x`, |x| < 2^40, along one axis: texel n spans n to n + 1. Ascending; weights sum to 1.
std::vector<WeightedTexel> axis_weights(const Kernel& kernel, double x);

}  // namespace rawtexel::texunit
