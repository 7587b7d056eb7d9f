// What is inside a texture file, for people and for scripts.
#pragma once

#include "cli/texture_file.h"

#include <cstdint>
#include <string>

namespace rawtexel::cli {

struct TextureInfo {
    std::string path;
    const TextureFile& file;
    uint64_t file_bytes = 0;
    bool color_space_chosen = false;  ///< by an option, whatever the file declares
};

/// "linear" or "srgb"; empty for images of integers, which do not say.
std::string color_space_of(const TextureInfo& info);

/// "100x50", with the depth of volumes behind.
std::string print_extents(const texunit::Shape& shape, int level);

std::string texture_info_text(const TextureInfo& info);
/// {"file", "container", "format", "color_space", "width", "height", "depth", "layers", "faces", "levels", "levels_full", "file_bytes",
/// "stored_bytes", "per_level": [{"level", "width", "height", "depth", "bytes"}]}. `levels` are those in the file, `bytes` what they take
/// there, all layers and faces together, before any supercompression.
std::string texture_info_json(const TextureInfo& info);

}  // namespace rawtexel::cli
