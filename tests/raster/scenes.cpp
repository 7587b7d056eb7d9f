#include "tests/raster/scenes.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace rawtexel::raster::testing {

namespace {

/// A triangle before the camera, or about it.
void add_random_triangle(std::mt19937& random, Mesh& mesh) {
    const float size = std::exp2(uniform(random, -6, random() % 16 == 0 ? 4.0f : 1.0f));
    const glm::vec3 middle(uniform(random, -4, 4), uniform(random, -4, 4), uniform(random, -8, 0.5f));
    const auto corner = [&] { return middle + size * glm::vec3(uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1)); };
    mesh.add(corner(), corner(), corner());
}

void repeat_some_triangles(std::mt19937& random, const Mesh& from, Mesh& to) {
    for (size_t t = 0; t + 2 < from.indices.size(); t += 3) {
        if (random() % 3 != 0) continue;
        std::array<glm::vec3, 3> corner;
        for (size_t i = 0; i < 3; ++i) corner[i] = from.positions[from.indices[t + i]];
        std::shuffle(corner.begin(), corner.end(), random);
        to.add(corner[0], corner[1], corner[2]);
    }
}

}  // namespace

MixedScene::MixedScene(uint32_t seed, int triangles_per_draw) : meshes(6) {
    std::mt19937 random(seed);
    for (size_t i = 0; i < meshes.size(); ++i) {
        for (int t = 0; t < triangles_per_draw; ++t) add_random_triangle(random, meshes[i]);
        if (i > 0) repeat_some_triangles(random, meshes[i - 1], meshes[i]);
    }
    uint32_t id = 0;
    for (size_t i = 0; i < meshes.size(); ++i) {
        draws.push_back(meshes[i].draw(perspective(1.5f, 1, 0.1f)));
        draws[i].coverage = CoverageClass((i + 1) % 3);
        draws[i].cull = i % 2 ? CullMode::Back : CullMode::None;
        draws[i].first_triangle_id = id;
        id += draws[i].triangle_count + 5;
    }
}

bool covers_by_hash(const SetupTriangle& triangle, int x, int y) {
    uint32_t hash = triangle.triangle_id * 0x9E3779B9u ^ uint32_t(x) * 0x85EBCA6Bu ^ uint32_t(y) * 0xC2B2AE35u;
    hash = (hash ^ (hash >> 15)) * 0x2C1B3C6Du;
    return (hash >> 16 & 1u) != 0;
}

uint32_t cover_by_hash(const CandidateWave& wave) {
    uint32_t covered = 0;
    for (uint32_t rest = wave.mask; rest != 0; rest &= rest - 1) {
        const int lane = std::countr_zero(rest);
        covered |= uint32_t(covers_by_hash(*wave.triangle, wave.x + lane % 8, wave.y + lane / 8)) << lane;
    }
    return covered;
}

}  // namespace rawtexel::raster::testing
