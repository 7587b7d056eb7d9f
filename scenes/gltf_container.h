// The outer form of a glTF file: JSON text, or a binary file of chunks (glTF 2.0 chapter 4).
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace rawtexel::scenes {

struct GltfContainer {
    std::string_view json;
    std::optional<std::span<const std::byte>> binary;  ///< the BIN chunk
};

/// Told by the first bytes, whatever the file is called. Throws InputError naming `path`.
GltfContainer split_gltf(const std::string& path, std::span<const std::byte> file);

}  // namespace rawtexel::scenes
