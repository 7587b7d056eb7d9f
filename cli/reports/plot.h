// Line plots as SVG: axes with units, a legend that names the series, colours that colour-blind readers tell apart, dashes for print.
#pragma once

#include <string>
#include <vector>

namespace rawtexel::cli {

struct PlotPoint {
    double x = 0, y = 0;
    // Of markers alone.
    bool ringed = false;    ///< stands out
    bool hollow = false;    ///< is not to be trusted
    std::string note = {};  ///< shown under the pointer
    int key = -1;           ///< at least 0: its data-key, for scripts
};

struct PlotSeries {
    std::string name;  ///< in the legend; empty: not there
    /// Joined in this order; those that are not finite, or not above 0 on a logarithmic axis, break the line.
    std::vector<PlotPoint> points;
    bool markers = false;  ///< on every point
    bool thin = false;     ///< without a marker, dotted
    /// Of the colours and dashes there are, counted on from their first; -1: those of the series' place.
    int color = -1, dash = -1;
};
inline constexpr int kGrey = 100;  ///< as PlotSeries::color: no colour of series

struct PlotAxis {
    std::string label;  ///< with its unit
    bool logarithmic = false;
};

struct Plot {
    std::string title;
    PlotAxis x, y;
    std::vector<PlotSeries> series;
};

/// A whole SVG document of 720x420 units, wider or higher where the legend asks for it, with no part outside of it. Axes span the points,
/// up to round numbers.
std::string plot_svg(const Plot& plot);

/// Where an axis has ticks, from the first at or below `least` to the last at or above `most`: multiples of 1, 2 or 5 times a power of ten,
/// at most some ten of them; of a logarithmic axis powers of ten, or 1, 2 and 5 times these where it spans few. A span of nothing is
/// widened.
std::vector<double> axis_ticks(double least, double most, bool logarithmic);

}  // namespace rawtexel::cli
