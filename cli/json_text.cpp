#include "cli/json_text.h"

#include "scenes/image_io.h"
#include "scenes/load.h"

#include <nlohmann/json.hpp>

#include <vector>

namespace rawtexel::cli {
namespace {

constexpr size_t kMostBytes = size_t{16} << 20;
constexpr int kMaxNesting = 8;

bool is_nested_too_deeply(std::string_view text) {
    int depth = 0;
    for (const char c : text) {
        if (c == '[' || c == '{') ++depth;
        if (c == ']' || c == '}') --depth;
        if (depth > kMaxNesting) return true;
    }
    return false;
}

}  // namespace

nlohmann::json parse_json(const std::string& path, std::string_view text) {
    if (text.size() > kMostBytes) throw scenes::InputError(path + ": has " + std::to_string(text.size()) + " bytes (allowed: 16 MiB)");
    if (is_nested_too_deeply(text)) throw scenes::InputError(path + ": JSON nested deeper than " + std::to_string(kMaxNesting) + " levels");
    nlohmann::json json = nlohmann::json::parse(text, nullptr, /*allow_exceptions=*/false);
    if (json.is_discarded()) throw scenes::InputError(path + ": not valid JSON");
    return json;
}

nlohmann::json read_json(const std::string& path) {
    const std::vector<std::byte> bytes = scenes::read_file(path);
    return parse_json(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

}  // namespace rawtexel::cli
