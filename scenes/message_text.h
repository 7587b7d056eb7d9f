// What messages quote: names, paths and numbers of files, and the words of other libraries.
#pragma once

#include <string>
#include <string_view>

namespace rawtexel::scenes {

/// The text with every run of white space and control characters as one space, none at the ends; bytes that are no UTF-8 as "\xNN".
std::string one_line(std::string_view text);

/// one_line of the text, cut after some 40 bytes, at the end of a character, and ended by "..." when it is longer.
std::string shortened(std::string_view text);

/// Shortest decimal that reads back as the same float: what a file said, without the digits that its double adds.
std::string print_short(double value);

}  // namespace rawtexel::scenes
