#include "scenes/gltf_lights.h"

#include "scenes/message_text.h"
#include "shading/camera_animation.h"

#include <cmath>
#include <optional>

namespace rawtexel::scenes {
namespace {

glm::dvec3 unit_or(const glm::dvec3& v, const glm::dvec3& otherwise) {
    const double length = glm::length(v);
    return length > 0.0 ? v / length : otherwise;
}

std::optional<shading::Light::Type> light_type(const std::string& name) {
    if (name == "directional") return shading::Light::Type::Directional;
    if (name == "point") return shading::Light::Type::Point;
    if (name == "spot") return shading::Light::Type::Spot;
    return std::nullopt;
}

}  // namespace

void check_lights(const GltfDocument& document) {
    for (size_t i = 0; i < document.model.lights.size(); ++i) {
        const tinygltf::Light& light = document.model.lights[i];
        const std::string what = "KHR_lights_punctual.lights[" + std::to_string(i) + "]";
        const auto type = light_type(light.type);
        if (!type) document.fail(what + ".type is \"" + shortened(light.type) + "\" (allowed: directional, point, spot)");
        const double inner = light.spot.innerConeAngle, outer = light.spot.outerConeAngle;
        if (type == shading::Light::Type::Spot && !(inner < outer))
            document.fail(what + ".spot has an inner cone of " + print_short(inner) + " and an outer cone of " + print_short(outer) +
                          " radians (the inner must be smaller)");
    }
}

shading::Light read_light(const GltfDocument& document, int index, const glm::dmat4& world) {
    const tinygltf::Light& source = document.model.lights[size_t(index)];
    shading::Light light;
    light.name = source.name.empty() ? "light " + std::to_string(index) : one_line(source.name);
    light.type = *light_type(source.type);
    if (!source.color.empty()) light.color = glm::vec3(source.color[0], source.color[1], source.color[2]);
    light.intensity = float(source.intensity);
    light.range = float(source.range);
    light.position = glm::vec3(world[3]);
    light.direction = glm::vec3(unit_or(-glm::dvec3(world[2]), {0.0, 0.0, -1.0}));
    light.inner_cone = float(source.spot.innerConeAngle);
    light.outer_cone = float(source.spot.outerConeAngle);
    return light;
}

shading::Camera read_camera(const GltfDocument& document, int index, const glm::dmat4& world) {
    const tinygltf::Camera& source = document.model.cameras[size_t(index)];
    const std::string what = "cameras[" + std::to_string(index) + "]";
    shading::Camera camera;
    camera.name = source.name.empty() ? "camera " + std::to_string(index) : one_line(source.name);
    camera.world_from_camera = shading::rigid_pose(world);
    const bool perspective = source.type == "perspective";
    const double znear = perspective ? source.perspective.znear : source.orthographic.znear;
    const double zfar = perspective ? source.perspective.zfar : source.orthographic.zfar;
    camera.znear = float(znear);
    camera.zfar = float(zfar);
    if (perspective) {
        camera.type = shading::Camera::Type::Perspective;
        camera.vertical_fov = float(source.perspective.yfov);
    } else {
        camera.type = shading::Camera::Type::Orthographic;
        camera.xmag = float(std::abs(source.orthographic.xmag));
        camera.ymag = float(std::abs(source.orthographic.ymag));
        if (!(camera.xmag > 0.0f && camera.ymag > 0.0f)) document.fail(what + " has a magnification of zero (allowed: above 0)");
    }
    const bool unlimited = perspective && camera.zfar == 0.0f;
    if (!unlimited && !(camera.zfar > camera.znear))
        document.fail(what + " has its far plane at " + print_short(zfar) + " (allowed: beyond the near plane at " + print_short(znear) +
                      ")");
    return camera;
}

}  // namespace rawtexel::scenes
