// Standing stones in a ring, two of them bridged: shapes that nobody unwrapped, whose maps are projected along the axes.
#include "scenes/builtin_assembly.h"
#include "scenes/builtin_makers.h"
#include "scenes/builtin_stones.h"
#include "scenes/procedural_masonry.h"
#include "scenes/procedural_noise.h"
#include "scenes/procedural_plants.h"
#include "scenes/shapes.h"

#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <array>
#include <cmath>

namespace rawtexel::scenes {
namespace {

constexpr int kStones = 9;
constexpr float kRing = 4.4f;  // metres

glm::mat4 on_ring(int stone, float radius, float height) {
    const float angle = 2.0f * glm::pi<float>() * (float(stone) + 0.25f) / float(kStones);
    const glm::mat4 turned = glm::rotate(glm::mat4(1.0f), angle, glm::vec3(0, 1, 0));
    return glm::translate(turned, glm::vec3(0.0f, height, radius));
}

/// Mossy rock whose grain shows where a plane ends and the next begins.
uint32_t rock(SceneAssembly& assembly) {
    Surface surface = square_surface(2.0f, 512, [](glm::vec2 p) {
        const float swell = swatch_noise(p, 4, 5, 800), grain = swatch_noise(p, 32, 3, 801), moss = swatch_noise(p, 6, 5, 802);
        const CellPoint crack = cells(p * 5.0f + 0.25f * swell, glm::ivec2(5), 0.9f, 803);
        const float split = smooth_step(0.0f, 0.035f, crack.edge), green = smooth_step(0.08f, 0.32f, moss);
        SurfacePoint point;
        const glm::vec3 stone = glm::mix(hex(0x8A8378), hex(0xC2B7A3), 0.5f + 0.5f * swell) * (0.9f + 0.12f * grain);
        point.color = glm::mix(stone, hex(0x6F7F3A) * (0.9f + 0.2f * grain), 0.75f * green) * (0.55f + 0.45f * split);
        point.height = 0.03f * swell + 0.006f * grain - 0.02f * (1.0f - split) + 0.008f * green;
        point.roughness = glm::clamp(0.78f + 0.12f * green + 0.06f * grain, 0.0f, 1.0f);
        point.occlusion = 0.6f + 0.4f * split;
        return point;
    });
    const uint32_t index = assembly.add_surface_material("mossy rock", std::move(surface));
    assembly.material(index).triplanar = shading::Triplanar{0.5f, 6};
    return index;
}

void add_ring(SceneAssembly& assembly, uint32_t material) {
    for (int i = 0; i < kStones; ++i) {
        const float tall = 1.25f + 0.35f * lattice_float(i, 0, 810), wide = 0.5f + 0.12f * lattice_float(i, 1, 811);
        // Neighbours that carry a lintel are equally tall.
        const bool bears = i < 2 || i == 4 || i == 5;
        const glm::vec3 half(wide, bears ? 1.45f : tall, 0.36f);
        const StoneStyle style{.half_extent = half, .roundness = 6.0f, .wear = 0.22f, .seed = 820u + 10u * uint32_t(i)};
        const uint32_t mesh = assembly.add_mesh("standing stone " + std::to_string(i), material, make_stone(style));
        assembly.place(mesh, glm::rotate(on_ring(i, kRing, half.y - 0.15f), 0.5f * (lattice_float(i, 2, 812) - 0.5f), glm::vec3(0, 1, 0)));
    }
    for (const int i : {0, 4}) {
        const StoneStyle style{.half_extent = {1.95f, 0.3f, 0.42f}, .roundness = 6.0f, .wear = 0.16f, .seed = 930u + uint32_t(i)};
        const uint32_t mesh = assembly.add_mesh("lintel " + std::to_string(i), material, make_stone(style));
        const float angle = 2.0f * glm::pi<float>() * (float(i) + 0.75f) / float(kStones);
        const glm::mat4 turned = glm::rotate(glm::mat4(1.0f), angle, glm::vec3(0, 1, 0));
        assembly.place(mesh, glm::translate(turned, glm::vec3(0.0f, 2.93f, kRing * 0.94f)));
    }
    const StoneStyle altar{.half_extent = {1.1f, 0.35f, 0.7f}, .roundness = 5.0f, .wear = 0.15f, .seed = 950};
    assembly.place(assembly.add_mesh("fallen stone", material, make_stone(altar)),
                   glm::rotate(glm::translate(glm::mat4(1.0f), {-0.4f, 0.22f, 0.3f}), 0.7f, glm::vec3(0, 1, 0)));
}

void add_meadow(SceneAssembly& assembly) {
    const uint32_t grass = assembly.add_surface_material("meadow", meadow_ground());
    shading::Mesh ground;
    constexpr float kHalf = 60.0f;
    append_patch(ground, 48, 48, [](float s, float t) {
        const glm::vec2 p((2.0f * s - 1.0f) * kHalf, (1.0f - 2.0f * t) * kHalf);
        const auto height = [](glm::vec2 at) {
            return 1.2f * fractal_noise(at / 18.0f, {64, 64}, 2, 960) * smooth_step(6.0f, 30.0f, glm::length(at));
        };
        constexpr float kStep = 0.25f;
        const glm::vec3 normal(height(p - glm::vec2(kStep, 0)) - height(p + glm::vec2(kStep, 0)), 2.0f * kStep,
                               height(p - glm::vec2(0, kStep)) - height(p + glm::vec2(0, kStep)));
        return ShapePoint{.position = {p.x, height(p), p.y}, .normal = normal, .along_u = {1, 0, 0}, .uv = p / 4.0f};
    });
    assembly.place(assembly.add_mesh("ground", grass, std::move(ground)));
}

}  // namespace

shading::Scene make_triplanar(const texunit::TextureOptions& options) {
    SceneAssembly assembly("triplanar", options);
    assembly.turn_to_sun(55.0f);
    add_ring(assembly, rock(assembly));
    add_meadow(assembly);
    assembly.add_camera("ring", {1.6f, 2.1f, 10.4f}, {-0.2f, 1.15f, 0.0f}, 40.0f);
    assembly.add_sky_and_sun();
    return assembly.take();
}

}  // namespace rawtexel::scenes
