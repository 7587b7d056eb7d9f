// Where a glTF keeps what it refers to: data URIs and paths relative to the file.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rawtexel::scenes {

/// What a data URI (RFC 2397) holds; nullopt when it is malformed.
struct DataUri {
    std::string mime_type;
    std::vector<std::byte> bytes;
};
bool is_data_uri(std::string_view uri);
std::optional<DataUri> decode_data_uri(std::string_view uri);

/// Percent escapes resolved (RFC 3986, 2.1); a '%' that starts none stands for itself.
std::string percent_decoded(std::string_view text);

/// True for "http://…", "file:…" and the like, and for absolute paths: everything but data URIs and relative references.
bool leaves_the_folder_tree(std::string_view uri);

}  // namespace rawtexel::scenes
