// What blue and stbn are for: little energy at low frequencies, over the pixels of a frame and over the frames of a pixel.
#include "texunit/noise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <array>
#include <numbers>
#include <vector>

namespace rawtexel::texunit {
namespace {

constexpr uint32_t kExtent = 128;    ///< pixels of a frame: a period of either mask
constexpr int kBand = kExtent / 8;   ///< low spatial frequencies: up to 1/8 cycle a pixel
constexpr uint32_t kPeriod = 32;     ///< samples
constexpr double kWhite = 1.0 / 12;  ///< energy of unrelated numbers at every frequency

using Frame = std::vector<double>;  ///< kExtent rows of kExtent pixels

/// The first and the second numbers of a pair.
struct PairFrames {
    Frame a = Frame(kExtent * kExtent), b = a;
};

PairFrames frames_of(Noise noise, const RandomAddress& at) {
    PairFrames frames;
    for (uint32_t y = 0; y < kExtent; y += kWaveHeight) {
        for (uint32_t x = 0; x < kExtent; x += kWaveWidth) {
            WaveFloat a, b;
            noise_pair_wave(noise, {x, y, at.sample, at.surface, at.dimension, at.seed}, Dimension::TapY, a, b);
            for (uint32_t lane = 0; lane < kWaveLanes; ++lane) {
                const size_t pixel = (y + lane / kWaveWidth) * kExtent + x + lane % kWaveWidth;
                frames.a[pixel] = double(a[int(lane)]);
                frames.b[pixel] = double(b[int(lane)]);
            }
        }
    }
    return frames;
}

using Complex = std::complex<double>;
Complex turn(int step, int of) { return std::polar(1.0, -2 * std::numbers::pi * step / of); }

/// Mean energy of the frequencies up to kBand, the mean value left out; kWhite for unrelated numbers.
double low_energy(const Frame& frame) {
    // Along rows, then along columns.
    std::vector<Complex> turns;
    for (int i = 0; i < int(kExtent); ++i) turns.push_back(turn(i, kExtent));
    double sum = 0;
    int count = 0;
    for (int u = 0; u <= kBand; ++u) {
        std::vector<Complex> rows(kExtent);
        for (uint32_t y = 0; y < kExtent; ++y) {
            for (uint32_t x = 0; x < kExtent; ++x) rows[y] += frame[y * kExtent + x] * turns[uint32_t(u) * x % kExtent];
        }
        for (int v = -kBand; v <= kBand; ++v) {
            if ((u == 0 && v <= 0) || u * u + v * v > kBand * kBand) continue;
            Complex wave = 0;
            for (uint32_t y = 0; y < kExtent; ++y) wave += rows[y] * turns[uint32_t(v + int(kExtent)) * y % kExtent];
            sum += std::norm(wave) / (kExtent * kExtent);
            ++count;
        }
    }
    return sum / count;
}

double decibels(double energy) { return 10 * std::log10(energy / kWhite); }

/// Of the first and of the second numbers, in decibels from white, meaned over frames of many kinds.
std::pair<double, double> mean_low_energies(Noise noise) {
    double a = 0, b = 0;
    constexpr uint32_t kFrames = 8;
    for (uint32_t i = 0; i < kFrames; ++i) {
        const auto dimension = i % 2 == 0 ? Dimension::TapX : Dimension::Level;
        const PairFrames frames = frames_of(noise, {0, 0, 11 * i * i, i < 4 ? 0 : i, dimension, i / 3});
        a += low_energy(frames.a) / kFrames;
        b += low_energy(frames.b) / kFrames;
    }
    return {decibels(a), decibels(b)};
}

TEST(NoiseSpectrum, BlueAndStbnHaveLittleEnergyAtLowSpatialFrequencies) {
    for (const Noise noise : {Noise::White, Noise::Sobol, Noise::R2}) {
        const auto [a, b] = mean_low_energies(noise);
        EXPECT_NEAR(a, 0, 0.5) << to_string(noise);
        EXPECT_NEAR(b, 0, 0.5) << to_string(noise);
    }
    for (const Noise noise : {Noise::Blue, Noise::Stbn}) {
        const auto [a, b] = mean_low_energies(noise);
        std::printf("%s: %.1f dB, second of pairs %.1f dB\n", std::string(to_string(noise)).c_str(), a, b);
        EXPECT_LT(a, -10.5) << to_string(noise);
        EXPECT_LT(b, -10.5) << to_string(noise);
    }
    // The first sample shows the mask itself.
    const PairFrames frames = frames_of(Noise::Blue, {.dimension = Dimension::TapX});
    std::printf("blue at sample 0: %.1f dB, second of pairs %.1f dB\n", decibels(low_energy(frames.a)), decibels(low_energy(frames.b)));
    EXPECT_LT(decibels(low_energy(frames.a)), -30);
    EXPECT_LT(decibels(low_energy(frames.b)), -25);
}

/// What a smooth function makes of a pair, here which of four texels it draws, is blue as well, though less.
TEST(NoiseSpectrum, DrawsByPairsHaveLessLowEnergyThanByUnrelatedNumbers) {
    for (const Noise noise : {Noise::White, Noise::Blue, Noise::Stbn}) {
        double energy = 0, second_elsewhere = 0;
        const auto draw = [](double a, double b) { return a < 0.5 && b < 0.5 ? 1.0 : 0.0; };
        for (uint32_t sample = 0; sample < 4; ++sample) {
            const PairFrames frames = frames_of(noise, {.sample = sample, .dimension = Dimension::TapX});
            const PairFrames others = frames_of(noise, {.sample = sample, .dimension = Dimension::Level});
            Frame together(frames.a), apart(frames.a);
            for (size_t i = 0; i < together.size(); ++i)
                together[i] = draw(frames.a[i], frames.b[i]), apart[i] = draw(frames.a[i], others.a[i]);
            energy += low_energy(together) / 4, second_elsewhere += low_energy(apart) / 4;
        }
        const double white = 0.25 * 0.75;
        std::printf("%s: %.1f dB by a pair, %.1f dB by two numbers\n", std::string(to_string(noise)).c_str(),
                    10 * std::log10(energy / white), 10 * std::log10(second_elsewhere / white));
        if (noise == Noise::White) {
            EXPECT_NEAR(energy / white, 1, 0.1);
        } else {
            EXPECT_LT(energy, 0.6 * second_elsewhere) << to_string(noise);
        }
    }
}

TEST(NoiseSpectrum, StbnHasLittleEnergyAtLowTemporalFrequencies) {
    constexpr int kLow = kPeriod / 8;  // up to 1/8 cycle a sample
    for (const Noise noise : {Noise::White, Noise::Stbn}) {
        double energy[2] = {};
        int count = 0;
        for (uint32_t wave = 0; wave < 512; ++wave, ++count) {
            std::vector<std::array<WaveFloat, 2>> numbers(kPeriod);
            const RandomAddress first{wave % 16 * 8, wave / 16 * 4, 0, wave % 3, wave % 2 == 0 ? Dimension::TapX : Dimension::Level};
            for (uint32_t n = 0; n < kPeriod; ++n) {
                RandomAddress at = first;
                at.sample = kPeriod * (wave % 5) + n;
                noise_pair_wave(noise, at, Dimension::TapY, numbers[n][0], numbers[n][1]);
            }
            for (size_t of : {0, 1}) {
                for (int lane = 0; lane < kWaveLanes; ++lane) {
                    for (int u = 1; u <= kLow; ++u) {
                        std::complex<double> sum = 0;
                        for (int n = 0; n < int(kPeriod); ++n) sum += double(numbers[size_t(n)][of][lane]) * turn(u * n, kPeriod);
                        energy[of] += std::norm(sum) / (kPeriod * kLow * kWaveLanes * 512.0);
                    }
                }
            }
        }
        const double a = decibels(energy[0]), b = decibels(energy[1]);
        if (noise == Noise::White) {
            EXPECT_NEAR(a, 0, 0.2);
            EXPECT_NEAR(b, 0, 0.2);
        } else {
            std::printf("stbn over a period: %.1f dB, second of pairs %.1f dB\n", a, b);
            EXPECT_LT(a, -12);
            EXPECT_LT(b, -10.5);
        }
    }
}

/// A ramp between texels 0 and 1 that are 48 pixels apart, one of which each pixel draws in each frame: the error of the exponential moving
/// average, from frame 64 on.
double moving_average_error(Noise noise) {
    constexpr double kAlpha = 0.05;
    constexpr uint32_t kWidth = 48, kRows = 48, kFrames = 256;
    std::vector<double> history(kWidth * kRows, 0.5);
    double squares = 0;
    int count = 0;
    for (uint32_t frame = 0; frame < kFrames; ++frame) {
        for (uint32_t wave = 0; wave < kWidth / 8 * kRows / 4; ++wave) {
            const uint32_t left = wave % (kWidth / 8) * 8, top = wave / (kWidth / 8) * 4;
            WaveFloat numbers;
            noise_wave(noise, {left, top, frame, 0, Dimension::TapX}, numbers);
            for (uint32_t lane = 0; lane < kWaveLanes; ++lane) {
                const uint32_t x = left + lane % 8, y = top + lane / 8;
                const double weight = (x + 0.5) / kWidth, drawn = double(numbers[int(lane)]) < weight ? 1 : 0;
                double& mean = history[y * kWidth + x];
                mean += kAlpha * (drawn - mean);
                if (frame < 64) continue;
                squares += (mean - weight) * (mean - weight);
                ++count;
            }
        }
    }
    return std::sqrt(squares / count);
}

TEST(NoiseSpectrum, MovingAveragesOfADrawnRampAreNearerItThanByWhite) {
    const double white = moving_average_error(Noise::White);
    for (const Noise noise : {Noise::Sobol, Noise::R2, Noise::Blue, Noise::Stbn}) {
        const double error = moving_average_error(noise);
        std::printf("%s: %.4f, white %.4f\n", std::string(to_string(noise)).c_str(), error, white);
        EXPECT_LT(error, 0.75 * white) << to_string(noise);
    }
    // Independent draws keep alpha/(2 - alpha) of the variance, whose mean over the ramp is 1/6.
    EXPECT_NEAR(white, std::sqrt(0.05 / 1.95 / 6), 0.002);
}

}  // namespace
}  // namespace rawtexel::texunit
