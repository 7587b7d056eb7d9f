// Built-in scenes, generated in code with their textures.
#pragma once

#include "shading/scene.h"
#include "texunit/texture.h"

#include <span>
#include <string_view>

namespace rawtexel::scenes {

struct BuiltinScene {
    std::string_view name, description;
    shading::Scene (*make)(const texunit::TextureOptions&);
};

/// plane spheres magnify metal-edge bumps foliage triplanar layers font shadow courtyard
std::span<const BuiltinScene> builtin_scenes();

}  // namespace rawtexel::scenes
