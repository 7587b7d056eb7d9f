#include "scenes/builtin_arcade.h"

#include "scenes/shapes.h"

#include <glm/gtc/constants.hpp>

#include <array>
#include <cmath>

namespace rawtexel::scenes {
namespace {

/// One face of the spandrels: `side` 1 looks to +z from z = 0, -1 to -z from the back.
void append_spandrel_face(shading::Mesh& mesh, const ArcadeBay& bay, float side, float metres_per_uv) {
    const float z = side > 0.0f ? 0.0f : -bay.thickness, half = 0.5f * bay.width, radius = bay.radius + 0.5f * bay.ring;
    const auto point = [&](float x, float y) {
        return ShapePoint{{side * x, y, z}, {0, 0, side}, {side, 0, 0}, glm::vec2(x, -y) / metres_per_uv};
    };
    append_patch(mesh, 1, 4, [&](float s, float t) { return point(glm::mix(-half, -radius, s), glm::mix(bay.spring, bay.height, t)); });
    append_patch(mesh, 24, 4, [&](float s, float t) {
        const float angle = glm::pi<float>() * s;
        const float low = bay.spring + radius * (s == 1.0f ? 0.0f : std::sin(angle));
        return point(-radius * std::cos(angle), glm::mix(low, bay.height, t));
    });
    append_patch(mesh, 1, 4, [&](float s, float t) { return point(glm::mix(radius, half, s), glm::mix(bay.spring, bay.height, t)); });
}

/// A block of an arch between two angles (from the +x axis), radii r0 < r1 and depths z0 < z1.
struct RingBlock {
    float r0, r1, angle0, angle1, z0, z1;
};

void append_ring_block(shading::Mesh& mesh, const RingBlock& b, glm::vec2 center, float metres_per_uv) {
    const auto at = [&](float r, float angle, float z) {
        return glm::vec3(center.x + r * std::cos(angle), center.y + r * std::sin(angle), z);
    };
    const auto outward = [](float angle) { return glm::vec3(std::cos(angle), std::sin(angle), 0.0f); };
    const auto along = [](float angle) { return glm::vec3(-std::sin(angle), std::cos(angle), 0.0f); };
    constexpr int kArcSteps = 3;
    for (const float side : {1.0f, -1.0f}) {
        const float z = side > 0.0f ? b.z1 : b.z0;
        append_patch(mesh, 1, kArcSteps, [&](float s, float t) {
            const float angle = glm::mix(b.angle0, b.angle1, t), r = side > 0.0f ? glm::mix(b.r1, b.r0, 1.0f - s) : glm::mix(b.r1, b.r0, s);
            return ShapePoint{at(r, angle, z), {0, 0, side}, side * outward(angle), glm::vec2(side * r, -angle * r) / metres_per_uv};
        });
    }
    append_patch(mesh, 1, kArcSteps, [&](float s, float t) {
        const float angle = glm::mix(b.angle0, b.angle1, t), z = glm::mix(b.z1, b.z0, s);
        return ShapePoint{at(b.r1, angle, z), outward(angle), {0, 0, -1}, glm::vec2(-z, -angle * b.r1) / metres_per_uv};
    });
    append_patch(mesh, 1, kArcSteps, [&](float s, float t) {
        const float angle = glm::mix(b.angle0, b.angle1, t), z = glm::mix(b.z0, b.z1, s);
        return ShapePoint{at(b.r0, angle, z), -outward(angle), {0, 0, 1}, glm::vec2(z, -angle * b.r0) / metres_per_uv};
    });
    for (const bool last : {false, true}) {
        const float angle = last ? b.angle1 : b.angle0;
        append_patch(mesh, 1, 1, [&](float s, float t) {
            const float r = glm::mix(b.r0, b.r1, s), z = last ? glm::mix(b.z1, b.z0, t) : glm::mix(b.z0, b.z1, t);
            return ShapePoint{at(r, angle, z), (last ? 1.0f : -1.0f) * along(angle), outward(angle),
                              glm::vec2(r, last ? z : -z) / metres_per_uv};
        });
    }
}

}  // namespace

void append_spandrels(shading::Mesh& mesh, const ArcadeBay& bay, float metres_per_uv) {
    append_spandrel_face(mesh, bay, 1.0f, metres_per_uv);
    append_spandrel_face(mesh, bay, -1.0f, metres_per_uv);
    // Undersides that rest on the capitals.
    const float half = 0.5f * bay.width, radius = bay.radius;
    for (const float left : {-half, radius}) {
        const float width = half - radius;
        append_rectangle(mesh, {left, bay.spring, -bay.thickness}, {width, 0, 0}, {0, 0, bay.thickness}, {0.0f, 0.0f},
                         glm::vec2(width, -bay.thickness) / metres_per_uv);
    }
}

void append_voussoirs(shading::Mesh& mesh, const ArcadeBay& bay, int count, int first, float metres_per_uv) {
    constexpr float kRelief = 0.025f, kJoint = 0.004f;  // metres
    for (int i = first; i < count; i += 2) {
        const float step = glm::pi<float>() / float(count), gap = kJoint / bay.radius;
        const bool keystone = 2 * i + 1 == count;
        const float relief = keystone ? 2.0f * kRelief : kRelief, ring = keystone ? 1.25f * bay.ring : bay.ring;
        append_ring_block(
            mesh, {bay.radius, bay.radius + ring, step * float(i) + gap, step * float(i + 1) - gap, -bay.thickness - relief, relief},
            {0.0f, bay.spring}, metres_per_uv);
    }
}

void append_column(shading::Mesh& mesh, float height, float shaft_radius) {
    const float r = shaft_radius, plinth = 0.10f, abacus = 0.09f;
    append_rounded_box(mesh, {0.0f, 0.5f * plinth, 0.0f}, {1.62f * r, 0.5f * plinth, 1.62f * r}, 0.012f, 2.0f);
    append_rounded_box(mesh, {0.0f, height - 0.5f * abacus, 0.0f}, {1.75f * r, 0.5f * abacus, 1.75f * r}, 0.014f, 2.0f);
    // Base mouldings, a shaft with entasis, necking, and a bell that opens to the abacus.
    const float foot = plinth, top = height - abacus;
    const std::array<glm::vec2, 27> profile{{
        {1.50f * r, foot},         {1.58f * r, foot + 0.02f},  {1.60f * r, foot + 0.04f},  {1.56f * r, foot + 0.065f},
        {1.42f * r, foot + 0.08f}, {1.24f * r, foot + 0.09f},  {1.20f * r, foot + 0.105f}, {1.22f * r, foot + 0.12f},
        {1.30f * r, foot + 0.13f}, {1.31f * r, foot + 0.145f}, {1.24f * r, foot + 0.16f},  {1.04f * r, foot + 0.17f},
        {1.00f * r, foot + 0.22f}, {1.00f * r, foot + 0.7f},   {0.97f * r, foot + 1.1f},   {0.91f * r, foot + 1.4f},
        {0.85f * r, top - 0.34f},  {0.95f * r, top - 0.33f},   {0.99f * r, top - 0.315f},  {0.95f * r, top - 0.30f},
        {0.86f * r, top - 0.29f},  {0.88f * r, top - 0.22f},   {0.97f * r, top - 0.14f},   {1.14f * r, top - 0.08f},
        {1.38f * r, top - 0.035f}, {1.58f * r, top - 0.012f},  {1.62f * r, top},
    }};
    append_lathe(mesh, profile, 32, 1.0f, 2.0f, 50.0f);
}

}  // namespace rawtexel::scenes
