#include "scenes/procedural_plants.h"

#include "scenes/builtin_assembly.h"
#include "scenes/procedural_noise.h"

#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace rawtexel::scenes {
namespace {

constexpr int kTexels = 512;
constexpr float kTau = 2.0f * glm::pi<float>();

/// A leaf on a card; lengths in card widths, y downwards.
struct Leaf {
    glm::vec2 base{0.0f}, along{0.0f};  ///< where it starts; unit direction
    float length = 0.0f, width = 0.0f;  ///< width: half of the widest
    glm::vec3 color{0.0f};
    bool lobed = false;
};

/// Half width of a leaf at `t` of its length.
float half_width(const Leaf& leaf, float t) {
    if (leaf.lobed) {
        // Ivy: three points, the middle one longest.
        const float body = std::sqrt(std::max(0.0f, t)) * std::pow(std::max(0.0f, 1.0f - t), 0.9f) * 1.9f;
        const float lobes = std::max(0.0f, 1.0f - std::abs(t - 0.28f) * 5.0f) * 0.55f;
        return leaf.width * (body * 0.75f + lobes);
    }
    return leaf.width * 2.1f * std::sqrt(std::max(0.0f, t)) * std::max(0.0f, 1.0f - t) * (1.0f + 0.5f * t);
}

/// Paints `leaf` over `point` where it covers `p`.
void paint_leaf(const Leaf& leaf, glm::vec2 p, SurfacePoint& point) {
    const glm::vec2 d = p - leaf.base;
    const float t = glm::dot(d, leaf.along) / leaf.length;
    if (t <= 0.0f || t >= 1.0f) {
        return;
    }
    const float across = d.x * leaf.along.y - d.y * leaf.along.x;
    const float inside = half_width(leaf, t) - std::abs(across);
    if (inside <= -0.5f / float(kTexels)) {
        return;
    }
    // Midrib and side veins are paler, one half of the blade catches more light.
    const float veins = 0.5f + 0.5f * std::sin((t * leaf.length - std::abs(across) * 0.8f) * kTau * 45.0f);
    const float rib = smooth_step(0.0045f, 0.0015f, std::abs(across));
    const float shade = (across > 0.0f ? 1.04f : 0.92f) + 0.06f * veins;
    point.color = glm::mix(leaf.color * shade, leaf.color * 1.25f + 0.05f, 0.6f * rib);
    point.alpha = std::max(point.alpha, std::clamp(inside * float(kTexels) + 0.5f, 0.0f, 1.0f));
}

/// A thin stem between two points.
void paint_stem(glm::vec2 a, glm::vec2 b, float radius, glm::vec3 color, glm::vec2 p, SurfacePoint& point) {
    const glm::vec2 ab = b - a;
    const float t = std::clamp(glm::dot(p - a, ab) / glm::dot(ab, ab), 0.0f, 1.0f);
    const float inside = radius - glm::distance(p, a + t * ab);
    if (inside > -0.5f / float(kTexels)) {
        point.color = color;
        point.alpha = std::max(point.alpha, std::clamp(inside * float(kTexels) + 0.5f, 0.0f, 1.0f));
    }
}

struct SprayStyle {
    int pairs;  ///< leaves on each side of the stem
    float length, width;
    float spread;  ///< radians between stem and leaves at the foot of the spray
    std::array<glm::vec3, 3> colors;
    uint32_t seed;
};

/// Leaves along a stem from the lower edge upwards, later ones over earlier ones.
std::vector<Leaf> grow_spray(const SprayStyle& style) {
    std::vector<Leaf> leaves;
    for (int i = 0; i <= 2 * style.pairs; ++i) {
        const float t = float(i) / float(2 * style.pairs);
        const float random = lattice_float(i, 0, style.seed), other = lattice_float(i, 1, style.seed);
        const float side = (i & 1) != 0 ? 1.0f : -1.0f;
        const float angle = side * style.spread * (1.0f - 0.8f * t * t) * (0.75f + 0.5f * random);
        Leaf leaf;
        leaf.base = {0.5f + 0.05f * std::sin(3.0f * t), 0.94f - 0.62f * t};
        leaf.along = {std::sin(angle), -std::cos(angle)};
        leaf.length = style.length * (0.8f + 0.35f * other) * (1.0f - 0.25f * t);
        leaf.width = style.width * (0.85f + 0.3f * random) * (1.0f - 0.25f * t);
        leaf.color = style.colors[lattice_bits(i, 2, style.seed) % 3] * (0.85f + 0.3f * lattice_float(i, 3, style.seed));
        leaves.push_back(leaf);
    }
    return leaves;
}

/// A card on which nothing has been painted.
SurfacePoint bare(glm::vec3 surroundings) {
    SurfacePoint point;
    point.color = surroundings;
    point.alpha = 0.0f;
    return point;
}

Surface spray(const SprayStyle& style) {
    return square_surface(0.5f, kTexels, [leaves = grow_spray(style), surroundings = style.colors[1] * 0.9f](glm::vec2 p) {
        SurfacePoint point = bare(surroundings);
        paint_stem({0.5f, 1.0f}, {0.54f, 0.35f}, 0.007f, hex(0x6B5A36), p, point);
        for (const Leaf& leaf : leaves) {
            paint_leaf(leaf, p, point);
        }
        return point;
    });
}

/// Leaves of any direction over the whole card, kept clear of its rim.
std::vector<Leaf> scatter(int count, float length, float width, bool lobed, const std::array<glm::vec3, 3>& colors, uint32_t seed) {
    std::vector<Leaf> leaves;
    for (int i = 0; i < count; ++i) {
        const float angle = kTau * lattice_float(i, 0, seed);
        Leaf leaf;
        leaf.length = length * (0.7f + 0.5f * lattice_float(i, 1, seed));
        leaf.width = width * leaf.length / length;
        leaf.along = {std::sin(angle), std::cos(angle)};
        const glm::vec2 middle(lattice_float(i, 2, seed), lattice_float(i, 3, seed));
        leaf.base = glm::mix(glm::vec2(0.5f * length), glm::vec2(1.0f - 0.5f * length), middle) - 0.5f * leaf.length * leaf.along;
        leaf.color = colors[lattice_bits(i, 4, seed) % 3] * (0.8f + 0.4f * lattice_float(i, 5, seed));
        leaf.lobed = lobed;
        leaves.push_back(leaf);
    }
    return leaves;
}

struct Blade {
    float base = 0.0f, lean = 0.0f, height = 0.0f, width = 0.0f;
    glm::vec3 color{0.0f};
};

std::vector<Blade> grow_blades(int count, float height, uint32_t seed) {
    std::vector<Blade> blades;
    for (int i = 0; i < count; ++i) {
        Blade blade;
        blade.base = 0.12f + 0.76f * lattice_float(i, 0, seed);
        blade.lean = 0.5f * (lattice_float(i, 1, seed) - 0.5f) + 0.35f * (blade.base - 0.5f);
        blade.lean = std::clamp(blade.lean, 0.02f - blade.base, 0.98f - blade.base);
        blade.height = height * (0.45f + 0.55f * lattice_float(i, 2, seed));
        blade.width = 0.010f + 0.010f * lattice_float(i, 3, seed);
        static const std::array<glm::vec3, 4> kGreens{hex(0x8FB542), hex(0xA6C64E), hex(0xC6CC64), hex(0x76A03A)};
        blade.color = kGreens[lattice_bits(i, 4, seed) % 4];
        blades.push_back(blade);
    }
    return blades;
}

void paint_blade(const Blade& blade, glm::vec2 p, SurfacePoint& point) {
    const float t = (1.0f - p.y) / blade.height;
    if (t >= 1.0f) {
        return;
    }
    const float inside = blade.width * (1.0f - t * t) - std::abs(p.x - blade.base - blade.lean * t * t);
    if (inside > -0.5f / float(kTexels)) {
        point.color = blade.color * (0.62f + 0.42f * t);
        point.alpha = std::max(point.alpha, std::clamp(inside * float(kTexels) + 0.5f, 0.0f, 1.0f));
    }
}

struct Flower {
    glm::vec2 center{0.0f}, foot{0.0f};
    float radius = 0.0f;
    int kind = 0;
};

std::vector<Flower> grow_flowers(int count, uint32_t seed) {
    std::vector<Flower> flowers;
    for (int i = 0; i < count; ++i) {
        Flower flower;
        flower.kind = (i * 3 + 1) % 4;  // all kinds in turn
        flower.center = {0.1f + 0.8f * lattice_float(i, 1, seed), 0.1f + 0.42f * lattice_float(i, 2, seed)};
        flower.foot = {0.5f + 0.6f * (flower.center.x - 0.5f), 1.0f};
        flower.radius = (flower.kind < 2 ? 0.075f : 0.055f) * (0.8f + 0.4f * lattice_float(i, 3, seed));
        flowers.push_back(flower);
    }
    return flowers;
}

/// Poppy (0, 1), daisy (2), cornflower (3).
void paint_flower(const Flower& flower, glm::vec2 p, SurfacePoint& point) {
    paint_stem(flower.foot, flower.center, 0.006f, hex(0x66863C), p, point);
    const glm::vec2 d = p - flower.center;
    const float r = glm::length(d) / flower.radius, angle = std::atan2(d.y, d.x);
    const float rays = flower.kind == 2 ? 11.0f : 9.0f;
    const float petals = flower.kind < 2 ? 0.92f + 0.08f * std::cos(4.0f * angle) : 0.72f + 0.28f * std::cos(rays * angle);
    if (r > petals) {
        return;
    }
    const glm::vec3 petal = flower.kind < 2 ? hex(0xE23B22) : flower.kind == 2 ? hex(0xFAF6EA) : hex(0x4A63D0);
    const glm::vec3 heart = flower.kind < 2 ? hex(0x2B1620) : flower.kind == 2 ? hex(0xF2B81F) : hex(0x2C2F86);
    point.color = r < 0.28f ? heart : petal * (0.75f + 0.3f * r);
    point.alpha = 1.0f;
}

}  // namespace

