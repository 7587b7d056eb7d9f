// Sums of many families of colours, each of which may take any of its colours by itself: judged by how far they reach in each of 80
// directions. The sum of the families reaches as far as they reach together.
#pragma once

#include "texunit/colour_search.h"

#include <array>
#include <span>

namespace rawtexel::texunit {

/// Directions: every vector of -1, 0 and 1 but the zero vector.
inline constexpr size_t kHullDirections = 80;

class ColourHull {
  public:
    /// Adds any one colour of `patches`, weighed.
    void add(double weight, std::span<const ColourPatch> patches);

    /// Of `colour` from mixes of `finer` with a share of `coarser` within `share`: the least, over shares, of the largest distance beyond
    /// what is reached, in `threshold`s of a channel. At most 1: within.
    static double excess(const ColourHull& finer, const ColourHull& coarser, Range share, const Colour& colour, double threshold);

    /// Bounds of each channel by itself.
    Colour least() const;
    Colour most() const;

  private:
    std::array<double, kHullDirections> reach_{};
};

}  // namespace rawtexel::texunit
