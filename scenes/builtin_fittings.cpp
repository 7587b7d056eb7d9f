#include "scenes/builtin_fittings.h"

#include "scenes/procedural_noise.h"
#include "scenes/shapes.h"

#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <array>
#include <cmath>
#include <initializer_list>
#include <span>

namespace rawtexel::scenes {
namespace {

constexpr float kTau = 2.0f * glm::pi<float>();

constexpr float kBasinRadius = 1.55f, kBasinHeight = 0.52f;  // metres, to the middle of the rim

/// A jet of water from the spout at `angle` into the basin: a parabola that thins out.
void append_stream(shading::Mesh& mesh, float angle) {
    std::array<glm::vec3, 12> path;
    for (size_t i = 0; i < path.size(); ++i) {
        const float t = float(i) / float(path.size() - 1);
        const float r = 0.52f + 0.42f * t, y = 1.28f + 0.10f * t - 1.02f * t * t;
        path[i] = {r * std::sin(angle), y, r * std::cos(angle)};
    }
    append_tube(mesh, path, 0.016f, 0.009f, 8, 0.2f, 1.0f);
}

/// The profile turned about the y axis.
void turn(shading::Mesh& mesh, std::initializer_list<glm::vec2> profile, int around, float repeat, float metres_per_uv,
          float crease = 40.0f) {
    append_lathe(mesh, std::span(profile.begin(), profile.size()), around, repeat, metres_per_uv, crease);
}

/// A rounded rim of stone on a step, over tiles inside and out.
void append_basin(Fountain& fountain) {
    turn(fountain.stone,
         {{1.62f, 0.44f},
          {1.68f, 0.45f},
          {1.72f, 0.48f},
          {1.72f, 0.53f},
          {1.68f, 0.57f},
          {1.60f, 0.585f},
          {1.46f, 0.57f},
          {1.42f, 0.53f},
          {1.42f, 0.46f}},
         64, 5.0f, 2.0f, 60.0f);
    turn(fountain.stone, {{1.86f, 0.0f}, {1.86f, 0.11f}, {1.84f, 0.13f}, {1.60f, 0.13f}}, 64, 6.0f, 2.0f);
    turn(fountain.tiles, {{1.62f, 0.13f}, {1.62f, 0.44f}}, 64, 8.0f, 1.2f);
    turn(fountain.tiles, {{1.44f, 0.48f}, {1.44f, 0.10f}}, 64, 8.0f, 1.2f);
    append_disc(fountain.tiles, 0.10f, 1.44f, 48, 1.2f);
}

/// Pedestal and upper bowl in one piece, and the finial that rises from the bowl.
void append_pedestal(Fountain& fountain) {
    turn(fountain.stone,
         {{0.34f, 0.10f}, {0.34f, 0.30f}, {0.31f, 0.34f}, {0.22f, 0.38f}, {0.17f, 0.46f}, {0.16f, 0.56f}, {0.19f, 0.64f}, {0.22f, 0.68f},
          {0.19f, 0.72f}, {0.13f, 0.78f}, {0.12f, 0.92f}, {0.15f, 1.02f}, {0.24f, 1.08f}, {0.40f, 1.13f}, {0.54f, 1.22f}, {0.60f, 1.32f},
          {0.62f, 1.34f}, {0.62f, 1.37f}, {0.59f, 1.38f}, {0.56f, 1.35f}, {0.45f, 1.24f}, {0.0f, 1.20f}},
         48, 3.0f, 2.0f, 55.0f);
    turn(fountain.bronze,
         {{0.10f, 1.22f},
          {0.11f, 1.30f},
          {0.07f, 1.36f},
          {0.06f, 1.46f},
          {0.11f, 1.50f},
          {0.15f, 1.57f},
          {0.165f, 1.65f},
          {0.15f, 1.74f},
          {0.11f, 1.83f},
          {0.06f, 1.90f},
          {0.02f, 1.945f},
          {0.0f, 1.95f}},
         32, 2.0f, 0.5f, 60.0f);
}

/// Six spouts on the bowl, a stream from each, and the water's two surfaces.
void append_water(Fountain& fountain) {
    for (int i = 0; i < 6; ++i) {
        const float angle = kTau * (float(i) + 0.5f) / 6.0f;
        const glm::vec3 out(std::sin(angle), 0.0f, std::cos(angle));
        const std::array<glm::vec3, 2> spout{glm::vec3(0, 1.265f, 0) + 0.40f * out, glm::vec3(0, 1.285f, 0) + 0.55f * out};
        append_tube(fountain.bronze, spout, 0.030f, 0.022f, 10, 1.0f, 0.5f);
        append_stream(fountain.water, angle);
    }
    append_disc(fountain.water, 0.44f, 1.44f, 64, 2.0f);
    append_disc(fountain.water, 1.33f, 0.56f, 48, 2.0f);
}

}  // namespace

Fountain make_fountain() {
    Fountain fountain;
    append_basin(fountain);
    append_pedestal(fountain);
    append_water(fountain);
    return fountain;
}

void append_pot(shading::Mesh& pot, float height, float radius) {
    const float h = height, r = radius;
    turn(pot,
         {{0.0f, 0.002f},
          {0.62f * r, 0.002f},
          {0.66f * r, 0.03f * h},
          {0.80f * r, 0.35f * h},
          {0.90f * r, 0.66f * h},
          {0.91f * r, 0.80f * h},
          {1.00f * r, 0.82f * h},
          {1.04f * r, 0.86f * h},
          {1.04f * r, 0.95f * h},
          {1.00f * r, 0.99f * h},
          {0.95f * r, 1.00f * h},
          {0.90f * r, 0.99f * h},
          {0.87f * r, 0.94f * h},
          {0.85f * r, 0.86f * h},
          {0.84f * r, 0.80f * h}},
         40, 2.0f, 1.0f, 50.0f);
}

void append_disc(shading::Mesh& mesh, float y, float radius, int around, float metres_per_uv) {
    append_patch(mesh, around, 6, [&](float s, float t) {
        const float angle = s == 1.0f ? 0.0f : kTau * s, r = radius * (1.0f - t);
        const glm::vec2 p(r * std::sin(angle), r * std::cos(angle));
        return ShapePoint{{p.x, y, p.y}, {0, 1, 0}, {1, 0, 0}, p / metres_per_uv};
    });
}

Lantern make_lantern() {
    Lantern lantern;
    const auto corner = [](int i, float r, float y) {
        const float angle = kTau * (float(i) + 0.5f) / 6.0f;
        return glm::vec3(r * std::sin(angle), y, r * std::cos(angle));
    };
    const std::array<glm::vec3, 2> chain{glm::vec3(0, 0, 0), glm::vec3(0, -0.32f, 0)};
    append_tube(lantern.metal, chain, 0.008f, 0.008f, 8, 1.0f, 1.0f);
    turn(lantern.metal, {{0.19f, -0.50f}, {0.20f, -0.485f}, {0.13f, -0.42f}, {0.05f, -0.36f}, {0.03f, -0.33f}, {0.0f, -0.31f}}, 6, 1.0f,
         1.0f, 20.0f);
    turn(lantern.metal, {{0.0f, -0.90f}, {0.03f, -0.88f}, {0.10f, -0.855f}, {0.135f, -0.84f}, {0.135f, -0.82f}, {0.0f, -0.82f}}, 6, 1.0f,
         1.0f, 20.0f);
    for (int i = 0; i < 6; ++i) {
        const std::array<glm::vec3, 2> bar{corner(i, 0.122f, -0.83f), corner(i, 0.172f, -0.49f)};
        append_tube(lantern.metal, bar, 0.009f, 0.009f, 6, 0.2f, 1.0f);
        const glm::vec3 low = corner(i, 0.120f, -0.82f), right = corner(i + 1, 0.120f, -0.82f) - low;
        const glm::vec3 top = corner(i, 0.170f, -0.495f);
        const glm::vec3 top_right = corner(i + 1, 0.170f, -0.495f);
        append_patch(lantern.glass, 1, 1, [&](float s, float t) {
            const glm::vec3 p = glm::mix(low + s * right, glm::mix(top, top_right, s), t);
            return ShapePoint{p, glm::cross(right, top - low), right, {s, 1.0f - t}};
        });
    }
    turn(lantern.flame,
         {{0.0f, -0.80f},
          {0.022f, -0.79f},
          {0.034f, -0.75f},
          {0.036f, -0.71f},
          {0.028f, -0.66f},
          {0.016f, -0.615f},
          {0.006f, -0.585f},
          {0.0f, -0.575f}},
         16, 1.0f, 1.0f, 70.0f);
    return lantern;
}

void append_roof(shading::Mesh& mesh, int columns, float pitch, float run, float rise) {
    constexpr float kTileLength = 0.42f, kOverlap = 0.06f;
    const float slope_length = std::hypot(run, rise);
    const int courses = int(std::ceil(slope_length / (kTileLength - kOverlap)));
    const glm::vec3 down = glm::normalize(glm::vec3(0.0f, -rise, run)), lift = glm::normalize(glm::vec3(0.0f, run, rise));
    const auto append_tile = [&](float x, int course, bool cover, uint32_t id) {
        const float start = float(course) * slope_length / float(courses);
        const glm::vec3 head = glm::vec3(x, rise, 0.0f) + start * down;
        const float sway = 0.02f * (float(id & 0xFFu) / 255.0f - 0.5f), radius = 0.5f * pitch * 0.86f;
        append_patch(mesh, 8, 1, [&](float s, float t) {
            // Covers arch upwards, channels downwards; each widens towards the end that lies over, or under, the next.
            const float angle = glm::pi<float>() * (s - 0.5f), along = (1.0f - t) * kTileLength;
            const float r = radius * (cover ? 0.88f + 0.12f * (1.0f - t) : 1.0f - 0.12f * (1.0f - t));
            const glm::vec3 across(std::sin(angle), 0.0f, 0.0f);
            const float bow = cover ? std::cos(angle) : -std::cos(angle);
            const glm::vec3 offset = r * (across + bow * lift) + lift * (cover ? 0.030f * (1.0f - t) : 0.045f - 0.03f * t);
            const glm::vec3 normal = cover ? across + bow * lift : -across - bow * lift;
            return ShapePoint{head + along * down + offset + glm::vec3(sway * (1.0f - t), 0, 0),
                              normal,
                              {1, 0, 0},
                              {float(id & 7u) * 0.37f + 0.2f * s, -0.42f * t + float(course) * 0.31f}};
        });
    };
    for (int column = 0; column < columns; ++column) {
        for (int course = courses - 1; course >= 0; --course) {
            const float x = (float(column) + 0.5f) * pitch;
            append_tile(x, course, false, lattice_bits(column, course, 500));
            append_tile(x + 0.5f * pitch, course, true, lattice_bits(column, course, 501));
        }
    }
}

}  // namespace rawtexel::scenes
