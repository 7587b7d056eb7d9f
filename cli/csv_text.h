// Fields of comma-separated files.
#pragma once

#include <string>

namespace rawtexel::cli {

/// RFC 4180: quotes around what holds a comma, a quote or a line end; quotes doubled.
std::string csv_field(const std::string& text);

}  // namespace rawtexel::cli
