#include "cli/view.h"

#include "cli/option_values.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

namespace rawtexel::cli {
namespace {

using shading::Bounds;
using shading::Camera;
using shading::Scene;

constexpr float kDefaultFov = 45.0f;  // degrees, of default_camera and orbit_camera

struct LookAt {
    glm::vec3 eye, target;
    float fov;  // degrees
};

std::string print_options(const LookAt& look) {
    return "--eye " + print_vector(look.eye) + " --target " + print_vector(look.target) + " --fov " + print_number(look.fov);
}

glm::vec3 eye_of(const Camera& camera) { return glm::vec3(camera.world_from_camera[3]); }
glm::vec3 forward_of(const Camera& camera) { return -glm::vec3(camera.world_from_camera[2]); }

size_t find_camera(const Scene& scene, const std::string& wanted) {
    std::vector<std::string> names;
    for (size_t i = 0; i < scene.cameras.size(); ++i) {
        if (scene.cameras[i].name == wanted) return i;
        names.push_back(scene.cameras[i].name.empty() ? std::to_string(i) : scene.cameras[i].name);
    }
    size_t index = 0;
    const auto [end, error] = std::from_chars(wanted.data(), wanted.data() + wanted.size(), index);
    if (error == std::errc() && end == wanted.data() + wanted.size() && index < scene.cameras.size()) return index;
    if (names.empty()) throw UsageError("--camera: the scene has no camera '" + wanted + "', it has none at all");
    throw unknown_value("--camera", wanted, names);
}

// Narrower half field of view, radians.
float narrow_half_fov(float vertical_degrees, float aspect) {
    const float half = glm::radians(vertical_degrees) * 0.5f;
    return std::min(half, std::atan(std::tan(half) * aspect));
}

// The just-fitting distance is radius / sin(half fov); default_camera and orbit_camera know it for 45 degrees.
float zoom_for_fov(float fov, float aspect) {
    return std::sin(narrow_half_fov(fov, aspect)) / std::sin(narrow_half_fov(kDefaultFov, aspect));
}

Camera orbiting_camera(const Bounds& bounds, const Orbit& orbit, float fov, float aspect) {
    const float zoom = fov == kDefaultFov ? orbit.zoom : orbit.zoom * zoom_for_fov(fov, aspect);
    Camera camera = shading::orbit_camera(bounds, aspect, orbit.yaw, orbit.pitch, zoom);
    camera.vertical_fov = glm::radians(fov);
    return camera;
}

LookAt framing_look(const Bounds& bounds, const ViewOptions& options, float aspect) {
    const float fov = options.fov.value_or(kDefaultFov);
    const glm::vec3 center = bounds.center();
    if (options.orbit) return {eye_of(orbiting_camera(bounds, *options.orbit, fov, aspect)), center, fov};
    const glm::vec3 eye = eye_of(shading::default_camera(bounds, aspect));
    return {fov == kDefaultFov ? eye : center + (eye - center) / zoom_for_fov(fov, aspect), center, fov};
}

// A target on the camera's axis, level with the scene's centre where that lies ahead.
LookAt look_of(const Camera& camera, const Bounds& bounds) {
    const glm::vec3 eye = eye_of(camera), forward = forward_of(camera);
    const float ahead = glm::dot(bounds.center() - eye, forward);
    const float fov = camera.type == Camera::Type::Perspective ? glm::degrees(camera.vertical_fov) : kDefaultFov;
    return {eye, eye + forward * (ahead > 0.0f ? ahead : 1.0f), fov};
}

// True when eye, target and field of view say all: perspective, and upright.
bool is_upright_perspective(const Camera& camera) {
    constexpr float kRollTolerance = 1e-4f;  // sine of the angle
    const float right_y = camera.world_from_camera[0].y, up_y = camera.world_from_camera[1].y;
    return camera.type == Camera::Type::Perspective && std::abs(right_y) < kRollTolerance && up_y > kRollTolerance;
}

View file_view(const Scene& scene, size_t index, const ViewOptions& options, const Bounds& bounds) {
    Camera camera = scene.cameras[index];
    if (options.fov) {
        camera.type = Camera::Type::Perspective;
        camera.vertical_fov = glm::radians(*options.fov);
    }
    const LookAt look = look_of(camera, bounds);
    if (is_upright_perspective(camera)) return {camera, look.target, index, print_options(look)};
    return {camera, look.target, index, "--camera " + std::to_string(index) + (options.fov ? " --fov " + print_number(*options.fov) : "")};
}

}  // namespace

View choose_view(const Scene& scene, const ViewOptions& options, float aspect) {
    const Bounds bounds = scene.bounds();
    std::optional<size_t> file_camera;
    if (options.camera)
        file_camera = find_camera(scene, *options.camera);
    else if (!options.orbit && !scene.cameras.empty())
        file_camera = 0;
    const bool moved = options.eye || options.target;
    if (file_camera && !moved) return file_view(scene, *file_camera, options, bounds);
    if (options.orbit && !moved) {
        // Past the poles the image's top is no longer up: only the orbit itself says so.
        const Camera camera = orbiting_camera(bounds, *options.orbit, options.fov.value_or(kDefaultFov), aspect);
        if (!is_upright_perspective(camera))
            return {camera, bounds.center(), std::nullopt,
                    "--orbit " + print(*options.orbit) + (options.fov ? " --fov " + print_number(*options.fov) : "")};
    }

    LookAt look = file_camera ? look_of(scene.cameras[*file_camera], bounds) : framing_look(bounds, options, aspect);
    if (options.eye) look = {*options.eye, bounds.center(), look.fov};
    if (options.target) look.target = *options.target;
    if (options.fov) look.fov = *options.fov;
    if (look.eye == look.target) throw UsageError("--eye and --target are the same point, " + print_vector(look.eye));
    return {shading::look_at_camera(bounds, look.eye, look.target, look.fov), look.target, std::nullopt, print_options(look)};
}

}  // namespace rawtexel::cli
