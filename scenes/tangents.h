// Tangent frames by the MikkTSpace algorithm (Mikkelsen 2008), as glTF 2.0 3.7.2.1 asks where a file has none.
#pragma once

#include "shading/scene.h"

namespace rawtexel::scenes {

/// Fills mesh.tangents from positions, normals and uv set `uv_set` (all must be present); splits vertices where one vertex would need
/// two tangents, so every attribute array and the indices may grow. Mesh size limits are the caller's.
void generate_tangents(shading::Mesh& mesh, int uv_set);

}  // namespace rawtexel::scenes
