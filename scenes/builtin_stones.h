// Weathered stones of any shape, without texture coordinates: their materials are triplanar.
#pragma once

#include "shading/scene.h"

#include <glm/glm.hpp>

#include <cstdint>

namespace rawtexel::scenes {

struct StoneStyle {
    glm::vec3 half_extent{1.0f};  ///< metres
    float roundness = 4.0f;       ///< exponent of the superellipsoid: 2 is an ellipsoid, more is nearer to a box
    float wear = 0.1f;            ///< depth of the dents, metres
    uint32_t seed = 0;
};

/// About the origin.
shading::Mesh make_stone(const StoneStyle& style);

}  // namespace rawtexel::scenes
