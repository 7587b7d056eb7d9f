// Ordered dithers: how close a few pixels together come to the bilinear filter.
#include "texunit/dither.h"

#include "tests/texunit/drawn_places.h"
#include "tests/texunit/hashed_source.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace rawtexel::texunit {
namespace {

constexpr int kExtent = 8, kPhases = 64;

/// What the 8x4 pixels at the frame's origin draw where all of them ask at texel (3 + phase_x, 3 + phase_y).
TexelDraw draw_at(Texture& texture, Dither dither, double phase_x, double phase_y) {
    const SamplerState sampler{.mip = MipMode::Nearest, .estimator = Estimator::Reservoir};
    DrawNumbers numbers;
    dither_numbers(dither, 0, 0, numbers);
    TexelDraw draw;
    const LaneCoordinates at{float((3.5 + phase_x) / kExtent), float((3.5 + phase_y) / kExtent), 0, 0, 0, 0};
    draw_wave(texture, sampler, everywhere(at), kWaveFull, numbers, draw);
    return draw;
}

/// Root mean square, over phases and the four texels, of the share of 2x2 pixels that draw a texel minus its bilinear weight.
double unreal_error(double shift) {
    Texture texture("hashed", make_hashed_pyramid(Format::RGBA8Unorm, kExtent, kExtent));
    double squares = 0;
    for (int i = 0; i < kPhases * kPhases; ++i) {
        const int column = i % kPhases, row = i / kPhases;
        const double fx = (column + 0.5) / kPhases, fy = (row + 0.5) / kPhases;
        const TexelDraw draw = draw_at(texture, Dither::Unreal, fx + shift, fy + shift);
        for (int texel = 0; texel < 4; ++texel) {
            const int x = texel % 2, y = texel / 2;
            double share = 0;
            for (const int lane : {0, 1, kWaveWidth, kWaveWidth + 1}) share += draw.x[lane] == 3 + x && draw.y[lane] == 3 + y ? 0.25 : 0;
            const double weight = (x ? fx : 1 - fx) * (y ? fy : 1 - fy);
            squares += (share - weight) * (share - weight);
        }
    }
    return std::sqrt(squares / (4.0 * kPhases * kPhases));
}

TEST(Dither, OfUnrealIsAsFarFromBilinearAsItsOffsetsSay) {
    const double plain = unreal_error(0), centred = unreal_error(0.125);
    std::printf("2x2 pixels against bilinear weights: RMSE %.4f, centred by 1/8 texel %.4f\n", plain, centred);
    EXPECT_NEAR(plain, 0.146, 0.05 * 0.146);
    EXPECT_NEAR(centred, 0.111, 0.05 * 0.111);
}

TEST(Dither, OfStarTrekIsWithinANinthOfBilinearAlongEitherAxis) {
    Texture texture("hashed", make_hashed_pyramid(Format::RGBA8Unorm, kExtent, kExtent));
    double worst = 0;
    for (int phase = 0; phase < 360; ++phase) {
        const double f = (phase + 0.5) / 360;
        const TexelDraw draw = draw_at(texture, Dither::StarTrek, f, f);
        // Every aligned block of eight pixels has all thresholds: 4x2 of them for columns, 2x4 for rows.
        for (int block = 0; block < 4; ++block) {
            const int first_x = block % 2 * 4 + block / 2 * 2 * kWaveWidth, first_y = 2 * block;
            double right = 0, below = 0;
            for (int k = 0; k < 8; ++k) {
                right += draw.x[first_x + k % 4 + k / 4 * kWaveWidth] == 4 ? 0.125 : 0;
                below += draw.y[first_y + k % 2 + k / 2 * kWaveWidth] == 4 ? 0.125 : 0;
            }
            worst = std::max({worst, std::abs(right - f), std::abs(below - f)});
        }
    }
    std::printf("8 pixels against bilinear weights: at most %.4f off\n", worst);
    EXPECT_LE(worst, 1.0 / 9 + 1e-9);
    EXPECT_GT(worst, 0.09);
}

TEST(Dither, GoesByThePlaceInTheFrame) {
    for (const Dither dither : {Dither::Unreal, Dither::StarTrek}) {
        DrawNumbers here, there;
        dither_numbers(dither, 0, 0, here);
        dither_numbers(dither, 128, 68, there);
        for (int lane = 0; lane < kWaveLanes; ++lane) {
            EXPECT_EQ(here.x[lane], there.x[lane]);
            EXPECT_EQ(here.y[lane], there.y[lane]);
            EXPECT_GE(here.x[lane], 0);
            EXPECT_LT(here.x[lane], 1);
        }
        EXPECT_NE(here.x[0], here.x[1]);
    }
}

}  // namespace
}  // namespace rawtexel::texunit
