#include "tests/shading/agreement.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

namespace rawtexel::shading::test {

Agreement agreement_of(const Image& expected, uint32_t frames, const std::function<Image(uint32_t seed)>& frame) {
    const size_t size = expected.values.size();
    std::vector<double> sum(size), squares(size);
    double range = 0;
    for (uint32_t seed = 1; seed <= frames; ++seed) {
        const Image drawn = frame(seed);
        for (size_t i = 0; i < size; ++i) {
            const double value = double(drawn.values[i]);
            sum[i] += value, squares[i] += value * value;
            range = std::max(range, std::abs(value));
        }
    }
    Agreement agreement;
    // What a texel too rare to be drawn may lack: its share is below log(2*values/1e-6)/frames (Bernstein's inequality, the term of the
    // range).
    const double unseen = range * std::log(2e6 * double(size)) / (3.0 * frames);
    for (size_t i = 0; i < size; ++i) {
        const double mean = sum[i] / frames, variance = std::max(squares[i] / frames - mean * mean, 0.0) / (frames - 1);
        const double difference = mean - double(expected.values[i]);
        if (variance < 1e-14) {
            EXPECT_NEAR(difference, 0, 1e-5);
            continue;
        }
        const double deviation = std::sqrt(variance);
        agreement.chi_square += difference * difference / variance;
        agreement.largest = std::max(agreement.largest, std::max(std::abs(difference) - unseen, 0.0) / deviation);
        ++agreement.values;
    }
    return agreement;
}

void expect_agreement(const Agreement& agreement, const char* what) {
    std::printf("%s: %zu values, chi^2/dof %.3f, largest |z| %.2f\n", what, agreement.values, agreement.per_value(), agreement.largest);
    EXPECT_GT(agreement.values, 0u) << what << " does not vary";
    EXPECT_LT(agreement.largest, 5.7) << what;
    // Three channels of a pixel come from the same draws: a third of the values is independent.
    EXPECT_NEAR(agreement.per_value(), 1, 4.9 * std::sqrt(2.0 / (double(agreement.values) / 3)) + 0.02) << what;
}

double largest_difference(const Image& a, const Image& b) {
    double largest = 0;
    for (size_t i = 0; i < a.values.size(); ++i) largest = std::max(largest, double(std::abs(a.values[i] - b.values[i])));
    return largest;
}

}  // namespace rawtexel::shading::test
