#include "scenes/builtin_courtyard.h"
#include "scenes/builtin_fittings.h"
#include "scenes/builtin_planting.h"
#include "scenes/procedural_noise.h"
#include "scenes/shapes.h"

#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace rawtexel::scenes {
namespace {

const glm::vec3 kFountainCenter(-0.9f, 0.0f, -0.6f);

glm::mat4 moved(glm::vec3 by) { return glm::translate(glm::mat4(1.0f), by); }

/// The floor is darker where walls, steps and the fountain rise from it.
float floor_openness(glm::vec3 p, glm::vec3) {
    const float to_step = std::min(p.x + kCourt, p.z + kCourt), to_wall = kCourt - p.x;
    const float to_fountain = std::max(0.0f, glm::distance(glm::vec2(p.x, p.z), glm::vec2(kFountainCenter.x, kFountainCenter.z)) - 1.86f);
    const auto shade = [](float distance, float reach) { return std::exp(-std::max(distance, 0.0f) / reach); };
    return 0.95f - 0.30f * shade(to_step, 0.5f) - 0.35f * shade(to_wall, 0.6f) - 0.35f * shade(to_fountain, 0.25f);
}

float fountain_openness(glm::vec3 p, glm::vec3 normal) {
    const float r = glm::length(glm::vec2(p.x, p.z));
    const float inside = r < 1.45f && p.y < 0.46f ? 0.45f : 0.92f;
    const float under_bowl = r < 0.5f && p.y < 1.15f ? 0.75f : 1.0f;
    return inside * under_bowl * (normal.y < -0.2f ? 0.55f : 1.0f) * (0.75f + 0.25f * smooth_step(0.0f, 0.3f, p.y));
}

float free_standing(glm::vec3 p, glm::vec3 normal) { return (0.80f + 0.15f * normal.y) * (0.65f + 0.35f * smooth_step(0.0f, 0.35f, p.y)); }

/// Oranges hung among the leaves of a crown.
shading::Mesh oranges(glm::vec3 center, glm::vec3 radius, int count, uint32_t seed) {
    shading::Mesh mesh, orange;
    append_sphere(orange, 0.045f, 14, 9, {1.0f, 1.0f});
    for (int i = 0; i < count; ++i) {
        const float height = 1.6f * lattice_float(i, 0, seed) - 0.9f, angle = 2.0f * glm::pi<float>() * lattice_float(i, 1, seed);
        const float ring = std::sqrt(std::max(0.0f, 1.0f - height * height));
        append_mesh(mesh, orange, moved(center + radius * glm::vec3(ring * std::sin(angle), height, ring * std::cos(angle))));
    }
    return mesh;
}

struct PotMeshes {
    uint32_t pot, soil;
};

PotMeshes make_pot(Courtyard& court, const std::string& name, float height, float radius) {
    shading::Mesh pot, soil;
    append_pot(pot, height, radius);
    append_disc(soil, 0.88f * height, 0.86f * radius, 24, 1.0f);
    return {court.add(name, court.materials().terracotta, std::move(pot), free_standing),
            court.add(name + " soil", court.materials().soil, std::move(soil), [](glm::vec3, glm::vec3) { return 0.6f; })};
}

void place_pot(Courtyard& court, const PotMeshes& pot, glm::vec3 at, float turn) {
    const glm::mat4 m = glm::rotate(moved(at), turn, glm::vec3(0, 1, 0));
    court.place(pot.pot, m);
    court.place(pot.soil, m);
}

/// An orange tree in a large pot.
void build_orange_trees(Courtyard& court) {
    const CourtyardMaterials& m = court.materials();
    const TreeStyle style{.height = 2.15f,
                          .crown_radius = {0.72f, 0.68f, 0.72f},
                          .trunk_radius = 0.05f,
                          .clusters = 16,
                          .cards = 34,
                          .cluster_radius = 0.30f,
                          .card = 0.24f,
                          .seed = 520};
    Tree tree = grow_tree(style);
    const glm::vec3 crown(0.0f, style.height - style.crown_radius.y, 0.0f);
    const Openness open = [](glm::vec3, glm::vec3) { return 0.6f; };
    const std::array<uint32_t, 3> parts{court.add("orange wood", m.bark, std::move(tree.wood), open),
                                        court.add("orange leaves", m.leaves, std::move(tree.leaves), open),
                                        court.add("oranges", m.fruit, oranges(crown, style.crown_radius * 0.98f, 42, 530), open)};
    const PotMeshes pot = make_pot(court, "large pot", 0.62f, 0.40f);
    static constexpr std::array<glm::vec3, 4> kPlaces{glm::vec3{-4.6f, 0, -4.6f}, {3.9f, 0, -4.7f}, {-4.7f, 0, 2.4f}, {1.5f, 0, -4.9f}};
    for (size_t i = 0; i < kPlaces.size(); ++i) {
        place_pot(court, pot, kPlaces[i], float(i));
        for (const uint32_t part : parts) {
            court.place(part, glm::rotate(moved(kPlaces[i] + glm::vec3(0, 0.5f, 0)), 1.7f * float(i), glm::vec3(0, 1, 0)));
        }
    }
}

/// Small pots along the arcade's step, with lavender-grey olive, ivy and bougainvillea.
void build_small_pots(Courtyard& court) {
    const CourtyardMaterials& m = court.materials();
    const PotMeshes pot = make_pot(court, "small pot", 0.34f, 0.21f);
    const Openness open = [](glm::vec3, glm::vec3) { return 0.8f; };
    const std::array<uint32_t, 3> plants{court.add("olive bush", m.olive, leaf_ball({0.30f, 0.30f, 0.30f}, 110, 0.26f, 540), open),
                                         court.add("blossom bush", m.blossom, leaf_ball({0.32f, 0.26f, 0.32f}, 90, 0.22f, 541), open),
                                         court.add("ivy bush", m.ivy, leaf_ball({0.28f, 0.22f, 0.28f}, 80, 0.22f, 542), open)};
    for (int i = 0; i < 6; ++i) {
        const float at = -kCourt + 2.4f * float(i);
        const float scale = 0.85f + 0.3f * lattice_float(i, 0, 550);
        for (const bool left : {false, true}) {
            if (i == 0 && left) {
                continue;
            }
            const glm::vec3 p = left ? glm::vec3(-kCourt + 0.42f, 0.0f, at + 0.1f) : glm::vec3(at + 0.1f, 0.0f, -kCourt + 0.42f);
            place_pot(court, pot, p, float(i));
            const glm::mat4 plant = glm::rotate(moved(p + glm::vec3(0, 0.30f + 0.22f * scale, 0)), 2.0f * float(i), glm::vec3(0, 1, 0));
            court.place(plants[lattice_bits(i, left ? 1 : 0, 551) % plants.size()], glm::scale(plant, glm::vec3(scale)));
        }
    }
}

/// A group by the garden wall, near the eye.
void build_pot_group(Courtyard& court) {
    const CourtyardMaterials& m = court.materials();
    const Openness open = [](glm::vec3, glm::vec3) { return 0.8f; };
    const PotMeshes tall = make_pot(court, "tall pot", 0.58f, 0.27f), low = make_pot(court, "low pot", 0.30f, 0.26f);
    const uint32_t olive = court.add("olive shrub", m.olive, leaf_ball({0.42f, 0.46f, 0.42f}, 230, 0.30f, 590), open);
    const uint32_t blossom = court.add("blossom shrub", m.blossom, leaf_ball({0.36f, 0.30f, 0.36f}, 150, 0.22f, 591), open);
    const uint32_t leafy = court.add("leafy shrub", m.leaves, leaf_ball({0.30f, 0.26f, 0.30f}, 120, 0.22f, 592), open);
    const auto plant = [&](const PotMeshes& pot, uint32_t shrub, glm::vec3 at, float height, float turn) {
        place_pot(court, pot, at, turn);
        court.place(shrub, glm::rotate(moved(at + glm::vec3(0, height, 0)), turn, glm::vec3(0, 1, 0)));
    };
    plant(tall, olive, {3.05f, 0.0f, 1.55f}, 0.90f, 0.6f);
    plant(low, blossom, {2.45f, 0.0f, 1.95f}, 0.48f, 1.9f);
    plant(low, leafy, {3.35f, 0.0f, 2.25f}, 0.46f, 3.0f);
}

/// Ivy and bougainvillea that have climbed the walls.
void build_creepers(Courtyard& court) {
    const CourtyardMaterials& m = court.materials();
    const Openness open = [](glm::vec3, glm::vec3) { return 0.8f; };
    static constexpr std::array<glm::vec3, 13> kIvy{{{5.8f, 2.9f, 0.5f},
                                                     {5.6f, 3.6f, 0.55f},
                                                     {5.2f, 4.2f, 0.6f},
                                                     {4.6f, 4.7f, 0.55f},
                                                     {4.0f, 5.0f, 0.45f},
                                                     {5.5f, 5.0f, 0.6f},
                                                     {5.8f, 5.7f, 0.45f},
                                                     {3.4f, 5.2f, 0.30f},
                                                     {5.9f, 2.2f, 0.4f},
                                                     {5.9f, 1.4f, 0.35f},
                                                     {5.9f, 0.7f, 0.35f},
                                                     {4.9f, 3.6f, 0.35f},
                                                     {5.0f, 5.6f, 0.4f}}};
    const uint32_t ivy = court.add("wall ivy", m.ivy, creeper(kIvy, 46, 0.30f, 560), open);
    court.place(ivy, moved({0.0f, 0.0f, -kCourt + 0.02f}));

    static constexpr std::array<glm::vec3, 12> kBlossom{{{-5.6f, 3.9f, 0.40f},
                                                         {-5.0f, 4.0f, 0.42f},
                                                         {-4.4f, 3.95f, 0.42f},
                                                         {-3.8f, 4.0f, 0.40f},
                                                         {-5.5f, 3.3f, 0.35f},
                                                         {-5.8f, 2.7f, 0.30f},
                                                         {-3.2f, 3.9f, 0.35f},
                                                         {-2.7f, 3.95f, 0.28f},
                                                         {-5.7f, 4.6f, 0.40f},
                                                         {-5.2f, 4.7f, 0.28f},
                                                         {-2.3f, 3.9f, 0.2f},
                                                         {-4.6f, 3.45f, 0.24f}}};
    const uint32_t blossom = court.add("bougainvillea", m.blossom, creeper(kBlossom, 60, 0.26f, 570), open);
    court.place(blossom, moved({0.0f, 0.0f, -kCourt + 0.08f}));
    court.place(blossom, glm::rotate(moved({-kCourt + 0.08f, 0.0f, 0.6f}), glm::half_pi<float>(), glm::vec3(0, 1, 0)) *
                             glm::scale(glm::mat4(1.0f), glm::vec3(-1.0f, 1.0f, 1.0f)));
}

/// Olive trees beyond the garden wall, whose shade falls into the court.
void build_outer_trees(Courtyard& court) {
    const CourtyardMaterials& m = court.materials();
    Tree tree = grow_tree({.height = 5.2f,
                           .crown_radius = {1.9f, 1.5f, 1.9f},
                           .trunk_radius = 0.2f,
                           .clusters = 22,
                           .cards = 60,
                           .cluster_radius = 0.72f,
                           .card = 0.50f,
                           .seed = 580});
    const Openness open = [](glm::vec3, glm::vec3) { return 0.75f; };
    const uint32_t wood = court.add("olive wood", m.bark, std::move(tree.wood), open);
    const uint32_t leaves = court.add("olive crown", m.olive, std::move(tree.leaves), open);
    static constexpr std::array<glm::vec3, 4> kPlaces{glm::vec3{8.6f, 0, -5.4f}, {8.3f, 0, -1.2f}, {8.9f, 0, 3.0f}, {11.6f, 0, -8.2f}};
    for (size_t i = 0; i < kPlaces.size(); ++i) {
        const glm::mat4 at = glm::rotate(moved(kPlaces[i]), 2.2f * float(i), glm::vec3(0, 1, 0));
        court.place(wood, at);
        court.place(leaves, at);
    }
}

}  // namespace

