// Normals and tangents of a loaded mesh made fit for shading.
#pragma once

#include "scenes/gltf_document.h"

#include "shading/scene.h"

namespace rawtexel::scenes {

/// Unit normals, where the file's are zero those of the adjoining triangles; then tangents for `normal_map` (null: none are kept):
/// the file's own, or generated from the map's transformed coordinates where it has none. A mesh with a normal map but without
/// normals gets flat ones, its vertices split (glTF 2.0, 3.7.2.1).
void complete_frames(shading::Mesh& mesh, const shading::TextureMap* normal_map, MemoryAllowance& memory);

}  // namespace rawtexel::scenes
