#include "scenes/gltf_uri.h"

#include <algorithm>
#include <array>
#include <cctype>

namespace rawtexel::scenes {
namespace {

int hex_digit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
}

/// Value of a base64 digit (RFC 4648, section 4, and the URL-safe letters of section 5), or -1.
int base64_digit(char c) {
    if (c >= 'A' && c <= 'Z') return c - 'A';
    if (c >= 'a' && c <= 'z') return c - 'a' + 26;
    if (c >= '0' && c <= '9') return c - '0' + 52;
    if (c == '+' || c == '-') return 62;
    if (c == '/' || c == '_') return 63;
    return -1;
}

std::optional<std::vector<std::byte>> decode_base64(std::string_view text) {
    while (!text.empty() && text.back() == '=') text.remove_suffix(1);
    if (text.size() % 4 == 1) return std::nullopt;
    std::vector<std::byte> bytes;
    bytes.reserve(text.size() / 4 * 3 + 2);
    uint32_t bits = 0;
    int held = 0;
    for (const char c : text) {
        const int digit = base64_digit(c);
        if (digit < 0) return std::nullopt;
        bits = bits << 6 | uint32_t(digit);
        held += 6;
        if (held < 8) continue;
        held -= 8;
        bytes.push_back(std::byte(bits >> held & 0xff));
    }
    return bytes;
}

}  // namespace

bool is_data_uri(std::string_view uri) {
    constexpr std::string_view kScheme = "data:";
    return uri.size() >= kScheme.size() &&
           std::ranges::equal(uri.substr(0, kScheme.size()), kScheme, {}, [](unsigned char c) { return char(std::tolower(c)); });
}

std::optional<DataUri> decode_data_uri(std::string_view uri) {
    const size_t comma = uri.find(',');
    if (!is_data_uri(uri) || comma == uri.npos) return std::nullopt;
    std::string_view header = uri.substr(5, comma - 5);
    const std::string_view payload = uri.substr(comma + 1);

    constexpr std::string_view kBase64 = ";base64";
    const bool base64 = header.ends_with(kBase64);
    if (base64) header.remove_suffix(kBase64.size());
    DataUri data{std::string(header.substr(0, header.find(';'))), {}};
    if (base64) {
        auto bytes = decode_base64(payload);
        if (!bytes) return std::nullopt;
        data.bytes = std::move(*bytes);
    } else {
        const std::string text = percent_decoded(payload);
        std::ranges::transform(text, std::back_inserter(data.bytes), [](char c) { return std::byte(c); });
    }
    return data;
}

std::string percent_decoded(std::string_view text) {
    std::string decoded;
    decoded.reserve(text.size());
    for (size_t i = 0; i < text.size(); ++i) {
        const int high = text[i] == '%' && i + 2 < text.size() ? hex_digit(text[i + 1]) : -1;
        const int low = high >= 0 ? hex_digit(text[i + 2]) : -1;
        if (low >= 0) {
            decoded += char(high << 4 | low);
            i += 2;
        } else {
            decoded += text[i];
        }
    }
    return decoded;
}

bool leaves_the_folder_tree(std::string_view uri) {
    if (uri.starts_with('/')) return true;
    // scheme = ALPHA *( ALPHA / DIGIT / "+" / "-" / "." ) ":"   (RFC 3986, 3.1)
    const size_t colon = uri.find(':');
    if (colon == uri.npos || colon == 0 || !std::isalpha(static_cast<unsigned char>(uri[0]))) return false;
    return std::ranges::all_of(uri.substr(0, colon), [](unsigned char c) { return std::isalnum(c) || c == '+' || c == '-' || c == '.'; });
}

}  // namespace rawtexel::scenes
