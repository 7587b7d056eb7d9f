// A survey chart: an 8x8 checker of numbered squares, each with a test figure of its own.
#pragma once

#include "scenes/procedural_surface.h"

namespace rawtexel::scenes {

/// 2048 x 2048 texels; every square is 256 texels wide and unlike its neighbours, with lines down to two texels.
Surface survey_chart();

}  // namespace rawtexel::scenes
