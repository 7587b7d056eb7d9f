#include "cli/reports/colour_map.h"

#include <algorithm>
#include <cmath>
#include <string_view>

namespace rawtexel::cli {
namespace {

constexpr int kColours = 256;

// Two hexadecimal digits a channel.
constexpr std::string_view kMagma =
    "00000401000501010601010802010902020b02020d03030f03031204041405041606051806051a07061c08071e0907200a08220b09240c09260d0a290e0b2b"
    "100b2d110c2f120d31130d34140e36150e38160f3b180f3d19103f1a10421c10441d11471e114920114b21114e22115024125325125527125829115a2a115c"
    "2c115f2d11612f116331116533106734106936106b38106c390f6e3b0f703d0f713f0f72400f74420f75440f764510774710784910784a10794c117a4e117b"
    "4f127b51127c52137c54137d56147d57157e59157e5a167e5c167f5d177f5f187f601880621980641a80651a80671b80681c816a1c816b1d816d1d816e1e81"
    "701f81721f817320817521817621817822817922827b23827c23827e24828025828125818326818426818627818827818928818b29818c29818e2a81902a81"
    "912b81932b80942c80962c80982d80992d809b2e7f9c2e7f9e2f7fa02f7fa1307ea3307ea5317ea6317da8327daa337dab337cad347cae347bb0357bb2357b"
    "b3367ab5367ab73779b83779ba3878bc3978bd3977bf3a77c03a76c23b75c43c75c53c74c73d73c83e73ca3e72cc3f71cd4071cf4070d0416fd2426fd3436e"
    "d5446dd6456cd8456cd9466bdb476adc4869de4968df4a68e04c67e24d66e34e65e44f64e55064e75263e85362e95462ea5661eb5760ec5860ed5a5fee5b5e"
    "ef5d5ef05f5ef1605df2625df2645cf3655cf4675cf4695cf56b5cf66c5cf66e5cf7705cf7725cf8745cf8765cf9785df9795df97b5dfa7d5efa7f5efa815f"
    "fb835ffb8560fb8761fc8961fc8a62fc8c63fc8e64fc9065fd9266fd9467fd9668fd9869fd9a6afd9b6bfe9d6cfe9f6dfea16efea36ffea571fea772fea973"
    "feaa74feac76feae77feb078feb27afeb47bfeb67cfeb77efeb97ffebb81febd82febf84fec185fec287fec488fec68afec88cfeca8dfecc8ffecd90fecf92"
    "fed194fed395fed597fed799fed89afdda9cfddc9efddea0fde0a1fde2a3fde3a5fde5a7fde7a9fde9aafdebacfcecaefceeb0fcf0b2fcf2b4fcf4b6fcf6b8"
    "fcf7b9fcf9bbfcfbbdfcfdbf";
static_assert(kMagma.size() == kColours * 6);

constexpr uint8_t digit(char c) { return uint8_t(c <= '9' ? c - '0' : c - 'a' + 10); }

constexpr std::array<Rgb8, kColours> read_colours() {
    std::array<Rgb8, kColours> colours{};
    for (size_t i = 0; i < kMagma.size(); i += 2) colours[i / 6][i / 2 % 3] = uint8_t(digit(kMagma[i]) * 16 + digit(kMagma[i + 1]));
    return colours;
}

constexpr std::array<Rgb8, kColours> kColourTable = read_colours();

}  // namespace

Rgb8 magma(double value) {
    if (std::isnan(value)) return kNotANumber;
    return kColourTable[size_t(std::lround(std::clamp(value, 0.0, 1.0) * (kColours - 1)))];
}

std::vector<uint8_t> magma_codes(std::span<const float> values, double low, double high) {
    std::vector<uint8_t> codes;
    codes.reserve(values.size() * 3);
    const double scale = high > low ? 1.0 / (high - low) : 0.0;
    for (const float value : values) {
        const Rgb8 colour = magma((double(value) - low) * scale);
        codes.insert(codes.end(), colour.begin(), colour.end());
    }
    return codes;
}

}  // namespace rawtexel::cli
