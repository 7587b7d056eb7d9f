#include "shading/tone_map.h"

#include <algorithm>
#include <cmath>

namespace rawtexel::shading {
namespace {

/// Brighter light than this saturates every curve; the bound keeps their squares finite.
constexpr float kBrightest = 1e9f;

float held(float value) { return value > 0.0f ? std::min(value, kBrightest) : 0.0f; }

float clamped(float value) { return std::min(std::max(value, 0.0f), 1.0f); }

/// Rational fit of the combined curve: (v (v + a) - b) / (v (c v + d) + e).
float aces_curve(float v) { return (v * (v + 0.0245786f) - 0.000090537f) / (v * (0.983729f * v + 0.4329510f) + 0.238081f); }

}  // namespace

glm::vec3 tone_map_aces(const glm::vec3& c) {
    // Rec. 709 to the fit's working space (sRGB, D65 to D60, AP1 and the red modifier's saturation in one matrix), rows written out.
    const glm::vec3 rrt(0.59719f * c.r + 0.35458f * c.g + 0.04823f * c.b, 0.07600f * c.r + 0.90834f * c.g + 0.01566f * c.b,
                        0.02840f * c.r + 0.13383f * c.g + 0.83777f * c.b);
    const glm::vec3 odt(aces_curve(rrt.r), aces_curve(rrt.g), aces_curve(rrt.b));
    return {1.60475f * odt.r - 0.53108f * odt.g - 0.07367f * odt.b, -0.10208f * odt.r + 1.10813f * odt.g - 0.00605f * odt.b,
            -0.00327f * odt.r - 0.07276f * odt.g + 1.07602f * odt.b};
}

glm::vec3 tone_map_reinhard(const glm::vec3& c) { return c / (1.0f + c); }

glm::vec3 tone_mapped(const glm::vec3& radiance, float exposure_factor, ToneMap tone_map) {
    glm::vec3 color = radiance;
    tone_map_pixels(&color.x, 1, 3, exposure_factor, tone_map);
    return color;
}

void tone_map_pixels(float* pixels, size_t count, int channels, float exposure_factor, ToneMap tone_map) {
    const auto map_with = [&](auto curve) {
        for (size_t i = 0; i < count; ++i) {
            float* p = pixels + i * size_t(channels);
            const glm::vec3 mapped =
                curve(glm::vec3(held(p[0] * exposure_factor), held(p[1] * exposure_factor), held(p[2] * exposure_factor)));
            p[0] = clamped(mapped.r);
            p[1] = clamped(mapped.g);
            p[2] = clamped(mapped.b);
        }
    };
    switch (tone_map) {
        case ToneMap::Aces: return map_with([](const glm::vec3& c) { return tone_map_aces(c); });
        case ToneMap::Reinhard: return map_with([](const glm::vec3& c) { return tone_map_reinhard(c); });
        case ToneMap::None: return map_with([](const glm::vec3& c) { return c; });
    }
}

}  // namespace rawtexel::shading
