// Octahedral maps: the sphere folded onto a square, so that looking a direction up takes one division and no trigonometry.
// Cigolle et al. 2014, "A Survey of Efficient Representations for Independent Unit Vectors", JCGT 3(2); the axis of the fold is +Y.
#pragma once

#include <glm/glm.hpp>

#include <cmath>

namespace rawtexel::shading {

/// Square coordinates in [0, 1]^2 of `direction` (any length but 0). The upper hemisphere is the inner diamond.
template <class T>
glm::vec<2, T> octahedral_from_direction(const glm::vec<3, T>& direction) {
    const T length = std::fabs(direction.x) + std::fabs(direction.y) + std::fabs(direction.z);
    glm::vec<2, T> p(direction.x / length, direction.z / length);
    if (direction.y < 0) {
        const glm::vec<2, T> folded(T(1) - std::fabs(p.y), T(1) - std::fabs(p.x));
        p = {std::copysign(folded.x, p.x), std::copysign(folded.y, p.y)};
    }
    return p * T(0.5) + T(0.5);
}

/// Unit direction of square coordinates; the inverse of the above.
template <class T>
glm::vec<3, T> direction_from_octahedral(const glm::vec<2, T>& square) {
    glm::vec<2, T> p = square * T(2) - T(1);
    const T y = T(1) - std::fabs(p.x) - std::fabs(p.y);
    if (y < 0) {
        const glm::vec<2, T> folded(T(1) - std::fabs(p.y), T(1) - std::fabs(p.x));
        p = {std::copysign(folded.x, p.x), std::copysign(folded.y, p.y)};
    }
    return glm::normalize(glm::vec<3, T>(p.x, y, p.y));
}

/// Texel of an N x N map that continues it beyond its edge: (x, y) at most one texel outside is folded back inside.
inline glm::ivec2 octahedral_wrapped(int x, int y, int extent) {
    if (x < 0 || x >= extent) {
        x = x < 0 ? 0 : extent - 1;
        y = extent - 1 - y;
    }
    if (y < 0 || y >= extent) {
        y = y < 0 ? 0 : extent - 1;
        x = extent - 1 - x;
    }
    return {x, y};
}

}  // namespace rawtexel::shading
