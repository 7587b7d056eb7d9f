#include "cli/illumination.h"

#include "scenes/image_io.h"
#include "shading/render.h"

#include <algorithm>
#include <cmath>

namespace rawtexel::cli {
namespace {

using shading::EnvironmentRequest;
using shading::Light;
using shading::Scene;

Light directional(std::string name, const glm::vec3& direction, float intensity, const glm::vec3& color = glm::vec3(1.0f)) {
    Light light;
    light.name = std::move(name);
    light.type = Light::Type::Directional;
    // Scaled first: the square of a large component would overflow, that of a small one vanish.
    const float largest = std::max({std::abs(direction.x), std::abs(direction.y), std::abs(direction.z)});
    light.direction = glm::normalize(direction / largest);
    light.intensity = intensity;
    light.color = color;
    return light;
}

std::vector<Light> choose_lights(const Scene& scene, const LightOptions& options) {
    if (options.light) return {directional("--light", options.light->direction, options.light->intensity)};
    if (!options.peer_shading) return scene.lights;
    // Viewers with one light take the file's first directional one.
    const auto sun = std::ranges::find(scene.lights, Light::Type::Directional, &Light::type);
    if (sun != scene.lights.end()) return {*sun};
    return {directional("peer", {-0.4f, -1.0f, -0.3f}, 3.0f)};
}

EnvironmentOption choose_environment(const Scene& scene, const LightOptions& options) {
    if (options.environment) return *options.environment;
    if (scene.environment == EnvironmentRequest::None) return {EnvironmentKind::None, {}};
    const bool sky = scene.environment == EnvironmentRequest::Sky || scene.lights.empty();
    return {sky ? EnvironmentKind::Sky : EnvironmentKind::None, {}};
}

std::shared_ptr<const shading::Environment> load_environment(const EnvironmentOption& choice, shading::Executor& executor) {
    switch (choice.kind) {
        case EnvironmentKind::None: return nullptr;
        case EnvironmentKind::Sky: return std::make_shared<shading::Environment>(shading::sky_latlong(), executor);
        case EnvironmentKind::File:
            return std::make_shared<shading::Environment>(scenes::read_image(choice.file, /*srgb_integers=*/true), executor);
    }
    return nullptr;
}

}  // namespace

shading::Lighting make_lighting(const Scene& scene, const LightOptions& options, shading::Executor& executor) {
    std::vector<Light> lights = choose_lights(scene, options);
    const EnvironmentOption environment = choose_environment(scene, options);
    if (environment.kind == EnvironmentKind::Sky && lights.empty()) {
        const shading::Sun sun = shading::sky_sun();
        lights.push_back(directional("sun", sun.direction, sun.intensity, sun.color));
    }
    shading::Lighting lighting =
        shading::resolve_lighting(scene, std::move(lights), options.ambient.value_or(0.0f), load_environment(environment, executor),
                                  options.shadows.value_or(true), executor);
    lighting.reflections = options.reflections;
    return lighting;
}

}  // namespace rawtexel::cli
