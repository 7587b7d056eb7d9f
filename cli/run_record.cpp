#include "cli/run_record.h"

#include <algorithm>
#include <cctype>

namespace rawtexel::cli {
namespace {

bool is_plain(const std::string& word) {
    constexpr std::string_view kPlain = "_-./,:=+@%";
    return !word.empty() &&
           std::ranges::all_of(word, [&](unsigned char c) { return std::isalnum(c) || kPlain.find(char(c)) != kPlain.npos; });
}

// Inside single quotes a shell reads everything as it is, but for the quote itself.
std::string quoted(const std::string& word) {
    std::string result = "'";
    for (const char c : word) {
        if (c == '\'')
            result += "'\\''";
        else
            result += c;
    }
    return result + "'";
}

}  // namespace

std::vector<texunit::TextureWork> texture_work(const shading::Scene& scene) {
    std::vector<texunit::TextureWork> work;
    for (const shading::SceneTexture& entry : scene.textures) work.push_back(entry.texture->work());
    return work;
}

std::string shell_quoted(const std::vector<std::string>& words) {
    std::string result;
    for (const std::string& word : words) {
        if (!result.empty()) result += ' ';
        result += is_plain(word) ? word : quoted(word);
    }
    return result;
}

}  // namespace rawtexel::cli
