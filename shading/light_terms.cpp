#include "shading/light_terms.h"

#include <utility>

namespace rawtexel::shading {
namespace {

glm::vec3 shade_lane(const Lighting& lighting, const SurfaceWave& surface, int lane) {
    WaveVector radiance;
    shade_surface(lighting, surface, WaveMask(1) << lane, radiance);
    return {radiance.x[lane], radiance.y[lane], radiance.z[lane]};
}

std::string name_of(const Light& light, size_t place) { return light.name.empty() ? "light " + std::to_string(place) : light.name; }

}  // namespace

std::vector<LightTerm> light_terms(const Lighting& lighting, const SurfaceWave& surface, int lane) {
    // Each term is shaded alone: what is left out adds zeros, which change no bit of it.
    SurfaceWave dark = surface;
    dark.emission = {};
    Lighting nothing = lighting;
    nothing.lights.clear();
    nothing.ambient = 0.0f;
    nothing.environment = nullptr;
    nothing.shadow = nullptr;

    std::vector<LightTerm> terms;
    Lighting ambient = nothing;
    ambient.ambient = lighting.ambient;
    terms.push_back({"ambient", shade_lane(ambient, dark, lane)});
    terms.push_back({"emission", shade_lane(nothing, surface, lane)});

    // The shadow map is the first directional light's.
    std::shared_ptr<const ShadowMap> shadow = lighting.shadow;
    for (size_t i = 0; i < lighting.lights.size(); ++i) {
        Lighting alone = nothing;
        alone.lights = {lighting.lights[i]};
        if (alone.lights[0].type == Light::Type::Directional) alone.shadow = std::exchange(shadow, nullptr);
        terms.push_back({name_of(lighting.lights[i], i), shade_lane(alone, dark, lane)});
    }
    if (lighting.environment) {
        Lighting around = nothing;
        around.environment = lighting.environment;
        terms.push_back({"environment", shade_lane(around, dark, lane)});
    }
    return terms;
}

}  // namespace rawtexel::shading
