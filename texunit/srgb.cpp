#include "texunit/srgb.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace rawtexel::texunit {
namespace {

// thresholds[i] is the linear value half-way, in code space, between the codes i and i + 1.
std::array<double, 255> build_thresholds() {
    std::array<double, 255> thresholds;
    for (int i = 0; i < 255; ++i) thresholds[size_t(i)] = srgb_to_linear((i + 0.5) / 255);
    return thresholds;
}

Srgb8Tables build_decoding() {
    Srgb8Tables tables;
    for (int i = 0; i < 256; ++i) {
        tables.whole[i] = float(srgb_to_linear(i / 255.0));
        const auto bits = std::bit_cast<uint32_t>(tables.whole[i]);
        tables.low[i] = uint16_t(bits);
        tables.high[i] = uint16_t(bits >> 16);
    }
    return tables;
}

}  // namespace

double srgb_to_linear(double encoded) { return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4); }

double linear_to_srgb(double linear) {
    if (!(linear > 0)) return 0;
    if (linear >= 1) return 1;
    return linear <= 0.0031308 ? linear * 12.92 : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

uint8_t encode_srgb8(float linear) {
    static const std::array<double, 255> thresholds = build_thresholds();
    if (!(linear > 0)) return 0;
    return uint8_t(std::upper_bound(thresholds.begin(), thresholds.end(), double(linear)) - thresholds.begin());
}

const Srgb8Tables& srgb8_tables() {
    static const Srgb8Tables tables = build_decoding();
    return tables;
}

const float* srgb8_table() { return srgb8_tables().whole; }

}  // namespace rawtexel::texunit
