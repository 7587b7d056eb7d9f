#include "shading/filtering_options.h"

namespace rawtexel::shading {

std::string_view to_string(FilterOrder order) { return order == FilterOrder::After ? "after" : "before"; }
std::string_view to_string(NumberSharing sharing) { return sharing == NumberSharing::PerMap ? "per-map" : "shared"; }
std::string_view to_string(Blend blend) { return blend == Blend::Draw ? "draw" : "all"; }
std::string_view to_string(ShadowTaps taps) { return taps == ShadowTaps::One ? "one" : "all"; }
std::string_view to_string(TextureJitter jitter) {
    return jitter == TextureJitter::None ? "none" : jitter == TextureJitter::Affine ? "affine" : "perspective";
}

std::optional<FilterOrder> parse_filter_order(std::string_view text) {
    if (text == "before") return FilterOrder::Before;
    if (text == "after") return FilterOrder::After;
    return std::nullopt;
}

std::optional<NumberSharing> parse_number_sharing(std::string_view text) {
    if (text == "shared") return NumberSharing::Shared;
    if (text == "per-map") return NumberSharing::PerMap;
    return std::nullopt;
}

}  // namespace rawtexel::shading
