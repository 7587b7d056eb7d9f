// Names of the files that a sweep writes.
#pragma once

#include <span>
#include <string>

namespace rawtexel::cli {

/// Letters, digits and points of `text`; whatever is between them becomes one dash.
std::string file_word(const std::string& text);

/// Of one of `scenes`: the name without folder and extension as a file_word; with its number where it is empty or another's is the same.
std::string scene_word(const std::string& scene, std::span<const std::string> scenes);

}  // namespace rawtexel::cli
