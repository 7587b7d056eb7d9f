#include "scenes/message_text.h"

#include "scenes/utf8.h"

#include <array>
#include <charconv>

namespace rawtexel::scenes {
namespace {

std::string escaped(char byte) {
    constexpr std::string_view kDigits = "0123456789abcdef";
    const auto value = static_cast<unsigned char>(byte);
    return {'\\', 'x', kDigits[value >> 4], kDigits[value & 15]};
}

}  // namespace

std::string one_line(std::string_view text) {
    std::string line;
    bool gap = false;
    for (size_t at = 0, length; at < text.size(); at += length) {
        length = utf8_character(text, at);
        if (static_cast<unsigned char>(text[at]) <= ' ' || text[at] == '\x7f') {
            gap = !line.empty();
            continue;
        }
        if (gap) line += ' ';
        gap = false;
        if (length > 0) {
            line += text.substr(at, length);
        } else {
            line += escaped(text[at]);
            length = 1;
        }
    }
    return line;
}

std::string shortened(std::string_view text) {
    constexpr size_t kLongest = 40;
    std::string line = one_line(text);
    if (line.size() <= kLongest) return line;
    size_t end = 0;
    while (end < kLongest) end += utf8_character(line, end);
    return line.substr(0, end) + "...";
}

std::string print_short(double value) {
    std::array<char, 64> text;
    const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), float(value));
    return std::string(text.data(), error == std::errc() ? end : text.data());
}

}  // namespace rawtexel::scenes
