#include "texunit/bc_rounding.h"

namespace rawtexel::texunit {

std::string_view to_string(BcRounding rounding) {
    constexpr std::array<std::string_view, kBcRoundings.size()> kNames = {"exact", "ideal8", "nvidia", "amd"};
    return kNames[size_t(rounding)];
}

std::optional<BcRounding> parse_bc_rounding(std::string_view text) {
    for (const BcRounding rounding : kBcRoundings) {
        if (to_string(rounding) == text) return rounding;
    }
    return std::nullopt;
}

}  // namespace rawtexel::texunit
