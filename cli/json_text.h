// Small JSON files that a user hands in: read whole, bounded in size and depth.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <string_view>

namespace rawtexel::cli {

/// Throws scenes::InputError, naming `path`, for text beyond 16 MiB, nested deeper than 8 levels, or no JSON.
nlohmann::json parse_json(const std::string& path, std::string_view text);
/// Of a file; throws scenes::InputError where it cannot be read, too.
nlohmann::json read_json(const std::string& path);

}  // namespace rawtexel::cli
