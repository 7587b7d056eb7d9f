#include "cli/lookup_places.h"

#include "cli/option_values.h"
#include "cli/word_list.h"
#include "scenes/image_io.h"
#include "scenes/message_text.h"

#include <algorithm>

namespace rawtexel::cli {
namespace {

std::vector<std::string> blank_separated(std::string text) {
    std::ranges::replace_if(
        text, [](char c) { return c == '\t' || c == '\r'; }, ' ');
    std::vector<std::string> words = split(text, ' ');
    std::erase(words, "");
    return words;
}

std::array<float, 3> take(const std::vector<float>& numbers, size_t first, size_t count) {
    std::array<float, 3> taken{};
    std::copy_n(numbers.begin() + std::ptrdiff_t(first), count, taken.begin());
    return taken;
}

/// Throws UsageError for a direction without length.
void check_place(std::string_view where, const std::array<float, 3>& at, CoordinateKind kind) {
    if (kind == CoordinateKind::Direction && at == std::array<float, 3>{})
        throw UsageError(std::string(where) + ": 0,0,0 is no direction (allowed: any other)");
}

LookupPlace parse_place(const std::string& where, const std::vector<std::string>& words, CoordinateKind kind) {
    const size_t n = components(kind);
    if (words.size() != n && words.size() != 3 * n)
        throw scenes::InputError(where + ": " + std::to_string(words.size()) + " numbers (allowed: " + std::to_string(n) +
                                 " coordinates, or these and " + std::to_string(2 * n) + " derivatives)");
    std::vector<float> numbers;
    for (const std::string& word : words) numbers.push_back(parse_number(where, scenes::shortened(word)));
    LookupPlace place{.at = take(numbers, 0, n), .derivatives = {}};
    check_place(where, place.at, kind);
    if (numbers.size() > n) place.derivatives = Derivatives{take(numbers, n, n), take(numbers, 2 * n, n)};
    return place;
}

}  // namespace

CoordinateKind coordinate_kind(const texunit::Shape& shape) {
    if (shape.cube) return CoordinateKind::Direction;
    return shape.depth > 1 ? CoordinateKind::Uvw : CoordinateKind::Uv;
}

std::string_view option_of(CoordinateKind kind) {
    return kind == CoordinateKind::Uv ? "--uv" : kind == CoordinateKind::Uvw ? "--uvw" : "--direction";
}

std::string_view form_of(CoordinateKind kind) {
    return kind == CoordinateKind::Uv ? "U,V" : kind == CoordinateKind::Uvw ? "U,V,W" : "X,Y,Z";
}

size_t components(CoordinateKind kind) { return kind == CoordinateKind::Uv ? 2 : 3; }

LookupPlace place_of(const texunit::LaneCoordinates& at) {
    return {{at.u, at.v, 0.0f}, Derivatives{{at.dudx, at.dvdx, 0.0f}, {at.dudy, at.dvdy, 0.0f}}};
}

std::array<float, 3> parse_components(std::string_view option, std::string_view text, CoordinateKind kind) {
    const size_t n = components(kind);
    return take(parse_numbers(option, text, form_of(kind), n, n), 0, n);
}

std::array<float, 3> parse_coordinates(std::string_view option, std::string_view text, CoordinateKind kind) {
    const std::array<float, 3> at = parse_components(option, text, kind);
    check_place(option, at, kind);
    return at;
}

std::vector<LookupPlace> read_places(const std::string& path, CoordinateKind kind) {
    const std::vector<std::byte> bytes = scenes::read_file(path);
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    std::vector<LookupPlace> places;
    size_t number = 0;
    for (size_t start = 0; start < text.size(); ++number) {
        const size_t end = std::min(text.find('\n', start), text.size());
        const std::vector<std::string> words = blank_separated(std::string(text.substr(start, end - start)));
        start = end + 1;
        if (words.empty()) continue;
        const std::string where = path + ": line " + std::to_string(number + 1);
        try {
            places.push_back(parse_place(where, words, kind));
        } catch (const UsageError& error) {
            // What stands in a file is input, not usage.
            throw scenes::InputError(error.what());
        }
    }
    if (places.empty()) throw scenes::InputError(path + ": no lookups (one a line: " + std::string(form_of(kind)) + ", blanks between)");
    return places;
}

}  // namespace rawtexel::cli
