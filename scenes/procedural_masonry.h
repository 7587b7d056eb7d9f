// What walls and floors are made of.
#pragma once

#include "scenes/procedural_surface.h"

namespace rawtexel::scenes {

Surface cobblestones();  ///< 2.4 m: rounded stones in sandy joints with moss
Surface ashlar();        ///< 3.2 m: dressed blocks in courses of 40 cm
Surface limestone();     ///< 2 m: one smooth piece, faintly veined
Surface worn_plaster();  ///< 4 m: warm lime wash, rain stains, and bricks where it fell off
Surface roof_clay();     ///< 1 m: fired clay with lichen
Surface terracotta();    ///< 1 m: turned pots
Surface garden_soil();   ///< 1 m

/// Where a point lies in a wall of staggered bricks.
struct BrickPoint {
    glm::vec2 local{0.0f};  ///< 0..1 across the brick
    float edge = 0.0f;      ///< metres to the middle of the nearest joint
    uint32_t id = 0;        ///< random bits of the brick
};
/// `count` bricks fill `extent` metres; every other row is shifted by half a brick, so count.y must be even.
BrickPoint brick_at(glm::vec2 p, glm::vec2 extent, glm::ivec2 count, uint32_t seed);

}  // namespace rawtexel::scenes
