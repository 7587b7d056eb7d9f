// Tangents by the definition, slowly and in double precision: what MikkTSpace's groups mean, without its way of finding them.
#pragma once

#include <glm/glm.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace rawtexel::reference {

/// Per triangle corner: xyz unit, w = +1 where the texture keeps its orientation, -1 where it is mirrored; zero at corners of triangles
/// without an area in space or in the texture, about which nothing is said. Edges with more than two triangles must not occur.
std::vector<glm::dvec4> corner_tangents(std::span<const glm::vec3> positions, std::span<const glm::vec3> normals,
                                        std::span<const glm::vec2> uv, std::span<const uint32_t> indices);

}  // namespace rawtexel::reference
