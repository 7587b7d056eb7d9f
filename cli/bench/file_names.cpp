#include "cli/bench/file_names.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

namespace rawtexel::cli {
namespace {

std::string stem_word(const std::string& scene) { return file_word(std::filesystem::path(scene).stem().string()); }

}  // namespace

std::string file_word(const std::string& text) {
    std::string word;
    bool gap = false;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        const bool plain = byte < 128 && (std::isalnum(byte) || c == '.');
        if (plain && gap && !word.empty()) word += '-';
        if (plain) word += c;
        gap = !plain;
    }
    return word;
}

std::string scene_word(const std::string& scene, std::span<const std::string> scenes) {
    const std::string word = stem_word(scene);
    const bool shared = std::ranges::any_of(scenes, [&](const std::string& other) { return other != scene && stem_word(other) == word; });
    if (!word.empty() && !shared) return word;
    const auto number = std::ranges::find(scenes, scene) - scenes.begin() + 1;
    return word + (word.empty() ? "" : "-") + std::to_string(number);
}

}  // namespace rawtexel::cli
