#include "texunit/texel_value.h"

#include "texunit/half.h"
#include "texunit/srgb.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace rawtexel::texunit {
namespace {

/// The 32 or 64 bits of a packed texel.
uint64_t load_word(StorageClass storage, const std::byte* texel) {
    if (storage == StorageClass::Packed32) {
        uint32_t word;
        std::memcpy(&word, texel, sizeof(word));
        return word;
    }
    uint64_t word;
    std::memcpy(&word, texel, sizeof(word));
    return word;
}

float field_value(const TexelLayout& layout, int c, uint64_t word) {
    const uint32_t field = uint32_t(word >> layout.shift[c]) & layout.mask[c];
    if (layout.table[c] != nullptr) return layout.table[c][field];
    // Subtracting the sign bit twice over extends it.
    const uint32_t sign = layout.is_signed ? (layout.mask[c] + 1) >> 1 : 0;
    const auto number = float(int32_t(field ^ sign) - int32_t(sign));
    return std::max(number * layout.scale_hi[c] + number * layout.scale_lo[c], -1.0f) + layout.bias[c];
}

}  // namespace

std::array<float, 4> load_texel(const TexelLayout& layout, const std::byte* texel) {
    std::array<float, 4> value;
    if (layout.storage == StorageClass::Float4) {
        std::memcpy(value.data(), texel, sizeof(value));
    } else if (layout.storage == StorageClass::Half4) {
        std::array<uint16_t, 4> halves;
        std::memcpy(halves.data(), texel, sizeof(halves));
        for (size_t c = 0; c < 4; ++c) value[c] = half_to_float(halves[c]);
    } else {
        const uint64_t word = load_word(layout.storage, texel);
        for (int c = 0; c < 4; ++c) value[size_t(c)] = field_value(layout, c, word);
    }
    return value;
}

TexelEncoder::TexelEncoder(const TexelLayout& layout) : layout_(layout) {
    for (size_t c = 0; c < 4; ++c) {
        if (layout.table[c] == nullptr) continue;
        for (int i = 0; i < layout.denominator[c]; ++i) thresholds_[c].push_back(srgb_to_linear((i + 0.5) / layout.denominator[c]));
    }
}

uint64_t TexelEncoder::field(int channel, double linear) const {
    const auto& thresholds = thresholds_[size_t(channel)];
    if (std::isnan(linear)) return 0;
    if (!thresholds.empty()) return uint64_t(std::upper_bound(thresholds.begin(), thresholds.end(), linear) - thresholds.begin());
    const double clamped = std::clamp(linear, layout_.is_signed ? -1.0 : 0.0, 1.0);
    return uint64_t(int64_t(std::floor(clamped * layout_.denominator[channel] + 0.5))) & layout_.mask[channel];
}

void TexelEncoder::store(const std::array<double, 4>& linear, std::byte* texel) const {
    if (layout_.storage == StorageClass::Float4) {
        std::array<float, 4> value;
        for (size_t c = 0; c < 4; ++c) value[c] = float(linear[c]);
        std::memcpy(texel, value.data(), sizeof(value));
        return;
    }
    if (layout_.storage == StorageClass::Half4) {
        std::array<uint16_t, 4> halves;
        for (size_t c = 0; c < 4; ++c) halves[c] = float_to_half(float(linear[c]));
        std::memcpy(texel, halves.data(), sizeof(halves));
        return;
    }
    uint64_t word = 0;
    for (int c = 0; c < 4; ++c) {
        if (layout_.mask[c] != 0) word |= field(c, linear[size_t(c)]) << layout_.shift[c];
    }
    // The low bytes come first: rawtexel runs on little-endian machines.
    std::memcpy(texel, &word, size_t(bytes_per_texel(layout_.storage)));
}

}  // namespace rawtexel::texunit
