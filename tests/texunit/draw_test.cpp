// One texel a lookup: its probabilities are the weights of the filter.
#include "texunit/draw.h"

#include "texunit/lookup_trace.h"
#include "texunit/random.h"
#include "tests/texunit/hashed_source.h"
#include "texunit/simd.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>
#include <tuple>

namespace rawtexel::texunit {
namespace {

/// level, slice, x, y; a border is level -1.
using Place = std::tuple<int, int, int, int>;

DrawNumbers random_numbers(uint32_t sample) {
    DrawNumbers numbers;
    draw_numbers({.x = 0, .y = 8, .sample = sample}, numbers);
    return numbers;
}

WaveCoordinates everywhere(const LaneCoordinates& at) {
    WaveCoordinates wave;
    for (int lane = 0; lane < kWaveLanes; ++lane) {
        wave.u[lane] = at.u, wave.v[lane] = at.v;
        wave.dudx[lane] = at.dudx, wave.dvdx[lane] = at.dvdx, wave.dudy[lane] = at.dudy, wave.dvdy[lane] = at.dvdy;
    }
    return wave;
}

Place place_of(const TexelDraw& draw, int lane) {
    if ((draw.border >> lane & 1) != 0) return {-1, 0, 0, 0};
    return {draw.level[lane], draw.slice[lane], draw.x[lane], draw.y[lane]};
}

/// Chi-square against the weights of the deterministic lookup, as a normal deviate (Wilson and Hilferty 1931); cells of few draws are
/// joined.
double chi_square_deviate(const std::map<Place, double>& weights, const std::map<Place, double>& drawn, double draws) {
    double statistic = 0, joined_expected = 0, joined_drawn = 0;
    int cells = 0;
    const auto add = [&](double expected, double found) {
        statistic += (found - expected) * (found - expected) / expected;
        ++cells;
    };
    for (const auto& [place, weight] : weights) {
        const auto found = drawn.find(place);
        const double count = found == drawn.end() ? 0 : found->second;
        if (weight * draws < 20) {
            joined_expected += weight * draws, joined_drawn += count;
        } else {
            add(weight * draws, count);
        }
    }
    if (joined_expected > 5) add(joined_expected, joined_drawn);
    const double freedom = std::max(cells - 1, 1), share = 2 / (9 * freedom);
    return (std::cbrt(statistic / freedom) - (1 - share)) / std::sqrt(share);
}

TEST(Draw, PicksTexelsWithTheProbabilityOfTheirWeights) {
    constexpr uint32_t kWaves = 4000;  // 128 000 draws a case
    // Some 300 cases: each deviate beyond 5.9 has probability 2e-9, all of them together less than 1e-6.
    constexpr double kBound = 5.9;
    Texture texture("hashed", make_hashed_pyramid(Format::RGBA8Unorm, 48, 20));
    std::mt19937 random(2);
    std::uniform_real_distribution<float> unit(-1, 1);
    double worst = 0;
    int cases = 0;
    const Kernel kernels[] = {Kernel::Nearest,        Kernel::Bilinear,       Kernel::Quadratic,           Kernel::BSpline,
                              Kernel::mitchell(1, 0), Kernel::gaussian(0.7f), Kernel::gaussian_point(0.6f)};
    for (const Kernel& kernel : kernels) {
        for (const Wrap wrap : {Wrap::Repeat, Wrap::MirroredRepeat, Wrap::ClampToEdge, Wrap::ClampToBorder, Wrap::MirrorOnce}) {
            for (const MipMode mip : {MipMode::None, MipMode::Nearest, MipMode::Linear}) {
                for (const int probes : {1, 6}) {
                    if (probes > 1 && mip != MipMode::Linear) continue;
                    SamplerState sampler{.magnify = kernel, .minify = kernel, .mip = mip, .probes = probes};
                    sampler.wrap_s = wrap, sampler.wrap_t = Wrap::Repeat;
                    sampler.probe_variance = probes > 1 && cases % 2 == 0 ? 0.2f : 0.0f;
                    const LaneCoordinates at{1.02f * unit(random), unit(random),         0.04f * unit(random),
                                             0.09f * unit(random), 0.01f * unit(random), 0.02f * unit(random)};
                    const LookupTrace trace = trace_lookup(texture, sampler, at);
                    std::map<Place, double> weights, drawn;
                    for (const TracedTap& tap : trace.taps)
                        weights[tap.border ? Place{-1, 0, 0, 0} : Place{tap.level, tap.slice, tap.x, tap.y}] += tap.weight;
                    TexelDraw draw;
                    for (uint32_t n = 0; n < kWaves; ++n) {
                        draw_wave(texture, sampler, everywhere(at), kWaveFull, random_numbers(uint32_t(cases) * kWaves + n), draw);
                        for (int lane = 0; lane < kWaveLanes; ++lane) ++drawn[place_of(draw, lane)];
                    }
                    for (const auto& [place, count] : drawn)
                        EXPECT_TRUE(weights.contains(place))
                            << to_string(kernel) << " level " << std::get<0>(place) << " x " << std::get<2>(place);
                    const double deviate = chi_square_deviate(weights, drawn, double(kWaves) * kWaveLanes);
                    EXPECT_LT(deviate, kBound) << to_string(kernel) << " wrap " << int(wrap) << " mip " << int(mip) << " probes " << probes;
                    worst = std::max(worst, deviate);
                    ++cases;
                }
            }
        }
    }
    std::printf("%d cases, largest deviate %.2f\n", cases, worst);
}

/// Numbers on a fine grid are a quadrature of the draw: the kernel's weights come out to the grid's step.
TEST(Draw, OverAllNumbersGivesTheWeights) {
    constexpr int kSteps = 256;
    Texture texture("hashed", make_hashed_pyramid(Format::RGBA8Unorm, 32, 32));
    for (const Kernel& kernel : {Kernel::Bilinear, Kernel::Quadratic, Kernel::BSpline, Kernel::gaussian(0.5f)}) {
        const SamplerState sampler{.magnify = kernel, .minify = kernel, .mip = MipMode::None};
        const LaneCoordinates at{0.3717f, 0.2229f, 0, 0, 0, 0};
        std::map<Place, double> weights, drawn;
        for (const TracedTap& tap : trace_lookup(texture, sampler, at).taps) weights[{tap.level, 0, tap.x, tap.y}] = tap.weight;
        DrawNumbers numbers{};
        TexelDraw draw;
        for (int i = 0; i < kSteps * kSteps; i += kWaveLanes) {
            for (int lane = 0; lane < kWaveLanes; ++lane) {
                numbers.x[lane] = (float((i + lane) % kSteps) + 0.5f) / kSteps;
                numbers.y[lane] = (float((i + lane) / kSteps) + 0.5f) / kSteps;
            }
            draw_wave(texture, sampler, everywhere(at), kWaveFull, numbers, draw);
            for (int lane = 0; lane < kWaveLanes; ++lane) drawn[place_of(draw, lane)] += 1.0 / (kSteps * kSteps);
        }
        for (const auto& [place, weight] : weights) EXPECT_NEAR(drawn[place], weight, 2.0 / kSteps) << to_string(kernel);
    }
}

class DrawOnSimd : public testing::TestWithParam<Simd> {};

TEST_P(DrawOnSimd, HashesTheNumbersOfItsPixels) {
    const Simd before = chosen_simd();
    ASSERT_TRUE(choose_simd(GetParam()));
    DrawNumbers numbers;
    draw_numbers({.x = 40, .y = 12, .sample = 3, .surface = 5, .seed = 9}, numbers);
    ASSERT_TRUE(choose_simd(before));
    for (uint32_t lane = 0; lane < kWaveLanes; ++lane) {
        RandomAddress address{.x = 40 + lane % 8, .y = 12 + lane / 8, .sample = 3, .surface = 5, .seed = 9};
        for (const auto& [number, dimension] : {std::pair{&numbers.x, Dimension::TapX},
                                                {&numbers.y, Dimension::TapY},
                                                {&numbers.level, Dimension::Level},
                                                {&numbers.probe, Dimension::Probe}}) {
            address.dimension = dimension;
            EXPECT_EQ((*number)[int(lane)], random_float(address));
        }
    }
}

TEST_P(DrawOnSimd, PicksTheSameTexelsAndReadsThem) {
    Texture texture("hashed", make_hashed_pyramid(Format::RGBA16Unorm, 100, 64));
    std::mt19937 random(9);
    std::uniform_real_distribution<float> unit(-1, 1);
    const Simd before = chosen_simd();
    for (uint32_t n = 0; n < 200; ++n) {
        const Kernel kernel = n % 3 == 0 ? Kernel::Bilinear : n % 3 == 1 ? Kernel::BSpline : Kernel::gaussian(1.1f);
        SamplerState sampler{.magnify = Kernel::Bilinear, .minify = kernel, .probes = n % 2 == 0 ? 1 : 12};
        sampler.wrap_s = Wrap::ClampToBorder;
        sampler.border = {0.5f, 0.25f, 2, 1};
        WaveCoordinates at;
        for (int lane = 0; lane < kWaveLanes; ++lane) {
            at.u[lane] = 1.1f * unit(random), at.v[lane] = unit(random);
            at.dudx[lane] = 0.1f * unit(random), at.dvdx[lane] = 0.1f * unit(random);
            at.dudy[lane] = 0.03f * unit(random), at.dvdy[lane] = 0.03f * unit(random);
        }
        const WaveMask mask = n % 4 == 0 ? 0x00FFF001u : kWaveFull;
        TexelDraw expected, found;
        WaveColor colour, direct;
        ASSERT_TRUE(choose_simd(Simd::Scalar));
        draw_wave(texture, sampler, at, mask, random_numbers(n), expected);
        ASSERT_TRUE(choose_simd(GetParam()));
        draw_wave(texture, sampler, at, mask, random_numbers(n), found);
        read_drawn_wave(texture, sampler, found, colour);
        sample_drawn_wave(texture, sampler, at, mask, random_numbers(n), direct);
        for (int lane = 0; lane < kWaveLanes; ++lane) {
            if ((mask >> lane & 1) == 0) continue;
            EXPECT_EQ(place_of(found, lane), place_of(expected, lane)) << n;
            const bool border = (found.border >> lane & 1) != 0;
            const std::array<float, 4> texel = border ? sampler.border : texture.texel(found.level[lane], 0, found.x[lane], found.y[lane]);
            for (int c = 0; c < 4; ++c) {
                EXPECT_EQ(colour.channel[c][lane], texel[size_t(c)]);
                EXPECT_EQ(direct.channel[c][lane], texel[size_t(c)]);
            }
        }
    }
    ASSERT_TRUE(choose_simd(before));
}

INSTANTIATE_TEST_SUITE_P(All, DrawOnSimd, testing::ValuesIn(available_simd()),
                         [](const auto& tested) { return std::string(to_string(tested.param)); });

TEST(Draw, KnowsWhichKernelsAreProbabilities) {
    for (const Kernel& kernel :
         {Kernel::Nearest, Kernel::Bilinear, Kernel::Quadratic, Kernel::BSpline, Kernel::gaussian(), Kernel::mitchell(1, 0)})
        EXPECT_TRUE(weighs_as_probability(kernel)) << to_string(kernel);
    for (const Kernel& kernel : {Kernel::mitchell(), Kernel::CatmullRom, Kernel::Lanczos2, Kernel::Lanczos3})
        EXPECT_FALSE(weighs_as_probability(kernel)) << to_string(kernel);
}

}  // namespace
}  // namespace rawtexel::texunit
