#include "scenes/spelling.h"

#include <algorithm>
#include <vector>

namespace rawtexel::scenes {

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

std::string_view nearest_spelling(std::string_view word, std::span<const std::string_view> candidates) {
    const auto nearest = std::ranges::min_element(candidates, {}, [&](std::string_view c) { return spelling_distance(word, c); });
    return nearest == candidates.end() ? std::string_view{} : *nearest;
}

std::string one_line(std::string_view text) {
    std::string line;
    bool gap = false;
    for (const char c : text) {
        if (static_cast<unsigned char>(c) <= ' ' || c == '\x7f') {
            gap = !line.empty();
            continue;
        }
        if (gap) line += ' ';
        gap = false;
        line += c;
    }
    return line;
}

}  // namespace rawtexel::scenes
