#include "scenes/load.h"

#include "scenes/builtin.h"
#include "scenes/message_text.h"
#include "scenes/spelling.h"

#include <algorithm>
#include <filesystem>
#include <vector>

namespace rawtexel::scenes {
namespace {

bool names_a_file(const std::string& scene) {
    std::error_code ignored;
    const std::filesystem::path path(scene);
    return path.has_parent_path() || path.extension() == ".gltf" || path.extension() == ".glb" || std::filesystem::exists(path, ignored);
}

}  // namespace

shading::Scene load(const std::string& scene, const LoadOptions& options) {
    std::vector<std::string> names;
    for (const BuiltinScene& builtin : builtin_scenes()) {
        if (builtin.name == scene) return builtin.make(options.texture);
        names.emplace_back(builtin.name);
    }
    if (names_a_file(scene)) return load_gltf(scene, options);
    throw InputError(one_line(scene) + ": no such scene (neither a .gltf or .glb file nor a built-in scene; the nearest is \"" +
                     nearest_spelling(scene, names) + "\")");
}

}  // namespace rawtexel::scenes
