// IEEE 754 binary16, for one value at a time.
#pragma once

#include <bit>
#include <cstdint>

namespace rawtexel::texunit {

/// Exact; infinities and NaNs keep their meaning.
constexpr float half_to_float(uint16_t half) {
    const uint32_t sign = uint32_t(half & 0x8000u) << 16;
    const uint32_t magnitude = half & 0x7FFFu;
    if (magnitude >= 0x7C00u) return std::bit_cast<float>(sign | 0x7F800000u | (magnitude & 0x3FFu) << 13);
    // Moving the bits up divides the value by 2^112, the difference of the exponent biases; subnormals included.
    const float scaled = std::bit_cast<float>(magnitude << 13) * 0x1p112f;
    return std::bit_cast<float>(sign | std::bit_cast<uint32_t>(scaled));
}

/// Rounded to nearest, ties to even; beyond 65520 infinity, NaN a quiet NaN.
constexpr uint16_t float_to_half(float value) {
    const uint32_t bits = std::bit_cast<uint32_t>(value);
    const auto sign = uint16_t(bits >> 16 & 0x8000u);
    const uint32_t magnitude = bits & 0x7FFFFFFFu;
    if (magnitude > 0x7F800000u) return uint16_t(sign | 0x7E00u);
    if (magnitude >= 0x47800000u) return uint16_t(sign | 0x7C00u);
    if (magnitude < 0x38800000u) {
        // Subnormal: adding 0.5 aligns the float's last bit with 2^-24, a half's smallest step, and rounds there.
        const float aligned = std::bit_cast<float>(magnitude) + 0.5f;
        return uint16_t(sign | (std::bit_cast<uint32_t>(aligned) - 0x3F000000u));
    }
    // Rebias the exponent and round 13 bits away; a carry runs into the exponent, up to infinity, as it should.
    const uint32_t odd = magnitude >> 13 & 1u;
    return uint16_t(sign | (magnitude - 0x38000000u + 0xFFFu + odd) >> 13);
}

}  // namespace rawtexel::texunit
