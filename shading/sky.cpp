// The built-in sky: analytic, so that it needs no file.
#include "shading/environment.h"
#include "shading/latlong_tree.h"

#include <algorithm>
#include <cmath>

namespace rawtexel::shading {
namespace {

/// Towards the sun: 38 degrees up, to the left of a camera that looks along (-1, 0, -1).
const glm::vec3 kToSun = glm::normalize(glm::vec3(-0.40f, 0.72f, 0.82f));

const glm::vec3 kZenith(0.15f, 0.40f, 1.10f);       // deep blue overhead
const glm::vec3 kHorizon(1.00f, 1.22f, 1.45f);      // pale haze
const glm::vec3 kWarmHorizon(1.75f, 1.38f, 1.00f);  // the same below the sun
const glm::vec3 kGround(0.30f, 0.25f, 0.18f);       // dry earth, lit by all this
const glm::vec3 kGlow(1.00f, 0.86f, 0.64f);

float smooth_step(float low, float high, float x) {
    const float t = std::clamp((x - low) / (high - low), 0.0f, 1.0f);
    return t * t * (3.0f - 2.0f * t);
}

/// Light that haze scatters forward, about 1 at the sun: Henyey and Greenstein's lobe with mean cosine g.
float forward_scatter(float cosine, float g) {
    const float near = (1.0f - g) * (1.0f - g), spread = 1.0f + g * g - 2.0f * g * cosine;
    const float ratio = near / spread;
    return ratio * std::sqrt(ratio);
}

glm::vec3 sky_radiance(const glm::vec3& direction) {
    const float cosine = glm::dot(direction, kToSun);
    const float up = std::max(direction.y, 0.0f);

    // Air thins with height: the haze falls off fast above the horizon, warmer towards the sun.
    const float haze = std::exp(-6.0f * up);
    const float sunward = 0.5f + 0.5f * cosine;
    const glm::vec3 horizon = glm::mix(kHorizon, kWarmHorizon, sunward * sunward * sunward);
    glm::vec3 sky = glm::mix(kZenith, horizon, haze);
    sky += kGlow * (0.45f * forward_scatter(cosine, 0.60f) + 2.2f * forward_scatter(cosine, 0.90f));

    // The ground fades into haze at the horizon.
    const glm::vec3 ground = glm::mix(kGround, horizon * 0.7f, 0.6f * std::exp(20.0f * std::min(direction.y, 0.0f)));
    return glm::mix(ground, sky, smooth_step(-0.035f, 0.025f, direction.y));
}

}  // namespace

Image sky_latlong(int width, int height) {
    Image image(width, height, 3);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const glm::vec3 radiance = sky_radiance(glm::vec3(latlong_direction((x + 0.5) / width, (y + 0.5) / height)));
            for (int c = 0; c < 3; ++c) image.pixel(x, y)[c] = radiance[c];
        }
    return image;
}

Sun sky_sun() { return {-kToSun, glm::vec3(1.0f, 0.93f, 0.82f), 5.0f}; }

}  // namespace rawtexel::shading
