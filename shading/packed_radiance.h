// RGB radiance in 64 bits: 21 bits a channel, a float without its sign and last ten bits. Any magnitude, relative error at most 2^-14.
#pragma once

#include <glm/glm.hpp>

#include <algorithm>
#include <bit>
#include <cstdint>

namespace rawtexel::shading {

struct PackedRadiance {
    uint32_t red_green;   ///< red in the top 21 bits, then the top 11 bits of green
    uint32_t blue_green;  ///< blue in the top 21 bits, a zero, then the low 10 bits of green
    bool operator==(const PackedRadiance&) const = default;
};

/// Nearest 21-bit value of a float; negative and NaN give 0, huge ones 1e37.
inline uint32_t packed_channel(float value) {
    const uint32_t bits = std::bit_cast<uint32_t>(std::min(value > 0.0f ? value : 0.0f, 1e37f));
    return (bits + 0x1FFu + ((bits >> 10) & 1u)) >> 10;
}

inline PackedRadiance pack_radiance(const glm::vec3& rgb) {
    const uint32_t green = packed_channel(rgb.g);
    return {packed_channel(rgb.r) << 11 | green >> 10, packed_channel(rgb.b) << 11 | (green & 0x3FFu)};
}

inline glm::vec3 unpack_radiance(const PackedRadiance& packed) {
    const uint32_t green = (packed.red_green & 0x7FFu) << 10 | (packed.blue_green & 0x3FFu);
    return {std::bit_cast<float>(packed.red_green >> 11 << 10), std::bit_cast<float>(green << 10),
            std::bit_cast<float>(packed.blue_green >> 11 << 10)};
}

}  // namespace rawtexel::shading
