// Whether the mean of many noisy frames is what it should be.
#pragma once

#include "shading/image.h"

#include <cstddef>
#include <cstdint>
#include <functional>

namespace rawtexel::shading::test {

/// The mean of frames against its expectation, value by value, in units of its own deviation.
struct Agreement {
    double chi_square = 0;
    double largest = 0;  ///< |z|, less what draws too rare to be met may lack
    size_t values = 0;
    double per_value() const { return chi_square / double(values); }
};

/// Of frame(seed), seed being 1..frames. Values that do not vary are to be as expected.
Agreement agreement_of(const Image& expected, uint32_t frames, const std::function<Image(uint32_t seed)>& frame);

/// |z| below 5.7, a family-wise 1e-6 of up to 80 000 values, and the mean of z^2 within its 1e-6 interval.
void expect_agreement(const Agreement& agreement, const char* what);

double largest_difference(const Image& a, const Image& b);

}  // namespace rawtexel::shading::test
