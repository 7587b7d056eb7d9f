// A word in glyphs of signed distances: alpha says how far the outline is, and 0.5 is the outline. The texels are no coverage: tested one
// by one they show blocks, so such a map is filtered before the test (Green 2007, "Improved Alpha-Tested Magnification for Vector Textures
// and Special Effects").
#include "scenes/builtin_assembly.h"
#include "scenes/builtin_makers.h"
#include "scenes/shapes.h"

#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>
#include <span>

namespace rawtexel::scenes {
namespace {

// In units of the x-height; the base line is at 0, a letter begins at x = 0.
constexpr float kStroke = 0.11f;  // half the width of a stroke
constexpr float kSpread = 0.3f;   // distance that alpha 0 and 1 stand for
constexpr int kTexelsPerUnit = 14;
constexpr float kWidth = 8.0f, kHeight = 2.3f, kBelow = 0.4f, kBefore = 0.45f;

float to_segment(glm::vec2 p, glm::vec2 a, glm::vec2 b) {
    const glm::vec2 along = b - a;
    const float t = glm::clamp(glm::dot(p - a, along) / glm::dot(along, along), 0.0f, 1.0f);
    return glm::length(p - a - t * along);
}

/// To the arc about `center` from angle `begin` counter-clockwise to `end`, radians.
float to_arc(glm::vec2 p, glm::vec2 center, float radius, float begin, float end) {
    const glm::vec2 d = p - center;
    const float turn = 2.0f * glm::pi<float>();
    float angle = std::atan2(d.y, d.x) - begin;
    angle -= turn * std::floor(angle / turn);
    if (angle <= end - begin) return std::abs(glm::length(d) - radius);
    const auto tip = [&](float at) { return glm::length(d - radius * glm::vec2(std::cos(at), std::sin(at))); };
    return std::min(tip(begin), tip(end));
}

/// Distance to the middle of the strokes of a letter.
float to_letter(char letter, glm::vec2 p) {
    constexpr float kPi = glm::pi<float>();
    switch (letter) {
        case 'r': return std::min(to_segment(p, {0, 0}, {0, 1}), to_arc(p, {0.4f, 0.6f}, 0.4f, 0.3f * kPi, kPi));
        case 'a': return std::min(to_arc(p, {0.45f, 0.5f}, 0.45f, 0.0f, 2.0f * kPi), to_segment(p, {0.9f, 0}, {0.9f, 1}));
        case 'w':
            return std::min({to_segment(p, {0, 1}, {0.3f, 0}), to_segment(p, {0.3f, 0}, {0.6f, 0.9f}),
                             to_segment(p, {0.6f, 0.9f}, {0.9f, 0}), to_segment(p, {0.9f, 0}, {1.2f, 1})});
        case 't':
            return std::min({to_segment(p, {0.25f, 1.4f}, {0.25f, 0.25f}), to_segment(p, {0, 1}, {0.6f, 1}),
                             to_arc(p, {0.5f, 0.25f}, 0.25f, kPi, 1.6f * kPi)});
        case 'e': return std::min(to_arc(p, {0.45f, 0.5f}, 0.45f, 0.0f, 1.75f * kPi), to_segment(p, {0, 0.5f}, {0.9f, 0.5f}));
        case 'x': return std::min(to_segment(p, {0, 0}, {0.75f, 1}), to_segment(p, {0, 1}, {0.75f, 0}));
        default: return to_segment(p, {0, 0}, {0, 1.5f});  // l
    }
}

struct PlacedLetter {
    char letter;
    float x;
};
constexpr PlacedLetter kWord[] = {{'r', 0.0f},  {'a', 0.95f}, {'w', 2.15f}, {'t', 3.65f},
                                  {'e', 4.55f}, {'x', 5.75f}, {'e', 6.75f}, {'l', 7.95f}};

Surface word() {
    Surface surface;
    surface.width = int((kWidth + 2.0f * kBefore) * kTexelsPerUnit);
    surface.height = int(kHeight * kTexelsPerUnit);
    surface.at = [](glm::vec2 p) {
        const glm::vec2 place(p.x * (kWidth + 2.0f * kBefore) - kBefore, (1.0f - p.y) * kHeight - kBelow);
        float distance = kSpread + kStroke;
        for (const PlacedLetter& placed : kWord) distance = std::min(distance, to_letter(placed.letter, place - glm::vec2(placed.x, 0)));
        SurfacePoint point;
        point.color = hex(0x1F2D4D);
        point.alpha = glm::clamp(0.5f + 0.5f * (kStroke - distance) / kSpread, 0.0f, 1.0f);
        return point;
    };
    return surface;
}

/// A line of writing whose letters are `size` metres tall, its left end at `place`.
void write_line(SceneAssembly& assembly, uint32_t mesh, glm::vec2 place, float size) {
    glm::mat4 m(size);
    m[3] = {place.x, place.y, 0.01f, 1.0f};
    assembly.place(mesh, m);
}

}  // namespace

shading::Scene make_font(const texunit::TextureOptions& options) {
    SceneAssembly assembly("font", options);
    const uint32_t ink = assembly.add_color_material("signed distances", word(), 1.0f);
    shading::Material& material = assembly.material(ink);
    material.unlit = true;
    material.alpha_mode = shading::AlphaMode::Mask;
    material.alpha_cutoff = 0.5f;
    texunit::SamplerState& sampler = material.maps[shading::kBaseColor].sampler;
    sampler.wrap_s = sampler.wrap_t = texunit::Wrap::ClampToEdge;

    shading::Material paper;
    paper.name = "paper";
    paper.unlit = true;
    paper.base_color = glm::vec4(linear_color(hex(0xF4ECDC)), 1.0f);
    shading::Mesh sheet;
    append_rectangle(sheet, {-12, -8, 0}, {24, 0, 0}, {0, 16, 0}, {0, 1}, {1, 0});
    assembly.place(assembly.add_mesh("sheet", assembly.add_material(paper), std::move(sheet)));

    shading::Mesh line;
    append_rectangle(line, {-kBefore, -kBelow, 0}, {kWidth + 2.0f * kBefore, 0, 0}, {0, kHeight, 0}, {0, 1}, {1, 0});
    const uint32_t mesh = assembly.add_mesh("word", ink, std::move(line));
    write_line(assembly, mesh, {-4.1f, 0.55f}, 1.0f);
    write_line(assembly, mesh, {-4.1f, -0.75f}, 0.5f);
    write_line(assembly, mesh, {0.4f, -0.75f}, 0.5f);
    write_line(assembly, mesh, {-4.1f, -1.5f}, 0.25f);
    write_line(assembly, mesh, {-1.85f, -1.5f}, 0.25f);
    write_line(assembly, mesh, {0.4f, -1.5f}, 0.25f);
    write_line(assembly, mesh, {2.65f, -1.5f}, 0.18f);

    shading::Camera camera;
    camera.name = "page";
    camera.type = shading::Camera::Type::Orthographic;
    camera.znear = 0.5f;
    camera.zfar = 2.0f;
    camera.ymag = 2.7f;
    camera.xmag = camera.ymag * 16.0f / 9.0f;
    camera.world_from_camera[3] = {0.0f, 0.1f, 1.0f, 1.0f};
    assembly.add_camera(camera);
    camera.name = "letter";
    camera.ymag = 0.7f;
    camera.xmag = camera.ymag * 16.0f / 9.0f;
    camera.world_from_camera[3] = {-2.6f, 1.0f, 1.0f, 1.0f};
    assembly.add_camera(camera);
    assembly.set_environment(shading::EnvironmentRequest::None);
    return assembly.take();
}

}  // namespace rawtexel::scenes
