// Files that appear whole or not at all.
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace rawtexel::scenes {

/// Writes `bytes` beside `path` under a temporary name and renames it to `path`; nothing is left behind on failure.
/// Throws OutputError (scenes/image_io.h): no such folder, not writable, no space.
void write_file(const std::string& path, std::span<const std::byte> bytes);

}  // namespace rawtexel::scenes
