#include "tests/shading/surfaces.h"

#include <cmath>
#include <numbers>

namespace rawtexel::shading::test {
namespace {

double uniform(std::mt19937& random, double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); }

}  // namespace

void set_lane(WaveVector& wave, int lane, const glm::dvec3& value) {
    wave.x[lane] = float(value.x);
    wave.y[lane] = float(value.y);
    wave.z[lane] = float(value.z);
}

glm::dvec3 lane_of(const WaveVector& wave, int lane) { return {wave.x[lane], wave.y[lane], wave.z[lane]}; }

glm::dvec3 random_direction(std::mt19937& random) {
    const double z = uniform(random, -1.0, 1.0), azimuth = uniform(random, 0.0, 2.0 * std::numbers::pi), radius = std::sqrt(1.0 - z * z);
    return {radius * std::cos(azimuth), z, radius * std::sin(azimuth)};
}

reference::Surface random_surface(std::mt19937& random) {
    reference::Surface s;
    s.base = {uniform(random, 0, 1), uniform(random, 0, 1), uniform(random, 0, 1)};
    s.metallic = std::min(std::max(uniform(random, -0.5, 1.5), 0.0), 1.0);
    s.roughness = uniform(random, 0, 1);
    s.occlusion = uniform(random, 0, 1);
    s.emission = glm::dvec3(uniform(random, 0, 0.1));
    s.position = random_direction(random) * uniform(random, 0, 2);
    s.normal = random_direction(random);
    do {
        s.view = random_direction(random);
    } while (glm::dot(s.normal, s.view) < 0.01);
    return s;
}

reference::Surface put_surface(const reference::Surface& s, SurfaceWave& wave, int lane) {
    set_lane(wave.base_color, lane, s.base);
    wave.metallic[lane] = float(s.metallic);
    wave.roughness[lane] = float(s.roughness);
    wave.occlusion[lane] = float(s.occlusion);
    set_lane(wave.emission, lane, s.emission);
    set_lane(wave.position, lane, s.position);
    set_lane(wave.normal, lane, s.normal);
    set_lane(wave.geometric_normal, lane, s.normal);
    set_lane(wave.view, lane, s.view);
    reference::Surface held;
    held.base = lane_of(wave.base_color, lane);
    held.metallic = wave.metallic[lane];
    held.roughness = wave.roughness[lane];
    held.occlusion = wave.occlusion[lane];
    held.emission = lane_of(wave.emission, lane);
    held.position = lane_of(wave.position, lane);
    held.normal = lane_of(wave.normal, lane);
    held.view = lane_of(wave.view, lane);
    return held;
}

SurfaceWave wave_of(const reference::Surface& surface) {
    SurfaceWave wave;
    for (int lane = 0; lane < texunit::kWaveLanes; ++lane) put_surface(surface, wave, lane);
    return wave;
}

SurfaceWave random_wave(std::mt19937& random) {
    SurfaceWave wave;
    for (int lane = 0; lane < texunit::kWaveLanes; ++lane) put_surface(random_surface(random), wave, lane);
    return wave;
}

glm::dvec3 shaded(const Lighting& lighting, const reference::Surface& surface) {
    WaveVector radiance;
    shade_surface(lighting, wave_of(surface), texunit::kWaveFull, radiance);
    return lane_of(radiance, 0);
}

}  // namespace rawtexel::shading::test
