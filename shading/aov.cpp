#include "shading/aov.h"

#include <array>

namespace rawtexel::shading {
namespace {

constexpr std::array<std::string_view, 9> kNames = {"depth", "normal", "albedo", "uv", "lod", "material", "texels", "lines", "spp"};

}  // namespace

std::string_view to_string(Aov aov) { return kNames[size_t(aov)]; }

std::optional<Aov> parse_aov(std::string_view text) {
    for (size_t i = 0; i < kNames.size(); ++i)
        if (kNames[i] == text) return Aov(i);
    return std::nullopt;
}

}  // namespace rawtexel::shading
