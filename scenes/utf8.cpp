#include "scenes/utf8.h"

namespace rawtexel::scenes {
namespace {

struct ByteRange {
    unsigned char first, last;
    bool holds(unsigned char byte) const { return byte >= first && byte <= last; }
};

/// Characters by their first byte: how many bytes they have and what the second may be. All further ones are 80..BF.
struct Form {
    ByteRange lead;
    size_t length;
    ByteRange second;
};
constexpr Form kForms[] = {
    {{0xC2, 0xDF}, 2, {0x80, 0xBF}}, {{0xE0, 0xE0}, 3, {0xA0, 0xBF}}, {{0xE1, 0xEC}, 3, {0x80, 0xBF}}, {{0xED, 0xED}, 3, {0x80, 0x9F}},
    {{0xEE, 0xEF}, 3, {0x80, 0xBF}}, {{0xF0, 0xF0}, 4, {0x90, 0xBF}}, {{0xF1, 0xF3}, 4, {0x80, 0xBF}}, {{0xF4, 0xF4}, 4, {0x80, 0x8F}},
};
constexpr ByteRange kFurther{0x80, 0xBF};

}  // namespace

size_t utf8_character(std::string_view text, size_t at) {
    const auto byte = [&](size_t i) { return static_cast<unsigned char>(text[at + i]); };
    if (byte(0) < 0x80) return 1;
    for (const Form& form : kForms) {
        if (!form.lead.holds(byte(0))) continue;
        if (form.length > text.size() - at || !form.second.holds(byte(1))) return 0;
        for (size_t i = 2; i < form.length; ++i)
            if (!kFurther.holds(byte(i))) return 0;
        return form.length;
    }
    return 0;
}

size_t find_invalid_utf8(std::string_view text) {
    for (size_t at = 0, length; at < text.size(); at += length) {
        length = utf8_character(text, at);
        if (length == 0) return at;
    }
    return text.npos;
}

}  // namespace rawtexel::scenes
