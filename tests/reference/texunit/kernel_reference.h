// Reconstruction kernels in double precision from their textbook definitions, as functions of the distance from the coordinate.
#pragma once

#include "texunit/kernel.h"

#include <vector>

namespace rawtexel::texunit::reference {

struct KernelTap {
    long long texel;  ///< not wrapped
    double weight;    ///< along one axis; they sum to 1
};

/// The taps of `kernel` at texel-space coordinate `x` (texel n spans n to n + 1), those of weight 0 left out. `cut_shift` widens, or
/// narrows, the interval of gaussian-point by so many texels.
std::vector<KernelTap> kernel_taps(const Kernel& kernel, double x, double cut_shift = 0);

}  // namespace rawtexel::texunit::reference
