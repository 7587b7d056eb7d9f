// Pictures of numbers: one colour a pixel, and below it what the colours mean.
#pragma once

#include "cli/reports/raster_text.h"
#include "shading/image.h"

#include <string>

namespace rawtexel::cli {

struct HeatMap {
    std::string label;  ///< what is shown, and its unit
    double low = 0, high = 1;
};

/// `values` (1 channel) in magma, the colours spread from low to high, above a legend: the label, and the colours between the numbers at
/// their ends. At least kLeastHeatMapWidth wide.
Canvas draw_heat_map(const shading::Image& values, const HeatMap& map);
inline constexpr int kLeastHeatMapWidth = 360, kLegendHeight = 48;

/// The largest finite value, at least 0.
double finite_maximum(const shading::Image& values);

}  // namespace rawtexel::cli
