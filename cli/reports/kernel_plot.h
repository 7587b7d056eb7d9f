// What kernels look like.
#pragma once

#include "cli/reports/plot.h"
#include "texunit/kernel.h"

#include <span>

namespace rawtexel::cli {

/// The weight of a texel along one axis, by how far its centre lies from the lookup, -4 to 4 texels: what a lookup of each kernel gives it.
Plot kernel_plot(std::span<const texunit::Kernel> kernels);

}  // namespace rawtexel::cli
