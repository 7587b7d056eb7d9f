// A path over uneven ground: three materials that meet by a mask of soft edges.
#include "scenes/builtin_assembly.h"
#include "scenes/builtin_makers.h"
#include "scenes/builtin_stones.h"
#include "scenes/procedural_masonry.h"
#include "scenes/procedural_noise.h"
#include "scenes/procedural_plants.h"
#include "scenes/shapes.h"

#include <glm/gtc/matrix_transform.hpp>

#include <cmath>

namespace rawtexel::scenes {
namespace {

constexpr float kSide = 48.0f;  // of the ground, metres

float path_center(float z) { return 1.6f * std::sin(0.28f * z + 0.6f) + 0.7f * std::sin(0.61f * z); }

float ground_height(glm::vec2 p) {
    const float away = smooth_step(1.0f, 9.0f, std::abs(p.x - path_center(p.y)));
    return 0.9f * away * (0.5f + fractal_noise(p / 11.0f, {64, 64}, 3, 700)) + 0.03f * gradient_noise(p * 1.3f, {256, 256}, 701);
}

/// Weights as red, green and blue: path, bare soil along it and meadow.
Surface mask() {
    Surface surface;
    surface.width = surface.height = 512;
    surface.extent = glm::vec2(kSide);
    surface.at = [](glm::vec2 p) {
        const glm::vec2 place = (p - 0.5f) * kSide;
        const float ragged = 0.7f * fractal_noise(place / 1.7f, {64, 64}, 4, 702);
        const float from_path = std::abs(place.x - path_center(place.y)) + ragged;
        const float path = smooth_step(1.6f, 1.0f, from_path), meadow = smooth_step(1.9f, 3.2f, from_path);
        const float bare = smooth_step(0.25f, 0.5f, fractal_noise(place / 5.0f, {64, 64}, 3, 703)) * (1.0f - path);
        SurfacePoint point;
        point.occlusion = path;
        point.roughness = (1.0f - path) * (1.0f - meadow) + bare * meadow;
        point.metallic = meadow * (1.0f - bare);
        return point;
    };
    return surface;
}

/// A material whose maps repeat every `extent` metres of a mesh whose coordinates are metres.
uint32_t layer(SceneAssembly& assembly, const std::string& name, Surface surface, float extent) {
    const uint32_t index = assembly.add_surface_material(name, std::move(surface));
    for (shading::TextureMap& map : assembly.material(index).maps) map.uv_from_vertex = {1.0f / extent, 0, 0, 1.0f / extent, 0, 0};
    return index;
}

uint32_t layered_material(SceneAssembly& assembly) {
    shading::Material ground;
    ground.name = "ground";
    shading::LayerBlend& layers = ground.layers.emplace();
    layers.materials = {layer(assembly, "cobbles", cobblestones(), 2.4f), layer(assembly, "soil", garden_soil(), 1.5f),
                        layer(assembly, "meadow", meadow_ground(), 4.0f)};
    // The map of occlusion, roughness and metalness has three channels of plain numbers.
    layers.mask = repeating_map(assembly.add_texture("ground mask", std::move(make_surface_maps(mask()).metallic_roughness)));
    layers.mask.sampler.wrap_s = layers.mask.sampler.wrap_t = texunit::Wrap::ClampToEdge;
    layers.mask.uv_from_vertex = {1.0f / kSide, 0, 0, 1.0f / kSide, 0.5f, 0.5f};
    return assembly.add_material(std::move(ground));
}

void add_ground(SceneAssembly& assembly) {
    shading::Mesh mesh;
    append_patch(mesh, 120, 120, [](float s, float t) {
        const glm::vec2 p((s - 0.5f) * kSide, (0.5f - t) * kSide);
        constexpr float kStep = 0.1f;
        const glm::vec3 normal(ground_height(p - glm::vec2(kStep, 0)) - ground_height(p + glm::vec2(kStep, 0)), 2.0f * kStep,
                               ground_height(p - glm::vec2(0, kStep)) - ground_height(p + glm::vec2(0, kStep)));
        return ShapePoint{.position = {p.x, ground_height(p), p.y}, .normal = normal, .along_u = {1, 0, 0}, .uv = p};
    });
    assembly.place(assembly.add_mesh("ground", layered_material(assembly), std::move(mesh)));
}

void add_boulders(SceneAssembly& assembly) {
    const uint32_t rock = assembly.add_surface_material("limestone", limestone());
    assembly.material(rock).triplanar = shading::Triplanar{0.5f, 4};
    for (int i = 0; i < 3; ++i) {
        const StoneStyle style{
            .half_extent = {0.75f, 0.45f + 0.1f * float(i), 0.6f}, .roundness = 2.6f, .wear = 0.5f, .seed = 720u + 10u * uint32_t(i)};
        const uint32_t mesh = assembly.add_mesh("boulder " + std::to_string(i), rock, make_stone(style));
        for (int k = 0; k < 4; ++k) {
            const float z = 6.0f - 5.5f * float(k) - 2.0f * float(i), side = (i + k) % 2 == 0 ? 1.0f : -1.0f;
            const glm::vec2 p(path_center(z) + side * (3.0f + 2.5f * lattice_float(i, k, 750)), z);
            const float size = 0.5f + 0.9f * lattice_float(i, k, 751);
            glm::mat4 m = glm::translate(glm::mat4(1.0f), {p.x, ground_height(p) + 0.15f * size, p.y});
            m = glm::rotate(m, 6.28f * lattice_float(i, k, 752), glm::vec3(0, 1, 0));
            assembly.place(mesh, glm::scale(m, glm::vec3(size)));
        }
    }
}

}  // namespace

shading::Scene make_layers(const texunit::TextureOptions& options) {
    SceneAssembly assembly("layers", options);
    assembly.turn_to_sun(-60.0f);
    add_ground(assembly);
    add_boulders(assembly);
    assembly.add_camera("path", {path_center(11.0f) + 0.4f, 2.2f, 11.0f}, {0.4f, 0.2f, 2.0f}, 48.0f);
    assembly.add_sky_and_sun();
    return assembly.take();
}

}  // namespace rawtexel::scenes
