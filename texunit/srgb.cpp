#include "texunit/srgb.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace rawtexel::texunit {
namespace {

// thresholds[i] is the linear value half-way, in code space, between the codes i and i + 1.
std::array<double, 255> build_thresholds() {
    std::array<double, 255> thresholds;
    for (int i = 0; i < 255; ++i) thresholds[size_t(i)] = srgb_to_linear((i + 0.5) / 255);
    return thresholds;
}

std::array<float, 256> build_decoding() {
    std::array<float, 256> values;
    for (int i = 0; i < 256; ++i) values[size_t(i)] = float(srgb_to_linear(i / 255.0));
    return values;
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

const float* srgb8_table() {
    static const std::array<float, 256> table = build_decoding();
    return table.data();
}

}  // namespace rawtexel::texunit
