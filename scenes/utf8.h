// Well-formed UTF-8.
#pragma once

#include <cstddef>
#include <string_view>

namespace rawtexel::scenes {

/// Bytes of the character that begins at `text[at]`, 1 to 4; 0 where none does (The Unicode Standard, table 3-7).
size_t utf8_character(std::string_view text, size_t at);

/// The first byte that is part of no character; npos when there is none.
size_t find_invalid_utf8(std::string_view text);

}  // namespace rawtexel::scenes
