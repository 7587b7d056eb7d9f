#include "shading/fetch_options.h"

#include <algorithm>
#include <array>

namespace rawtexel::shading {
namespace {

constexpr std::array<std::string_view, 3> kNames = {"visible", "forward", "quad"};

}  // namespace

std::string_view to_string(FetchModel model) { return kNames[size_t(model)]; }

std::optional<FetchModel> parse_fetch_model(std::string_view text) {
    const auto found = std::ranges::find(kNames, text);
    if (found == kNames.end()) return std::nullopt;
    return FetchModel(found - kNames.begin());
}

}  // namespace rawtexel::shading
