// The MikkTSpace algorithm: M. Mikkelsen, "Simulation of Wrinkled Surfaces Revisited", 2008, section 3.
#pragma once

#include <glm/glm.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace rawtexel::scenes {

/// A triangle list; every index is below the number of positions, normals and coordinates.
struct TangentGeometry {
    std::span<const glm::vec3> positions, normals;
    std::span<const glm::vec2> uv;
    std::span<const uint32_t> indices;
};

/// A tangent for each corner, in the order of the indices: xyz unit, w = +1 where the texture keeps its orientation on the surface, -1
/// where it is mirrored (bitangent = w * cross(normal, tangent), along increasing v). Zero at corners where no triangle says anything.
/// Corners of equal position, normal and coordinates count as one vertex; those of a vertex share a tangent when their triangles hang
/// together over edges and have the same orientation; the shared tangent is the mean of the triangles' tangents, projected into the
/// vertex's plane and weighted by the corners' angles. (No angle between triangles separates them, as in the default of 180 degrees.)
std::vector<glm::vec4> mikktspace_tangents(const TangentGeometry& geometry);

}  // namespace rawtexel::scenes
