// Materials of an exported file.
#pragma once

#include "scenes/export_textures.h"
#include "shading/scene.h"

#include <nlohmann/json.hpp>

#include <set>
#include <string>

namespace rawtexel::scenes {

/// Extensions that a file names: all that it uses, and those that a reader must know to draw it right.
struct ExportExtensions {
    std::set<std::string> used, required;
};

/// The glTF material. Throws OutputError where a texture or its transform cannot be said in glTF; `path` is named in errors.
nlohmann::json export_material(const shading::Material& material, const std::string& path, ExportTextures& textures,
                               ExportExtensions& extensions);

}  // namespace rawtexel::scenes
