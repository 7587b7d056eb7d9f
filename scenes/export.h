// Scenes to .glb files that render the same.
#pragma once

#include "shading/scene.h"

#include <string>

namespace rawtexel::scenes {

/// Writes a self-contained binary glTF under a temporary name and renames. Images keep their file's own bytes; generated ones become PNG
/// (8 or 16 bits). What glTF cannot say goes to extras.rawtexel. Throws OutputError.
void export_glb(const shading::Scene& scene, const std::string& path);

}  // namespace rawtexel::scenes
