#include "cli/pixel_explanation.h"

#include <cstring>

namespace rawtexel::cli {

bool same_bits(const glm::vec3& a, const glm::vec3& b) { return std::memcmp(&a, &b, sizeof a) == 0; }

std::string_view name_of(shading::MapSlot slot) {
    static_assert(shading::kLayerMask == shading::kMapSlots);
    constexpr std::array<std::string_view, shading::kMapSlots + 1> kNames{"base colour", "metallic and roughness", "normal", "occlusion",
                                                                          "emission",    "mask of layers"};
    return kNames[size_t(slot)];
}

}  // namespace rawtexel::cli
