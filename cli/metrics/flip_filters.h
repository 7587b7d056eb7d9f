// FLIP's filters: the contrast sensitivity of the eye, and detectors of edges and points. All are separable or sums of two that are.
#pragma once

#include "cli/metrics/flip_colour.h"

#include <cstddef>
#include <span>
#include <vector>

namespace rawtexel::cli {

/// Weights of pixels -radius to radius along one axis.
using FlipKernel = std::vector<double>;

/// For one viewing distance.
class FlipKernels {
  public:
    explicit FlipKernels(double pixels_per_degree);
    /// The widest kernel's, pixels.
    int radius() const { return radius_; }

    FlipKernel y, cx, cz_narrow, cz_wide;  ///< of contrast sensitivity, each sums to 1
    double cz_narrow_share = 0;            ///< of the two that cz is the sum of
    FlipKernel smooth, edge, point;        ///< a Gaussian that sums to 1; its derivatives, positive and negative weights sum to 1 and -1

  private:
    int radius_ = 0;
};

/// One row of the image, filtered along both axes.
struct FilteredRow {
    std::vector<double> y, cx, cz, edge_x, edge_y, point_x, point_y;
};

/// Filters rows [first, last) of an image along x as they are added, and along y as they are asked for. Pixels beyond the image are those
/// at its border.
class FilteredRows {
  public:
    FilteredRows(const FlipKernels& kernels, int width, int height, int first, int last);
    /// `row` in YCxCz, `width` pixels.
    void add_row(int y, std::span<const Triple> row);
    /// Rows within the kernels' radius of `y` have been added, where there are such.
    FilteredRow row(int y) const;

  private:
    enum Plane { kY, kCx, kCzNarrow, kCzWide, kSmooth, kEdge, kPoint, kPlanes };
    double* plane_row(Plane plane, int y);
    const double* plane_row(Plane plane, int y) const { return const_cast<FilteredRows*>(this)->plane_row(plane, y); }
    std::vector<double> along_y(Plane plane, const FlipKernel& kernel, int y) const;

    const FlipKernels& kernels_;
    int width_, height_, first_, last_;
    std::vector<double> values_;  ///< plane by plane
};

}  // namespace rawtexel::cli
