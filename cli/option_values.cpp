#include "cli/option_values.h"

#include "cli/spelling.h"

#include <array>
#include <charconv>
#include <cmath>

namespace rawtexel::cli {
namespace {

UsageError bad_value(std::string_view option, std::string_view text, const std::string& wanted) {
    return UsageError(std::string(option) + ": '" + std::string(text) + "' is not " + wanted);
}

template <class T>
bool read_whole(std::string_view text, T& value) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() && end == text.data() + text.size();
}

std::string print_range(float lowest, float highest) {
    if (lowest == std::numeric_limits<float>::lowest()) return "";
    if (highest == std::numeric_limits<float>::max()) return " of at least " + print_number(lowest);
    return " from " + print_number(lowest) + " to " + print_number(highest);
}

}  // namespace

int64_t parse_integer(std::string_view option, std::string_view text, int64_t lowest, int64_t highest) {
    int64_t value = 0;
    if (!read_whole(text, value) || value < lowest || value > highest)
        throw bad_value(option, text, "a whole number from " + std::to_string(lowest) + " to " + std::to_string(highest));
    return value;
}

float parse_number(std::string_view option, std::string_view text, float lowest, float highest) {
    float value = 0.0f;
    if (!read_whole(text, value) || !std::isfinite(value) || value < lowest || value > highest)
        throw bad_value(option, text, "a number" + print_range(lowest, highest));
    return value;
}

std::vector<float> parse_numbers(std::string_view option, std::string_view text, std::string_view form, size_t least, size_t most) {
    std::vector<float> values;
    for (const std::string& word : split(text, ',')) {
        float value = 0.0f;
        if (!read_whole(word, value) || !std::isfinite(value)) throw bad_value(option, text, std::string(form));
        values.push_back(value);
    }
    if (values.size() < least || values.size() > most) throw bad_value(option, text, std::string(form));
    return values;
}

std::vector<int64_t> parse_integers(std::string_view option, std::string_view text, std::string_view form, size_t count, int64_t lowest,
                                    int64_t highest) {
    std::vector<int64_t> values;
    const std::vector<std::string> words = split(text, ',');
    if (words.size() != count) throw bad_value(option, text, std::string(form));
    for (const std::string& word : words) {
        int64_t value = 0;
        if (!read_whole(word, value)) throw bad_value(option, text, std::string(form));
        if (value < lowest || value > highest)
            throw bad_value(option, text,
                            std::string(form) + " of numbers from " + std::to_string(lowest) + " to " + std::to_string(highest));
        values.push_back(value);
    }
    return values;
}

glm::vec3 parse_vector(std::string_view option, std::string_view text, std::string_view form) {
    constexpr float kLargest = 1e15f;
    const std::vector<float> values = parse_numbers(option, text, form, 3, 3);
    for (const float value : values)
        if (std::abs(value) > kLargest) throw bad_value(option, text, std::string(form) + print_range(-kLargest, kLargest));
    return {values[0], values[1], values[2]};
}

std::string print_number(float value) {
    std::array<char, 64> text;
    const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), value);
    return std::string(text.data(), error == std::errc() ? end : text.data());
}

std::string print_vector(const glm::vec3& value) {
    return print_number(value.x) + "," + print_number(value.y) + "," + print_number(value.z);
}

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
    for (const std::string& word : words) {
        if (!result.empty()) result += separator;
        result += word;
    }
    return result;
}

UsageError unknown_value(std::string_view option, std::string_view text, std::span<const std::string> names) {
    return UsageError(std::string(option) + ": unknown value '" + std::string(text) + "', the nearest is '" +
                      nearest_spelling(text, names) + "' (" + join(names, " ") + ")");
}

size_t parse_word(std::string_view option, std::string_view text, std::initializer_list<std::string_view> names) {
    size_t index = 0;
    for (const std::string_view name : names) {
        if (name == text) return index;
        ++index;
    }
    const std::vector<std::string> all(names.begin(), names.end());
    throw unknown_value(option, text, all);
}

}  // namespace rawtexel::cli
