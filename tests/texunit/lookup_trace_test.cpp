// A lookup taken apart adds up to what the wave functions return, tap by tap.
#include "texunit/lookup_trace.h"

#include "texunit/simd.h"

#include "tests/texunit/hashed_source.h"
#include "tests/texunit/lookup_draw.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <memory>
#include <tuple>

namespace rawtexel::texunit {
namespace {

std::unique_ptr<Texture> hashed_texture(Shape shape) {
    shape.levels = full_level_count(shape.width, shape.height, shape.depth);
    return std::make_unique<Texture>("hashed", std::make_unique<HashedSource>(Format::RGBA8Unorm, shape));
}

void expect_adds_up(const LookupTrace& trace, const WaveColor& colour, const FetchCounts& counts, const std::string& what) {
    double weights = 0, magnitude = 0;
    std::array<double, 4> sum{};
    uint64_t texels = 0;
    for (const TracedTap& tap : trace.taps) {
        EXPECT_NE(tap.weight, 0) << what;
        weights += tap.weight;
        magnitude += std::abs(tap.weight);
        texels += !tap.border;
        for (size_t c = 0; c < 4; ++c) sum[c] += tap.weight * double(tap.value[c]);
    }
    const double bound = (double(trace.taps.size()) + 8) * 0x1p-23 * std::max(1.0, magnitude);
    EXPECT_NEAR(weights, 1, bound) << what;
    EXPECT_EQ(texels, counts.texels_requested) << what;
    EXPECT_EQ(counts.lookups, 1u);
    for (size_t c = 0; c < 4; ++c) {
        EXPECT_EQ(std::bit_cast<uint32_t>(trace.result[c]), std::bit_cast<uint32_t>(colour.channel[c][0])) << what;
        EXPECT_NEAR(trace.result[c], sum[c], bound) << what << " channel " << c;
    }
    // Levels in order, and where every row is told of once also slices and rows.
    for (size_t n = 1; n < trace.taps.size(); ++n) EXPECT_LE(trace.taps[n - 1].level, trace.taps[n].level) << what;
}

class LookupTraces : public testing::TestWithParam<Simd> {
  protected:
    LookupTraces() { EXPECT_TRUE(choose_simd(GetParam())); }
    ~LookupTraces() override { choose_simd(Simd::Auto); }
};
INSTANTIATE_TEST_SUITE_P(AllSets, LookupTraces, testing::ValuesIn(available_simd()),
                         [](const auto& parameters) { return std::string(to_string(parameters.param)); });

TEST_P(LookupTraces, AddUpForEveryKernelWrapAndShape) {
    const auto flat = hashed_texture({.width = 20, .height = 13});
    const auto array = hashed_texture({.width = 20, .height = 13, .layers = 3});
    const auto volume = hashed_texture({.width = 9, .height = 6, .depth = 5});
    const auto cube = hashed_texture({.width = 8, .height = 8, .layers = 12, .cube = true});
    LookupDraw draw({20, 13, 5}, flat->shape().levels, 4);
    for (const Kernel& kernel : every_kernel()) {
        for (int n = 0; n < 10; ++n) {
            SamplerState sampler = draw_sampler(draw, kernel, Wrap(n % 5));
            if (n % 3 == 0) sampler.probes = 8;
            const std::string what = describe(sampler);
            WaveColor colour;
            FetchCounts counts;
            const reference::Lookup at = draw.next();
            const LaneCoordinates lane{at.u, at.v, at.dudx, at.dvdx, at.dudy, at.dvdy};
            const WaveCoordinates wave = gather(std::vector<reference::Lookup>(kWaveLanes, at), 0);
            sample_wave(*flat, sampler, wave, 1, colour, &counts);
            expect_adds_up(trace_lookup(*flat, sampler, lane), colour, counts, what + describe(at));

            counts = {};
            WaveFloat layers{};
            layers[0] = 2;
            sample_wave(*array, sampler, wave, 1, colour, LookupExtras{.layer = &layers, .counts = &counts});
            expect_adds_up(trace_lookup(*array, sampler, lane, 2), colour, counts, "array " + what + describe(at));

            if (axis_taps(sampler.magnify) < 7 && axis_taps(sampler.minify) < 7) {
                counts = {};
                const reference::Lookup3 in_volume = draw.next_in_volume();
                const WaveCoordinates3 wave3 = gather(std::vector<reference::Lookup3>(kWaveLanes, in_volume), 0);
                sample_volume_wave(*volume, sampler, wave3, 1, colour, {.counts = &counts});
                expect_adds_up(trace_volume_lookup(*volume, sampler, {in_volume.position, in_volume.dx, in_volume.dy}), colour, counts,
                               "volume " + what + describe(in_volume));
            }

            counts = {};
            const reference::Lookup3 direction = draw.next_direction();
            layers[0] = 1;
            const WaveCoordinates3 directions = gather(std::vector<reference::Lookup3>(kWaveLanes, direction), 0);
            sample_cube_wave(*cube, sampler, directions, 1, colour, {.layer = &layers, .counts = &counts});
            expect_adds_up(trace_cube_lookup(*cube, sampler, {direction.position, direction.dx, direction.dy}, 1), colour, counts,
                           "cube " + what + describe(direction));
            if (HasFailure()) return;
        }
    }
}

TEST_P(LookupTraces, NameTheTexelsAndWeightsOfATrilinearLookup) {
    const auto texture = hashed_texture({.width = 16, .height = 16});
    // 3/4 of a texel right of the centre of texel (2, 5); lambda = 1/2.
    const float footprint = std::exp2(0.5f) / 16;
    const LookupTrace trace = trace_lookup(*texture, {}, {.u = 3.25f / 16, .v = 5.5f / 16, .dudx = footprint, .dvdy = footprint});
    EXPECT_NEAR(trace.lod, 0.5f, 1e-6f);
    ASSERT_EQ(trace.taps.size(), 2u + 4u);
    const auto expect_tap = [&](size_t n, int level, int x, int y, double weight) {
        const TracedTap& tap = trace.taps[n];
        EXPECT_EQ(std::tuple(tap.level, tap.slice, tap.x, tap.y, tap.border), std::tuple(level, 0, x, y, false)) << "tap " << n;
        EXPECT_NEAR(tap.weight, weight, 1e-6) << "tap " << n;
        EXPECT_EQ(tap.value, texture->texel(level, 0, x, y));
    };
    expect_tap(0, 0, 2, 5, 0.5 * 0.25);
    expect_tap(1, 0, 3, 5, 0.5 * 0.75);
    // Level 1: u = 1.625, v = 2.75 texels, 1/8 beyond the centre of column 1 and 1/4 beyond that of row 2.
    expect_tap(2, 1, 1, 2, 0.5 * 0.875 * 0.75);
    expect_tap(3, 1, 2, 2, 0.5 * 0.125 * 0.75);
    expect_tap(4, 1, 1, 3, 0.5 * 0.875 * 0.25);
    expect_tap(5, 1, 2, 3, 0.5 * 0.125 * 0.25);
}

TEST_P(LookupTraces, MarkTapsThatTakeTheBorder) {
    const auto texture = hashed_texture({.width = 16, .height = 16});
    SamplerState sampler{.wrap_s = Wrap::ClampToBorder, .mip = MipMode::None};
    sampler.border = {0.25f, 0.5f, 0.75f, 1};
    const LookupTrace trace = trace_lookup(*texture, sampler, {.u = 0.25f / 16, .v = 2.5f / 16});
    ASSERT_EQ(trace.taps.size(), 2u);
    EXPECT_TRUE(trace.taps[0].border);
    EXPECT_EQ(trace.taps[0].value, sampler.border);
    EXPECT_FALSE(trace.taps[1].border);
    EXPECT_EQ(trace.taps[1].x, 0);
    EXPECT_EQ(trace.taps[0].weight, 0.25);
}

TEST_P(LookupTraces, ShareATapBeyondACubesCornerAmongThreeTexels) {
    const auto texture = hashed_texture({.width = 4, .height = 4, .layers = 6, .cube = true});
    const LookupTrace trace = trace_cube_lookup(*texture, {.mip = MipMode::None}, {.position = {0.999f, 0.999f, 1}});
    std::array<double, 6> of_face{};
    for (const TracedTap& tap : trace.taps) of_face[size_t(tap.slice)] += tap.weight;
    EXPECT_EQ(trace.taps.size(), 6u);
    EXPECT_NEAR(of_face[0], 1.0 / 3, 2e-3);
    EXPECT_NEAR(of_face[2], 1.0 / 3, 2e-3);
    EXPECT_NEAR(of_face[4], 1.0 / 3, 2e-3);
}

}  // namespace
}  // namespace rawtexel::texunit
