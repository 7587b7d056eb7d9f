// Environments for tests, and how errors of light are gathered.
#pragma once

#include "shading/environment.h"
#include "shading/image.h"

namespace rawtexel::shading::test {

/// Noon: a small sun 20 000 times as bright as the sky, a green lamp, dark ground.
Image sharp_sun(int width);
glm::dvec3 to_sharp_sun();

/// The built-in sky, prefiltered when first asked for.
const Image& sky();
const Environment& sky_environment();

/// Differences between found and expected light, gathered over directions.
struct Errors {
    double worst_relative = 0.0, squares = 0.0, expected_squares = 0.0;

    void add(const glm::dvec3& found, const glm::dvec3& expected);
    double rms() const;  ///< relative to the root mean square of the light expected
};

}  // namespace rawtexel::shading::test
