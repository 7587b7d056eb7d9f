// How far one image is from another.
#pragma once

#include <span>
#include <string_view>

namespace rawtexel::cli {

/// Over all pixels and the colour channels given. `test` and `reference` hold the same number of linear (or display) values.
struct ImageError {
    double mse = 0, rmse = 0;
    double rel_mse = 0;  ///< mean of (t-r)^2 / (r^2 + 0.01)
    double psnr = 0;     ///< dB for a peak of 1; infinite for equal images
    double max = 0;      ///< largest absolute difference
    double mean = 0;     ///< mean absolute difference
};

/// Sums in double, pairwise. Asserts equal sizes; non-finite values make every figure NaN.
ImageError image_error(std::span<const float> test, std::span<const float> reference);

}  // namespace rawtexel::cli
