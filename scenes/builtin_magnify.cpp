// One small picture, enlarged until the kernel between its texels is what one sees.
#include "scenes/builtin_assembly.h"
#include "scenes/builtin_makers.h"
#include "scenes/shapes.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace rawtexel::scenes {
namespace {

constexpr int kTexels = 64;

/// A hill line: 0 at its top, growing downwards, texels.
float below_hill(glm::vec2 p, float base, float swing, float period, float phase) {
    return p.y - base - swing * std::sin((p.x + phase) / period);
}

glm::vec3 evening_sky(glm::vec2 p) {
    static const std::array<glm::vec3, 5> kStops{hex(0x1C2B5A), hex(0x5B4B8A), hex(0xD1688A), hex(0xF7A072), hex(0xFFE0A3)};
    const float t = std::clamp(p.y / 46.0f, 0.0f, 1.0f) * 4.0f;
    const auto i = std::min(size_t(t), size_t{3});
    return glm::mix(kStops[i], kStops[i + 1], t - float(i));
}

/// The balloon's envelope in gores of alternating colour, shaded as a ball; false outside it.
bool paint_balloon(glm::vec2 p, glm::vec3& color) {
    const glm::vec2 d = p - glm::vec2(27.5f, 29.0f);
    // A ball above, drawn in towards the mouth below.
    constexpr float kRadius = 8.2f;
    const float half_width = d.y < 0.0f ? std::sqrt(std::max(0.0f, kRadius * kRadius - d.y * d.y))
                                        : kRadius * std::sqrt(std::max(0.0f, 1.0f - d.y * d.y / 125.0f)) - 0.27f * d.y;
    if (std::abs(d.x) > half_width || d.y > 9.0f || half_width < 0.5f) return false;
    static const std::array<glm::vec3, 5> kGores{hex(0x1D8A99), hex(0xE63946), hex(0xFFF3DC), hex(0xE63946), hex(0x1D8A99)};
    // Gores are equally wide on the ball, so they narrow towards its outline.
    const float across = std::asin(std::clamp(d.x / half_width, -1.0f, 1.0f)) * 0.318310f + 0.5f;
    const size_t gore = std::min(size_t(across * 5.0f), size_t{4});
    const bool band = d.y > 1.0f && d.y < 3.0f;
    color = band ? hex(gore % 2 == 0 ? 0xFFC22E : 0x27325C) : kGores[gore];
    color *= std::clamp(0.95f - 0.022f * d.x - 0.016f * d.y, 0.45f, 1.0f);
    return true;
}

bool paint_basket(glm::vec2 p, glm::vec3& color) {
    const glm::vec2 d = p - glm::vec2(27.5f, 42.0f);
    if (std::abs(d.x) <= 2.0f && d.y >= -0.5f && d.y <= 2.5f) {
        color = hex((int(p.x) + int(p.y)) % 2 == 0 ? 0x8A5A2B : 0xC98F4E);
        return true;
    }
    // Single-texel ropes.
    if (d.y < -0.5f && d.y > -5.0f && std::abs(std::abs(d.x) - 2.0f + 0.25f * d.y) < 0.5f) {
        color = hex(0x3A2A1C);
        return true;
    }
    return false;
}

glm::vec3 landscape(glm::vec2 p) {
    glm::vec3 color = evening_sky(p);
    // The sun and, over it, a bank of cloud with hard edges.
    if (glm::distance(p, {44.0f, 29.0f}) < 5.2f) {
        color = hex(0xFFE873);
    }
    const auto cloud = [&](float row, float left, float right) { return std::abs(p.y - row) < 0.6f && p.x > left && p.x < right; };
    if (cloud(31.5f, 38.0f, 48.0f) || cloud(33.5f, 41.0f, 58.0f) || cloud(24.5f, 8.0f, 15.0f)) {
        color = hex(0x7A4E86);
    }
    // Stars: the impulse response of the kernel, nothing less.
    static constexpr std::array<glm::ivec2, 9> kStars{glm::ivec2{14, 21}, {39, 21}, {46, 20}, {50, 22}, {13, 34}, {6, 9}, {33, 6},
                                                      {55, 12},           {22, 12}};
    if (std::find(kStars.begin(), kStars.end(), glm::ivec2(p)) != kStars.end()) {
        color = hex(0xFFFFFF);
    }
    if (const float depth = below_hill(p, 39.0f, 2.5f, 5.0f, 3.0f); depth > 0.0f) {
        color = glm::mix(hex(0x8C4F7D), hex(0xA75F78), std::min(depth / 8.0f, 1.0f));
    }
    if (const float depth = below_hill(p, 42.5f, 2.0f, 7.0f, 20.0f); depth > 0.0f) {
        color = glm::mix(hex(0x3B3561), hex(0x5A4272), std::min(depth / 8.0f, 1.0f));
    }
    if (p.y > 46.0f) {
        const bool furrow = int(p.x * 0.5f + p.y) % 4 == 0;
        color = furrow ? hex(0x2A4B4F) : glm::mix(hex(0x1D3340), hex(0x16242F), (p.y - 46.0f) / 18.0f);
    }
    return color;
}

Surface postcard() {
    Surface surface;
    surface.width = surface.height = kTexels;
    surface.at = [](glm::vec2 p) {
        const glm::vec2 texel = p * float(kTexels);
        SurfacePoint point;
        if (!paint_balloon(texel, point.color) && !paint_basket(texel, point.color)) {
            point.color = landscape(texel);
        }
        return point;
    };
    return surface;
}

}  // namespace

shading::Scene make_magnify(const texunit::TextureOptions& options) {
    SceneAssembly assembly("magnify", options);
    const uint32_t material = assembly.add_color_material("postcard", postcard(), 1.0f);
    assembly.material(material).unlit = true;
    texunit::SamplerState& sampler = assembly.material(material).maps[shading::kBaseColor].sampler;
    sampler.wrap_s = sampler.wrap_t = texunit::Wrap::ClampToEdge;

    // One metre per texel; row 0 on top.
    constexpr float kSide = float(kTexels);
    shading::Mesh quad;
    append_rectangle(quad, {0.0f, -kSide, 0.0f}, {kSide, 0.0f, 0.0f}, {0.0f, kSide, 0.0f}, {0.0f, 1.0f}, {1.0f, 0.0f});
    assembly.place(assembly.add_mesh("quad", material, std::move(quad)));

    // 24 texels high and, at 16:9, 42.7 wide: 30 pixels a texel at 1280x720.
    shading::Camera camera;
    camera.type = shading::Camera::Type::Orthographic;
    camera.znear = 0.5f;
    camera.zfar = 2.0f;
    camera.name = "close";
    camera.ymag = 12.0f;
    camera.xmag = camera.ymag * 16.0f / 9.0f;
    camera.world_from_camera[3] = {32.0f, -32.0f, 1.0f, 1.0f};
    assembly.add_camera(camera);
    camera.name = "whole";
    camera.ymag = 32.0f;
    camera.xmag = camera.ymag * 16.0f / 9.0f;
    assembly.add_camera(camera);
    assembly.set_environment(shading::EnvironmentRequest::None);
    return assembly.take();
}

}  // namespace rawtexel::scenes
