#include "scenes/procedural_masonry.h"

#include "scenes/builtin_assembly.h"
#include "scenes/procedural_noise.h"

#include <algorithm>
#include <cmath>

namespace rawtexel::scenes {
namespace {

/// Small red bricks with raked joints, as they show under fallen plaster.
SurfacePoint rubble_brick(glm::vec2 p) {
    const glm::vec2 wobble = 0.0015f * glm::vec2(swatch_noise(p, 24, 2, 90), swatch_noise(p, 24, 2, 91));
    const BrickPoint brick = brick_at(p + wobble, glm::vec2(4.0f), {16, 48}, 12);
    const float grain = swatch_noise(p, 64, 3, 13);
    const float face = smooth_step(0.006f, 0.016f, brick.edge);
    SurfacePoint point;
    const glm::vec3 clay = glm::mix(hex(0x9A4B33), hex(0xC07A52), random_part(brick.id, 0)) * (0.9f + 0.25f * grain);
    point.color = glm::mix(hex(0xB9A68A) * (0.85f + 0.2f * grain), clay, face);
    point.height = -0.022f + 0.010f * face + 0.003f * grain + 0.003f * random_part(brick.id, 8);
    point.roughness = 0.9f;
    point.occlusion = 0.55f + 0.45f * face;
    return point;
}

SurfacePoint lime_wash(glm::vec2 p, float coarse) {
    const float fine = swatch_noise(p, 48, 4, 22), blotch = swatch_noise(p, 6, 4, 23);
    // Rain draws the stains out downwards.
    const float streak = fractal_noise(p * glm::vec2(28.0f, 2.0f), {28, 2}, 3, 24);
    SurfacePoint point;
    point.color = glm::mix(hex(0xE2B878), hex(0xF1D6A2), smooth_step(-0.5f, 0.5f, blotch));
    point.color = glm::mix(point.color, hex(0xC98F5B), 0.45f * smooth_step(0.05f, 0.5f, streak));
    point.color *= 1.0f + 0.07f * fine + 0.05f * coarse;
    point.height = 0.0025f * fine + 0.004f * blotch;
    point.roughness = 0.88f;
    return point;
}

}  // namespace

BrickPoint brick_at(glm::vec2 p, glm::vec2 extent, glm::ivec2 count, uint32_t seed) {
    glm::vec2 q = p * glm::vec2(count);
    const int row = int(std::floor(q.y));
    q.x += (row & 1) != 0 ? 0.5f : 0.0f;
    const int column = int(std::floor(q.x));
    BrickPoint brick;
    brick.local = q - glm::vec2(column, row);
    const glm::vec2 to_edge = (0.5f - glm::abs(brick.local - 0.5f)) * extent / glm::vec2(count);
    brick.edge = std::min(to_edge.x, to_edge.y);
    brick.id = lattice_bits((column % count.x + count.x) % count.x, (row % count.y + count.y) % count.y, seed);
    return brick;
}

Surface cobblestones() {
    return square_surface(2.4f, 1024, [](glm::vec2 p) {
        const glm::vec2 warp(swatch_noise(p, 9, 3, 1), swatch_noise(p, 9, 3, 2));
        const CellPoint stone = cells(p * 14.0f + 0.22f * warp, glm::ivec2(14), 0.62f, 3);
        const float fine = swatch_noise(p, 40, 4, 4), patch = swatch_noise(p, 3, 3, 5);
        const float rise = smooth_step(0.035f, 0.17f, stone.edge);
        const float dome = rise * (1.0f - 0.45f * glm::dot(stone.from_center, stone.from_center));
        const glm::vec2 lean(random_part(stone.id, 16) - 0.5f, random_part(stone.id, 24) - 0.5f);

        glm::vec3 rock = glm::mix(hex(0x9C8E7A), hex(0xC7B396), random_part(stone.id, 0));
        rock = glm::mix(rock, random_part(stone.id, 8) < 0.5f ? hex(0xB8906C) : hex(0x8D8A84), 0.55f * random_part(stone.id, 12));
        rock *= 0.96f + 0.16f * fine;
        const glm::vec3 sand = hex(0x8F7D5F) * (0.82f + 0.25f * fine);
        const float moss = smooth_step(0.05f, 0.42f, patch + 0.25f * fine) * (1.0f - smooth_step(0.02f, 0.14f, stone.edge));

        SurfacePoint point;
        point.color = glm::mix(glm::mix(sand, rock, rise), hex(0x66702F) * (0.8f + 0.4f * fine), 0.85f * moss);
        const float settling = 0.022f * glm::dot(lean, stone.from_center) + 0.004f * random_part(stone.id, 4);
        point.height = 0.024f * dome + rise * settling + 0.003f * fine;
        point.roughness = glm::mix(0.95f, 0.56f + 0.16f * random_part(stone.id, 20) + 0.14f * fine, rise);
        point.occlusion = 0.42f + 0.58f * smooth_step(0.0f, 0.13f, stone.edge);
        return point;
    });
}

Surface ashlar() {
    return square_surface(3.2f, 1024, [](glm::vec2 p) {
        const glm::vec2 wobble = 0.0010f * glm::vec2(swatch_noise(p, 20, 3, 30), swatch_noise(p, 20, 3, 31));
        const BrickPoint block = brick_at(p + wobble, glm::vec2(3.2f), {4, 8}, 32);
        const float fine = swatch_noise(p, 48, 4, 33), coarse = swatch_noise(p, 7, 4, 34);
        const float pits = smooth_step(0.30f, 0.55f, swatch_noise(p, 70, 2, 35));
        const float face = smooth_step(0.004f, 0.020f, block.edge - 0.004f * coarse);

        SurfacePoint point;
        glm::vec3 stone = glm::mix(hex(0xC9B794), hex(0xE2D3B0), random_part(block.id, 0));
        stone = glm::mix(stone, hex(0xB79B78), 0.5f * random_part(block.id, 8) * random_part(block.id, 16));
        stone *= 1.0f + 0.07f * fine + 0.09f * coarse - 0.16f * pits;
        point.color = glm::mix(hex(0xA89677) * (0.92f + 0.1f * fine), stone, face);
        point.height = 0.012f * face + 0.002f * fine + 0.004f * coarse - 0.004f * pits + 0.003f * random_part(block.id, 24);
        point.roughness = 0.82f + 0.08f * fine;
        point.occlusion = (0.6f + 0.4f * face) * (1.0f - 0.25f * pits);
        return point;
    });
}

Surface limestone() {
    return square_surface(2.0f, 512, [](glm::vec2 p) {
        const float fine = swatch_noise(p, 32, 4, 40), coarse = swatch_noise(p, 4, 4, 41);
        const float vein = 1.0f - smooth_step(0.0f, 0.06f, std::abs(swatch_noise(p + 0.03f * coarse, 5, 4, 42)));
        const float pits = smooth_step(0.34f, 0.56f, swatch_noise(p, 56, 2, 43));
        SurfacePoint point;
        point.color = glm::mix(hex(0xDCCFB2), hex(0xEFE6CF), smooth_step(-0.4f, 0.4f, coarse)) * (1.0f + 0.05f * fine);
        point.color = glm::mix(point.color, hex(0xBFA98A), 0.35f * vein + 0.35f * pits);
        point.height = 0.0012f * fine + 0.002f * coarse - 0.0025f * pits;
        point.roughness = 0.66f + 0.12f * fine + 0.1f * pits;
        point.occlusion = 1.0f - 0.25f * pits;
        return point;
    });
}

Surface worn_plaster() {
    return square_surface(4.0f, 1024, [](glm::vec2 p) {
        const float coarse = swatch_noise(p, 3, 5, 20);
        const float fallen = coarse + 0.12f * swatch_noise(p, 20, 3, 21) - 0.34f;  // > 0 where the plaster is gone
        SurfacePoint wash = lime_wash(p, coarse);
        if (fallen <= -0.02f) {
            return wash;
        }
        const SurfacePoint brick = rubble_brick(p);
        const float t = smooth_step(-0.02f, 0.0f, fallen);
        // The broken edge of the coat is pale and catches the light.
        const float rim = 1.0f - smooth_step(0.0f, 0.03f, std::abs(fallen));
        wash.color = glm::mix(glm::mix(wash.color, brick.color, t), hex(0xF0E4CB), 0.6f * rim);
        wash.height = glm::mix(wash.height, brick.height, t);
        wash.roughness = glm::mix(wash.roughness, brick.roughness, t);
        wash.occlusion = glm::mix(1.0f, brick.occlusion * (0.7f + 0.3f * smooth_step(0.0f, 0.08f, fallen)), t);
        return wash;
    });
}

Surface roof_clay() {
    return square_surface(1.0f, 512, [](glm::vec2 p) {
        const float fine = swatch_noise(p, 24, 4, 50), coarse = swatch_noise(p, 4, 4, 51);
        const float lichen = smooth_step(0.28f, 0.42f, swatch_noise(p, 9, 4, 52));
        SurfacePoint point;
        point.color = glm::mix(hex(0xA9502F), hex(0xD68A58), smooth_step(-0.45f, 0.45f, coarse)) * (0.95f + 0.16f * fine);
        point.color = glm::mix(point.color, hex(0xC9BE93), 0.55f * lichen);
        point.height = 0.0015f * fine + 0.001f * lichen;
        point.roughness = 0.82f;
        return point;
    });
}

Surface terracotta() {
    return square_surface(1.0f, 512, [](glm::vec2 p) {
        // The potter's fingers leave rings; lime blooms in patches.
        const float rings = value_noise({0.5f, p.y * 64.0f}, {1, 64}, 60), fine = swatch_noise(p, 32, 4, 61);
        const float bloom = smooth_step(0.08f, 0.5f, swatch_noise(p, 5, 5, 62));
        SurfacePoint point;
        point.color = glm::mix(hex(0xB65D38), hex(0xCB7A4E), rings) * (0.97f + 0.1f * fine);
        point.color = glm::mix(point.color, hex(0xE3C2A2), 0.42f * bloom);
        point.height = 0.0012f * rings + 0.0008f * fine;
        point.roughness = 0.74f + 0.14f * bloom;
        return point;
    });
}

Surface garden_soil() {
    return square_surface(1.0f, 512, [](glm::vec2 p) {
        const CellPoint crumb = cells(p * 22.0f, glm::ivec2(22), 0.9f, 70);
        const float fine = swatch_noise(p, 40, 3, 71);
        const float lump = smooth_step(0.0f, 0.35f, crumb.edge);
        SurfacePoint point;
        point.color = glm::mix(hex(0x3B2A1D), hex(0x6B4E36), 0.6f * lump * (0.5f + random_part(crumb.id, 0)) + 0.2f * fine);
        point.height = 0.012f * lump + 0.004f * fine;
        point.roughness = 0.95f;
        point.occlusion = 0.5f + 0.5f * lump;
        return point;
    });
}

}  // namespace rawtexel::scenes
