#include "cli/reports/page.h"

#include "cli/reports/colour_map.h"
#include "cli/reports/page_files.h"
#include "scenes/image_io.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cassert>
#include <cstdio>

namespace rawtexel::cli {
namespace {

using Json = nlohmann::ordered_json;

std::string_view file_text(std::string_view name) {
    const auto files = page_files();
    const auto found = std::ranges::find(files, name, &PageFile::name);
    assert(found != files.end());
    return found->text;
}

std::string colour_map_text() {
    std::string text;
    for (int i = 0; i < 256; ++i)
        for (const uint8_t channel : magma(i / 255.0)) {
            char digits[3];
            std::snprintf(digits, sizeof digits, "%02x", channel);
            text += digits;
        }
    return text;
}

// As the text of a script element: nothing in it ends the element or begins a comment.
std::string script_json(const Json& data) {
    std::string text;
    for (const char c : data.dump(-1, ' ', false, Json::error_handler_t::replace)) text += c == '<' ? "\\u003c" : std::string(1, c);
    return text;
}

}  // namespace

std::string report_page(std::string_view name, Json data) {
    data["colour_map"] = colour_map_text();
    const std::string_view page = file_text(name);
    std::string text;
    size_t at = 0;
    for (size_t open; (open = page.find("{{", at)) != std::string_view::npos;) {
        const size_t close = page.find("}}", open);
        const std::string_view part = page.substr(open + 2, close - open - 2);
        text += page.substr(at, open - at);
        text += part == "data" ? script_json(data) : std::string(file_text(part));
        at = close + 2;
    }
    return text += page.substr(at);
}

std::string picture_address(int width, int height, int channels, std::span<const uint8_t> codes) {
    return "data:image/png;base64," + base64(scenes::encode_png(width, height, channels, 8, std::as_bytes(codes)));
}

std::string base64(std::span<const std::byte> bytes) {
    static constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (size_t i = 0; i < bytes.size(); i += 3) {
        const size_t count = std::min<size_t>(3, bytes.size() - i);
        uint32_t group = 0;
        for (size_t k = 0; k < 3; ++k) group = group << 8 | (k < count ? std::to_integer<uint32_t>(bytes[i + k]) : 0);
        for (size_t k = 0; k < 4; ++k) text += k <= count ? kDigits[group >> (18 - 6 * k) & 63] : '=';
    }
    return text;
}

}  // namespace rawtexel::cli
