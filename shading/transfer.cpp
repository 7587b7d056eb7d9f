#include "shading/transfer.h"

#include <bit>
#include <cassert>
#include <cmath>
#include <limits>

namespace rawtexel::shading {

double encoded(double linear, Transfer transfer) {
    switch (transfer) {
        case Transfer::Srgb: return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
        case Transfer::Sqrt: return std::sqrt(linear);
        case Transfer::Linear: break;
    }
    return linear;
}

double decoded(double code, Transfer transfer) {
    switch (transfer) {
        case Transfer::Srgb: return code <= 12.92 * 0.0031308 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4);
        case Transfer::Sqrt: return code * code;
        case Transfer::Linear: break;
    }
    return code;
}

CodeTable::CodeTable(Transfer transfer) {
    threshold_[0] = 0.0f;
    threshold_[256] = std::numeric_limits<float>::infinity();
    for (int k = 1; k < 256; ++k) {
        const double exact = decoded((k - 0.5) / 255.0, transfer);
        float least = float(exact);
        if (double(least) < exact) least = std::nextafter(least, 2.0f);
        threshold_[size_t(k)] = least;
    }
    int code = 0;
    for (uint32_t bucket = 0; bucket < kBuckets; ++bucket) {
        const float start = std::bit_cast<float>((bucket + kFirst) << kBucketBits);
        while (start >= threshold_[size_t(code + 1)]) ++code;
        code_at_start_[bucket] = uint8_t(code);
        assert(code == 255 || bucket == 0 || code - code_at_start_[bucket - 1] <= 1);
    }
    assert(code_at_start_[0] == 0 && code == 255);
}

uint8_t CodeTable::code(float linear) const {
    if (!(linear >= threshold_[1])) return 0;
    if (linear >= 1.0f) return 255;
    const uint8_t below = code_at_start_[(std::bit_cast<uint32_t>(linear) >> kBucketBits) - kFirst];
    return uint8_t(below + (linear >= threshold_[size_t(below) + 1]));
}

}  // namespace rawtexel::shading
