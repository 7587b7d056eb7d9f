#include "shading/interleave.h"

#include "texunit/simd.h"
#include "texunit/wave.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace rawtexel::shading {
namespace {

using texunit::kWaveHeight;
using texunit::kWaveLanes;
using texunit::kWaveWidth;

constexpr int kTile = 32;
constexpr size_t kPixels = kTile * kTile;

/// Where the value of a pixel is in a plane.
size_t place(int x, int y) {
    const int wave = y / kWaveHeight * (kTile / kWaveWidth) + x / kWaveWidth;
    return size_t(wave * kWaveLanes + y % kWaveHeight * kWaveWidth + x % kWaveWidth);
}

TEST(Interleave, PutsEveryPixelInItsPlaceOnEveryInstructionSet) {
    for (const texunit::Simd simd : texunit::available_simd()) {
        ASSERT_TRUE(texunit::choose_simd(simd));
        // Rows that start where vectors do go past the caches; those of other images do not.
        for (int k = 0; k < 12; ++k) {
            const int channels = 1 + k / 3, shift = k % 3 == 1 ? 3 : 0, padding = k % 3 == 2 ? 5 : 16;
            SCOPED_TRACE(std::string(to_string(simd)) + ", " + std::to_string(channels) + " channels, rows " + std::to_string(padding) +
                         " apart, shifted by " + std::to_string(shift));
            std::vector<float> planes(kPixels * size_t(channels));
            for (size_t i = 0; i < planes.size(); ++i) planes[i] = float(i);
            const PixelRect rect{8, 3, 24, 29};
            const size_t stride = 16 * size_t(channels) + size_t(padding);
            std::vector<texunit::WaveFloat> memory(stride * size_t(rect.y1 - rect.y0) / kWaveLanes + 2);
            float* const out = reinterpret_cast<float*>(memory.data()) + shift;
            std::fill_n(out, stride * size_t(rect.y1 - rect.y0), -1.0f);
            interleave_waves({planes.data(), kPixels, kTile / kWaveWidth, channels}, rect, 0.5f, out, stride);
            for (int y = rect.y0; y < rect.y1; ++y) {
                const float* const row = &out[size_t(y - rect.y0) * stride];
                for (int x = rect.x0; x < rect.x1; ++x)
                    for (int c = 0; c < channels; ++c)
                        ASSERT_EQ(row[(x - rect.x0) * channels + c], 0.5f * planes[size_t(c) * kPixels + place(x, y)]) << x << ' ' << y;
                for (size_t beyond = 16 * size_t(channels); beyond < stride; ++beyond) ASSERT_EQ(row[beyond], -1.0f);
            }
        }
    }
    texunit::choose_simd(texunit::Simd::Auto);
}

}  // namespace
}  // namespace rawtexel::shading
