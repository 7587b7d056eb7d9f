// Inlay of gold in black lacquer, one texel a tessera: metalness flips from texel to texel, so filtering before shading invents
// materials that are not there, and the highlight shows it.
#include "scenes/builtin_assembly.h"
#include "scenes/builtin_makers.h"
#include "scenes/shapes.h"

#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace rawtexel::scenes {
namespace {

constexpr int kTexels = 96;
constexpr float kTau = 2.0f * glm::pi<float>();

/// Distance to the nearest of `count` equal directions, as an angle from it; `turn` in steps.
float folded_angle(float angle, int count, float turn) {
    const float step = kTau / float(count);
    return std::abs(std::remainder(angle - turn * step, step));
}

/// True inside a star of `points` points between the radii `inner` and `outer`.
bool in_star(float r, float angle, int points, float inner, float outer, float turn) {
    const float fold = folded_angle(angle, points, turn) / (glm::pi<float>() / float(points));
    return r < glm::mix(outer, inner, fold);
}

/// The drawing of the inlay: `d` in texels from the middle.
bool is_metal(glm::vec2 d, glm::ivec2 texel) {
    const float r = glm::length(d), angle = std::atan2(d.y, d.x);
    const bool checker = ((texel.x + texel.y) & 1) != 0;
    if (r < 3.0f) {
        return true;
    }
    if (r < 5.0f) {
        return false;
    }
    if (in_star(r, angle, 8, 8.0f, 18.0f, 0.0f)) {
        return !in_star(r, angle, 8, 5.5f, 13.5f, 0.0f);
    }
    if (in_star(r, angle, 8, 12.0f, 22.0f, 0.5f)) {
        return checker;
    }
    if (r < 22.0f) {
        return false;
    }
    if (r < 23.6f) {
        return true;
    }
    if (r < 26.0f) {
        return checker;
    }
    if (r < 27.4f) {
        return true;
    }
    // A ring of sixteen drops, then bands of single-texel lines and squares.
    if (r < 37.0f) {
        const float across = r * std::sin(folded_angle(angle, 16, 0.5f));
        const float along = (r - 32.0f) / 4.2f;
        return across < 2.4f * std::sqrt(std::max(0.0f, 1.0f - along * along)) * (1.0f - 0.35f * along);
    }
    if (r < 38.4f) {
        return true;
    }
    if (r < 42.0f) {
        return ((texel.x / 2 + texel.y / 2) & 1) != 0;
    }
    if (r < 43.4f) {
        return true;
    }
    return r > 45.4f && checker;
}

Surface inlay() {
    return square_surface(2.0f, kTexels, [](glm::vec2 p) {
        const glm::vec2 texel = glm::floor(p * float(kTexels));
        SurfacePoint point;
        // Gold that reflects all red, next to lacquer that reflects a twentieth: the widest step that materials offer.
        const bool metal = is_metal(texel + 0.5f - 0.5f * float(kTexels), glm::ivec2(texel));
        point.color = metal ? hex(0xFFD38C) : hex(0x3B3F46);
        point.metallic = metal ? 1.0f : 0.0f;
        point.roughness = metal ? 0.34f : 0.22f;
        return point;
    });
}

/// A shallow dish seen from its convex side: the highlight runs over it as light or eye moves.
shading::Mesh shield() {
    constexpr float kDome = 0.34f;  // metres at the middle, of a radius of one
    shading::Mesh mesh;
    append_patch(mesh, 96, 48, [](float s, float t) {
        const float angle = s == 1.0f ? 0.0f : kTau * s;
        // Rows go inwards, so that the shield faces +Z.
        const float r = 1.0f - t;
        const glm::vec2 d(std::sin(angle) * r, std::cos(angle) * -r);
        const glm::vec3 normal(2.0f * kDome * d.x, 2.0f * kDome * d.y, 1.0f);
        return ShapePoint{
            {d.x, d.y, kDome * (1.0f - r * r)}, normal, {1.0f, 0.0f, -2.0f * kDome * d.x}, {0.5f + 0.498f * d.x, 0.5f - 0.498f * d.y}};
    });
    return mesh;
}

}  // namespace

shading::Scene make_metal_edge(const texunit::TextureOptions& options) {
    SceneAssembly assembly("metal-edge", options);
    const uint32_t material = assembly.add_flat_material("inlay", inlay());
    for (shading::TextureMap& map : assembly.material(material).maps) {
        map.sampler.wrap_s = map.sampler.wrap_t = texunit::Wrap::ClampToEdge;
    }
    assembly.place(assembly.add_mesh("shield", material, shield()));

    // Dark cloth behind it.
    shading::Material cloth;
    cloth.name = "cloth";
    cloth.base_color = {0.035f, 0.065f, 0.07f, 1.0f};
    cloth.metallic = 0.0f;
    cloth.roughness = 0.95f;
    shading::Mesh backdrop;
    append_rectangle(backdrop, {-6.0f, -4.0f, -0.9f}, {12.0f, 0.0f, 0.0f}, {0.0f, 8.0f, 0.0f}, {0.0f, 1.0f}, {1.0f, 0.0f});
    assembly.place(assembly.add_mesh("backdrop", assembly.add_material(cloth), std::move(backdrop)));

    shading::Light lamp;
    lamp.name = "lamp";
    lamp.type = shading::Light::Type::Point;
    lamp.position = {-1.7f, 1.5f, 2.2f};
    lamp.color = {1.0f, 0.95f, 0.88f};
    lamp.intensity = 26.0f;
    assembly.add_light(lamp);
    assembly.add_camera("front", {0.75f, 0.25f, 2.62f}, {0.0f, 0.0f, 0.08f}, 42.0f);
    assembly.set_environment(shading::EnvironmentRequest::Sky);
    return assembly.take();
}

}  // namespace rawtexel::scenes
