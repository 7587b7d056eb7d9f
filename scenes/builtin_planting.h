// Plants built of cards: trees, tufts, hedges and creepers.
#pragma once

#include "shading/scene.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <span>

namespace rawtexel::scenes {

/// A textured rectangle with a face on either side, both shaded by one normal, so that foliage shades as the mass it belongs to.
struct Card {
    glm::vec3 foot{0.0f};                                     ///< middle of the lower edge
    glm::vec3 up{0.0f, 1.0f, 0.0f}, right{1.0f, 0.0f, 0.0f};  ///< full height, full width
    glm::vec3 normal{0.0f, 1.0f, 0.0f};
    glm::vec3 tint{1.0f};  ///< linear
};
void append_card(shading::Mesh& mesh, const Card& card);

struct TreeStyle {
    float height = 7.0f;                         ///< metres, to the top of the crown
    glm::vec3 crown_radius{2.6f, 2.2f, 2.6f};    ///< metres
    float trunk_radius = 0.24f;                  ///< metres, at the foot
    int clusters = 26, cards = 48;               ///< clusters of leaves, cards in each
    float cluster_radius = 0.95f, card = 0.62f;  ///< metres
    uint32_t seed = 1;
};
struct Tree {
    shading::Mesh wood, leaves;
};
/// Rooted at the origin, +Y up.
Tree grow_tree(const TreeStyle& style);

/// Crossed cards standing on the square [-extent/2, extent/2]^2 of the plane y = 0.
shading::Mesh tuft_patch(int tufts, float extent, float height, float width, uint32_t seed);

/// Cards hugging the wall x, y of the plane z = 0 (which faces +Z) around each of `runs` (x, y, radius), metres.
shading::Mesh creeper(std::span<const glm::vec3> runs, int cards_per_square_metre, float card, uint32_t seed);

/// A ball of leaves about the origin.
shading::Mesh leaf_ball(glm::vec3 radius, int cards, float card, uint32_t seed);

}  // namespace rawtexel::scenes
