#include "scenes/spelling.h"

#include <algorithm>
#include <cctype>
#include <limits>
#include <vector>

namespace rawtexel::scenes {
namespace {

std::string lower_case(std::string_view text) {
    std::string result(text);
    std::ranges::transform(result, result.begin(), [](unsigned char c) { return char(std::tolower(c)); });
    return result;
}

// Twice the edits, so that an abbreviation can lie between "equal" and "one edit".
int spelling_cost(std::string_view word, std::string_view candidate) {
    const bool abbreviates = !word.empty() && word.size() < candidate.size() && candidate.starts_with(word);
    return abbreviates ? 1 : 2 * spelling_distance(word, candidate);
}

}  // namespace

int spelling_distance(std::string_view a, std::string_view b) {
    // Rows of the alignment table: the one before last is needed for swaps.
    std::vector<int> before_last(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
    for (size_t j = 0; j <= b.size(); ++j) row[j] = int(j);
    for (size_t i = 1; i <= a.size(); ++i) {
        before_last.swap(last);
        last.swap(row);
        row[0] = int(i);
        for (size_t j = 1; j <= b.size(); ++j) {
            row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] != b[j - 1])});
            const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
            if (swapped) row[j] = std::min(row[j], before_last[j - 2] + 1);
        }
    }
    return row[b.size()];
}

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

}  // namespace rawtexel::scenes
