#include "tests/reference/cli/image_error_reference.h"

#include <cmath>
#include <limits>

namespace rawtexel::reference {

cli::ImageError image_error(std::span<const float> test, std::span<const float> reference) {
    long double squares = 0, relative = 0, absolute = 0, largest = 0;
    for (size_t i = 0; i < test.size(); ++i) {
        const long double r = reference[i], d = static_cast<long double>(test[i]) - r;
        squares += d * d;
        relative += d * d / (r * r + 0.01L);
        absolute += std::fabs(d);
        largest = std::fmax(largest, std::fabs(d));
    }
    const long double n = static_cast<long double>(test.size()), mse = squares / n;
    cli::ImageError error;
    error.mse = double(mse);
    error.rmse = double(std::sqrt(mse));
    error.rel_mse = double(relative / n);
    error.psnr = mse > 0 ? double(-10.0L * std::log10(mse)) : std::numeric_limits<double>::infinity();
    error.max = double(largest);
    error.mean = double(absolute / n);
    return error;
}

}  // namespace rawtexel::reference
