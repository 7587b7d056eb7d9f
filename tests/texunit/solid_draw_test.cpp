// Draws in volumes, cube maps and arrays: listed, repeated on every instruction set, and told.
#include "texunit/draw_trace.h"

#include "tests/reference/texunit/kernel_reference.h"
#include "tests/texunit/drawn_places.h"
#include "tests/texunit/hashed_source.h"
#include "tests/texunit/placed_lookup.h"
#include "texunit/simd.h"

#include <gtest/gtest.h>

#include <random>

namespace rawtexel::texunit {
namespace {

const Kernel kKernels[] = {Kernel::Nearest,    Kernel::Bilinear, Kernel::Quadratic, Kernel::BSpline,        Kernel::mitchell(),
                           Kernel::CatmullRom, Kernel::Lanczos2, Kernel::Lanczos3,  Kernel::gaussian(0.6f), Kernel::gaussian_point(0.5f)};
constexpr Wrap kWraps[] = {Wrap::Repeat, Wrap::MirroredRepeat, Wrap::ClampToEdge, Wrap::ClampToBorder, Wrap::MirrorOnce};

std::unique_ptr<Texture> hashed(const Shape& shape) {
    return std::make_unique<Texture>("hashed", std::make_unique<HashedSource>(Format::RGBA8Unorm, shape));
}

const Shape kArray{.width = 20, .height = 12, .layers = 3, .levels = 3}, kVolume{.width = 12, .height = 10, .depth = 9, .levels = 3},
    kCube{.width = 8, .height = 8, .layers = 12, .levels = 3, .cube = true};

/// Places near edges and corners more often than not.
struct Places {
    std::mt19937 random{17};
    float unit() { return std::uniform_real_distribution<float>(-1, 1)(random); }

