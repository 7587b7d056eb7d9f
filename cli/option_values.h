// Values of options as text: strict readers and the printers that match them.
#pragma once

#include "cli/usage_error.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <initializer_list>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rawtexel::cli {

/// What a number may be, ends included.
struct NumberRange {
    float lowest = std::numeric_limits<float>::lowest(), highest = std::numeric_limits<float>::max();
};
/// "0.01 to 179", "at least 0", "any number".
std::string print(const NumberRange& range);

/// The readers take the whole text or throw UsageError "OPTION: 'TEXT' is not … (what is allowed)".
int64_t parse_integer(std::string_view option, std::string_view text, int64_t lowest, int64_t highest);
/// A number of bytes, at least 1: digits and optionally K, M or G for 2^10, 2^20 or 2^30 of them.
uint64_t parse_bytes(std::string_view option, std::string_view text);
/// Finite and in range; throws UsageError otherwise, as all below.
float parse_number(std::string_view option, std::string_view text, const NumberRange& range = {});
/// `form` such as "X,Y,Z[,I]" is for the message; between `least` and `most` numbers separated by commas, each in range.
std::vector<float> parse_numbers(std::string_view option, std::string_view text, std::string_view form, size_t least, size_t most,
                                 const NumberRange& range = {});
std::vector<int64_t> parse_integers(std::string_view option, std::string_view text, std::string_view form, size_t count, int64_t lowest,
                                    int64_t highest);
/// Three numbers, each in range; without one, within kMaxLength.
glm::vec3 parse_vector(std::string_view option, std::string_view text, std::string_view form = "X,Y,Z");
glm::vec3 parse_vector(std::string_view option, std::string_view text, std::string_view form, const NumberRange& range);

/// Shortest decimal that reads back as the same float.
std::string print_number(float value);
std::string print_vector(const glm::vec3& value);

/// "OPTION: unknown value 'TEXT', nearest is 'NAME' (all names)".
UsageError unknown_value(std::string_view option, std::string_view text, std::span<const std::string> names);

/// The member of `all` whose to_string is `text`; throws unknown_value.
template <class T>
T parse_choice(std::string_view option, std::string_view text, std::initializer_list<T> all) {
    std::vector<std::string> names;
    for (const T value : all) {
        if (to_string(value) == text) return value;
        names.emplace_back(to_string(value));
    }
    throw unknown_value(option, text, names);
}

/// Index of `text` in `names`; throws unknown_value.
size_t parse_word(std::string_view option, std::string_view text, std::initializer_list<std::string_view> names);

}  // namespace rawtexel::cli
