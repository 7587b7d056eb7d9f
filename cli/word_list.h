// Lists of words in one text.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rawtexel::cli {

/// The parts between separators, empty ones included: one more than there are separators.
std::vector<std::string> split(std::string_view text, char separator);

/// All words, the separator between neighbours.
std::string join(std::span<const std::string> words, std::string_view separator);

}  // namespace rawtexel::cli