Surface leaf_spray() {
    return spray({.pairs = 11,
                  .length = 0.30f,
                  .width = 0.062f,
                  .spread = 1.25f,
                  .colors = {hex(0x7FA033), hex(0x64862C), hex(0x9BB548)},
                  .seed = 300});
}

Surface olive_spray() {
    return spray({.pairs = 14,
                  .length = 0.27f,
                  .width = 0.026f,
                  .spread = 1.0f,
                  .colors = {hex(0x7F9467), hex(0x5F7A4D), hex(0xA3B28A)},
                  .seed = 310});
}

Surface ivy_spray() {
    const std::array<glm::vec3, 3> colors{hex(0x3F6B2C), hex(0x2F5526), hex(0x5E8A3A)};
    return square_surface(0.6f, kTexels, [leaves = scatter(58, 0.22f, 0.075f, true, colors, 320), colors](glm::vec2 p) {
        SurfacePoint point = bare(colors[1]);
        for (const Leaf& leaf : leaves) {
            paint_leaf(leaf, p, point);
        }
        return point;
    });
}

Surface blossom_spray() {
    const std::array<glm::vec3, 3> greens{hex(0x4E7B33), hex(0x6B9440), hex(0x3B6229)};
    const std::array<glm::vec3, 3> bracts{hex(0xD0307F), hex(0xE85AA0), hex(0xB3206B)};
    std::vector<Leaf> leaves = scatter(26, 0.22f, 0.055f, false, greens, 330);
    const std::vector<Leaf> flowers = scatter(46, 0.14f, 0.050f, false, bracts, 331);
    leaves.insert(leaves.end(), flowers.begin(), flowers.end());
    return square_surface(0.5f, kTexels, [leaves = std::move(leaves), surroundings = bracts[2]](glm::vec2 p) {
        SurfacePoint point = bare(surroundings);
        for (const Leaf& leaf : leaves) {
            paint_leaf(leaf, p, point);
        }
        return point;
    });
}

