// Waves of surfaces for tests: random ones, and single ones spread over all lanes.
#pragma once

#include "shading/executor.h"
#include "shading/lighting.h"
#include "tests/reference/shading/brdf.h"

#include <random>

namespace rawtexel::shading::test {

/// One after the other on the calling thread.
class SerialExecutor : public Executor {
  public:
    int threads() const override { return 1; }
    void parallel_for(int64_t count, const std::function<void(int64_t, int)>& body) override {
        for (int64_t i = 0; i < count; ++i) body(i, 0);
    }
};

void set_lane(WaveVector& wave, int lane, const glm::dvec3& value);
glm::dvec3 lane_of(const WaveVector& wave, int lane);

/// A surface of any kind, seen from its front, position within 2 m of the origin.
reference::Surface random_surface(std::mt19937& random);
glm::dvec3 random_direction(std::mt19937& random);

/// Puts a surface at a lane; the geometric normal is the shading normal. Returns what the lane holds after rounding to float.
reference::Surface put_surface(const reference::Surface& surface, SurfaceWave& wave, int lane);
/// The same surface at every lane.
SurfaceWave wave_of(const reference::Surface& surface);
SurfaceWave random_wave(std::mt19937& random);

/// Shades one surface.
glm::dvec3 shaded(const Lighting& lighting, const reference::Surface& surface);

}  // namespace rawtexel::shading::test
