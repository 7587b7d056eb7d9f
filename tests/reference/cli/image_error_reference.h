// Image metrics, one value after the other in extended precision.
#pragma once

#include "cli/metrics/metrics.h"

#include <span>

namespace rawtexel::reference {

cli::ImageError image_error(std::span<const float> test, std::span<const float> reference);

}  // namespace rawtexel::reference
