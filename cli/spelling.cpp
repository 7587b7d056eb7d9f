#include "cli/spelling.h"

#include "scenes/spelling.h"

#include <algorithm>
#include <cctype>
#include <limits>

namespace rawtexel::cli {
namespace {

std::string lower_case(std::string_view text) {
    std::string result(text);
    std::ranges::transform(result, result.begin(), [](unsigned char c) { return char(std::tolower(c)); });
    return result;
}

// Twice the edits, so that an abbreviation can lie between "equal" and "one edit".
int spelling_cost(std::string_view word, std::string_view candidate) {
    const bool abbreviates = !word.empty() && word.size() < candidate.size() && candidate.starts_with(word);
    return abbreviates ? 1 : 2 * scenes::spelling_distance(word, candidate);
}

}  // namespace

std::string nearest_spelling(std::string_view word, std::span<const std::string> candidates) {
    const std::string wanted = lower_case(word);
    std::string best;
    int best_cost = std::numeric_limits<int>::max();
    for (const std::string& candidate : candidates) {
        const int cost = spelling_cost(wanted, lower_case(candidate));
        if (cost < best_cost) {
            best_cost = cost;
            best = candidate;
        }
    }
    return best;
}

}  // namespace rawtexel::cli
