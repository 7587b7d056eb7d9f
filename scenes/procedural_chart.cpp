#include "scenes/procedural_chart.h"

#include "scenes/builtin_assembly.h"
#include "scenes/procedural_noise.h"

#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace rawtexel::scenes {
namespace {

constexpr int kSquares = 8;
constexpr float kSquareTexels = 256.0f;

/// Letters A-H, then digits 1-8: seven rows of five pixels, the leftmost in bit 4.
constexpr std::array<std::array<uint8_t, 7>, 16> kGlyphs{{
    {0x0E, 0x11, 0x11, 0x1F, 0x11, 0x11, 0x11},
    {0x1E, 0x11, 0x11, 0x1E, 0x11, 0x11, 0x1E},
    {0x0E, 0x11, 0x10, 0x10, 0x10, 0x11, 0x0E},
    {0x1E, 0x11, 0x11, 0x11, 0x11, 0x11, 0x1E},
    {0x1F, 0x10, 0x10, 0x1E, 0x10, 0x10, 0x1F},
    {0x1F, 0x10, 0x10, 0x1E, 0x10, 0x10, 0x10},
    {0x0E, 0x11, 0x10, 0x17, 0x11, 0x11, 0x0F},
    {0x11, 0x11, 0x11, 0x1F, 0x11, 0x11, 0x11},
    {0x04, 0x0C, 0x04, 0x04, 0x04, 0x04, 0x0E},
    {0x0E, 0x11, 0x01, 0x06, 0x08, 0x10, 0x1F},
    {0x1F, 0x02, 0x04, 0x02, 0x01, 0x11, 0x0E},
    {0x02, 0x06, 0x0A, 0x12, 0x1F, 0x02, 0x02},
    {0x1F, 0x10, 0x1E, 0x01, 0x01, 0x11, 0x0E},
    {0x06, 0x08, 0x10, 0x1E, 0x11, 0x11, 0x0E},
    {0x1F, 0x01, 0x02, 0x04, 0x08, 0x08, 0x08},
    {0x0E, 0x11, 0x11, 0x0E, 0x11, 0x11, 0x0E},
}};

/// 1 inside (distance < 0), 0 outside, one texel of transition.
float inside(float distance) { return std::clamp(0.5f - distance, 0.0f, 1.0f); }

/// The label of a square, `scale` texels per glyph pixel, its upper left corner at `origin`.
float label(glm::vec2 p, glm::vec2 origin, float scale, int column, int row) {
    const glm::vec2 pixel = glm::floor((p - origin) / scale);
    const int x = int(pixel.x), y = int(pixel.y);
    if (x < 0 || y < 0 || x > 10 || y > 6 || x == 5) {
        return 0.0f;
    }
    const auto& glyph = kGlyphs[size_t(x < 5 ? column : 8 + row)];
    return (glyph[size_t(y)] >> (4 - x % 6) & 1) != 0 ? 1.0f : 0.0f;
}

/// Rings whose period shrinks towards the rim from 28 to 8 texels.
float zone_rings(glm::vec2 d) {
    const float r = glm::length(d);
    return r < 92.0f ? inside(std::cos(r * r / 92.0f * 0.39f * glm::pi<float>()) * 2.0f) : 0.0f;
}

float siemens_star(glm::vec2 d) {
    const float r = glm::length(d);
    const float spoke = std::sin(24.0f * std::atan2(d.y, d.x)) * r / 24.0f;
    return r > 6.0f && r < 92.0f ? inside(spoke) : 0.0f;
}

/// Bars of 16, 8, 4 and 2 texels, upright in one half and lying in the other.
float bar_groups(glm::vec2 d) {
    if (std::abs(d.x) > 88.0f || std::abs(d.y) > 88.0f) {
        return 0.0f;
    }
    const float along = d.y < 0.0f ? d.x + 88.0f : d.y * 2.0f;
    const float width = 16.0f / float(1 << std::clamp(int(along / 44.0f), 0, 3));
    const float across = d.y < 0.0f ? d.x + 88.0f : d.y;
    return std::fmod(std::floor(across / width), 2.0f) == 0.0f && std::abs(d.y) > 3.0f ? 1.0f : 0.0f;
}

float nested_diamonds(glm::vec2 d) {
    const float r = std::abs(d.x) + std::abs(d.y);
    return r < 112.0f ? inside(std::abs(std::fmod(r, 28.0f) - 14.0f) - 7.0f) : 0.0f;
}

float dot_field(glm::vec2 d) {
    const glm::vec2 cell = glm::floor(d / 24.0f + 0.5f);
    const float size = 10.5f - 1.4f * glm::length(cell);
    const glm::vec2 offset = d - cell * 24.0f;
    return glm::length(d) < 104.0f ? inside(glm::length(offset) - size) : 0.0f;
}

float compass_rose(glm::vec2 d) {
    const float angle = std::atan2(d.y, d.x), r = glm::length(d);
    const auto points = [&](float count, float phase, float reach) {
        const float turn = std::abs(std::remainder(angle - phase, 2.0f * glm::pi<float>() / count));
        return inside(r * std::sin(turn) - (reach - r * std::cos(turn)) * 0.2f);
    };
    const float ring = inside(std::abs(r - 96.0f) - 3.0f) + inside(std::abs(r - 84.0f) - 1.0f);
    return std::min(1.0f, points(4.0f, 0.0f, 92.0f) + points(4.0f, glm::quarter_pi<float>(), 62.0f) + ring);
}

float fine_checker(glm::vec2 d) {
    if (std::abs(d.x) > 80.0f || std::abs(d.y) > 80.0f) {
        return 0.0f;
    }
    // Squares of 16, 8, 4 and 2 texels, one size per quarter.
    const float size = float(2 << ((d.x < 0.0f ? 2 : 0) + (d.y < 0.0f ? 1 : 0)));
    const glm::vec2 cell = glm::floor((d + 80.0f) / size);
    return std::fmod(cell.x + cell.y, 2.0f);
}

float spiral(glm::vec2 d) {
    const float r = glm::length(d);
    const float arm = std::remainder(std::atan2(d.y, d.x) - 9.0f * std::log(std::max(r, 1.0f)), glm::pi<float>());
    return r > 4.0f && r < 94.0f ? inside((std::abs(arm) - glm::quarter_pi<float>()) * r / 9.0f) : 0.0f;
}

float figure(int kind, glm::vec2 from_center) {
    switch (kind) {
        case 0: return zone_rings(from_center);
        case 1: return compass_rose(from_center);
        case 2: return bar_groups(from_center);
        case 3: return nested_diamonds(from_center);
        case 4: return siemens_star(from_center);
        case 5: return dot_field(from_center);
        case 6: return fine_checker(from_center);
        default: return spiral(from_center);
    }
}

/// Ink of the dark squares: a slow turn through teal, blue, plum and brick.
glm::vec3 ink(int column, int row) {
    static const std::array<glm::vec3, 8> kInks{hex(0x14505C), hex(0x174A66), hex(0x25406B), hex(0x3F3765),
                                                hex(0x5E3158), hex(0x7F3446), hex(0x8C4435), hex(0x4E5A3A)};
    return kInks[size_t((column + row) / 2 + (row & 1)) % kInks.size()];
}

}  // namespace

