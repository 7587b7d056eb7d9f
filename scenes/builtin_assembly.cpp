#include "scenes/builtin_assembly.h"

#include "scenes/shapes.h"
#include "scenes/tangents.h"

#include "shading/environment.h"

#include <glm/gtc/matrix_transform.hpp>

#include <cmath>
#include <utility>

namespace rawtexel::scenes {
namespace {

/// A rigid frame with the z axis and, as nearly as that allows, the y axis of `frame`, such that making it rigid once more in double
/// precision gives the same bits.
glm::mat4 settled_frame(glm::mat4 frame) {
    for (int i = 0; i < 8; ++i) {
        const glm::dvec3 back(frame[2]), up(frame[1]);
        const glm::dvec3 z = back / glm::length(back), across = glm::cross(up, z), x = across / glm::length(across);
        const glm::mat4 next(glm::dmat4(glm::dvec4(x, 0), glm::dvec4(glm::cross(z, x), 0), glm::dvec4(z, 0), glm::dvec4(frame[3])));
        if (next == frame) break;
        frame = next;
    }
    return frame;
}

}  // namespace

SceneAssembly::SceneAssembly(std::string name, texunit::TextureOptions options) : options_(options) { scene_.name = std::move(name); }

int SceneAssembly::add_texture(std::string name, std::unique_ptr<texunit::TexelSource> source) {
    const bool srgb = texunit::info(source->format()).srgb;
    auto texture = std::make_shared<texunit::Texture>(name, std::move(source), options_);
    scene_.textures.push_back(
        {.texture = std::move(texture), .image_name = std::move(name), .mime_type = "image/png", .srgb = srgb, .encoded = nullptr});
    return int(scene_.textures.size()) - 1;
}

uint32_t SceneAssembly::add_surface_material(const std::string& name, Surface surface) {
    SurfaceMaps maps = make_surface_maps(std::move(surface));
    const uint32_t material = add_finish_material(name, maps);
    scene_.materials[material].maps[shading::kNormal] = repeating_map(add_texture(name + " normal", std::move(maps.normal)));
    return material;
}

uint32_t SceneAssembly::add_flat_material(const std::string& name, Surface surface) {
    SurfaceMaps maps = make_surface_maps(std::move(surface));
    return add_finish_material(name, maps);
}

uint32_t SceneAssembly::add_finish_material(const std::string& name, SurfaceMaps& maps) {
    shading::Material material;
    material.name = name;
    material.maps[shading::kBaseColor] = repeating_map(add_texture(name + " color", std::move(maps.base_color)));
    const int finish = add_texture(name + " finish", std::move(maps.metallic_roughness));
    material.maps[shading::kMetallicRoughness] = repeating_map(finish);
    material.maps[shading::kOcclusion] = repeating_map(finish);
    return add_material(std::move(material));
}

uint32_t SceneAssembly::add_color_material(const std::string& name, Surface surface, float roughness) {
    shading::Material material;
    material.name = name;
    material.metallic = 0.0f;
    material.roughness = roughness;
    material.maps[shading::kBaseColor] = repeating_map(add_texture(name + " color", make_color_map(std::move(surface))));
    return add_material(std::move(material));
}

uint32_t SceneAssembly::add_material(shading::Material material) {
    scene_.materials.push_back(std::move(material));
    return uint32_t(scene_.materials.size() - 1);
}

uint32_t SceneAssembly::add_mesh(std::string name, uint32_t material, shading::Mesh mesh) {
    mesh.name = std::move(name);
    mesh.material = material;
    if (!map_with_tangents(scene_.materials, material)) {
        mesh.tangents.clear();
    }
    drop_unused_points(mesh);
    scene_.meshes.push_back(std::move(mesh));
    return uint32_t(scene_.meshes.size() - 1);
}

void SceneAssembly::place(uint32_t mesh, const glm::mat4& world_from_object) {
    scene_.instances.push_back({mesh, world_from_design_ * world_from_object});
}

void SceneAssembly::turn_to_sun(float azimuth) {
    const glm::vec3 to_sun = -shading::sky_sun().direction;
    const float turn = std::atan2(to_sun.x, to_sun.z) - glm::radians(azimuth);
    world_from_design_ = glm::rotate(glm::mat4(1.0f), turn, glm::vec3(0, 1, 0));
}

void SceneAssembly::add_camera(shading::Camera camera) {
    camera.world_from_camera = settled_frame(world_from_design_ * camera.world_from_camera);
    scene_.cameras.push_back(std::move(camera));
}

void SceneAssembly::add_light(shading::Light light) {
    light.position = glm::vec3(world_from_design_ * glm::vec4(light.position, 1.0f));
    light.direction = settled_unit(glm::vec3(world_from_design_ * glm::vec4(light.direction, 0.0f)));
    scene_.lights.push_back(std::move(light));
}

void SceneAssembly::add_camera(const std::string& name, glm::vec3 eye, glm::vec3 target, float vertical_fov) {
    shading::Camera camera;
    camera.name = name;
    camera.world_from_camera = looking_at(eye, target);
    camera.vertical_fov = glm::radians(vertical_fov);
    camera.znear = 0.05f;
    add_camera(std::move(camera));
}

void SceneAssembly::add_sky_and_sun() {
    const shading::Sun sun = shading::sky_sun();
    shading::Light light;
    light.name = "sun";
    light.color = sun.color;
    light.intensity = sun.intensity;
    light.direction = settled_unit(sun.direction);  // the world's, however the scene is turned
    scene_.lights.push_back(std::move(light));
    set_environment(shading::EnvironmentRequest::Sky);
}

shading::TextureMap repeating_map(int texture) {
    shading::TextureMap map;
    map.texture = texture;
    return map;
}

glm::mat4 looking_at(glm::vec3 eye, glm::vec3 target) {
    const glm::vec3 backward = glm::normalize(eye - target);
    const glm::vec3 right = glm::normalize(glm::cross(glm::vec3(0, 1, 0), backward));
    return {glm::vec4(right, 0), glm::vec4(glm::cross(backward, right), 0), glm::vec4(backward, 0), glm::vec4(eye, 1)};
}

glm::vec3 linear_color(glm::vec3 srgb) {
    // IEC 61966-2-1
    const auto channel = [](float c) { return c <= 0.04045f ? c / 12.92f : std::pow((c + 0.055f) / 1.055f, 2.4f); };
    return {channel(srgb.r), channel(srgb.g), channel(srgb.b)};
}

glm::vec3 hex(uint32_t rgb) { return glm::vec3(float(rgb >> 16 & 255u), float(rgb >> 8 & 255u), float(rgb & 255u)) / 255.0f; }

}  // namespace rawtexel::scenes
