// Tangent frames by the MikkTSpace algorithm (Mikkelsen 2008), as glTF 2.0 3.7.2.1 asks where a file has none.
#pragma once

#include "shading/scene.h"

#include <span>

namespace rawtexel::scenes {

/// Fills mesh.tangents from positions, normals and uv set `uv_set` (all must be present), the coordinates taken through `uv_from_vertex`;
/// splits vertices where one vertex would need two tangents, so every attribute array and the indices may grow. xyz is unit, w = +1 or -1
/// with bitangent = w * cross(normal, tangent), pointing up in the image, against v (glTF has v down). Triangles without an area in
/// texture space take the tangent of a neighbour, or any perpendicular to the normal. Mesh size limits are the caller's.
void generate_tangents(shading::Mesh& mesh, int uv_set, const glm::mat3x2& uv_from_vertex = glm::mat3x2{1, 0, 0, 1, 0, 0});

/// The normal map that meshes of material `index` need tangents for, of layers the first; null where none does. Triplanar maps have the
/// tangents of their planes.
const shading::TextureMap* map_with_tangents(std::span<const shading::Material> materials, uint32_t index);

/// A unit vector at right angles to the unit vector `normal`.
glm::vec3 perpendicular_to(const glm::vec3& normal);

}  // namespace rawtexel::scenes
