// Which valid word someone meant.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace rawtexel::scenes {

/// Insertions, deletions, substitutions and swaps of neighbours that turn one word into the other (optimal string alignment).
int spelling_distance(std::string_view a, std::string_view b);

/// The candidate with the fewest edits from `word`, ignoring ASCII case. A candidate that `word` is the beginning of counts as half an edit
/// away; the first of equals wins. Empty only when there are no candidates.
std::string nearest_spelling(std::string_view word, std::span<const std::string> candidates);

}  // namespace rawtexel::scenes
