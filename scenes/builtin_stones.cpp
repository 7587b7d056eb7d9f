#include "scenes/builtin_stones.h"

#include "scenes/procedural_noise.h"
#include "scenes/shapes.h"

#include <glm/gtc/constants.hpp>

#include <cmath>

namespace rawtexel::scenes {
namespace {

/// Noise in space as the mean of noises in three planes.
float spatial_noise(glm::vec3 p, uint32_t seed) {
    const glm::ivec2 period(1024);
    return (fractal_noise({p.x, p.y}, period, 4, seed) + fractal_noise({p.y, p.z}, period, 4, seed + 1) +
            fractal_noise({p.z, p.x}, period, 4, seed + 2)) /
           3.0f;
}

/// The stone's surface in direction `along`.
glm::vec3 surface_point(const StoneStyle& style, glm::vec3 along) {
    const glm::vec3 power = glm::pow(glm::abs(along), glm::vec3(style.roundness));
    const glm::vec3 smooth = along * std::pow(power.x + power.y + power.z, -1.0f / style.roundness) * style.half_extent;
    const float dent = spatial_noise(smooth * 1.1f + 300.0f, style.seed);
    return smooth + style.wear * dent * glm::normalize(along / style.half_extent);
}

glm::vec3 direction(float s, float t) {
    const float around = 2.0f * glm::pi<float>() * s, up = glm::pi<float>() * t;
    return {std::sin(up) * std::sin(around), -std::cos(up), std::sin(up) * std::cos(around)};
}

}  // namespace

shading::Mesh make_stone(const StoneStyle& style) {
    shading::Mesh mesh;
    append_patch(mesh, 96, 64, [&](float s, float t) {
        // The poles are points: there the surface is taken a little beside them.
        const float beside = glm::clamp(t, 0.004f, 0.996f);
        constexpr float kStep = 0.002f;
        const glm::vec3 right = surface_point(style, direction(s + kStep, beside)) - surface_point(style, direction(s - kStep, beside));
        const glm::vec3 up = surface_point(style, direction(s, beside + kStep)) - surface_point(style, direction(s, beside - kStep));
        return ShapePoint{.position = surface_point(style, direction(s, t)), .normal = glm::cross(right, up), .along_u = right};
    });
    mesh.uv[0].clear();
    return mesh;
}

}  // namespace rawtexel::scenes
