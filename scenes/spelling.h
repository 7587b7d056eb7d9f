// Words as people read them: the nearest spelling of a mistyped name, and messages of other libraries on one line.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace rawtexel::scenes {

/// Insertions, deletions, substitutions and swaps of neighbours that turn one word into the other (optimal string alignment).
int spelling_distance(std::string_view a, std::string_view b);

/// The candidate nearest to `word`, the first among equals; empty when there are none.
std::string_view nearest_spelling(std::string_view word, std::span<const std::string_view> candidates);

/// The text with every run of white space and control characters as one space, none at the ends.
std::string one_line(std::string_view text);

}  // namespace rawtexel::scenes
