// glTF materials (glTF 2.0, 3.9) as the renderer's.
#pragma once

#include "scenes/gltf_document.h"
#include "scenes/gltf_notices.h"
#include "scenes/gltf_textures.h"

#include "shading/scene.h"

#include <vector>

namespace rawtexel::scenes {

/// All materials of the document, in its order. Throws InputError.
std::vector<shading::Material> read_materials(const GltfDocument& document, GltfTextures& textures, GltfNotices& notices);

}  // namespace rawtexel::scenes
