// One texel a lookup: its probabilities are the weights of the filter.
#include "texunit/draw.h"

#include "texunit/lookup_trace.h"
#include "texunit/memory_source.h"
#include "texunit/random.h"
#include "tests/reference/texunit/kernel_reference.h"
#include "tests/texunit/drawn_places.h"
#include "tests/texunit/hashed_source.h"
#include "texunit/simd.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace rawtexel::texunit {
namespace {

DrawNumbers random_numbers(uint32_t sample) {
    DrawNumbers numbers;
    draw_numbers({.x = 0, .y = 8, .sample = sample}, numbers);
    return numbers;
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
                    for (const TracedTap& tap : trace.taps) weights[place_of(tap)] += tap.weight;
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

/// A lookup by positivization: how its two texels are drawn, and the red that they make.
SignedDraw signed_draw(Texture& texture, const SamplerState& sampler, const WaveCoordinates& at, const RandomAddress& first) {
    DrawNumbers positive, negative;
    draw_numbers(first, positive);
    negative_draw_numbers(first, negative);
    SignedDraw draw;
    draw_signed_wave(texture, sampler, at, kWaveFull, positive, negative, draw);
    return draw;
}
WaveFloat signed_value(Texture& texture, const SamplerState& sampler, const SignedDraw& draw) {
    WaveColor above, below;
    read_drawn_wave(texture, sampler, draw.positive, above);
    read_drawn_wave(texture, sampler, draw.negative, below);
    WaveFloat value;
    for (int lane = 0; lane < kWaveLanes; ++lane)
        value[lane] = draw.positive_weight[lane] * above.channel[0][lane] - draw.negative_weight[lane] * below.channel[0][lane];
    return value;
}

const Kernel kSignedKernels[] = {Kernel::mitchell(), Kernel::CatmullRom, Kernel::Lanczos2, Kernel::Lanczos3, Kernel::mitchell(0.2f, 0.9f)};

/// On centres and edges of texels some taps weigh nothing, and no number draws them, the least and the largest neither.
TEST(Draw, NeverDrawsATexelThatWeighsNothing) {
    constexpr int kExtent = 16;
    Texture texture("hashed", make_hashed_pyramid(Format::RGBA8Unorm, kExtent, kExtent));
    struct Case {
        Kernel kernel;
        float place;                  ///< texels from the left edge of one
        std::vector<int> neighbours;  ///< that weigh something there
    };
    const Case cases[] = {{Kernel::Nearest, 0.5f, {0}},
                          {Kernel::Bilinear, 0.5f, {0}},
                          {Kernel::mitchell(0, 0), 0.5f, {0}},
                          {Kernel::Quadratic, 0.5f, {-1, 0, 1}},
                          {Kernel::Quadratic, 0.0f, {-1, 0}},
                          {Kernel::BSpline, 0.5f, {-1, 0, 1}},
                          {Kernel::mitchell(1, 0), 0.5f, {-1, 0, 1}}};
    for (const Case& of : cases) {
        for (const Estimator estimator : {Estimator::Reservoir, Estimator::Jitter}) {
            SamplerState sampler{.magnify = of.kernel, .minify = of.kernel, .mip = MipMode::None};
            sampler.estimator = estimator;
            for (const float number : {0.0f, 1 - 0x1p-24f}) {
                WaveCoordinates at{};
                DrawNumbers numbers{};
                for (int lane = 0; lane < kWaveLanes; ++lane) {
                    at.u[lane] = (float(lane % kExtent) + of.place) / kExtent, at.v[lane] = 0.5f / kExtent;
                    numbers.x[lane] = number, numbers.y[lane] = 0.5f;
                }
                TexelDraw drawn;
                draw_wave(texture, sampler, at, kWaveFull, numbers, drawn);
                for (int lane = 0; lane < kWaveLanes; ++lane) {
                    const bool weighs = std::any_of(of.neighbours.begin(), of.neighbours.end(),
                                                    [&](int neighbour) { return (lane + neighbour + kExtent) % kExtent == drawn.x[lane]; });
                    EXPECT_TRUE(weighs) << to_string(of.kernel) << ' ' << to_string(estimator) << " drew texel " << drawn.x[lane] << " at "
                                        << lane % kExtent << " + " << of.place << " with " << number;
                }
            }
        }
    }
}

TEST(SignedDraw, PicksTexelsOfEitherSignWithTheProbabilityOfTheirWeights) {
    constexpr uint32_t kWaves = 4000;
    constexpr double kBound = 5.9;  // 120 deviates
    Texture texture("hashed", make_hashed_pyramid(Format::RGBA8Unorm, 48, 20));
    std::mt19937 random(4);
    std::uniform_real_distribution<float> unit(-1, 1);
    double worst = 0;
    uint32_t cases = 0;
    for (const Kernel& kernel : kSignedKernels) {
        for (const Wrap wrap : {Wrap::Repeat, Wrap::MirroredRepeat, Wrap::ClampToEdge, Wrap::ClampToBorder}) {
            for (const int probes : {1, 1, 5}) {
                SamplerState sampler{.magnify = kernel, .minify = kernel, .probes = probes};
                sampler.wrap_s = wrap, sampler.wrap_t = Wrap::Repeat;
                const LaneCoordinates at{0.9f * unit(random),  unit(random),         0.04f * unit(random),
                                         0.09f * unit(random), 0.01f * unit(random), 0.02f * unit(random)};
                // Weights of one sign by place; wraps may give a texel taps of both signs.
                std::map<Place, double> weights[2], drawn[2];
                double sums[2] = {};
                for (const TracedTap& tap : trace_lookup(texture, sampler, at).taps) {
                    const int side = tap.weight < 0;
                    weights[side][place_of(tap)] += std::abs(tap.weight);
                    sums[side] += std::abs(tap.weight);
                }
                // Levels and probes are drawn first, and weigh either sign by their own sums: the expectation is what the weights say.
                double found[2] = {};
                for (uint32_t n = 0; n < kWaves; ++n) {
                    const SignedDraw draw = signed_draw(texture, sampler, everywhere(at), {.x = 0, .y = 0, .sample = cases * kWaves + n});
                    for (int lane = 0; lane < kWaveLanes; ++lane) {
                        EXPECT_NEAR(draw.positive_weight[lane] - draw.negative_weight[lane], 1, 2e-6);
                        drawn[0][place_of(draw.positive, lane)] += double(draw.positive_weight[lane]);
                        if (draw.negative_weight[lane] > 0) drawn[1][place_of(draw.negative, lane)] += double(draw.negative_weight[lane]);
                        found[0] += double(draw.positive_weight[lane]), found[1] += double(draw.negative_weight[lane]);
                    }
                }
                constexpr double kDraws = double(kWaves) * kWaveLanes;
                for (int side = 0; side < 2; ++side) {
                    EXPECT_NEAR(found[side] / kDraws, sums[side], 0.02) << to_string(kernel);
                    for (auto& [place, weight] : weights[side]) weight /= sums[side];
                    for (auto& [place, weight] : drawn[side]) weight *= kDraws / found[side];
                    const double deviate = chi_square_deviate(weights[side], drawn[side], kDraws);
                    // Draws of several levels or probes differ in weight, which widens the statistic.
                    EXPECT_LT(deviate, probes == 1 ? kBound : 3 * kBound)
                        << to_string(kernel) << " wrap " << int(wrap) << " probes " << probes;
                    worst = std::max(worst, probes == 1 ? deviate : 0.0);
                }
                ++cases;
            }
        }
    }
    std::printf("%u cases, largest deviate %.2f\n", cases, worst);
}

/// Expected variance of one lookup over uniform texels and phases: each sign draws a texel of variance 1/12, less what the draw is sure of.
double variance_over_phases(const Kernel& kernel) {
    constexpr int kPhases = 256;
    double sum = 0;
    for (int i = 0; i < kPhases * kPhases; ++i) {
        const auto x = reference::kernel_taps(kernel, 20 + (i % kPhases + 0.5) / kPhases);
        const auto y = reference::kernel_taps(kernel, 30 + (i / kPhases + 0.5) / kPhases);
        double total[2] = {}, squares[2] = {};
        for (const reference::KernelTap& column : x) {
            for (const reference::KernelTap& row : y) {
                const double weight = column.weight * row.weight;
                total[weight < 0] += std::abs(weight);
                squares[weight < 0] += weight * weight;
            }
        }
        for (int side = 0; side < 2; ++side) sum += (total[side] * total[side] - squares[side]) / 12;
    }
    return sum / (kPhases * kPhases);
}

TEST(SignedDraw, HasTheVarianceOfPositivization) {
    // By quadrature over phases; published to three digits: Wyman et al. 2024 and independent integrals.
    const std::pair<Kernel, double> known[] = {{Kernel::Bilinear, 5.0 / 108}, {Kernel::BSpline, 0.0642},  {Kernel::mitchell(), 0.0578},
                                               {Kernel::CatmullRom, 0.0642},  {Kernel::Lanczos2, 0.0665}, {Kernel::Lanczos3, 0.1213}};
    constexpr uint32_t kWaves = 16000;
    Texture texture("hashed", make_hashed_pyramid(Format::R16Unorm, 2048, 2048));
    for (const auto& [kernel, expected] : known) {
        EXPECT_NEAR(variance_over_phases(kernel), expected, 0.002 * expected) << to_string(kernel);
        const SamplerState sampler{.magnify = kernel, .minify = kernel, .mip = MipMode::None};
        const double found = variance_over_places(kWaves, [&](const WaveCoordinates& at, const RandomAddress& first) {
            return signed_value(texture, sampler, signed_draw(texture, sampler, at, first));
        });
        std::printf("%s: variance %.4f, expected %.4f\n", to_string(kernel).c_str(), found, expected);
        EXPECT_NEAR(found, expected, 0.01 * expected) << to_string(kernel);
    }
}

TEST(SignedDraw, LeavesAConstantAsItIs) {
    Texture texture("constant", make_memory_source(Format::RGBA8Unorm, 40, 24, std::vector<std::byte>(40 * 24 * 4, std::byte{77})));
    const std::array<float, 4> expected = texture.texel(0, 0, 0, 0);
    std::mt19937 random(6);
    std::uniform_real_distribution<float> unit(-1, 1);
    for (const Kernel& kernel : kSignedKernels) {
        const SamplerState sampler{.magnify = kernel, .minify = kernel};
        WaveCoordinates at;
        for (int lane = 0; lane < kWaveLanes; ++lane) {
            at.u[lane] = unit(random), at.v[lane] = unit(random);
            at.dudx[lane] = 0.1f * unit(random), at.dvdx[lane] = at.dudy[lane] = 0, at.dvdy[lane] = 0.05f;
        }
        const WaveFloat value = signed_value(texture, sampler, signed_draw(texture, sampler, at, {.sample = 1}));
        for (int lane = 0; lane < kWaveLanes; ++lane) EXPECT_NEAR(value[lane], expected[0], 4e-6) << to_string(kernel);
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

}  // namespace
}  // namespace rawtexel::texunit