void build_court_floor(Courtyard& court) {
    const CourtyardMaterials& m = court.materials();
    shading::Mesh cobbles, ring;
    const glm::vec2 low(-kCourt, -kCourt), high(kCourt + 0.4f, kCourt + 4.0f);
    append_patch(cobbles, 60, 70, [&](float s, float t) {
        const glm::vec2 p(glm::mix(low.x, high.x, s), glm::mix(high.y, low.y, t));
        return ShapePoint{{p.x, 0.0f, p.y}, {0, 1, 0}, {1, 0, 0}, p / 2.4f};
    });
    court.add_and_place("cobbles", m.cobbles, std::move(cobbles), floor_openness);

    // A band of slabs around the fountain, a hand above the cobbles' bed.
    const std::array<glm::vec2, 4> band{{{2.62f, -0.01f}, {2.62f, 0.012f}, {2.60f, 0.018f}, {1.85f, 0.018f}}};
    append_lathe(ring, band, 72, 8.0f, 3.2f);
    court.place(court.add("fountain band", m.ashlar, std::move(ring),
                          [](glm::vec3 p, glm::vec3 n) { return floor_openness(p + kFountainCenter, n); }),
                moved(kFountainCenter));
}

void build_fountain(Courtyard& court) {
    const CourtyardMaterials& m = court.materials();
    Fountain fountain = make_fountain();
    const glm::mat4 at = moved(kFountainCenter);
    court.place(court.add("fountain stone", m.limestone, std::move(fountain.stone), fountain_openness), at);
    court.place(court.add("fountain tiles", m.tiles, std::move(fountain.tiles), fountain_openness), at);
    court.place(court.add("fountain bronze", m.bronze, std::move(fountain.bronze), [](glm::vec3, glm::vec3) { return 0.95f; }), at);
    court.place(court.add("fountain water", m.water, std::move(fountain.water), [](glm::vec3, glm::vec3) { return 0.9f; }), at);
}

void build_garden(Courtyard& court) {
    build_orange_trees(court);
    build_small_pots(court);
    build_pot_group(court);
    build_creepers(court);
    build_outer_trees(court);
}

}  // namespace rawtexel::scenes
