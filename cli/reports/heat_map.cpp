#include "cli/reports/heat_map.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdio>

namespace rawtexel::cli {
namespace {

constexpr int kScale = 2, kMargin = 6;
constexpr Rgb8 kPaper{255, 255, 255}, kInk{20, 20, 24};

std::string number(double value) {
    std::array<char, 32> text;
    std::snprintf(text.data(), text.size(), "%.6g", value);
    return text.data();
}

}  // namespace

Canvas draw_heat_map(const shading::Image& values, const HeatMap& map) {
    assert(values.channels == 1);
    Canvas canvas(std::max(values.width, kLeastHeatMapWidth), values.height + kLegendHeight, kPaper);
    const std::vector<uint8_t> codes = magma_codes(values.values, map.low, map.high);
    for (int y = 0; y < values.height; ++y)
        std::copy_n(codes.begin() + ptrdiff_t(y) * values.width * 3, values.width * 3,
                    canvas.codes.begin() + ptrdiff_t(y) * canvas.width * 3);

    const int top = values.height + kMargin, below = top + kLetterHeight * kScale + kMargin;
    draw_text(canvas, kMargin, top, map.label, kScale, kInk);
    const std::string low = number(map.low), high = number(map.high);
    draw_text(canvas, kMargin, below, low, kScale, kInk);
    const int bar = kMargin + text_width(low, kScale) + kMargin;
    const int length = std::min(256, canvas.width - bar - 2 * kMargin - text_width(high, kScale));
    for (int i = 0; i < length; ++i) canvas.fill(bar + i, below, 1, kLetterHeight * kScale, magma(i / double(length - 1)));
    draw_text(canvas, bar + length + kMargin, below, high, kScale, kInk);
    return canvas;
}

double finite_maximum(const shading::Image& values) {
    double most = 0;
    for (const float value : values.values)
        if (std::isfinite(value)) most = std::max(most, double(value));
    return most;
}

}  // namespace rawtexel::cli
