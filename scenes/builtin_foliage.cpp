// A summer meadow with trees to the horizon: near leaves show their texels' edges, far ones are smaller than a pixel, and what is left
// of them depends on how alpha is filtered.
#include "scenes/builtin_assembly.h"
#include "scenes/builtin_makers.h"
#include "scenes/builtin_planting.h"
#include "scenes/procedural_noise.h"
#include "scenes/procedural_plants.h"
#include "scenes/shapes.h"

#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace rawtexel::scenes {
namespace {

constexpr float kTau = 2.0f * glm::pi<float>();
constexpr float kLeft = -75.0f, kRight = 75.0f, kNear = 12.0f, kFar = -140.0f;  // of the ground, metres
constexpr float kPatch = 2.0f;                                                  // side of a patch of tufts, metres

/// The lie of the land: level where one stands, rising into hills.
float ground_height(glm::vec2 p) {
    const float away = smooth_step(4.0f, 90.0f, glm::length(p));
    const float swell = fractal_noise(p / 55.0f, {64, 64}, 2, 400);
    return swell * (0.6f + 4.0f * away) + 5.0f * away * away;
}

glm::vec3 ground_normal(glm::vec2 p) {
    constexpr float kStep = 0.25f;
    const float dx = ground_height(p + glm::vec2(kStep, 0)) - ground_height(p - glm::vec2(kStep, 0));
    const float dz = ground_height(p + glm::vec2(0, kStep)) - ground_height(p - glm::vec2(0, kStep));
    return glm::normalize(glm::vec3(-dx, 2.0f * kStep, -dz));
}

shading::Mesh ground() {
    shading::Mesh mesh;
    append_patch(mesh, 100, 100, [](float s, float t) {
        const glm::vec2 p(glm::mix(kLeft, kRight, s), glm::mix(kNear, kFar, t));
        return ShapePoint{{p.x, ground_height(p), p.y}, ground_normal(p), {1, 0, 0}, p / 4.0f};
    });
    return mesh;
}

/// On the ground at `p`, turned and scaled; `lean` 1 stands across the slope, 0 upright.
glm::mat4 rooted(glm::vec2 p, float turn, float scale, float lean) {
    const glm::vec3 up = glm::normalize(glm::mix(glm::vec3(0, 1, 0), ground_normal(p), lean));
    const glm::vec3 right = glm::normalize(glm::cross(up, glm::vec3(0, 0, 1)));
    glm::mat4 m(glm::vec4(right, 0), glm::vec4(up, 0), glm::vec4(glm::cross(right, up), 0), glm::vec4(p.x, ground_height(p), p.y, 1));
    m = glm::rotate(m, turn, glm::vec3(0, 1, 0));
    return glm::scale(m, glm::vec3(scale));
}

uint32_t masked_material(SceneAssembly& assembly, const std::string& name, Surface surface) {
    const uint32_t index = assembly.add_color_material(name, std::move(surface), 0.75f);
    shading::Material& material = assembly.material(index);
    material.alpha_mode = shading::AlphaMode::Mask;
    texunit::SamplerState& sampler = material.maps[shading::kBaseColor].sampler;
    sampler.wrap_s = sampler.wrap_t = texunit::Wrap::ClampToEdge;
    return index;
}

constexpr size_t kTrees = 4;

struct PlantedTree {
    uint32_t wood, leaves;
};

std::array<PlantedTree, kTrees> make_trees(SceneAssembly& assembly) {
    const uint32_t bark_material = assembly.add_surface_material("bark", bark());
    const uint32_t leaf_material = masked_material(assembly, "leaves", leaf_spray());
    // A spreading oak for the foreground; a tall, a low and a round tree for the woods.
    const std::array<TreeStyle, kTrees> styles{{{.height = 8.4f,
                                                 .crown_radius = {4.0f, 3.1f, 4.0f},
                                                 .trunk_radius = 0.34f,
                                                 .clusters = 54,
                                                 .cards = 84,
                                                 .cluster_radius = 1.10f,
                                                 .card = 0.40f,
                                                 .seed = 410},
                                                {.height = 10.0f,
                                                 .crown_radius = {2.5f, 4.2f, 2.5f},
                                                 .trunk_radius = 0.26f,
                                                 .clusters = 28,
                                                 .cards = 32,
                                                 .cluster_radius = 1.05f,
                                                 .card = 0.72f,
                                                 .seed = 420},
                                                {.height = 5.2f,
                                                 .crown_radius = {2.4f, 2.2f, 2.4f},
                                                 .trunk_radius = 0.20f,
                                                 .clusters = 24,
                                                 .cards = 32,
                                                 .cluster_radius = 0.92f,
                                                 .card = 0.62f,
                                                 .seed = 430},
                                                {.height = 7.6f,
                                                 .crown_radius = {3.2f, 3.1f, 3.2f},
                                                 .trunk_radius = 0.27f,
                                                 .clusters = 28,
                                                 .cards = 32,
                                                 .cluster_radius = 1.15f,
                                                 .card = 0.72f,
                                                 .seed = 440}}};
    std::array<PlantedTree, kTrees> trees{};
    for (size_t i = 0; i < styles.size(); ++i) {
        Tree tree = grow_tree(styles[i]);
        const std::string name = "tree " + std::to_string(i);
        trees[i] = {assembly.add_mesh(name + " wood", bark_material, std::move(tree.wood)),
                    assembly.add_mesh(name + " leaves", leaf_material, std::move(tree.leaves))};
    }
    return trees;
}

void plant(SceneAssembly& assembly, const PlantedTree& tree, glm::vec2 p, float turn, float scale) {
    const glm::mat4 m = rooted(p, turn, scale, 0.0f);
    assembly.place(tree.wood, m);
    assembly.place(tree.leaves, m);
}

/// A few trees set by hand, then woods that close in with distance and leave a glade in the middle.
void plant_trees(SceneAssembly& assembly) {
    const std::array<PlantedTree, kTrees> trees = make_trees(assembly);
    plant(assembly, trees[0], {6.2f, -12.0f}, 0.4f, 1.0f);
    plant(assembly, trees[1], {-9.5f, -21.0f}, 2.1f, 0.95f);
    plant(assembly, trees[3], {-13.5f, -26.0f}, 0.3f, 1.0f);
    plant(assembly, trees[2], {-4.2f, -33.0f}, 1.0f, 1.0f);
    plant(assembly, trees[0], {16.0f, -36.0f}, 3.3f, 1.05f);
    const uint32_t leaves = assembly.mesh(trees[0].leaves).material;
    const uint32_t bush = assembly.add_mesh("bush", leaves, leaf_ball({1.7f, 1.2f, 1.7f}, 110, 0.75f, 445));
    constexpr float kPitch = 8.0f;
    for (int row = 0; row < 12; ++row) {
        for (int column = -8; column <= 8; ++column) {
            const glm::vec2 jitter(lattice_float(column, row, 440), lattice_float(column, row, 441));
            const glm::vec2 p = kPitch * (glm::vec2(column, -row) + 0.8f * (jitter - 0.5f)) + glm::vec2(0.0f, -42.0f);
            const float density = smooth_step(40.0f, 95.0f, -p.y) + smooth_step(14.0f, 40.0f, std::abs(p.x)) * 0.6f;
            if (lattice_float(column, row, 442) < density && p.x > kLeft && p.x < kRight) {
                const float random = lattice_float(column, row, 443);
                plant(assembly, trees[1 + lattice_bits(column, row, 444) % 3], p, kTau * random, 0.8f + 0.5f * random);
                // Undergrowth beside it.
                assembly.place(bush, rooted(p + 2.5f * (jitter - 0.5f), kTau * jitter.x, 0.8f + 0.9f * jitter.y, 0.0f));
            }
        }
    }
}

/// Tufts where one sees them as such: near, in the field of view, thinning out.
void plant_meadow(SceneAssembly& assembly) {
    const uint32_t grass = masked_material(assembly, "grass", grass_tuft());
    const uint32_t flowers = masked_material(assembly, "flowers", flower_tuft());
    const std::array<uint32_t, 2> grass_patches{assembly.add_mesh("grass 0", grass, tuft_patch(48, kPatch, 0.32f, 0.46f, 450)),
                                                assembly.add_mesh("grass 1", grass, tuft_patch(48, kPatch, 0.27f, 0.42f, 451))};
    const uint32_t flower_patch = assembly.add_mesh("flowers", flowers, tuft_patch(10, kPatch, 0.40f, 0.40f, 452));
    for (int row = -2; row < 24; ++row) {
        const float z = -float(row) * kPatch;
        const int reach = int((6.0f - 0.55f * std::min(z, 0.0f)) / kPatch);
        for (int column = -reach; column <= reach; ++column) {
            const glm::vec2 p(float(column) * kPatch, z);
            const float quarter_turn = 0.25f * kTau * float(lattice_bits(column, row, 460) & 3u);
            if (lattice_float(column, row, 461) < 1.35f - 0.022f * float(row * 2)) {
                assembly.place(grass_patches[lattice_bits(column, row, 462) & 1u], rooted(p, quarter_turn, 1.0f, 1.0f));
            }
            if (gradient_noise(p / 7.0f, {64, 64}, 463) > -0.25f) {
                assembly.place(flower_patch, rooted(p, quarter_turn, 1.0f, 1.0f));
            }
        }
    }
}

}  // namespace

shading::Scene make_foliage(const texunit::TextureOptions& options) {
    SceneAssembly assembly("foliage", options);
    assembly.turn_to_sun(-70.0f);
    const uint32_t soil = assembly.add_surface_material("meadow", meadow_ground());
    assembly.place(assembly.add_mesh("ground", soil, ground()));
    plant_trees(assembly);
    plant_meadow(assembly);

    const glm::vec2 eye(0.0f, 5.0f);
    const float level = ground_height(eye);
    assembly.add_camera("glade", {eye.x, level + 1.35f, eye.y}, {0.6f, level + 2.0f, -12.0f}, 48.0f);
    assembly.add_sky_and_sun();
    return assembly.take();
}

}  // namespace rawtexel::scenes
