#include "cli/word_list.h"

namespace rawtexel::cli {

std::vector<std::string> split(std::string_view text, char separator) {
    std::vector<std::string> words;
    size_t start = 0;
    for (size_t end; (end = text.find(separator, start)) != std::string_view::npos; start = end + 1)
        words.emplace_back(text.substr(start, end - start));
    words.emplace_back(text.substr(start));
    return words;
}

std::string join(std::span<const std::string> words, std::string_view separator) {
    std::string result;
    for (size_t i = 0; i < words.size(); ++i) {
        if (i > 0) result += separator;
        result += words[i];
    }
    return result;
}

}  // namespace rawtexel::cli
