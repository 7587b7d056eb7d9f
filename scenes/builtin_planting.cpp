#include "scenes/builtin_planting.h"

#include "scenes/procedural_noise.h"
#include "scenes/shapes.h"

#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace rawtexel::scenes {
namespace {

constexpr float kTau = 2.0f * glm::pi<float>();

/// A direction spread evenly over the sphere.
glm::vec3 random_direction(int x, int y, uint32_t seed) {
    const float height = 2.0f * lattice_float(x, y, seed) - 1.0f, angle = kTau * lattice_float(x, y, seed + 1);
    const float ring = std::sqrt(std::max(0.0f, 1.0f - height * height));
    return {ring * std::sin(angle), height, ring * std::cos(angle)};
}

/// Some direction across `axis`, turned by `turn` (0..1 of a circle).
glm::vec3 random_across(glm::vec3 axis, float turn) {
    const glm::vec3 helper = std::abs(axis.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
    const glm::vec3 a = glm::normalize(glm::cross(axis, helper)), b = glm::cross(axis, a);
    return a * std::cos(kTau * turn) + b * std::sin(kTau * turn);
}

/// Leaves around `center`, pointing outwards, darker on the side that faces the middle of the crown.
struct Cluster {
    glm::vec3 center, crown_center, radius;
    int cards;
    float card;
    uint32_t seed;
};

void append_cluster(shading::Mesh& leaves, const Cluster& cluster) {
    for (int i = 0; i < cluster.cards; ++i) {
        const glm::vec3 out = random_direction(i, 0, cluster.seed);
        const float reach = std::sqrt(0.25f + 0.75f * lattice_float(i, 2, cluster.seed));
        const glm::vec3 from_crown = cluster.center + out * cluster.radius - cluster.crown_center;
        const float size = cluster.card * (0.75f + 0.5f * lattice_float(i, 3, cluster.seed));
        Card card;
        card.up = glm::normalize(out + 0.55f * random_direction(i, 4, cluster.seed) + glm::vec3(0, -0.15f, 0)) * size;
        card.right = random_across(glm::normalize(card.up), lattice_float(i, 6, cluster.seed)) * size;
        card.foot = cluster.center + out * cluster.radius * reach - 0.5f * card.up;
        card.normal = glm::normalize(out + 0.8f * glm::normalize(from_crown + glm::vec3(0, 0.2f, 0)) + glm::vec3(0, 0.35f, 0));
        // Less light reaches what lies deep or low.
        const float facing_out = glm::dot(out, glm::normalize(from_crown + 1e-4f));
        const float open = (0.62f + 0.38f * facing_out) * (0.55f + 0.45f * reach);
        const float low = 0.78f + 0.22f * smooth_step(-1.0f, 0.4f, out.y);
        const float hue = lattice_float(i, 7, cluster.seed);
        card.tint = glm::vec3(0.85f + 0.30f * hue, 1.0f, 0.85f) * (open * low * (0.85f + 0.3f * lattice_float(i, 8, cluster.seed)));
        append_card(leaves, card);
    }
}

/// A path that leaves `from` along `first` and bends towards `to`.
std::array<glm::vec3, 6> bent_path(glm::vec3 from, glm::vec3 first, glm::vec3 to) {
    std::array<glm::vec3, 6> path;
    const glm::vec3 handle = from + first * (0.5f * glm::distance(from, to));
    for (size_t i = 0; i < path.size(); ++i) {
        const float t = float(i) / float(path.size() - 1);
        path[i] = glm::mix(glm::mix(from, handle, t), glm::mix(handle, to, t), t);
    }
    return path;
}

}  // namespace

void append_card(shading::Mesh& mesh, const Card& card) {
    const glm::vec3 corner = card.foot - 0.5f * card.right;
    for (const bool back : {false, true}) {
        append_patch(mesh, 1, 1, [&](float s, float t) {
            const float across = back ? 1.0f - s : s;
            return ShapePoint{corner + across * card.right + t * card.up, card.normal, card.right, {across, 1.0f - t}, back};
        });
    }
    tint(mesh, [&](glm::vec3, glm::vec3) { return card.tint; });
}

Tree grow_tree(const TreeStyle& style) {
    Tree tree;
    const glm::vec3 crown_center(0.0f, style.height - style.crown_radius.y, 0.0f);
    const glm::vec3 fork(0.06f * style.height * (lattice_float(0, 0, style.seed) - 0.5f), 0.42f * style.height, 0.0f);
    const glm::vec3 top = crown_center + glm::vec3(fork.x, 0.3f * style.crown_radius.y, 0.0f);
    append_tube(tree.wood, bent_path({0, -0.15f, 0}, {0, 1, 0}, top), style.trunk_radius, 0.25f * style.trunk_radius, 12, 2.0f, 1.0f);
    for (int i = 0; i < style.clusters; ++i) {
        // Cluster centres wind down the crown by the golden angle, well apart.
        const float t = (float(i) + 0.5f) / float(style.clusters);
        const float height = 1.0f - 1.75f * t, angle = 2.39996f * float(i) + lattice_float(i, 1, style.seed);
        const float ring = std::sqrt(std::max(0.0f, 1.0f - height * height)) * (0.62f + 0.28f * lattice_float(i, 2, style.seed));
        const glm::vec3 around(ring * std::sin(angle), 0.72f * height, ring * std::cos(angle));
        const glm::vec3 center = crown_center + style.crown_radius * around;
        const float swell = style.cluster_radius * (0.8f + 0.4f * lattice_float(i, 3, style.seed));
        append_cluster(tree.leaves, {center, crown_center, glm::vec3(1.0f, 0.78f, 1.0f) * swell, style.cards, style.card,
                                     style.seed * 977u + uint32_t(i) * 31u});
        const glm::vec3 from = glm::mix(fork, crown_center, 0.6f * (1.0f - t));
        append_tube(tree.wood, bent_path(from, glm::normalize(center - from + glm::vec3(0, 0.8f, 0)), center), 0.32f * style.trunk_radius,
                    0.04f * style.trunk_radius, 6, 1.0f, 1.0f);
    }
    return tree;
}

shading::Mesh tuft_patch(int tufts, float extent, float height, float width, uint32_t seed) {
    shading::Mesh mesh;
    for (int i = 0; i < tufts; ++i) {
        const float angle = glm::pi<float>() * lattice_float(i, 0, seed), grow = 0.7f + 0.6f * lattice_float(i, 1, seed);
        Card card;
        card.foot = {extent * (lattice_float(i, 2, seed) - 0.5f), -0.02f, extent * (lattice_float(i, 3, seed) - 0.5f)};
        card.up = {0.12f * height * (lattice_float(i, 4, seed) - 0.5f), height * grow, 0.12f * height * (lattice_float(i, 5, seed) - 0.5f)};
        card.normal = glm::normalize(glm::vec3(0.5f * (lattice_float(i, 6, seed) - 0.5f), 1.0f, 0.5f * (lattice_float(i, 7, seed) - 0.5f)));
        card.tint = glm::vec3(0.8f + 0.2f * lattice_float(i, 8, seed), 1.0f, 0.9f) * (0.9f + 0.1f * lattice_float(i, 9, seed));
        for (const float turn : {0.0f, glm::half_pi<float>()}) {
            card.right = glm::vec3(std::cos(angle + turn), 0.0f, std::sin(angle + turn)) * (width * grow);
            append_card(mesh, card);
        }
    }
    return mesh;
}

shading::Mesh creeper(std::span<const glm::vec3> runs, int cards_per_square_metre, float card_size, uint32_t seed) {
    shading::Mesh mesh;
    int index = 0;
    for (const glm::vec3& run : runs) {
        const int cards = std::max(1, int(glm::pi<float>() * run.z * run.z * float(cards_per_square_metre)));
        for (int i = 0; i < cards; ++i, ++index) {
            const float r = run.z * std::sqrt(lattice_float(index, 0, seed)), angle = kTau * lattice_float(index, 1, seed);
            const float size = card_size * (0.7f + 0.6f * lattice_float(index, 2, seed));
            const glm::vec3 out = random_direction(index, 3, seed);
            Card card;
            card.up = glm::normalize(glm::vec3(0.6f * out.x, 0.8f + 0.4f * out.y, 0.25f * out.z)) * size;
            card.right = glm::normalize(glm::cross(card.up, glm::vec3(0.35f * out.y, 0.3f * out.x, 1.0f))) * size;
            const float depth = 0.03f + 0.10f * lattice_float(index, 5, seed);
            card.foot = glm::vec3(run.x + r * std::sin(angle), run.y + r * std::cos(angle), depth) - 0.5f * card.up;
            card.normal = glm::normalize(glm::vec3(0.5f * out.x, 0.35f + 0.3f * out.y, 1.0f));
            card.tint = glm::vec3(0.9f + 0.25f * lattice_float(index, 6, seed), 1.0f, 0.9f) * (0.55f + 4.0f * depth);
            append_card(mesh, card);
        }
    }
    return mesh;
}

shading::Mesh leaf_ball(glm::vec3 radius, int cards, float card, uint32_t seed) {
    shading::Mesh mesh;
    append_cluster(mesh, {glm::vec3(0.0f), glm::vec3(0.0f, -0.3f * radius.y, 0.0f), radius, cards, card, seed});
    return mesh;
}

}  // namespace rawtexel::scenes
