// Estimators beside each other: what they draw, with which probability, and what they refuse.
#include "texunit/estimator.h"

#include "tests/texunit/drawn_places.h"
#include "tests/texunit/hashed_source.h"
#include "texunit/draw.h"
#include "texunit/memory_source.h"
#include "texunit/reservoir.h"
#include "texunit/simd.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace rawtexel::texunit {
namespace {

/// Of Mitchell's cubics one inside the region of densities and its corners: (0,0), (2,0) and (3,-1.5).
const Kernel kJitteredKernels[] = {Kernel::Nearest,        Kernel::Bilinear,           Kernel::Quadratic,
                                   Kernel::BSpline,        Kernel::mitchell(1, 0),     Kernel::mitchell(0, 0),
                                   Kernel::mitchell(2, 0), Kernel::mitchell(3, -1.5f), Kernel::mitchell(1, -0.3f),
                                   Kernel::gaussian(0.3f), Kernel::gaussian(0.5f),     Kernel::gaussian(2.5f)};

SamplerState jittered(const Kernel& kernel, MipMode mip = MipMode::None) {
    SamplerState sampler{.magnify = kernel, .minify = kernel, .mip = mip};
    sampler.estimator = Estimator::Jitter;
    return sampler;
}

TEST(Estimator, IsSpelledAsItIsRead) {
    for (const EstimatorInfo& info : all_estimators()) {
        EXPECT_EQ(to_string(info.estimator), info.name);
        EXPECT_EQ(parse_estimator(info.name), info.estimator);
    }
    EXPECT_FALSE(parse_estimator("every"));
    EXPECT_FALSE(parse_estimator(""));
}

TEST(Estimator, KnowsWhichKernelsAreProbabilities) {
    for (const Kernel& kernel :
         {Kernel::Nearest, Kernel::Bilinear, Kernel::Quadratic, Kernel::BSpline, Kernel::gaussian(), Kernel::mitchell(1, 0)})
        EXPECT_TRUE(weighs_as_probability(kernel)) << to_string(kernel);
    for (const Kernel& kernel : {Kernel::mitchell(), Kernel::mitchell(-0.1f, 0), Kernel::mitchell(1, 0.1f), Kernel::CatmullRom,
                                 Kernel::Lanczos2, Kernel::Lanczos3})
        EXPECT_FALSE(weighs_as_probability(kernel)) << to_string(kernel);
}

TEST(Estimator, JitterRefusesWhatIsNoDensityConvolvedWithABox) {
    for (const Kernel& kernel : kJitteredKernels) EXPECT_EQ(refusal(Estimator::Jitter, kernel), "") << to_string(kernel);
    for (const Kernel& kernel : {Kernel::mitchell(), Kernel::mitchell(2.5f, 0), Kernel::mitchell(1, -0.6f), Kernel::CatmullRom,
                                 Kernel::Lanczos2, Kernel::Lanczos3, Kernel::gaussian_point()}) {
        EXPECT_NE(refusal(Estimator::Jitter, kernel), "") << to_string(kernel);
        EXPECT_EQ(refusal(Estimator::Reservoir, kernel), "") << to_string(kernel);
    }
}

/// The density whose convolution with a box is Mitchell's kernel: what is left of its slope when those before are taken along.
double offset_density(double b, double c, double x) {
    double density = 0;
    for (int j = 0; j < 4; ++j) {
        const double at = x - 0.5 - j, r = std::abs(at);
        if (r >= 2) continue;
        const double slope = r < 1 ? (12 - 9 * b - 6 * c) * r * r / 2 + (-18 + 12 * b + 6 * c) * r / 3
                                   : (-b - 6 * c) * r * r / 2 + (6 * b + 30 * c) * r / 3 + (-12 * b - 48 * c) / 6;
        density += at < 0 ? -slope : slope;
    }
    return density;
}

/// Jitter draws a cubic of Mitchell's exactly where the density of its offsets is nowhere negative; where the kernel is, it says so.
TEST(Estimator, JitterTakesTheCubicsWhoseOffsetsHaveADensity) {
    int taken = 0, nonnegative = 0;
    for (int i = -8; i <= 40; ++i) {
        for (int j = -24; j <= 12; ++j) {
            // Beside the region's borders, which cross the grid's points.
            const double b = i / 10.0 + 0.013, c = j / 10.0 + 0.0071;
            double least_density = 0, least_weight = 0;  // the latter times 6
            for (int n = -300; n <= 300; ++n) {
                const double x = n / 200.0;
                least_density = std::min(least_density, offset_density(b, c, x));
                const double r = (x + 1.5) * 2 / 3, within = (12 - 9 * b - 6 * c) * r * r * r + (-18 + 12 * b + 6 * c) * r * r + 6 - 2 * b;
                const double beyond = (-b - 6 * c) * r * r * r + (6 * b + 30 * c) * r * r + (-12 * b - 48 * c) * r + 8 * b + 24 * c;
                least_weight = std::min(least_weight, r < 1 ? within : beyond);
            }
            const Kernel kernel = Kernel::mitchell(float(b), float(c));
            if (least_density > -1e-3 && least_density < 0) continue;
            EXPECT_EQ(refusal(Estimator::Jitter, kernel).empty(), least_density == 0)
                << to_string(kernel) << " least density " << least_density;
            taken += least_density == 0;
            if (least_weight > -1e-3 && least_weight < -1e-12) continue;
            EXPECT_EQ(weighs_as_probability(kernel), least_weight >= -1e-12) << to_string(kernel) << " least weight " << least_weight;
            nonnegative += least_weight >= -1e-12;
        }
    }
    std::printf("%d cubics are convolved, %d nonnegative\n", taken, nonnegative);
    EXPECT_GT(taken, 100);
    EXPECT_GT(nonnegative, taken);
}

/// Probabilities of the texels along x at one place, exact but for the numbers' grid of 2^-24: the texel rises with the number, so the
/// numbers at which it changes are found by bisection.
std::map<Place, double> probabilities(Texture& texture, const SamplerState& sampler, const LaneCoordinates& at) {
    constexpr uint32_t kNumbers = 1u << 24;
    const WaveCoordinates wave = everywhere(at);
    const auto texel_at = [&](uint32_t number) {
        DrawNumbers numbers{};
        std::fill_n(numbers.x.lane, kWaveLanes, float(number) * 0x1p-24f);
        TexelDraw draw;
        draw_wave(texture, sampler, wave, kWaveFull, numbers, draw);
        return place_of(draw, 0);
    };
    std::map<Place, double> found;
    for (uint32_t start = 0; start < kNumbers;) {
        const Place place = texel_at(start);
        // Texels next to each other follow each other, so a texel's numbers end before the next other one.
        uint32_t low = start, high = kNumbers;
        while (high - low > 1) {
            const uint32_t middle = low + (high - low) / 2;
            (texel_at(middle) == place ? low : high) = middle;
        }
        found[place] += double(high - start) * 0x1p-24;
        start = high;
    }
    return found;
}

TEST(Estimator, ProbabilitiesAreTheKernelsWeights) {
    Texture texture("hashed", make_hashed_pyramid(Format::RGBA8Unorm, 4096, 8));
    std::mt19937 random(11);
    std::uniform_real_distribution<float> unit(0.1f, 0.9f);
    double worst = 0;
    for (const Estimator estimator : {Estimator::Reservoir, Estimator::Jitter}) {
        for (const Kernel& kernel : kJitteredKernels) {
            for (int place = 0; place < 4; ++place) {
                SamplerState sampler = jittered(kernel);
                sampler.estimator = estimator;
                const LaneCoordinates at{unit(random), 0.5f / 8, 0, 0, 0, 0};
                std::map<Place, double> weights;
                for (const auto& [texel, weight] : weights_of(trace_lookup(texture, sampler, at))) {
                    // Along x alone.
                    weights[{std::get<0>(texel), 0, std::get<2>(texel), 0}] += weight;
                }
                std::map<Place, double> found;
                for (const auto& [texel, share] : probabilities(texture, sampler, at)) found[{0, 0, std::get<2>(texel), 0}] += share;
                for (const auto& [texel, weight] : weights) {
                    worst = std::max(worst, std::abs(found[texel] - weight));
                    EXPECT_NEAR(found[texel], weight, 1e-6) << to_string(estimator) << ' ' << to_string(kernel) << " at " << at.u;
                }
                for (const auto& [texel, share] : found) EXPECT_TRUE(share < 1e-6 || weights.contains(texel)) << to_string(kernel);
            }
        }
    }
    std::printf("largest difference %.2e\n", worst);
}

TEST(Estimator, JitterPicksTheTexelThatTheReservoirPicks) {
    Texture texture("hashed", make_hashed_pyramid(Format::RGBA8Unorm, 96, 40));
    std::mt19937 random(12);
    std::uniform_real_distribution<float> unit(-1, 1);
    int differing = 0, picked = 0;
    for (const Kernel& kernel : kJitteredKernels) {
        for (const Wrap wrap : {Wrap::Repeat, Wrap::MirroredRepeat, Wrap::ClampToEdge, Wrap::ClampToBorder, Wrap::MirrorOnce}) {
            for (uint32_t n = 0; n < 40; ++n) {
                SamplerState sampler = jittered(kernel, MipMode::Linear);
                sampler.wrap_s = wrap;
                WaveCoordinates at;
                for (int lane = 0; lane < kWaveLanes; ++lane) {
                    at.u[lane] = 1.2f * unit(random), at.v[lane] = unit(random);
                    at.dudx[lane] = 0.05f * unit(random), at.dvdx[lane] = at.dudy[lane] = 0, at.dvdy[lane] = 0.05f;
                }
                DrawNumbers numbers;
                draw_numbers({.sample = n}, numbers);
                TexelDraw jitter, reservoir;
                draw_wave(texture, sampler, at, kWaveFull, numbers, jitter);
                sampler.estimator = Estimator::Reservoir;
                draw_wave(texture, sampler, at, kWaveFull, numbers, reservoir);
                for (int lane = 0; lane < kWaveLanes; ++lane) differing += place_of(jitter, lane) != place_of(reservoir, lane);
                picked += kWaveLanes;
            }
        }
    }
    // Only numbers within rounding of a step may differ.
    std::printf("%d of %d differ\n", differing, picked);
    EXPECT_LE(differing, 2);
}

TEST(Estimator, AbsWeightIsUnbiasedAndNoisyOnAConstant) {
    Texture constant("constant", make_memory_source(Format::RGBA8Unorm, 40, 24, std::vector<std::byte>(40 * 24 * 4, std::byte{255})));
    Texture hashed("hashed", make_hashed_pyramid(Format::R16Unorm, 40, 24));
    constexpr uint32_t kWaves = 8000;
    for (const Kernel& kernel : {Kernel::mitchell(), Kernel::CatmullRom, Kernel::Lanczos2, Kernel::Lanczos3}) {
        const SamplerState sampler{.magnify = kernel, .minify = kernel, .mip = MipMode::None};
        const LaneCoordinates at{0.371f, 0.583f, 0, 0, 0, 0};
        const double expected = double(trace_lookup(hashed, sampler, at).result[0]);
        double sum = 0, squares = 0, constant_sum = 0, constant_squares = 0;
        for (uint32_t n = 0; n < kWaves; ++n) {
            DrawNumbers numbers;
            draw_numbers({.sample = n}, numbers);
            TexelDraw draw;
            WaveFloat factor;
            WaveColor value;
            draw_absolute_wave(hashed, sampler, everywhere(at), kWaveFull, numbers, draw, factor);
            read_drawn_wave(hashed, sampler, draw, value);
            for (int lane = 0; lane < kWaveLanes; ++lane) {
                const double x = double(factor[lane]) * double(value.channel[0][lane]), one = double(factor[lane]);
                sum += x, squares += x * x, constant_sum += one, constant_squares += one * one;
            }
        }
        constexpr double kDraws = double(kWaves) * kWaveLanes;
        const double mean = sum / kDraws, error = std::sqrt((squares / kDraws - mean * mean) / kDraws);
        EXPECT_LT(std::abs(mean - expected), 5.6 * error) << to_string(kernel);
        const double constant_mean = constant_sum / kDraws, variance = constant_squares / kDraws - constant_mean * constant_mean;
        EXPECT_LT(std::abs(constant_mean - 1), 5.6 * std::sqrt(variance / kDraws)) << to_string(kernel);
        EXPECT_GT(variance, 0.05) << to_string(kernel) << ": a constant should be noisy";
    }
}

/// Variance of one abs-weight lookup over uniform texels and phases, in double (tests/reference) against draws.
TEST(Estimator, AbsWeightHasItsPublishedVariance) {
    const std::pair<Kernel, double> known[] = {
        {Kernel::mitchell(), 0.1503}, {Kernel::CatmullRom, 0.3173}, {Kernel::Lanczos2, 0.3395}, {Kernel::Lanczos3, 0.8526}};
    Texture texture("hashed", make_hashed_pyramid(Format::R16Unorm, 2048, 2048));
    constexpr uint32_t kWaves = 24000;
    for (const auto& [kernel, expected] : known) {
        const SamplerState sampler{.magnify = kernel, .minify = kernel, .mip = MipMode::None};
        const double found = variance_over_places(kWaves, [&](const WaveCoordinates& at, const RandomAddress& first) {
            DrawNumbers numbers;
            draw_numbers(first, numbers);
            TexelDraw draw;
            WaveFloat value;
            WaveColor texel;
            draw_absolute_wave(texture, sampler, at, kWaveFull, numbers, draw, value);
            read_drawn_wave(texture, sampler, draw, texel);
            for (int lane = 0; lane < kWaveLanes; ++lane) value[lane] *= texel.channel[0][lane];
            return value;
        });
        std::printf("%s: variance %.4f, expected %.4f\n", to_string(kernel).c_str(), found, expected);
        EXPECT_NEAR(found, expected, 0.01 * expected) << to_string(kernel);
    }
}

// --- the ellipse

struct Moments {
    double mean[2]{}, covariance[3]{};  ///< xx, xy, yy
};

/// Of texel centres, in texels from the coordinate, over draws around one place of a texture large enough for no wrap to matter; over
/// places since a filter narrower than a texel depends on where between the centres it lies.
Moments draw_moments(Texture& texture, const SamplerState& sampler, const LaneCoordinates& at, uint32_t waves) {
    const auto width = double(texture.shape().width), height = double(texture.shape().height);
    double sum[2]{}, product[3]{};
    for (uint32_t n = 0; n < waves; ++n) {
        DrawNumbers numbers;
        draw_numbers({.sample = n}, numbers);
        TexelDraw draw;
        WaveCoordinates wave = everywhere(at);
        for (uint32_t lane = 0; lane < kWaveLanes; ++lane) {
            wave.u[int(lane)] += 0.02f * random_float({.x = lane, .y = 100, .sample = n});
            wave.v[int(lane)] += 0.02f * random_float({.x = lane, .y = 101, .sample = n});
        }
        draw_wave(texture, sampler, wave, kWaveFull, numbers, draw);
        for (int lane = 0; lane < kWaveLanes; ++lane) {
            const double size = std::exp2(draw.level[lane]);
            const double x = (draw.x[lane] + 0.5) * size - double(wave.u[lane]) * width;
            const double y = (draw.y[lane] + 0.5) * size - double(wave.v[lane]) * height;
            // A texel of a coarser level is the mean of a box.
            const double box = (size * size - 1) / 12;
            sum[0] += x, sum[1] += y, product[0] += x * x + box, product[1] += x * y, product[2] += y * y + box;
        }
    }
    const double draws = double(waves) * kWaveLanes;
    Moments m;
    for (int i = 0; i < 2; ++i) m.mean[i] = sum[i] / draws;
    m.covariance[0] = product[0] / draws - m.mean[0] * m.mean[0];
    m.covariance[1] = product[1] / draws - m.mean[0] * m.mean[1];
    m.covariance[2] = product[2] / draws - m.mean[1] * m.mean[1];
    return m;
}

/// S2*J*J^T + I/6 for a footprint of `ratio` whose minor axis is `minor` texels, at an angle. Level 0, and every level of a hybrid: what a
/// level has filtered is not filtered again.
TEST(EllipseDraw, DeliversTheWholeVarianceAtAnyRatio) {
    constexpr double kS2 = 1.0 / 6;
    Texture texture("hashed", make_hashed_pyramid(Format::R8Unorm, 16384, 16384));
    for (const double ratio : {1.0, 4.0, 20.0, 32.0, 64.0}) {
        for (const float bias : {std::numeric_limits<float>::infinity(), 0.0f, 1.0f, 2.0f}) {
            for (const double minor : {3.0, 9.0}) {
                const double angle = 0.6, major = minor * ratio, c = std::cos(angle), s = std::sin(angle);
                const LaneCoordinates at{0.40003f,
                                         0.61007f,
                                         float(major * c / 16384),
                                         float(major * s / 16384),
                                         float(-minor * s / 16384),
                                         float(minor * c / 16384)};
                SamplerState sampler;
                sampler.ellipse = float(kS2);
                sampler.estimator = Estimator::Jitter;
                sampler.hybrid_bias = bias;
                const Moments m = draw_moments(texture, sampler, at, 2500);
                const double xx = kS2 * (major * major * c * c + minor * minor * s * s) + 1.0 / 6;
                const double yy = kS2 * (major * major * s * s + minor * minor * c * c) + 1.0 / 6;
                const double along = m.covariance[0] * c * c + 2 * m.covariance[1] * c * s + m.covariance[2] * s * s;
                const double across = m.covariance[0] * s * s - 2 * m.covariance[1] * c * s + m.covariance[2] * c * c;
                const double wanted_along = xx * c * c + yy * s * s + 2 * c * s * kS2 * (major * major - minor * minor) * c * s;
                const double wanted_across = kS2 * minor * minor + 1.0 / 6;
                EXPECT_NEAR(along / wanted_along, 1, 0.02) << ratio << ":1, bias " << bias;
                EXPECT_NEAR(across / wanted_across, 1, 0.02) << ratio << ":1, bias " << bias << ", minor axis " << minor;
            }
        }
    }
}

TEST(EllipseDraw, StreamsAndJittersTheTexelsOfTheExactFilter) {
    constexpr uint32_t kWaves = 1500;
    Texture texture("hashed", make_hashed_pyramid(Format::RGBA8Unorm, 64, 48));
    for (const Estimator estimator : {Estimator::Reservoir, Estimator::Jitter}) {
        for (const Wrap wrap : {Wrap::Repeat, Wrap::ClampToBorder}) {
            SamplerState sampler;
            sampler.ellipse = 1.0f / 6;
            sampler.estimator = estimator;
            sampler.wrap_s = wrap;
            const LaneCoordinates at{0.97f, 0.31f, 0.07f, 0.02f, -0.01f, 0.03f};
            const std::map<Place, double> weights = weights_of(trace_lookup(texture, sampler, at));
            std::map<Place, double> drawn;
            for (uint32_t n = 0; n < kWaves; ++n) {
                DrawNumbers numbers;
                draw_numbers({.sample = n}, numbers);
                TexelDraw draw;
                draw_wave(texture, sampler, everywhere(at), kWaveFull, numbers, draw);
                for (int lane = 0; lane < kWaveLanes; ++lane) ++drawn[place_of(draw, lane)];
            }
            EXPECT_LT(chi_square_deviate(weights, drawn, double(kWaves) * kWaveLanes), 5.6) << to_string(estimator);
        }
    }
}

// --- streams

TEST(StreamingReservoir, HoldsItemsInProportionToTheirWeights) {
    const std::vector<double> weights{1, 0, 5, 0.25, 1000, 0.5, 3, 17, 0, 2};
    constexpr int kStreams = 1000000;
    std::vector<double> held(weights.size());
    for (uint32_t n = 0; n < kStreams; ++n) {
        StreamingReservoir reservoir(mix_bits(n));
        size_t item = 0;
        for (size_t i = 0; i < weights.size(); ++i)
            if (reservoir.offer(weights[i])) item = i;
        EXPECT_NEAR(reservoir.sum(), 1028.75, 1e-9);
        ++held[item];
    }
    for (size_t i = 0; i < weights.size(); ++i) {
        const double expected = kStreams * weights[i] / 1028.75;
        EXPECT_LE(std::abs(held[i] - expected), 5.6 * std::sqrt(expected) + 1e-9) << i;
    }
}

/// A stream so long that one number's bits would be used up many times over.
TEST(StreamingReservoir, StaysUniformOverLongStreams) {
    constexpr int kItems = 1024, kStreams = 20000, kCells = 32;
    std::vector<double> held(kCells);
    for (uint32_t n = 0; n < kStreams; ++n) {
        StreamingReservoir reservoir(mix_bits(n + 77));
        int item = 0;
        for (int i = 0; i < kItems; ++i)
            if (reservoir.offer(1.0)) item = i;
        ++held[size_t(item * kCells / kItems)];
    }
    for (const double count : held) EXPECT_LT(std::abs(count - double(kStreams) / kCells), 5.6 * std::sqrt(double(kStreams) / kCells));
}

}  // namespace
}  // namespace rawtexel::texunit
