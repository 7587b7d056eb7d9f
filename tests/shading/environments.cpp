#include "tests/shading/environments.h"

#include "tests/reference/shading/environment.h"
#include "tests/shading/surfaces.h"

#include <algorithm>
#include <cmath>

namespace rawtexel::shading::test {

glm::dvec3 to_sharp_sun() { return glm::normalize(glm::dvec3(0.5, 0.6, -0.62)); }

Image sharp_sun(int width) {
    Image image(width, width / 2, 3);
    const glm::dvec3 sun = to_sharp_sun(), lamp = glm::normalize(glm::dvec3(-0.7, 0.1, 0.3));
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < width; ++x) {
            const glm::dvec3 d = reference::direction_of_latlong((x + 0.5) / width, (y + 0.5) / image.height);
            glm::dvec3 light = d.y > 0 ? glm::dvec3(0.2, 0.4, 1.0) * (1.0 - 0.7 * d.y) : glm::dvec3(0.05, 0.04, 0.03);
            if (glm::dot(d, lamp) > std::cos(glm::radians(6.0))) light = {2, 30, 5};
            if (glm::dot(d, sun) > std::cos(glm::radians(1.5))) light = {8000, 7000, 5000};
            for (int c = 0; c < 3; ++c) image.pixel(x, y)[c] = float(light[c]);
        }
    return image;
}

const Image& sky() {
    static const Image image = sky_latlong();
    return image;
}

const Environment& sky_environment() {
    static const Environment environment = [] {
        SerialExecutor executor;
        return Environment(sky(), executor);
    }();
    return environment;
}

void Errors::add(const glm::dvec3& found, const glm::dvec3& expected) {
    for (int c = 0; c < 3; ++c) {
        const double difference = found[c] - expected[c];
        worst_relative = std::max(worst_relative, std::fabs(difference) / expected[c]);
        squares += difference * difference;
        expected_squares += expected[c] * expected[c];
    }
}

double Errors::rms() const { return std::sqrt(squares / expected_squares); }

}  // namespace rawtexel::shading::test
