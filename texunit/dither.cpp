#include "texunit/dither.h"

namespace rawtexel::texunit {
namespace {

struct Offset {
    float x, y;
};

/// By 2*(y & 1) + (x & 1). A bilinear draw takes texel floor(x + number), so offsets are numbers.
constexpr Offset kUnreal[4] = {{0.25f, 0.0f}, {0.5f, 0.75f}, {0.75f, 0.5f}, {0.0f, 0.25f}};

/// Ninths. A fraction above t is rounded up by the number 1 - t.
constexpr int kStarTrek[8] = {8, 4, 6, 2, 7, 3, 5, 1};

Offset offset_of(Dither dither, int x, int y) {
    switch (dither) {
        case Dither::Unreal: return kUnreal[2 * (y & 1) + (x & 1)];
        case Dither::StarTrek: {
            const auto number = [](int index) { return float(9 - kStarTrek[index]) / 9.0f; };
            return {number(4 * (y & 1) + (x & 3)), number(4 * (x & 1) + (y & 3))};
        }
        case Dither::None: break;
    }
    return {0.0f, 0.0f};
}

}  // namespace

void dither_numbers(Dither dither, int x, int y, DrawNumbers& numbers) {
    numbers = {};
    for (int lane = 0; lane < kWaveLanes; ++lane) {
        const Offset offset = offset_of(dither, x + lane % kWaveWidth, y + lane / kWaveWidth);
        numbers.x[lane] = offset.x;
        numbers.y[lane] = offset.y;
    }
}

}  // namespace rawtexel::texunit
