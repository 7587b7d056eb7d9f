#include "cli/shell_words.h"

#include "cli/usage_error.h"

namespace rawtexel::cli {

std::vector<std::string> shell_words(std::string_view text) {
    std::vector<std::string> words;
    bool in_word = false;
    char quote = 0;
    const auto add = [&](char c) {
        if (!in_word) words.emplace_back();
        in_word = true;
        if (c != 0) words.back() += c;
    };
    for (size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (quote == 0 && (c == ' ' || c == '\t' || c == '\n')) {
            in_word = false;
        } else if (c == quote) {
            quote = 0;
        } else if (quote == 0 && (c == '\'' || c == '"')) {
            quote = c;
            add(0);  // quotes around nothing are a word
        } else if (c == '\\' && quote != '\'' && i + 1 < text.size()) {
            // Between double quotes a backslash keeps only what means something there.
            const char next = text[i + 1];
            if (quote == '"' && next != '"' && next != '\\') add(c);
            add(next);
            ++i;
        } else {
            add(c);
        }
    }
    if (quote != 0) throw UsageError(std::string("a quote (") + quote + ") has no end");
    return words;
}

}  // namespace rawtexel::cli
