// Which valid word someone meant.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace rawtexel::cli {

/// The candidate with the fewest edits from `word` (scenes::spelling_distance), ignoring ASCII case. A candidate that `word` is the
/// beginning of counts as half an edit away; the first of equals wins. Empty only when there are no candidates.
std::string nearest_spelling(std::string_view word, std::span<const std::string> candidates);

}  // namespace rawtexel::cli
