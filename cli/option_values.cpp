#include "cli/option_values.h"

#include "cli/limits.h"
#include "cli/word_list.h"
#include "scenes/spelling.h"

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

/// 1e15, not 1e+15; 1e-6, not 1e-06.
std::string print_bound(float value) {
    std::string text = print_number(value);
    const size_t exponent = text.find('e');
    if (exponent == text.npos) return text;
    size_t digits = exponent + 2;
    while (digits + 1 < text.size() && text[digits] == '0') ++digits;
    return text.substr(0, exponent + 1) + (text[exponent + 1] == '-' ? "-" : "") + text.substr(digits);
}

bool is_in(const NumberRange& range, float value) { return std::isfinite(value) && value >= range.lowest && value <= range.highest; }

// As it ends "… is not a number".
std::string print_wanted(const NumberRange& range) {
    const NumberRange all;
    if (range.lowest == all.lowest && range.highest == all.highest) return "";
    return (range.highest == all.highest ? " of " : " from ") + print(range);
}

}  // namespace

int64_t parse_integer(std::string_view option, std::string_view text, int64_t lowest, int64_t highest) {
    int64_t value = 0;
    if (!read_whole(text, value) || value < lowest || value > highest)
        throw bad_value(option, text, "a whole number from " + std::to_string(lowest) + " to " + std::to_string(highest));
    return value;
}

uint64_t parse_bytes(std::string_view option, std::string_view text) {
    constexpr std::string_view kUnits = "KMG";
    constexpr int64_t kMost = int64_t{1} << 40;
    const size_t unit = text.empty() ? std::string_view::npos : kUnits.find(text.back());
    if (unit == std::string_view::npos) return uint64_t(parse_integer(option, text, 1, kMost));
    const int shift = 10 * (int(unit) + 1);
    return uint64_t(parse_integer(option, text.substr(0, text.size() - 1), 1, kMost >> shift)) << shift;
}

std::string print(const NumberRange& range) {
    const NumberRange all;
    if (range.lowest == all.lowest && range.highest == all.highest) return "any number";
    if (range.highest == all.highest) return "at least " + print_bound(range.lowest);
    return print_bound(range.lowest) + " to " + print_bound(range.highest);
}

float parse_number(std::string_view option, std::string_view text, const NumberRange& range) {
    float value = 0.0f;
    if (!read_whole(text, value) || !is_in(range, value)) throw bad_value(option, text, "a number" + print_wanted(range));
    return value;
}

std::vector<float> parse_numbers(std::string_view option, std::string_view text, std::string_view form, size_t least, size_t most,
                                 const NumberRange& range) {
    std::vector<float> values;
    for (const std::string& word : split(text, ',')) {
        float value = 0.0f;
        if (!read_whole(word, value)) throw bad_value(option, text, std::string(form));
        if (!is_in(range, value)) throw bad_value(option, text, std::string(form) + print_wanted(range));
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
    return parse_vector(option, text, form, {-kMaxLength, kMaxLength});
}

glm::vec3 parse_vector(std::string_view option, std::string_view text, std::string_view form, const NumberRange& range) {
    const std::vector<float> values = parse_numbers(option, text, form, 3, 3, range);
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

UsageError unknown_value(std::string_view option, std::string_view text, std::span<const std::string> names) {
    return UsageError(std::string(option) + ": unknown value '" + std::string(text) + "', the nearest is '" +
                      scenes::nearest_spelling(text, names) + "' (" + join(names, " ") + ")");
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