    LaneCoordinates3 next_solid(bool cube) {
        LaneCoordinates3 at;
        for (size_t axis = 0; axis < 3; ++axis) {
            const bool beside_edge = random() % 2 == 0;
            at.position[axis] = beside_edge ? (random() % 2 == 0 ? 1.0f : cube ? -1.0f : 0.0f) + 0.04f * unit() : unit();
            at.dx[axis] = (cube ? 0.3f : 0.12f) * unit();
        }
        return at;
    }
    LaneCoordinates next_flat() { return {1.02f * unit(), unit(), 0.1f * unit(), 0.1f * unit(), 0, 0.05f}; }
};

void spread(const LaneCoordinates3& at, PlacedLookup& lookup) {
    for (size_t axis = 0; axis < 3; ++axis) {
        std::fill_n(lookup.solid.position[axis].lane, kWaveLanes, at.position[axis]);
        std::fill_n(lookup.solid.dx[axis].lane, kWaveLanes, at.dx[axis]);
    }
}

/// A lookup of `texture` and what the deterministic one weighs.
struct Weighed {
    PlacedLookup lookup;
    std::map<Place, double> weights;
};
Weighed next_lookup(Texture& texture, const SamplerState& sampler, Places& places) {
    Weighed weighed{{.texture = &texture, .sampler = sampler}, {}};
    std::fill_n(weighed.lookup.layer.lane, kWaveLanes, 1.0f);
    if (!weighed.lookup.is_solid()) {
        const LaneCoordinates at = places.next_flat();
        weighed.lookup.at = everywhere(at);
        weighed.weights = weights_of(trace_lookup(texture, sampler, at, 1));
        return weighed;
    }
    const bool cube = texture.shape().cube;
    const LaneCoordinates3 at = places.next_solid(cube);
    spread(at, weighed.lookup);
    weighed.weights = weights_of(cube ? trace_cube_lookup(texture, sampler, at, 1) : trace_volume_lookup(texture, sampler, at));
    return weighed;
}

/// Two lookups that share their numbers: each keeps its own weights.
TEST(SolidDraw, ListsTheWeightsOfLookups) {
    Places places;
    double worst = 0;
    int cases = 0;
    for (const Shape& shape : {kArray, kVolume, kCube}) {
        const std::unique_ptr<Texture> texture = hashed(shape);
        const std::unique_ptr<Texture> other = hashed({.width = 5, .height = 7, .depth = 3, .levels = 2});
        for (const Kernel& kernel : kKernels) {
            // Six taps an axis of a volume make half a million tuples a pair.
            const bool alone = shape.depth > 1 && (kernel == Kernel::Lanczos3 || kernel.kind == KernelKind::Gaussian);
            for (const MipMode mip : {MipMode::None, MipMode::Nearest, MipMode::Linear}) {
                if (alone && mip == MipMode::Linear) continue;
                SamplerState sampler{.magnify = kernel, .minify = kernel, .mip = mip};
                sampler.wrap_s = kWraps[cases % 5], sampler.wrap_t = kWraps[cases / 5 % 5], sampler.wrap_r = kWraps[cases / 3 % 5];
                const Weighed expected[2] = {next_lookup(*texture, sampler, places),
                                             next_lookup(*other, {.magnify = Kernel::Bilinear, .minify = Kernel::Bilinear}, places)};
                LookupSet set = expected[0].lookup.set();
                if (!alone) set.lookup[set.count++] = expected[1].lookup.set().lookup[0];
                set.mask = 1;
                std::map<Place, double> found[2];
                enumerate_shared(set, [&](const SharedTap& tap) {
                    for (int k = 0; k < set.count; ++k) found[k][place_of(tap.draw[k], 0)] += double(tap.weight[0]);
                });
                for (int k = 0; k < set.count; ++k) {
                    std::map<Place, double> weights = expected[k].weights;
                    for (const auto& [place, weight] : found[k]) weights.try_emplace(place, 0.0);
                    for (const auto& [place, weight] : weights) {
                        worst = std::max(worst, std::abs(found[k][place] - weight));
                        EXPECT_NEAR(found[k][place], weight, 1e-6)
                            << to_string(kernel) << ' ' << to_string(mip) << " cube " << shape.cube << " lookup " << k;
                    }
                }
                ++cases;
            }
        }
    }
    std::printf("%d cases, largest difference %.2e\n", cases, worst);
}

/// Over uniform texels and phases. With A an axis's sum of magnitudes, the masses of either sign are (A_x*A_y*A_z +- 1)/2, each draws a
/// texel of variance 1/12 less what the draw is sure of, and means over phases are products of the axes'.
double variance_in_volumes(const Kernel& kernel) {
    constexpr int kPhases = 4096;
    double squared_sum = 0, sum_of_squares = 0;
    for (int i = 0; i < kPhases; ++i) {
        double magnitude = 0;
        for (const reference::KernelTap& tap : reference::kernel_taps(kernel, 20 + (i + 0.5) / kPhases))
            magnitude += std::abs(tap.weight), sum_of_squares += tap.weight * tap.weight / kPhases;
        squared_sum += magnitude * magnitude / kPhases;
    }
    return ((std::pow(squared_sum, 3) + 1) / 2 - std::pow(sum_of_squares, 3)) / 12;
}

TEST(SolidDraw, HasTheVarianceOfPositivizationInVolumes) {
    constexpr uint32_t kWaves = 12000;
    Texture texture("hashed", std::make_unique<HashedSource>(Format::R16Unorm, Shape{.width = 128, .height = 128, .depth = 128}));
    for (const Kernel& kernel : {Kernel::Bilinear, Kernel::BSpline, Kernel::mitchell(), Kernel::CatmullRom, Kernel::Lanczos3}) {
        PlacedLookup lookup{.texture = &texture, .sampler = {.magnify = kernel, .minify = kernel, .mip = MipMode::None}};
        const auto draw = [&](const RandomAddress& first) {
            DrawNumbers positive, negative;
            draw_numbers(first, positive), draw_depth_numbers(first, positive);
            negative_draw_numbers(first, negative), negative_draw_depth_numbers(first, negative);
            WaveFloat value{};
            draw_shared(lookup.set(), positive, negative, [&](const SharedTap& tap) {
                WaveColor texel;
                read_drawn_wave(texture, lookup.sampler, tap.draw[0], texel);
                for (int lane = 0; lane < kWaveLanes; ++lane)
                    if ((tap.lanes >> lane & 1) != 0) value[lane] += tap.weight[lane] * texel.channel[0][lane];
            });
            return value;
        };
        double squares = 0;
        for (uint32_t n = 0; n < kWaves; ++n) {
            for (uint32_t axis = 0; axis < 3; ++axis)
                for (uint32_t lane = 0; lane < kWaveLanes; ++lane)
                    lookup.solid.position[axis][int(lane)] = random_float({.x = lane, .y = 100 + axis, .sample = n});
            const WaveFloat one = draw({.sample = n}), other = draw({.y = 4, .sample = n});
            for (int lane = 0; lane < kWaveLanes; ++lane) squares += std::pow(double(one[lane] - other[lane]), 2) / 2;
        }
        const double found = squares / (double(kWaves) * kWaveLanes), expected = variance_in_volumes(kernel);
        std::printf("%s: variance %.4f, expected %.4f\n", to_string(kernel).c_str(), found, expected);
        EXPECT_NEAR(found, expected, 0.01 * expected) << to_string(kernel);
    }
}

/// Also where a direction meets the very edge of a face, which one texel never leaves.
TEST(SolidDraw, JitterPicksTheTexelThatTheReservoirPicks) {
    int differing = 0, picked = 0;
    for (const Shape& shape : {kVolume, kCube}) {
        const std::unique_ptr<Texture> texture = hashed(shape);
        Places places;
        for (const Kernel& kernel : {Kernel::Nearest, Kernel::Bilinear, Kernel::BSpline, Kernel::mitchell(0, 0), Kernel::gaussian(0.7f)}) {
            for (uint32_t n = 0; n < 60; ++n) {
                PlacedLookup lookup{.texture = texture.get(), .sampler = {.magnify = kernel, .minify = kernel}};
                lookup.sampler.wrap_s = kWraps[n % 5], lookup.sampler.wrap_t = kWraps[n / 5 % 5], lookup.sampler.wrap_r = kWraps[n / 7 % 5];
                std::fill_n(lookup.layer.lane, kWaveLanes, 1.0f);
                for (int lane = 0; lane < kWaveLanes; ++lane) {
                    const LaneCoordinates3 at = places.next_solid(shape.cube);
                    for (size_t axis = 0; axis < 3; ++axis) {
                        const bool on_edge = n % 2 == 0 && (size_t(lane) + n / 2 + axis) % 3 != 0;
                        lookup.solid.position[axis][lane] = on_edge ? (places.unit() < 0 ? -1.0f : 1.0f) : at.position[axis];
                        lookup.solid.dx[axis][lane] = at.dx[axis];
                    }
                }
                DrawNumbers numbers;
                draw_numbers({.sample = n}, numbers);
                draw_depth_numbers({.sample = n}, numbers);
                Place places_of[2][kWaveLanes];
                for (const Estimator estimator : {Estimator::Reservoir, Estimator::Jitter}) {
                    lookup.sampler.estimator = estimator;
                    draw_shared(lookup.set(), numbers, numbers, [&](const SharedTap& tap) {
                        for (int lane = 0; lane < kWaveLanes; ++lane)
                            places_of[estimator == Estimator::Jitter][lane] = place_of(tap.draw[0], lane);
                    });
                }
                for (int lane = 0; lane < kWaveLanes; ++lane) differing += places_of[0][lane] != places_of[1][lane];
                picked += kWaveLanes;
            }
        }
    }
    // Only numbers within rounding of a step may differ.
    std::printf("%d of %d differ\n", differing, picked);
    EXPECT_LE(differing, 2);
}

class SolidDrawOnSimd : public testing::TestWithParam<Simd> {};

TEST_P(SolidDrawOnSimd, PicksTheSameTexelsAndReadsThem) {
    const Simd before = chosen_simd();
    for (const Shape& shape : {kArray, kVolume, kCube}) {
        const std::unique_ptr<Texture> texture = hashed(shape);
        Places places;
        for (uint32_t n = 0; n < 120; ++n) {
            const Kernel& kernel = kKernels[n % std::size(kKernels)];
            PlacedLookup lookup{.texture = texture.get(), .sampler = {.magnify = Kernel::Bilinear, .minify = kernel}};
            lookup.sampler.wrap_s = kWraps[n % 5], lookup.sampler.wrap_t = kWraps[n / 5 % 5], lookup.sampler.wrap_r = kWraps[n / 7 % 5];
            if (n % 3 == 0 && refusal(Estimator::Jitter, kernel).empty()) lookup.sampler.estimator = Estimator::Jitter;
            lookup.sampler.border = {0.5f, 0.25f, 2, 1};
            for (int lane = 0; lane < kWaveLanes; ++lane) {
                const LaneCoordinates3 at = places.next_solid(shape.cube);
                for (size_t axis = 0; axis < 3; ++axis)
                    lookup.solid.position[axis][lane] = at.position[axis], lookup.solid.dx[axis][lane] = at.dx[axis];
                lookup.at.u[lane] = at.position[0], lookup.at.v[lane] = at.position[1], lookup.at.dudx[lane] = 0.1f * places.unit();
                lookup.layer[lane] = float(lane % 3);
            }
            DrawNumbers positive, negative;
            draw_numbers({.sample = n}, positive), draw_depth_numbers({.sample = n}, positive);
            negative_draw_numbers({.sample = n}, negative), negative_draw_depth_numbers({.sample = n}, negative);
            const auto draw = [&](Simd simd) {
                EXPECT_TRUE(choose_simd(simd));
                std::vector<SharedTap> taps;
                draw_shared(lookup.set(), positive, negative, [&](const SharedTap& tap) { taps.push_back(tap); });
                return taps;
            };
            const std::vector<SharedTap> expected = draw(Simd::Scalar), found = draw(GetParam());
            ASSERT_EQ(found.size(), expected.size());
            for (size_t k = 0; k < found.size(); ++k) {
                WaveColor colour;
                read_drawn_wave(*texture, lookup.sampler, found[k].draw[0], colour);
                EXPECT_EQ(found[k].lanes, expected[k].lanes);
                for (int lane = 0; lane < kWaveLanes; ++lane) {
                    if ((found[k].lanes >> lane & 1) == 0) continue;
                    const Place place = place_of(found[k].draw[0], lane);
                    EXPECT_EQ(place, place_of(expected[k].draw[0], lane)) << n << ' ' << to_string(kernel);
                    EXPECT_EQ(found[k].weight[lane], expected[k].weight[lane]);
                    const auto [level, slice, x, y] = place;
                    const std::array<float, 4> texel = level < 0 ? lookup.sampler.border : texture->texel(level, slice, x, y);
                    for (int c = 0; c < 4; ++c) EXPECT_EQ(colour.channel[c][lane], texel[size_t(c)]);
                }
            }
        }
    }
    ASSERT_TRUE(choose_simd(before));
}

INSTANTIATE_TEST_SUITE_P(All, SolidDrawOnSimd, testing::ValuesIn(available_simd()),
                         [](const auto& tested) { return std::string(to_string(tested.param)); });

/// The mean of many draws, told one by one, is the lookup; each role's number is the one of its address.
TEST(DrawTraces, AverageToTheLookupAndTellTheNumbersOfTheirAddress) {
    constexpr int kDraws = 20000;
    const std::unique_ptr<Texture> cube = hashed(kCube), volume = hashed(kVolume), flat = hashed(kArray);
    for (const Kernel& kernel : {Kernel::BSpline, Kernel::Lanczos2}) {
        const SamplerState sampler{.magnify = kernel, .minify = kernel, .mip = MipMode::Linear, .estimator = Estimator::Reservoir};
        const LaneCoordinates at{0.98f, 0.03f, 0.09f, 0.01f, 0, 0.1f};
        const LaneCoordinates3 solid{{1, 0.97f, -0.96f}, {0.3f, 0.1f, 0}, {0, 0.1f, 0.2f}};
        const DrawSource source{.address = {.x = 5, .y = 9, .sample = 40, .seed = 3}, .draws = kDraws};
        const std::pair<DrawTrace, LookupTrace> traces[] = {
            {trace_draws(*flat, sampler, at, source, 2), trace_lookup(*flat, sampler, at, 2)},
            {trace_volume_draws(*volume, sampler, solid, source), trace_volume_lookup(*volume, sampler, solid)},
            {trace_cube_draws(*cube, sampler, solid, source, 1), trace_cube_lookup(*cube, sampler, solid, 1)}};
        for (const auto& [drawn, weighed] : traces) {
            for (size_t c = 0; c < 4; ++c) {
                std::vector<double> values(kDraws);
                double squares = 0;
                for (const DrawnTap& tap : drawn.taps) values[size_t(tap.draw)] += tap.tap.weight * kDraws * double(tap.tap.value[c]);
                for (const double value : values) squares += (value - double(weighed.result[c])) * (value - double(weighed.result[c]));
                const double deviation = std::sqrt(squares) / kDraws;
                EXPECT_LT(std::abs(double(drawn.result[c] - weighed.result[c])), 5.6 * deviation + 1e-5) << to_string(kernel) << c;
            }
            for (const size_t n : {size_t(0), drawn.taps.size() - 1}) {
                const DrawnTap& tap = drawn.taps[n];
                RandomAddress address = source.address;
                address.sample += uint32_t(tap.draw);
                const auto number = [&](Dimension dimension) {
                    address.dimension = dimension;
                    return random_float(address);
                };
                const bool negative = tap.tap.weight < 0;
                EXPECT_EQ(tap.numbers.x, number(negative ? Dimension::NegativeX : Dimension::TapX));
                EXPECT_EQ(tap.numbers.y, number(negative ? Dimension::NegativeY : Dimension::TapY));
                EXPECT_EQ(tap.numbers.level, number(Dimension::Level));
                EXPECT_FALSE(tap.numbers.probe);
                EXPECT_EQ(tap.numbers.z.has_value(), &drawn != &traces[0].first);
                if (tap.numbers.z) {
                    EXPECT_EQ(*tap.numbers.z, number(negative ? Dimension::NegativeZ : Dimension::TapZ));
                }
                EXPECT_EQ(tap.numbers.sign.has_value(), !weighs_as_probability(kernel));
                if (tap.numbers.sign) {
                    EXPECT_EQ(*tap.numbers.sign, number(negative ? Dimension::NegativeSign : Dimension::Sign));
                }
            }
        }
    }
}

}  // namespace
}  // namespace rawtexel::texunit
