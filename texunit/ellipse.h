// The exact elliptical filter's geometry: the Gaussian of one pixel on a level, its rows and its wrapped texels. One pixel at a time, in
// double; texunit/elliptical-inl.h weighs and fetches the texels it lists.
#pragma once

#include "texunit/level_table.h"
#include "texunit/sampler.h"

#include <array>
#include <cstdint>

namespace rawtexel::texunit {

/// The Gaussian is cut where d^T C^-1 d exceeds the square of this; 4e-6 of it lies beyond.
inline constexpr double kEllipseReach = 5;
/// Footprints that need more texels read the finest level at which they do not.
inline constexpr int64_t kMostEllipseTexels = int64_t{1} << 18;
inline constexpr int kMostEllipseNodes = 8;

/// Gauss-Legendre nodes and weights on [0, 1].
struct Quadrature {
    int count;
    std::array<double, kMostEllipseNodes> node, weight;
};

/// A Gaussian over the texels of one level, to be integrated over their boxes: covariance [a b; b c] texels^2. Over level 0 it is
/// S2*J*J^T + I/12, and the box adds the other I/12. A coarser level l of a large footprint has filtered by boxes itself, so the covariance
/// loses (2*4^l - 3)/12 texels^2 of level 0, as far as a standard deviation of sqrt(1/12) texels of the level remains along the minor axis.
struct Ellipse {
    int level = 0;
    int64_t column = 0, row = 0;  ///< texel that holds the centre, not wrapped
    double x = 0, y = 0;          ///< centre within that texel, [0, 1)
    double a = 1.0 / 12, b = 0, c = 1.0 / 12;
    double determinant = 1.0 / 144;      ///< a*c - b*b, from the eigenvalues: thin ellipses would cancel it away
    double slope = 0;                    ///< b/c: how far the rows' centres move per texel
    double inverse_sigma = 0;            ///< of x within a row
    int first_row = 0, last_row = 0;     ///< from `row`
    const Quadrature* across = nullptr;  ///< for the integral over a row's height
};

/// One lookup, derivatives as in WaveCoordinates.
struct EllipseLookup {
    float u, v, dudx, dvdx, dudy, dvdy;
};

/// S2 is sampler.ellipse; sampler.min_lod picks a coarser level than 0 if it is at least 1. A derivative that is not finite gives the last
/// level. At most some 1.1*kMostEllipseTexels texels and always at least one.
Ellipse make_ellipse(const LevelTable& table, const SamplerState& sampler, const EllipseLookup& at);

/// The coarsest level that leaves room for the minor axis of S2*J*J^T + I/6, as a real number >= 0: there the covariance that make_ellipse
/// leaves along that axis is the variance of the level's own texel box. Infinite where a derivative is not finite.
double roomy_level(const LevelTable& table, const SamplerState& sampler, const EllipseLookup& at);

/// Columns of `row` that the cut ellipse touches, all counted from the centre's texel; last < first where there are none.
struct EllipseSpan {
    int first, last;
};
EllipseSpan ellipse_span(const Ellipse& ellipse, int row);

/// Walks along texel indices that wrap, without a division a step.
class WrapWalk {
  public:
    WrapWalk(Wrap wrap, int64_t index, int extent);
    /// The texel, 0 <= texel < extent, or -1 for the border.
    int texel() const;
    void next();

  private:
    Wrap wrap_;
    int64_t place_;  ///< in [0, period) where the wrap has a period
    int extent_, period_;
};

}  // namespace rawtexel::texunit
