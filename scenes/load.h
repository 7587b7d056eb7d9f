// Scenes from files: glTF 2.0, .gltf or .glb.
#pragma once

#include "shading/scene.h"
#include "texunit/containers.h"

#include <functional>
#include <stdexcept>
#include <string>

namespace rawtexel::scenes {

/// The input cannot be read or is not valid. what() is one line: "FILE: what is wrong (what was found, what is allowed)".
class InputError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

struct LoadOptions {
    texunit::TextureOptions texture;
    texunit::ContainerOptions files;  ///< the limit holds for images too
    bool camera_animations = false;   ///< read what moves the scene's cameras; other animations are left out all the same
    /// Told once of each thing that is left out: an unknown optional extension, an animation, a skin.
    std::function<void(const std::string&)> warn = [](const std::string&) {};
    /// Told of every file that the scene was read from, by its path.
    std::function<void(const std::string&)> opened = [](const std::string&) {};
};

/// How far from the origin, along any axis, a scene may reach: beyond it the products that shading takes of lengths leave single precision.
inline constexpr double kMaxReach = 1e15;  // metres

/// Loads a .gltf or .glb. Every file it names is opened and its header checked; pixels are read when first sampled.
/// Throws InputError, also for a scene that reaches beyond kMaxReach.
shading::Scene load_gltf(const std::string& path, const LoadOptions& options = {});

/// A file by its extension or a built-in scene by its name; unknown names list the nearest.
shading::Scene load(const std::string& scene, const LoadOptions& options = {});

}  // namespace rawtexel::scenes
