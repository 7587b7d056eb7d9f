// Levels, ratios, probes and axes against double precision, on every instruction set.
#include "texunit/footprint.h"

#include "texunit/probe_table.h"
#include "texunit/simd.h"

#include "tests/reference/texunit/footprint_reference.h"
#include "tests/stress/worst_case.h"
#include "tests/stress_scale.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <sstream>

namespace rawtexel::texunit {
namespace {

using reference::Lookup;

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

LevelTable make_levels(int width, int height) {
    LevelTable table;
    EXPECT_TRUE(
        lay_out_levels({.width = width, .height = height, .levels = full_level_count(width, height)}, StorageClass::Packed32, table));
    return table;
}

reference::Image image_of(const LevelTable& table) { return {table.width[0], table.height[0], table.levels, {}}; }

/// All footprints with axes `major` and `minor` texels long: the ellipse at angle `turn`, the screen at angle `screen`.
Lookup ellipse_lookup(const LevelTable& table, double major, double minor, double turn, double screen) {
    const double c = std::cos(turn), s = std::sin(turn), cx = std::cos(screen), sx = std::sin(screen);
    return {0.3f,
            0.7f,
            float((c * major * cx - s * minor * sx) / table.width[0]),
            float((s * major * cx + c * minor * sx) / table.height[0]),
            float((-c * major * sx - s * minor * cx) / table.width[0]),
            float((-s * major * sx + c * minor * cx) / table.height[0])};
}

WaveCoordinates gather(const std::vector<Lookup>& lookups, size_t first) {
    WaveCoordinates at;
    for (int i = 0; i < kWaveLanes; ++i) {
        const Lookup& one = lookups[(first + size_t(i)) % lookups.size()];
        at.u[i] = one.u, at.v[i] = one.v;
        at.dudx[i] = one.dudx, at.dvdx[i] = one.dvdx;
        at.dudy[i] = one.dudy, at.dvdy[i] = one.dvdy;
    }
    return at;
}

std::string describe(const Lookup& at) {
    std::ostringstream text;
    text.precision(9);
    text << "d/dx " << at.dudx << ',' << at.dvdx << " d/dy " << at.dudy << ',' << at.dvdy;
    return text.str();
}

std::vector<Lookup> random_lookups(const LevelTable& table, int count, uint32_t seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> log_length(-2, 10), log_ratio(0, 8), angle(0, 6.2831853);
    std::vector<Lookup> lookups;
    for (int i = 0; i < count; ++i) {
        const double minor = std::exp2(log_length(random)), ratio = std::exp2(log_ratio(random));
        lookups.push_back(ellipse_lookup(table, minor * ratio, minor, angle(random), angle(random)));
    }
    return lookups;
}

bool same_bits(const WaveFootprint& a, const WaveFootprint& b) {
    const auto same = [](const auto& x, const auto& y) { return std::memcmp(x.lane, y.lane, sizeof(x.lane)) == 0; };
    return same(a.lod, b.lod) && same(a.anisotropy, b.anisotropy) && same(a.finer, b.finer) && same(a.coarser, b.coarser) &&
           same(a.fraction, b.fraction) && a.magnify == b.magnify && same(a.probes, b.probes) && same(a.axis_u, b.axis_u) &&
           same(a.axis_v, b.axis_v);
}

/// Runs every test on every instruction set.
class Footprints : public testing::TestWithParam<Simd> {
  protected:
    Footprints() { EXPECT_TRUE(choose_simd(GetParam())); }
    ~Footprints() override { choose_simd(Simd::Auto); }
};
INSTANTIATE_TEST_SUITE_P(AllSets, Footprints, testing::ValuesIn(available_simd()),
                         [](const auto& parameters) { return std::string(to_string(parameters.param)); });

TEST_P(Footprints, AgreeWithDoublePrecisionUnderBothRules) {
    const LevelTable table = make_levels(2048, 512);
    const reference::Image image = image_of(table);
    const std::vector<Lookup> lookups = random_lookups(table, 20000 * stress_scale(), 3);
    uint64_t measured = 0;
    double most_lod = 0, most_eta = 0, most_axis = 0;
    for (const LodRule rule : {LodRule::D3d, LodRule::Exact}) {
        for (const int probes : {1, 2, 16, 64}) {
            const SamplerState sampler{.probes = probes, .lod_rule = rule};
            double worst_lod = 0, worst_eta = 0, worst_axis = 0;
            int other_counts = 0;
            for (size_t first = 0; first < lookups.size(); first += kWaveLanes) {
                WaveFootprint found;
                measure_footprint(table, sampler, gather(lookups, first), found);
                for (int i = 0; i < kWaveLanes; ++i) {
                    const Lookup& at = lookups[(first + size_t(i)) % lookups.size()];
                    const reference::Footprint expected = reference::footprint(image, sampler, at);
                    const double lambda = std::clamp(expected.lambda, 0.0, double(table.levels - 1));
                    worst_lod = std::max(worst_lod, std::abs(found.lod[i] - lambda));
                    ASSERT_NEAR(found.lod[i], lambda, 0x1p-19) << describe(at);
                    worst_eta = std::max(worst_eta, std::abs(found.anisotropy[i] / expected.eta - 1));
                    ASSERT_NEAR(found.anisotropy[i], expected.eta, 0x1p-20 * expected.eta) << describe(at);
                    if (found.probes[i] != expected.probes) {
                        // Only where the deciding quantity is at its threshold.
                        ++other_counts;
                        const bool lower = int(std::ceil(expected.real_probes * (1 - 0x1p-19))) == found.probes[i];
                        const bool at_last = std::abs(expected.lambda - (table.levels - 1)) < 0x1p-18;
                        ASSERT_TRUE(lower || at_last) << describe(at) << " probes " << found.probes[i] << " for " << expected.real_probes;
                    }
                    if (probes == 1 || expected.eta < 1.01) continue;
                    // A nearly round ellipse leaves its axis open.
                    const double length = std::hypot(expected.axis_u, expected.axis_v);
                    const double off = std::min(std::hypot(found.axis_u[i] - expected.axis_u, found.axis_v[i] - expected.axis_v),
                                                std::hypot(found.axis_u[i] + expected.axis_u, found.axis_v[i] + expected.axis_v));
                    worst_axis = std::max(worst_axis, off / length * (expected.eta - 1));
                    ASSERT_LE(off / length * std::min(1.0, expected.eta - 1), 0x1p-19) << describe(at);
                }
            }
            EXPECT_LE(other_counts, int(lookups.size()) / 1000);
            most_lod = std::max(most_lod, worst_lod), most_eta = std::max(most_eta, worst_eta), most_axis = std::max(most_axis, worst_axis);
            measured += lookups.size();
        }
    }
    tell_tested(measured, "footprints");
    tell_worst_case("lod_off_by", most_lod);
    tell_worst_case("ratio_off_by", most_eta);
    tell_worst_case("axis_off_by", most_axis);
}

TEST_P(Footprints, AreTheSameBitsOnEveryInstructionSet) {
    const LevelTable table = make_levels(3000, 700);
    const std::vector<Lookup> lookups = random_lookups(table, 4096, 4);
    for (int n = 0; n < 8; ++n) {
        const SamplerState sampler{.probes = n % 2 ? 16 : 1,
                                   .probe_variance = n == 7 ? 0.2f : 0.0f,
                                   .lod_rule = n & 2 ? LodRule::Exact : LodRule::D3d,
                                   .precision = n & 4 ? Precision::Gpu : Precision::Exact,
                                   .lod_bias = -0.3f};
        for (size_t first = 0; first < lookups.size(); first += kWaveLanes) {
            const WaveCoordinates at = gather(lookups, first);
            WaveFootprint found, scalar;
            choose_simd(GetParam());
            measure_footprint(table, sampler, at, found);
            choose_simd(Simd::Scalar);
            measure_footprint(table, sampler, at, scalar);
            ASSERT_TRUE(same_bits(found, scalar)) << "sampler " << n << ' ' << describe(lookups[first]);
        }
    }
}

TEST_P(Footprints, DoNotDependOnTheirNeighbours) {
    constexpr int kExtent = 1024;
    const LevelTable table = make_levels(kExtent, kExtent);
    choose_simd(GetParam());
    std::mt19937 random(29);
    std::uniform_real_distribution<float> element(-1, 1);
    for (const LodRule rule : {LodRule::D3d, LodRule::Exact}) {
        for (int round = 0; round < 1000; ++round) {
            // All lanes alike, of any size, half of them round but for a few bits; the bias makes a level of every size.
            const int exponent = int(random() % 60) - 55;
            const SamplerState sampler{.lod_rule = rule, .lod_bias = float(5 - exponent)};
            const float size = std::ldexp(1.0f, exponent) / float(kExtent);
            const auto nearly = [&](float value) { return value * (1 + 0x1p-12f * element(random)); };
            const float dudx = element(random) * size, dvdx = element(random) * size;
            const float dudy = round % 2 == 0 ? element(random) * size : nearly(-dvdx), dvdy = round % 2 == 0 ? dudx : nearly(dudx);
            WaveCoordinates alone{};
            for (int lane = 0; lane < kWaveLanes; ++lane)
                alone.dudx[lane] = dudx, alone.dvdx[lane] = dvdx, alone.dudy[lane] = dudy, alone.dvdy[lane] = dvdy;
            WaveFootprint expected;
            measure_footprint(table, sampler, alone, expected);
            for (const float neighbour : {0.0f, 1e30f, 1e-30f, std::numeric_limits<float>::quiet_NaN()}) {
                WaveCoordinates mixed = alone;
                for (int lane = 1; lane < kWaveLanes; lane += 2) mixed.dudx[lane] = neighbour;
                WaveFootprint found;
                measure_footprint(table, sampler, mixed, found);
                for (int lane = 0; lane < kWaveLanes; lane += 2) {
                    ASSERT_EQ(found.finer[lane], expected.finer[lane]) << "size " << size << ", beside " << neighbour << ", lane " << lane;
                    ASSERT_EQ(found.fraction[lane], expected.fraction[lane])
                        << "size " << size << ", beside " << neighbour << ", lane " << lane;
                }
            }
        }
    }
    choose_simd(Simd::Auto);
}

TEST_P(Footprints, NeedNoBoundsBeyondTheLevelsThereAre) {
    choose_simd(GetParam());
    for (const auto& [width, height] : {std::pair(4096, 512), {1, 1}, {300, 7}}) {
        const LevelTable table = make_levels(width, height);
        const std::vector<Lookup> lookups = random_lookups(table, 2048, 31);
        for (const Precision precision : {Precision::Exact, Precision::Gpu}) {
            for (const float bias : {0.0f, -3.3f, 1000.0f, -1000.0f}) {
                SamplerState loose{.precision = precision, .lod_bias = bias}, tight = loose;
                loose.min_lod = 0, loose.max_lod = 1000;
                tight.min_lod = 0, tight.max_lod = 149;  // bounds that are taken seriously
                for (size_t first = 0; first < lookups.size(); first += kWaveLanes) {
                    WaveCoordinates at = gather(lookups, first);
                    at.dudx[3] = std::numeric_limits<float>::quiet_NaN();
                    WaveFootprint of_loose, of_tight;
                    measure_footprint(table, loose, at, of_loose);
                    measure_footprint(table, tight, at, of_tight);
                    ASSERT_TRUE(same_bits(of_loose, of_tight)) << "bias " << bias << ' ' << describe(lookups[first]);
                }
            }
        }
    }
    choose_simd(Simd::Auto);
}

TEST_P(Footprints, OfRatioOneTakeOneProbeWhateverTheAngle) {
    const LevelTable table = make_levels(1024, 1024);
    std::vector<Lookup> lookups;
    for (int i = 0; i < 1024; ++i) lookups.push_back(ellipse_lookup(table, 2.7, 2.7, i * 0.01, i * 0.37));
    for (const LodRule rule : {LodRule::D3d, LodRule::Exact}) {
        for (size_t first = 0; first < lookups.size(); first += kWaveLanes) {
            WaveFootprint found;
            measure_footprint(table, {.probes = 16, .lod_rule = rule}, gather(lookups, first), found);
            for (int i = 0; i < kWaveLanes; ++i)
                ASSERT_EQ(found.probes[i], 1) << describe(lookups[first + size_t(i)]) << " eta " << found.anisotropy[i];
        }
    }
}

TEST_P(Footprints, WithoutExtentOrWithoutEndAreHarmless) {
    const LevelTable table = make_levels(256, 64);
    const float coarsest = float(table.levels - 1);
    struct Case {
        Lookup at;
        int probes;
        float lod;
    };
    const float texel = 1.0f / 256;
    const Case cases[] = {
        {{0, 0, 0, 0, 0, 0}, 1, 0},                          // a point
        {{0, 0, 16 * texel, 0, 0, 0}, 16, 0},                // a line: the ratio is the limit, a probe a texel
        {{0, 0, 4 * texel, 0, 0, 0}, 4, 0},                  // a short one
        {{0, 0, 64 * texel, 0, 64 * texel, 0}, 16, 2.5f},    // parallel: a line of 64*sqrt(2) texels, though both are as long
        {{0, 0, kNan, 0, 0, texel}, 1, coarsest},            // not finite
        {{0, 0, 0, -kInfinity, 0, texel}, 1, coarsest},      //
        {{0, 0, 1e30f, 0, 0, 1e30f}, 1, coarsest},           // beyond every level
        {{0, 0, 3e38f, 3e38f, 3e38f, -3e38f}, 1, coarsest},  //
        {{0, 0, 1e-40f, 0, 0, 1e-42f}, 1, 0},                // denormal
        {{0, 0, 1e30f, 0, 0, 1e-30f}, 1, coarsest},          // the horizon
    };
    double worst = 0;
    for (const Case& one : cases) {
        WaveFootprint found;
        measure_footprint(table, {.probes = 16, .lod_rule = LodRule::Exact}, gather({one.at}, 0), found);
        EXPECT_NEAR(found.lod[0], one.lod, 1e-6) << describe(one.at);
        worst = std::max(worst, std::abs(double(found.lod[0]) - double(one.lod)));
        EXPECT_EQ(found.probes[0], one.probes) << describe(one.at);
        EXPECT_TRUE(std::isfinite(found.axis_u[0]) && std::isfinite(found.axis_v[0])) << describe(one.at);
        measure_footprint(table, {.probes = 16, .probe_variance = 0.25f}, gather({one.at}, 0), found);
        EXPECT_LE(found.lod[0], coarsest) << describe(one.at);
        EXPECT_TRUE(found.probes[0] >= 1 && found.probes[0] <= 16) << describe(one.at);
        EXPECT_TRUE(std::isfinite(found.axis_u[0]) && std::isfinite(found.axis_v[0])) << describe(one.at);
    }
    tell_worst_case("lod_off_by", worst);
}

TEST_P(Footprints, KeepTheirLevelAtAllAnglesUpToTheProbeLimit) {
    // The fault this guards against: a level that follows the angle or the eccentricity instead of the minor axis.
    const LevelTable table = make_levels(2048, 2048);
    for (const double minor : {1.7, 3.3, 6.0}) {
        for (double ratio = 1; ratio <= 32; ratio *= 1.25) {
            double least = 100, most = 0;
            for (int turn = 0; turn < 64; turn += 4) {
                std::vector<Lookup> lookups;
                for (int screen = 0; screen < kWaveLanes; ++screen) {
                    lookups.push_back(ellipse_lookup(table, minor * ratio, minor, turn * 0.0982, screen * 0.1963));
                }
                WaveFootprint found;
                measure_footprint(table, {.probes = 32, .lod_rule = LodRule::Exact}, gather(lookups, 0), found);
                for (int i = 0; i < kWaveLanes; ++i)
                    least = std::min(least, double(found.lod[i])), most = std::max(most, double(found.lod[i]));
            }
            EXPECT_NEAR(least, std::log2(minor), 1e-4) << minor << " x " << ratio;
            EXPECT_NEAR(most, std::log2(minor), 1e-4) << minor << " x " << ratio;
        }
    }
}

TEST_P(Footprints, ObeyBiasBoundsAndQuantisation) {
    const LevelTable table = make_levels(1024, 1024);
    const auto lod = [&](SamplerState sampler, double length) {
        WaveFootprint found;
        measure_footprint(table, sampler, gather({ellipse_lookup(table, length, length, 0, 0)}, 0), found);
        return found;
    };
    EXPECT_NEAR(lod({.lod_bias = 1.25f}, 4).lod[0], 3.25, 1e-6);
    EXPECT_NEAR(lod({.lod_bias = -1.25f}, 4).lod[0], 0.75, 1e-6);
    EXPECT_NEAR(lod({.min_lod = 3.5f}, 4).lod[0], 3.5, 1e-6);
    EXPECT_NEAR(lod({.max_lod = 1.5f}, 4).lod[0], 1.5, 1e-6);
    EXPECT_NEAR(lod({.min_lod = 3.0f, .max_lod = 1.0f}, 4).lod[0], 3.0, 1e-6) << "the lower bound wins";
    EXPECT_EQ(lod({.lod_bias = -9.0f}, 4).magnify, kWaveFull);
    EXPECT_EQ(lod({.min_lod = 0.25f}, 0.5).magnify, 0u) << "magnification is decided after the bounds";
    EXPECT_EQ(lod({.max_lod = 0.0f}, 4).magnify, kWaveFull);
    EXPECT_EQ(lod({.lod_bias = -1000.0f}, kNan).lod[0], 10) << "no bias makes a footprint without end fine";
    for (const double length : {1.001, 1.37, 2.9, 77.7}) {
        const float quantised = lod({.precision = Precision::Gpu}, length).lod[0];
        EXPECT_EQ(quantised * 256, std::round(quantised * 256));
        EXPECT_NEAR(quantised, std::log2(length), 0.5 / 256 + 1e-5);
    }
    EXPECT_EQ(lod({.precision = Precision::Gpu}, 1.001).magnify, kWaveFull) << "lambda below half a step is 0";
}

TEST_P(Footprints, OfTheEllipticalFilterHaveTheirOwnRatio) {
    const LevelTable table = make_levels(1024, 1024);
    for (const double ratio : {1.0, 7.5, 64.0, 200.0}) {
        WaveFootprint found;
        measure_footprint(table, {.ellipse = 0.2f, .lod_rule = LodRule::Exact}, gather({ellipse_lookup(table, 2 * ratio, 2, 0.3, 1.1)}, 0),
                          found);
        EXPECT_NEAR(found.anisotropy[0], std::min(ratio, 64.0), 1e-4 * ratio);
        EXPECT_EQ(found.probes[0], 1);
    }
}

TEST_P(Footprints, ByVarianceGiveProbesAndLevelTheWholeVariance) {
    const LevelTable table = make_levels(4096, 4096);
    std::mt19937 random(8);
    std::uniform_real_distribution<double> log_minor(0, 3), log_ratio(0.5, 6), angle(0, 6.28);
    for (const float s2 : {1.0f / 12, 1.0f / 6, 1.0f / 4, 1.0f / 3}) {
        for (int n = 0; n < 64; ++n) {
            const double minor = std::exp2(log_minor(random)), ratio = std::exp2(log_ratio(random));
            WaveFootprint found;
            measure_footprint(table, {.probes = 64, .probe_variance = s2},
                              gather({ellipse_lookup(table, minor * ratio, minor, angle(random), angle(random))}, 0), found);
            const int count = found.probes[0];
            double probes = 0;
            for (int i = 0; i < count; ++i) {
                const auto at = size_t(64 * count + i);
                probes += double(gaussian_probes().weight[at]) * std::pow(double(gaussian_probes().place[at]), 2);
            }
            probes *= std::pow(std::hypot(double(found.axis_u[0]), double(found.axis_v[0])) * 4096, 2);
            const double level = std::ldexp(1 + 3 * double(found.fraction[0]), 2 * found.finer[0]) / 4 - 1.0 / 12;
            const double wanted = s2 * minor * minor * ratio * ratio + 1.0 / 6;
            if (count > 1) {
                ASSERT_NEAR(probes + level, wanted, 1e-4 * wanted) << "minor " << minor << " ratio " << ratio << " S2 " << s2;
            }
            const double wanted_minor = s2 * minor * minor + 1.0 / 6;
            ASSERT_GE(level, wanted_minor * (1 - 1e-5));
            if (count < 64 && count > 2) {
                ASSERT_LE(level, wanted_minor * 1.3) << "minor " << minor << " ratio " << ratio << " S2 " << s2;
            }
        }
    }
}

TEST(ProbeTable, WeighsProbesToOneAndCentresThem) {
    for (const ProbeTable* table : {&uniform_probes(), &gaussian_probes()}) {
        for (int n = 1; n <= kMostProbes; ++n) {
            double weights = 0, mean = 0, running = 0;
            for (int i = 0; i < n; ++i) {
                const auto at = size_t(kMostProbes * n + i);
                weights += double(table->weight[at]);
                mean += double(table->weight[at]) * double(table->place[at]);
                running += double(table->share[at]) * (double(table->place[at]) - running);
            }
            ASSERT_NEAR(weights, 1, 1e-6) << n;
            ASSERT_NEAR(mean, 0, 1e-6) << n;
            ASSERT_NEAR(running, 0, 1e-6) << n << ": the running mean is the weighted one";
        }
    }
}

TEST(QuadDerivatives, AreDifferencesWithinEachQuad) {
    WaveCoordinates at{};
    for (int lane = 0; lane < kWaveLanes; ++lane) {
        const int x = lane % kWaveWidth, y = lane / kWaveWidth;
        at.u[lane] = float(x * x + 10 * y), at.v[lane] = float(y * y - x);
    }
    set_quad_derivatives(at);
    for (int lane = 0; lane < kWaveLanes; ++lane) {
        const int x = lane % kWaveWidth & ~1, y = lane / kWaveWidth & ~1;
        EXPECT_EQ(at.dudx[lane], float(2 * x + 1)) << lane;
        EXPECT_EQ(at.dvdx[lane], -1) << lane;
        EXPECT_EQ(at.dudy[lane], 10) << lane;
        EXPECT_EQ(at.dvdy[lane], float(2 * y + 1)) << lane;
    }
}

}  // namespace
}  // namespace rawtexel::texunit
