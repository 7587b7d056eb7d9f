#include "shading/shadow_map.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace rawtexel::shading {
namespace {

/// Texels around the sphere that the filter of a point on its rim may read.
constexpr float kMargin = 3.0f;

/// The world axis farthest from `direction`: what "up" means in the map.
glm::vec3 up_axis(const glm::vec3& direction) {
    const glm::vec3 a = glm::abs(direction);
    if (a.y <= a.x && a.y <= a.z) return {0, 1, 0};
    return a.x <= a.z ? glm::vec3(1, 0, 0) : glm::vec3(0, 0, 1);
}

/// Integral of a tent of total weight 1 and radius 1.5 from minus infinity to `edge`.
float tent_integral(float edge) {
    const float rest = 1.5f - std::fabs(edge);
    const float tail = rest * rest * (1.0f / 4.5f);
    return edge > 0.0f ? 1.0f - tail : tail;
}

/// Weights of the four texels that begin `first` texels from the point (-2.5 < first <= -1.5).
void tent_weights(float first, float weights[4]) {
    float below = 0.0f;
    for (int k = 0; k < 3; ++k) {
        const float integral = tent_integral(first + float(k + 1));
        weights[k] = integral - below;
        below = integral;
    }
    weights[3] = 1.0f - below;
}

float row_dot(const glm::mat4& m, int row, const glm::vec3& v) { return (m[0][row] * v.x + m[1][row] * v.y) + m[2][row] * v.z; }

}  // namespace

ShadowMap make_shadow_frame(const glm::vec3& direction, const glm::vec3& center, float radius, int size) {
    assert(size > 2 * int(kMargin));
    ShadowMap map;
    map.size = size;
    map.depth.assign(size_t(size) * size_t(size), 0.0f);
    const double held = std::max(double(radius), 1e-6) * 1.0001;
    const double texel = 2.0 * held / (double(size) - 2.0 * kMargin);
    map.texel_world = float(texel);
    map.depth_world = float(2.0 * held);

    // Axes of the map in the world: x right, y down, z towards the light.
    const glm::dvec3 to_light = -glm::normalize(glm::dvec3(direction));
    const glm::dvec3 right = glm::normalize(glm::cross(glm::dvec3(up_axis(direction)), to_light));
    const glm::dvec3 down = -glm::cross(to_light, right);
    const auto set_row = [&](int row, const glm::dvec3& axis, double factor, double at_center) {
        for (int k = 0; k < 3; ++k) map.map_from_world[k][row] = float(axis[k] * factor);
        map.map_from_world[3][row] = float(at_center - glm::dot(axis, glm::dvec3(center)) * factor);
    };
    set_row(0, right, 1.0 / texel, 0.5 * size);
    set_row(1, down, 1.0 / texel, 0.5 * size);
    set_row(2, to_light, 0.5 / held, 0.5);
    return map;
}

float shadow_visibility(const ShadowMap& map, const glm::vec3& position, const glm::vec3& normal) {
    const glm::mat4& m = map.map_from_world;
    const float cosine = row_dot(m, 2, normal) * map.depth_world;
    if (!(cosine > 0.0f)) return 0.0f;

    // The point in the map, the first of its 4x4 texels and their weights.
    const float x = row_dot(m, 0, position) + m[3][0], y = row_dot(m, 1, position) + m[3][1], z = row_dot(m, 2, position) + m[3][2];
    const float limit = float(map.size) + 8.0f;
    const float column = std::floor(std::min(std::max(x, -8.0f), limit) - 1.5f),
                row = std::floor(std::min(std::max(y, -8.0f), limit) - 1.5f);
    float weight_x[4], weight_y[4];
    tent_weights(column - x, weight_x);
    tent_weights(row - y, weight_y);

    // The surface's plane as depth over the map, and how much nearer a caster must be.
    const float steep = std::max(cosine, kShadowMinCosine);
    const float slope = map.texel_world * map.texel_world / (steep * map.depth_world);
    const float dz_dx = -(row_dot(m, 0, normal) * slope), dz_dy = -(row_dot(m, 1, normal) * slope);
    const float tangent = std::sqrt(std::max(1.0f - steep * steep, 0.0f)) / steep;
    const float bias = (tangent * kShadowSlopeBias + kShadowConstantBias) * (map.texel_world / map.depth_world) + kShadowDepthRounding;

    float hidden = 0.0f;
    for (int j = 0; j < 4; ++j) {
        const float tap_y = row + float(j), plane_y = (z + bias) + ((tap_y + 0.5f) - y) * dz_dy;
        for (int i = 0; i < 4; ++i) {
            const float tap_x = column + float(i), plane = plane_y + ((tap_x + 0.5f) - x) * dz_dx;
            if (!(tap_x >= 0.0f && tap_x < float(map.size) && tap_y >= 0.0f && tap_y < float(map.size))) continue;
            const float stored = map.depth[size_t(tap_y) * size_t(map.size) + size_t(tap_x)];
            if (stored > std::max(plane, 0.0f)) hidden += weight_x[i] * weight_y[j];
        }
    }
    return std::max(1.0f - hidden, 0.0f);  // the weights add up to 1 within rounding
}

}  // namespace rawtexel::shading
