#include "scene_parts.h"

#include "shading/camera.h"
#include "texunit/memory_source.h"
#include "texunit/random.h"

#include <cmath>
#include <cstring>
#include <numbers>

namespace rawtexel::shading::test {

SceneTexture make_texture(int width, int height, const std::function<glm::vec4(int, int)>& color) {
    std::vector<std::byte> texels(size_t(width) * size_t(height) * sizeof(glm::vec4));
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const glm::vec4 value = color(x, y);
            std::memcpy(&texels[(size_t(y) * size_t(width) + size_t(x)) * sizeof value], &value, sizeof value);
        }
    }
    auto source = texunit::make_memory_source(texunit::Format::RGBA32Float, width, height, std::move(texels));
    SceneTexture texture;
    texture.texture = std::make_shared<texunit::Texture>("generated", std::move(source));
    return texture;
}

SceneTexture make_noise_texture(int width, int height, uint32_t seed) {
    return make_texture(width, height, [seed](int x, int y) {
        const auto number = [&](uint32_t channel) {
            return texunit::random_float({.x = uint32_t(x), .y = uint32_t(y), .sample = channel, .seed = seed});
        };
        return glm::vec4(number(0), number(1), number(2), number(3));
    });
}

Mesh make_quad(const glm::vec3& p, const glm::vec3& right, const glm::vec3& up, const glm::vec2& uv) {
    Mesh mesh;
    mesh.positions = {p, p + right, p + right + up, p + up};
    mesh.uv[0] = {{0.0f, uv.y}, {uv.x, uv.y}, {uv.x, 0.0f}, {0.0f, 0.0f}};
    mesh.indices = {0, 1, 2, 0, 2, 3};
    return mesh;
}

Mesh make_sphere(int columns, int rows) {
    constexpr float kPi = std::numbers::pi_v<float>;
    Mesh mesh;
    for (int row = 0; row <= rows; ++row) {
        for (int column = 0; column <= columns; ++column) {
            const float u = float(column) / float(columns), v = float(row) / float(rows);
            const glm::vec3 p(std::sin(kPi * v) * std::sin(2.0f * kPi * u), std::cos(kPi * v),
                              std::sin(kPi * v) * std::cos(2.0f * kPi * u));
            mesh.positions.push_back(p);
            mesh.normals.push_back(p);
            mesh.uv[0].push_back({u, v});
        }
    }
    const auto vertex = [&](int column, int row) { return uint32_t(row * (columns + 1) + column); };
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            for (const uint32_t index : {vertex(column, row), vertex(column, row + 1), vertex(column + 1, row + 1), vertex(column, row),
                                         vertex(column + 1, row + 1), vertex(column + 1, row)})
                mesh.indices.push_back(index);
        }
    }
    return mesh;
}

uint32_t add_object(Scene& scene, Mesh mesh, const Material& material, const glm::mat4& world_from_object) {
    mesh.material = uint32_t(scene.materials.size());
    scene.materials.push_back(material);
    scene.instances.push_back({uint32_t(scene.meshes.size()), world_from_object});
    scene.meshes.push_back(std::move(mesh));
    return uint32_t(scene.instances.size() - 1);
}

Material unlit(const glm::vec4& color, AlphaMode mode) {
    Material material;
    material.base_color = color;
    material.alpha_mode = mode;
    material.unlit = true;
    return material;
}

Camera square_camera() {
    Camera camera;
    camera.type = Camera::Type::Orthographic;
    camera.world_from_camera[3] = glm::vec4(0.0f, 0.0f, 11.0f, 1.0f);
    camera.znear = 1.0f;
    camera.zfar = 21.0f;
    return camera;
}

namespace {

glm::mat4 placed(const glm::vec3& position, const glm::vec3& scale) {
    glm::mat4 m(1.0f);
    for (int i = 0; i < 3; ++i) m[i][i] = scale[i];
    m[3] = glm::vec4(position, 1.0f);
    return m;
}

Material textured(int base_color) {
    Material material;
    material.maps[kBaseColor].texture = base_color;
    material.metallic = 0.3f;
    material.roughness = 0.6f;
    return material;
}

}  // namespace

Scene make_busy_scene() {
    Scene scene;
    scene.textures = {make_noise_texture(64, 64, 1), make_noise_texture(37, 20, 2), make_noise_texture(16, 16, 3)};
    add_object(scene, make_quad({-20, -1, 4}, {40, 0, 0}, {0, 0, -80}, {30, 60}), textured(0));

    Material bumpy = textured(1);
    bumpy.maps[kNormal].texture = 2;
    bumpy.maps[kMetallicRoughness].texture = 0;
    bumpy.maps[kOcclusion].texture = 1;
    bumpy.maps[kEmissive].texture = 2;
    bumpy.emission = glm::vec3(0.1f, 0.05f, 0.0f);
    bumpy.maps[kEmissive].uv_from_vertex = {2, 0.5f, -0.5f, 2, 0.25f, 0.75f};
    add_object(scene, make_sphere(24, 12), bumpy, placed({-1.2f, 0, -1}, glm::vec3(1)));
    bumpy.double_sided = true;
    add_object(scene, make_sphere(20, 10), bumpy, placed({1.2f, 0.2f, -1}, {-1, 1.2f, 0.8f}));

    Material cutout = textured(2);
    cutout.alpha_mode = AlphaMode::Mask;
    cutout.double_sided = true;
    add_object(scene, make_quad({-1.5f, -0.8f, 1}, {2, 0, 0.5f}, {0, 1.2f, 0}, {2, 1}), cutout);
    Material glass = textured(2);
    glass.alpha_mode = AlphaMode::Blend;
    add_object(scene, make_quad({-0.5f, -0.9f, 1.5f}, {1.8f, 0, -0.2f}, {0.2f, 1.1f, 0}, {1, 3}), glass);
    glass.base_color = {0.9f, 0.3f, 0.2f, 0.4f};
    glass.maps[kBaseColor].texture = -1;
    add_object(scene, make_quad({-0.9f, -0.5f, 1.8f}, {1.4f, 0.2f, 0}, {0, 0.9f, -0.2f}), glass);
    return scene;
}

Camera busy_camera() {
    const Bounds bounds{{-2, -1, -2}, {2, 1, 2}};
    return look_at_camera(bounds, {0.3f, 0.6f, 5.0f}, {0.0f, -0.1f, 0.0f}, 45.0f);
}

Lighting busy_lighting(const Scene& scene, Executor& executor) {
    Image sky(16, 8, 3);
    for (int y = 0; y < sky.height; ++y)
        for (int x = 0; x < sky.width; ++x)
            for (int c = 0; c < 3; ++c) sky.pixel(x, y)[c] = 0.2f + 0.1f * float((x * 3 + y * 5 + c) % 7);
    Light lamp;
    lamp.type = Light::Type::Point;
    lamp.position = {0.0f, 2.0f, 2.0f};
    lamp.intensity = 5.0f;
    Light sun;
    sun.direction = glm::normalize(glm::vec3(-0.4f, -1.0f, -0.3f));
    sun.intensity = 3.0f;
    return resolve_lighting(scene, {lamp, sun}, 0.05f, std::make_shared<Environment>(sky, executor), true, executor);
}

}  // namespace rawtexel::shading::test