Surface grass_tuft() {
    return square_surface(0.5f, kTexels, [blades = grow_blades(44, 0.98f, 340)](glm::vec2 p) {
        SurfacePoint point = bare(hex(0x5E7F36));
        for (const Blade& blade : blades) {
            paint_blade(blade, p, point);
        }
        return point;
    });
}

Surface flower_tuft() {
    return square_surface(0.5f, kTexels, [blades = grow_blades(26, 0.7f, 350), flowers = grow_flowers(12, 351)](glm::vec2 p) {
        SurfacePoint point = bare(hex(0x5E7F36));
        for (const Blade& blade : blades) {
            paint_blade(blade, p, point);
        }
        for (const Flower& flower : flowers) {
            paint_flower(flower, p, point);
        }
        return point;
    });
}

Surface bark() {
    return square_surface(1.0f, 512, [](glm::vec2 p) {
        const glm::vec2 warp(swatch_noise(p, 8, 3, 360), swatch_noise(p, 8, 3, 361));
        const CellPoint plate = cells(p * glm::vec2(16.0f, 6.0f) + 0.5f * warp, {16, 6}, 0.85f, 362);
        const float fine = swatch_noise(p, 48, 3, 363);
        const float ridge = smooth_step(0.02f, 0.30f, plate.edge);
        SurfacePoint point;
        point.color = glm::mix(hex(0x3E2F24), hex(0x8F7C66), ridge * (0.7f + 0.3f * random_part(plate.id, 0))) * (1.0f + 0.2f * fine);
        point.height = 0.020f * ridge + 0.004f * fine;
        point.roughness = 0.92f;
        point.occlusion = 0.45f + 0.55f * ridge;
        return point;
    });
}

Surface meadow_ground() {
    return square_surface(4.0f, 1024, [](glm::vec2 p) {
        const float fine = swatch_noise(p, 128, 3, 370), blades = fractal_noise(p * glm::vec2(160.0f, 60.0f), {160, 60}, 2, 371);
        const float patch = swatch_noise(p, 4, 4, 372), flowers = swatch_noise(p, 110, 1, 373);
        SurfacePoint point;
        point.color = glm::mix(hex(0x638030), hex(0x90AA48), smooth_step(-0.5f, 0.5f, patch + 0.6f * blades));
        point.color = glm::mix(point.color, hex(0xB5A868), 0.5f * smooth_step(0.1f, 0.6f, swatch_noise(p, 6, 3, 374)));
        point.color *= 0.92f + 0.35f * fine;
        if (flowers > 0.62f) {
            point.color = patch > 0.0f ? hex(0xE8DFC4) : hex(0xD9563A);
        }
        point.height = 0.02f * blades + 0.01f * fine;
        point.roughness = 0.95f;
        point.occlusion = 0.8f + 0.2f * smooth_step(-0.5f, 0.2f, blades);
        return point;
    });
}

}  // namespace rawtexel::scenes
