// The program's version.
#pragma once

#include <string_view>

namespace rawtexel::cli {

/// Such as "0.1.0".
std::string_view version();

}  // namespace rawtexel::cli
