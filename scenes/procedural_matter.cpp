#include "scenes/procedural_matter.h"

#include "scenes/builtin_assembly.h"
#include "scenes/procedural_noise.h"

#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>

namespace rawtexel::scenes {
namespace {

constexpr float kTau = 2.0f * glm::pi<float>();

/// Where a point lies in a honeycomb.
struct Hexagon {
    glm::vec2 from_center{0.0f};  ///< hexagon widths
    float edge = 0.0f;            ///< distance to the nearest wall, hexagon widths
    uint32_t id = 0;              ///< random bits of the hexagon
};

/// `p` in hexagon widths; the honeycomb repeats after `columns` x `rows`, rows even.
Hexagon hexagon_at(glm::vec2 p, int columns, int rows, uint32_t seed) {
    constexpr float kRowPitch = 0.8660254f;
    Hexagon best;
    float best_distance = 1e9f;
    const int row0 = int(std::floor(p.y / kRowPitch));
    for (int row = row0 - 1; row <= row0 + 1; ++row) {
        const float shift = (row & 1) != 0 ? 0.5f : 0.0f;
        const int column0 = int(std::floor(p.x - shift));
        for (int column = column0; column <= column0 + 1; ++column) {
            const glm::vec2 d = p - glm::vec2(float(column) + shift, float(row) * kRowPitch);
            if (const float distance = glm::dot(d, d); distance < best_distance) {
                best_distance = distance;
                best.from_center = d;
                best.id = lattice_bits((column % columns + columns) % columns, (row % rows + rows) % rows, seed);
            }
        }
    }
    const glm::vec2 d = glm::abs(best.from_center);
    best.edge = 0.5f - std::max(d.x, 0.5f * d.x + kRowPitch * d.y);
    return best;
}

/// One painted tile, quarter-symmetric: `q` in 0..1 from its middle to a corner. Returns the glaze.
glm::vec3 majolica(glm::vec2 q) {
    const glm::vec3 white = hex(0xF4EFE2), cobalt = hex(0x1F4E9E), sky = hex(0x7FA8D6), ochre = hex(0xE0A02C), leaf = hex(0x3E7F5A);
    const float r = glm::length(q), angle = std::atan2(q.y, q.x);
    const float petals = 0.44f + 0.16f * std::cos(8.0f * angle);
    const float corner = glm::length(q - 1.0f);
    const float diagonal = std::abs(q.x - q.y);
    glm::vec3 color = white;
    if (diagonal < 0.07f && r > 0.5f) {
        color = leaf;
    }
    if (corner < 0.52f) {
        color = cobalt;
    }
    if (corner < 0.44f) {
        color = white;
    }
    if (corner < 0.34f) {
        color = sky;
    }
    if (corner < 0.22f) {
        color = ochre;
    }
    if (r < petals + 0.05f) {
        color = cobalt;
    }
    if (r < petals - 0.03f) {
        color = sky;
    }
    if (r < 0.30f) {
        color = white;
    }
    if (r < 0.22f) {
        color = ochre;
    }
    if (r < 0.10f) {
        color = cobalt;
    }
    if (std::max(q.x, q.y) > 0.93f) {
        color = cobalt;
    }
    return color;
}

}  // namespace

Surface oak_planks() {
    return square_surface(1.2f, 1024, [](glm::vec2 p) {
        constexpr int kBoards = 6;
        const int board = int(p.x * kBoards);
        const float across = p.x * kBoards - float(board);
        const uint32_t id = lattice_bits(board, 0, 80);
        // Growth rings: stretched noise, a different cut in each board.
        const glm::vec2 grain_p(p.x * 48.0f, p.y * 3.0f + 17.0f * random_part(id, 0));
        const float rings = fractal_noise(grain_p, {48, 3}, 4, 81 + uint32_t(board));
        const float fibres = fractal_noise(p * glm::vec2(220.0f, 9.0f), {220, 9}, 2, 82);
        const float edge = std::min(across, 1.0f - across) * 0.2f;  // metres
        const float face = smooth_step(0.0015f, 0.010f, edge);

        SurfacePoint point;
        const glm::vec3 heartwood = glm::mix(hex(0x6E4526), hex(0xA9743F), smooth_step(-0.5f, 0.6f, rings));
        const glm::vec3 wood = heartwood * (0.86f + 0.3f * random_part(id, 8));
        point.color = glm::mix(hex(0x2A1A10), wood * (1.0f + 0.2f * fibres), face);
        point.height = 0.010f * face + 0.0016f * rings + 0.0008f * fibres;
        point.roughness = 0.62f - 0.08f * rings;
        point.occlusion = 0.4f + 0.6f * face;

        // Two rows of nails with domed iron heads.
        const glm::vec2 nail((across - 0.5f) * 0.2f, (p.y - std::floor(p.y * 2.0f) / 2.0f - 0.25f) * 1.2f);
        if (const float r = glm::length(nail); r < 0.017f) {
            point.color = hex(0x3B3835) * (1.0f + 0.3f * fibres);
            point.height = 0.012f + 0.010f * std::sqrt(1.0f - r * r / (0.017f * 0.017f));
            point.roughness = 0.42f;
            point.metallic = 1.0f;
        }
        return point;
    });
}

Surface painted_planks() {
    return square_surface(1.2f, 512, [oak = oak_planks().at](glm::vec2 p) {
        SurfacePoint point = oak(p);
        const float luminance = glm::dot(point.color, glm::vec3(0.3f, 0.6f, 0.1f));
        const float worn = smooth_step(0.22f, 0.42f, swatch_noise(p, 6, 5, 145) + 0.25f * (1.0f - point.occlusion));
        const glm::vec3 paint =
            glm::mix(hex(0x2C6E86), hex(0x4FA0AE), smooth_step(0.1f, 0.6f, luminance)) * (0.45f + 0.55f * point.occlusion);
        point.color = glm::mix(paint, point.color, 0.8f * worn);
        point.roughness = glm::mix(0.5f, point.roughness, worn);
        point.metallic = 0.0f;
        return point;
    });
}

Surface wrought_iron() {
    return square_surface(1.0f, 512, [](glm::vec2 p) {
        const float dents = swatch_noise(p, 14, 3, 90), fine = swatch_noise(p, 60, 3, 91);
        const float rust = smooth_step(0.12f, 0.4f, swatch_noise(p, 6, 5, 92) + 0.3f * fine);
        SurfacePoint point;
        point.color = glm::mix(hex(0x55524F) * (1.0f + 0.1f * fine), hex(0x6E4028) * (0.9f + 0.4f * fine), 0.7f * rust);
        point.height = 0.0022f * dents + 0.0005f * fine;
        point.roughness = glm::mix(0.44f + 0.12f * dents, 0.88f, rust);
        point.metallic = 1.0f - rust;
        return point;
    });
}

Surface aged_bronze() {
    return square_surface(1.0f, 512, [](glm::vec2 p) {
        const float dents = swatch_noise(p, 9, 4, 100), fine = swatch_noise(p, 52, 3, 101);
        const float patina = smooth_step(-0.05f, 0.12f, swatch_noise(p, 5, 5, 102) - 0.35f * dents);
        SurfacePoint point;
        const glm::vec3 metal = glm::mix(hex(0xC08A4A), hex(0xE2B26C), 0.5f + 0.5f * fine);
        const glm::vec3 verdigris = glm::mix(hex(0x3F7F74), hex(0x83B8A2), 0.5f + 0.7f * fine);
        point.color = glm::mix(metal, verdigris, patina);
        point.height = 0.003f * dents + 0.0008f * fine + 0.0008f * patina;
        point.roughness = glm::mix(0.28f + 0.1f * fine, 0.85f, patina);
        point.metallic = 1.0f - patina;
        return point;
    });
}

Surface glazed_tiles() {
    return square_surface(1.2f, 1024, [](glm::vec2 p) {
        constexpr int kTiles = 8;  // 15 cm
        const glm::vec2 q = p * float(kTiles), tile = glm::floor(q);
        const uint32_t id = lattice_bits(int(tile.x), int(tile.y), 110);
        const glm::vec2 local = q - tile;
        const glm::vec2 from_center = glm::abs(local - 0.5f) * 2.0f;
        const float edge = (1.0f - std::max(from_center.x, from_center.y)) * 0.075f;  // metres
        const float brush = swatch_noise(p, 64, 3, 111);
        const float glaze = smooth_step(0.0016f, 0.0040f, edge);

        SurfacePoint point;
        const glm::vec3 paint = majolica(from_center + 0.012f * brush) * (0.93f + 0.07f * random_part(id, 0) + 0.05f * brush);
        point.color = glm::mix(hex(0xC9BCA2), paint, glaze);
        const glm::vec2 lean = glm::vec2(random_part(id, 8), random_part(id, 16)) - 0.5f;
        point.height = 0.003f * glaze + 0.0016f * glm::dot(lean, local - 0.5f) + 0.0004f * swatch_noise(p, 24, 2, 112);
        point.roughness = glm::mix(0.9f, 0.16f + 0.1f * random_part(id, 24), glaze);
        point.occlusion = 0.7f + 0.3f * glaze;
        return point;
    });
}

Surface rippled_water() {
    return square_surface(2.0f, 512, [](glm::vec2 p) {
        const float warp = swatch_noise(p, 4, 3, 120);
        const float waves = swatch_noise(p + 0.02f * warp, 8, 3, 121);
        SurfacePoint point;
        point.color = hex(0x2F6F73);
        point.alpha = 0.62f;
        point.height = 0.010f * waves;
        point.roughness = 0.06f;
        return point;
    });
}

Surface hammered_ceramic() {
    return square_surface(2.0f, 1024, [](glm::vec2 p) {
        // Eight hexagons wide; eight rows of 0.866 stretched a little so that the swatch closes.
        constexpr int kColumns = 8, kRows = 10;
        const Hexagon tile = hexagon_at({p.x * kColumns, p.y * kRows * 0.8660254f}, kColumns, kRows, 130);
        const CellPoint blow = cells(p * 40.0f, glm::ivec2(40), 0.85f, 131);
        const float fine = swatch_noise(p, 90, 2, 132), cloud = swatch_noise(p, 5, 4, 133);
        const float glaze = smooth_step(0.012f, 0.05f, tile.edge);
        // Each blow leaves a shallow bowl; bowls meet in ridges.
        const float bowl = glm::dot(blow.from_center, blow.from_center);

        SurfacePoint point;
        static const glm::vec3 kTeal = hex(0x0F5560), kNavy = hex(0x1A2F5F), kJade = hex(0x1F6B58), kPlum = hex(0x47305E);
        const float pick = random_part(tile.id, 0);
        glm::vec3 color = pick < 0.4f ? kTeal : pick < 0.7f ? kNavy : pick < 0.9f ? kJade : kPlum;
        color *= 0.85f + 0.35f * random_part(tile.id, 8) + 0.18f * cloud;
        point.color = glm::mix(hex(0xB59A5E), color, glaze);
        point.height = 0.0085f * bowl * glaze + 0.006f * glaze + 0.0004f * fine;
        point.roughness = glm::mix(0.42f, 0.10f + 0.06f * random_part(tile.id, 16), glaze);
        point.metallic = 1.0f - glaze;  // brass inlay in the joints
        point.occlusion = 0.75f + 0.25f * glaze;
        return point;
    });
}

Surface sculpted_stucco() {
    return square_surface(1.0f, 512, [](glm::vec2 p) {
        const CellPoint scroll = cells(p * 5.0f, glm::ivec2(5), 0.75f, 140);
        const float r = glm::length(scroll.from_center);
        const float turn = std::atan2(scroll.from_center.y, scroll.from_center.x);
        const float wave = std::sin(26.0f * r - turn + kTau * random_part(scroll.id, 0));
        const float fade = smooth_step(0.0f, 0.12f, scroll.edge);
        const float fine = swatch_noise(p, 40, 3, 141);
        SurfacePoint point;
        point.color = glm::mix(hex(0xD8C9AE), hex(0xF3EADA), 0.5f + 0.4f * wave * fade) * (1.0f + 0.04f * fine);
        point.height = 0.004f * wave * fade + 0.0008f * fine;
        point.roughness = 0.7f;
        point.occlusion = 0.8f + 0.2f * wave * fade;
        return point;
    });
}

}  // namespace rawtexel::scenes
