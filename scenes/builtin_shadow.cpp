// An iron screen in the sun, close to the ground that its shadow falls on: one texel of the shadow map meets many pixels, so what one sees
// between light and dark is its filter.
#include "scenes/builtin_assembly.h"
#include "scenes/builtin_makers.h"
#include "scenes/procedural_masonry.h"
#include "scenes/procedural_matter.h"
#include "scenes/shapes.h"

#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <array>
#include <cmath>

namespace rawtexel::scenes {
namespace {

constexpr float kTau = 2.0f * glm::pi<float>();

void add_bar(shading::Mesh& mesh, glm::vec3 from, glm::vec3 to, float radius) {
    const std::array<glm::vec3, 2> path{from, to};
    append_tube(mesh, path, radius, radius, 16, 1.0f, 0.5f);
}

/// A ring that stands in the screen's plane.
void add_ring(shading::Mesh& mesh, glm::vec2 center, float radius, float bar) {
    shading::Mesh ring;
    append_torus(ring, radius, bar, 64, 12, {4.0f, 1.0f});
    const glm::mat4 place = glm::translate(glm::mat4(1.0f), {center.x, center.y, 0.0f});
    append_mesh(mesh, ring, glm::rotate(place, 0.25f * kTau, glm::vec3(1, 0, 0)));
}

/// A rose of rings between upright bars.
shading::Mesh screen() {
    shading::Mesh mesh;
    for (int i = -6; i <= 6; ++i) {
        const float x = 0.3f * float(i);
        if (std::abs(i) > 2) add_bar(mesh, {x, 0.0f, 0.0f}, {x, 2.3f, 0.0f}, 0.016f);
    }
    for (const float y : {0.12f, 2.15f}) add_bar(mesh, {-1.9f, y, 0.0f}, {1.9f, y, 0.0f}, 0.025f);
    const glm::vec2 middle(0.0f, 1.14f);
    add_ring(mesh, middle, 0.82f, 0.024f);
    add_ring(mesh, middle, 0.2f, 0.018f);
    for (int i = 0; i < 8; ++i) {
        const float angle = kTau * float(i) / 8.0f;
        add_ring(mesh, middle + 0.51f * glm::vec2(std::cos(angle), std::sin(angle)), 0.27f, 0.014f);
    }
    for (const float side : {-1.0f, 1.0f})
        for (const float y : {0.22f, 2.05f}) add_ring(mesh, {side * 0.72f, y}, 0.1f, 0.012f);
    return mesh;
}

}  // namespace

shading::Scene make_shadow(const texunit::TextureOptions& options) {
    SceneAssembly assembly("shadow", options);
    assembly.turn_to_sun(180.0f);
    const uint32_t stone = assembly.add_surface_material("limestone floor", limestone());
    shading::Mesh floor;
    constexpr float kHalf = 14.0f;
    append_rectangle(floor, {-kHalf, 0.0f, kHalf}, {2.0f * kHalf, 0.0f, 0.0f}, {0.0f, 0.0f, -2.0f * kHalf}, {0.0f, kHalf}, {kHalf, 0.0f});
    assembly.place(assembly.add_mesh("floor", stone, std::move(floor)));

    const uint32_t iron = assembly.add_surface_material("wrought iron", wrought_iron());
    assembly.place(assembly.add_mesh("screen", iron, screen()));
    const uint32_t clay = assembly.add_surface_material("terracotta", terracotta());
    shading::Mesh ball;
    append_sphere(ball, 0.22f, 64, 33, {2.0f, 1.0f});
    const uint32_t balls = assembly.add_mesh("ball", clay, std::move(ball));
    for (const glm::vec2 p : {glm::vec2(-1.15f, 0.9f), glm::vec2(1.3f, 1.5f)})
        assembly.place(balls, glm::translate(glm::mat4(1.0f), {p.x, 0.22f, p.y}));

    assembly.add_camera("screen", {1.5f, 1.75f, 4.3f}, {0.0f, 0.5501f, 0.8f}, 42.0f);
    assembly.add_camera("penumbra", {0.2f, 0.9f, 2.3f}, {0.0f, 0.0f, 1.5f}, 30.0f);
    assembly.add_sky_and_sun();
    return assembly.take();
}

}  // namespace rawtexel::scenes
