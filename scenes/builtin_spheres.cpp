// Ten finishes on a hundred finely tessellated spheres: much geometry, every map in use, few materials.
#include "scenes/builtin_assembly.h"
#include "scenes/builtin_makers.h"
#include "scenes/procedural_masonry.h"
#include "scenes/procedural_noise.h"
#include "scenes/shapes.h"

#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <array>
#include <cmath>

namespace rawtexel::scenes {
namespace {

constexpr int kPerSide = 10;
constexpr int kAround = 100, kRings = 101;  // 20 000 triangles
constexpr float kRadius = 0.43f;            // metres; the grid's pitch is one metre

struct Finish {
    const char* name;
    uint32_t color;
    float metallic, roughness;
};

/// From warm to cold, metal beside dielectric, polished beside rough.
constexpr std::array<Finish, kPerSide> kFinishes{{
    {"polished gold", 0xFFD27A, 1.0f, 0.22f},
    {"brushed copper", 0xF0A075, 1.0f, 0.50f},
    {"vermilion lacquer", 0xC8321E, 0.0f, 0.20f},
    {"matt rose", 0xD98A8C, 0.0f, 0.85f},
    {"anodised violet", 0x9A62C8, 1.0f, 0.38f},
    {"cobalt glaze", 0x1E3FA0, 0.0f, 0.16f},
    {"blued steel", 0x8FA8C8, 1.0f, 0.30f},
    {"turquoise enamel", 0x1E9C9A, 0.0f, 0.28f},
    {"satin jade", 0x6FAF72, 0.0f, 0.60f},
    {"ivory", 0xF3E7CB, 0.0f, 0.45f},
}};

/// Worked all over: panels between engraved bands, each panel stippled or smooth. Neutral, to be tinted by the finish.
Surface engraved() {
    return square_surface(0.66f, 512, [](glm::vec2 p) {
        const CellPoint panel = cells(p * 6.0f, glm::ivec2(6), 0.55f, 200);
        const CellPoint stipple = cells(p * 48.0f, glm::ivec2(48), 0.5f, 201);
        const float fine = swatch_noise(p, 48, 3, 202), wear = swatch_noise(p, 5, 4, 203);
        const bool stippled = random_part(panel.id, 0) < 0.4f;
        const float groove = smooth_step(0.02f, 0.07f, panel.edge);
        const float field = smooth_step(0.10f, 0.13f, panel.edge);
        const float dimple = stippled ? field * smooth_step(0.45f, 0.0f, glm::length(stipple.from_center)) : 0.0f;

        SurfacePoint point;
        point.color = glm::vec3(0.93f + 0.05f * fine - 0.10f * dimple) * (0.55f + 0.45f * groove);
        point.height = 0.0055f * groove + 0.0028f * (1.0f - field) - 0.0032f * dimple + 0.0003f * fine;
        point.roughness = glm::clamp(0.72f + 0.25f * smooth_step(-0.1f, 0.5f, wear) + 0.3f * (1.0f - groove), 0.0f, 1.0f);
        point.metallic = 1.0f;
        point.occlusion = (0.6f + 0.4f * groove) * (1.0f - 0.3f * dimple);
        return point;
    });
}

shading::Mesh globe() {
    shading::Mesh mesh;
    append_sphere(mesh, kRadius, kAround, kRings, {4.0f, 2.0f});
    return mesh;
}

/// Each sphere shows another side: a turn and a tilt of its own.
glm::mat4 placement(int column, int row) {
    const float middle = 0.5f * float(kPerSide - 1);
    const glm::mat4 move = glm::translate(glm::mat4(1.0f), {float(column) - middle, kRadius, float(row) - middle});
    // The poles, where the texture is pinched, lie to the sides.
    const float lean = glm::half_pi<float>() + 0.3f * (lattice_float(column, row, 210) - 0.5f);
    return glm::rotate(glm::rotate(move, lean, glm::vec3(0, 0, 1)), 2.0f * glm::pi<float>() * lattice_float(column, row, 211),
                       glm::vec3(0, 1, 0));
}

void add_floor(SceneAssembly& assembly) {
    const uint32_t stone = assembly.add_surface_material("limestone floor", limestone());
    assembly.material(stone).roughness = 0.8f;
    constexpr float kHalf = 24.0f, kRepeats = 20.0f;  // reaches beyond the picture
    shading::Mesh floor;
    append_rectangle(floor, {-kHalf, 0.0f, kHalf}, {2.0f * kHalf, 0.0f, 0.0f}, {0.0f, 0.0f, -2.0f * kHalf}, {0.0f, kRepeats},
                     {kRepeats, 0.0f});
    assembly.place(assembly.add_mesh("floor", stone, std::move(floor)));
}

}  // namespace

shading::Scene make_spheres(const texunit::TextureOptions& options) {
    SceneAssembly assembly("spheres", options);
    const uint32_t first = assembly.add_surface_material("engraved", engraved());
    const shading::Mesh sphere = globe();
    std::array<uint32_t, kPerSide> meshes{};
    for (size_t i = 0; i < kFinishes.size(); ++i) {
        shading::Material material = assembly.material(first);
        material.name = kFinishes[i].name;
        material.base_color = glm::vec4(linear_color(hex(kFinishes[i].color)), 1.0f);
        material.metallic = kFinishes[i].metallic;
        material.roughness = kFinishes[i].roughness;
        // The first finish takes the place of the material that brought the maps.
        const uint32_t index = i == 0 ? first : assembly.add_material(material);
        assembly.material(index) = material;
        meshes[i] = assembly.add_mesh(material.name, index, sphere);
    }
    for (int row = 0; row < kPerSide; ++row) {
        for (int column = 0; column < kPerSide; ++column) {
            assembly.place(meshes[size_t(row + column) % kFinishes.size()], placement(column, row));
        }
    }
    add_floor(assembly);
    assembly.add_camera("overview", {-4.4f, 6.1f, 9.9f}, {0.2f, 0.0f, 0.7f}, 36.5f);
    assembly.add_sky_and_sun();
    return assembly.take();
}

}  // namespace rawtexel::scenes