Surface survey_chart() {
    Surface surface;
    surface.width = surface.height = kSquares * int(kSquareTexels);
    surface.extent = glm::vec2(float(kSquares));
    surface.at = [](glm::vec2 p) {
        const glm::vec2 square = glm::floor(p * float(kSquares));
        const int column = int(square.x), row = int(square.y);
        const glm::vec2 texel = (p * float(kSquares) - square) * kSquareTexels, d = texel - 0.5f * kSquareTexels;
        const bool dark = ((column + row) & 1) != 0;
        const glm::vec3 paper = hex(0xF3ECDD), shade = ink(column, row);

        const float border = std::max(std::abs(d.x), std::abs(d.y));
        const float frame = std::max(inside(std::abs(border - 116.0f) - 1.0f), 0.0f);
        const float drawing = figure((column * 3 + row * 5) % 8, d) * 0.86f;
        const float name = label(texel, {19.0f, 19.0f}, 3.0f, column, row);
        const float marks = std::max({drawing, frame, name});
        const glm::vec2 cell(texel / 8.0f + square * 32.0f);
        const float grain = 0.035f * fractal_noise(cell, glm::ivec2(kSquares * 32), 2, 7);

        SurfacePoint point;
        point.color = glm::mix(dark ? shade : paper, dark ? paper : shade, marks) + grain;
        return point;
    };
    return surface;
}

}  // namespace rawtexel::scenes
