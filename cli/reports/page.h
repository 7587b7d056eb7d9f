// Reports as single HTML files: a template of cli/reports/pages with its styles, scripts, pictures and data inside.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace rawtexel::cli {

/// The page `name`, such as "compare.html": "{{FILE}}" is replaced by that file's text, "{{data}}" by `data` with the colours of maps
/// (`colour_map`, 256 of six hexadecimal digits) added. Asserts that the files exist. Text that is not UTF-8 is replaced.
std::string report_page(std::string_view name, nlohmann::ordered_json data);

/// "data:image/png;base64,…" of 8-bit codes, 1 to 4 channels interleaved.
std::string picture_address(int width, int height, int channels, std::span<const uint8_t> codes);

/// RFC 4648, with padding.
std::string base64(std::span<const std::byte> bytes);

}  // namespace rawtexel::cli
