// Wide kernels, borders and mixed kernels: what is read, what is counted, and that lanes keep to themselves, on every instruction set.
#include "texunit/sample.h"

#include "texunit/memory_source.h"
#include "texunit/simd.h"

#include "tests/texunit/hashed_source.h"
#include "tests/texunit/judged_lookup.h"
#include "tests/texunit/lookup_draw.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

namespace rawtexel::texunit {
namespace {

class SampleWide : public testing::TestWithParam<Simd> {
  protected:
    SampleWide() { EXPECT_TRUE(choose_simd(GetParam())); }
    ~SampleWide() override { choose_simd(Simd::Auto); }
};
INSTANTIATE_TEST_SUITE_P(AllSets, SampleWide, testing::ValuesIn(available_simd()),
                         [](const auto& parameters) { return std::string(to_string(parameters.param)); });

SamplerState through(const Kernel& kernel, MipMode mip = MipMode::None) { return {.magnify = kernel, .minify = kernel, .mip = mip}; }

/// The same lookup in all lanes, `footprint` texels of a texture `extent` wide to a pixel.
WaveCoordinates everywhere(float u, float v, float footprint, int extent) {
    WaveCoordinates at{};
    for (int i = 0; i < kWaveLanes; ++i) {
        at.u[i] = u, at.v[i] = v;
        at.dudx[i] = at.dvdy[i] = footprint / float(extent);
    }
    return at;
}

TEST_P(SampleWide, AsksForTheTapsThatTheKernelWeighs) {
    constexpr int kExtent = 64;
    Texture texture("hashed", make_hashed_pyramid(Format::RGBA8Unorm, kExtent, kExtent));
    const auto taps = [&](const SamplerState& sampler, float u, float v, float footprint) {
        FetchCounts counts;
        WaveColor plain, counting;
        const WaveCoordinates at = everywhere(u, v, footprint, kExtent);
        sample_wave(texture, sampler, at, kWaveFull, plain);
        sample_wave(texture, sampler, at, kWaveFull, counting, &counts);
        EXPECT_TRUE(same_bits(plain, counting)) << "counting changes the result";
        EXPECT_EQ(counts.lookups, 32u);
        EXPECT_EQ(counts.taps, counts.texels_requested);
        EXPECT_EQ(counts.taps % 32, 0u);
        return counts.taps / 32;
    };
    constexpr float kGeneric = 0.3771f, kCentre = 20.5f / kExtent;
    const std::pair<Kernel, uint64_t> expected[] = {{Kernel::Nearest, 1},
                                                    {Kernel::Bilinear, 4},
                                                    {Kernel::Quadratic, 9},
                                                    {Kernel::BSpline, 16},
                                                    {Kernel::mitchell(), 16},
                                                    {Kernel::CatmullRom, 16},
                                                    {Kernel::Lanczos2, 16},
                                                    {Kernel::Lanczos3, 36},
                                                    {Kernel::gaussian(0.5f), 25},
                                                    {Kernel::gaussian_point(0.5f), 16},
                                                    {Kernel::gaussian_point(0.02f), 1},
                                                    {Kernel::gaussian(1.0f), 81},
                                                    {Kernel::gaussian_point(1.0f), 64}};
    for (const auto& [kernel, count] : expected) {
        EXPECT_EQ(taps(through(kernel), kGeneric, kGeneric, 1), count) << to_string(kernel);
        EXPECT_EQ(taps(through(kernel, MipMode::Linear), kGeneric, kGeneric, 3), 2 * count) << to_string(kernel);
    }
    // On a texel's centre interpolating kernels weigh that texel alone.
    for (const Kernel& kernel : {Kernel::CatmullRom, Kernel::Lanczos2, Kernel::Lanczos3}) {
        EXPECT_EQ(taps(through(kernel), kCentre, kCentre, 1), 1u) << to_string(kernel);
        EXPECT_EQ(taps(through(kernel), kCentre, kGeneric, 1), uint64_t(axis_taps(kernel))) << to_string(kernel);
    }
}

TEST_P(SampleWide, ReadsNothingThatItDoesNotWeigh) {
    for (const Kernel& kernel : {Kernel::CatmullRom, Kernel::Lanczos3}) {
        Texture texture("hashed", make_hashed_pyramid(Format::RGBA16Half, 64, 64));
        WaveColor colour;
        sample_wave(texture, through(kernel), everywhere(19.5f / 64, 19.5f / 64, 1, 64), kWaveFull, colour);
        EXPECT_EQ(texture.work().blocks_decoded, 1u) << to_string(kernel);
        const std::array<float, 4> texel = texture.texel(0, 0, 19, 19);
        for (size_t c = 0; c < 4; ++c) EXPECT_EQ(lane_of(colour, 7)[c], texel[c]) << to_string(kernel);
    }
}

TEST_P(SampleWide, KeepsInfinitiesOfWeightZeroOut) {
    constexpr int kExtent = 8;
    std::vector<float> texels(size_t(kExtent) * kExtent, std::numeric_limits<float>::infinity());
    texels[3 * kExtent + 3] = 2.5f;
    std::vector<std::byte> bytes(texels.size() * sizeof(float));
    std::memcpy(bytes.data(), texels.data(), bytes.size());
    Texture texture("infinite", make_memory_source(Format::R32Float, kExtent, kExtent, std::move(bytes)));
    for (const Kernel& kernel : every_kernel()) {
        WaveColor colour;
        sample_wave(texture, through(kernel), everywhere(3.5f / kExtent, 3.5f / kExtent, 1, kExtent), kWaveFull, colour);
        const bool interpolates = kernel == Kernel::CatmullRom || kernel.kind == KernelKind::Lanczos2 ||
                                  kernel.kind == KernelKind::Lanczos3 || axis_taps(kernel) <= 2;
        if (interpolates) {
            EXPECT_EQ(colour.channel[0][0], 2.5f) << to_string(kernel);
        }
        if (kernel == Kernel::BSpline) {
            EXPECT_EQ(colour.channel[0][0], std::numeric_limits<float>::infinity());
        }
    }
}

TEST_P(SampleWide, ReadsNoTexelBeyondABorder) {
    for (const Kernel& kernel : every_kernel()) {
        if (std::abs(kernel.b) > 5) continue;
        Texture texture("hashed", make_hashed_pyramid(Format::RGBA8Unorm, 16, 16));
        SamplerState sampler = through(kernel);
        sampler.wrap_s = sampler.wrap_t = Wrap::ClampToBorder;
        sampler.border = {0.25f, -3.0f, 1e5f, 1.0f};
        FetchCounts counts;
        WaveColor colour;
        sample_wave(texture, sampler, everywhere(-3, 0.4f, 1, 16), kWaveFull, colour, &counts);
        EXPECT_EQ(texture.work().blocks_decoded, 0u) << to_string(kernel);
        EXPECT_EQ(counts, (FetchCounts{32, 0, 0})) << to_string(kernel);
        for (size_t c = 0; c < 4; ++c) EXPECT_EQ(lane_of(colour, 5)[c], sampler.border[c]) << to_string(kernel);

        // One lane on the texture: its blocks and no others.
        WaveCoordinates at = everywhere(-3, 0.4f, 1, 16);
        at.u[9] = 1.5f / 16, at.v[9] = 1.5f / 16;
        sample_wave(texture, sampler, at, kWaveFull, colour, &counts);
        const int reach = axis_taps(kernel) / 2;
        if (reach <= 2) {
            EXPECT_EQ(texture.work().blocks_decoded, 1u) << to_string(kernel);
        }
        for (size_t c = 0; c < 4; ++c) EXPECT_EQ(lane_of(colour, 10)[c], sampler.border[c]) << to_string(kernel);
    }
}

TEST_P(SampleWide, DependsOnNothingOutsideItsLane) {
    LookupDraw draw({64, 64, 1}, 7, 11);
    for (const Format format : {Format::RGBA8Srgb, Format::RGBA16Half}) {
        for (const Kernel& kernel : every_kernel()) {
            const SamplerState sampler = draw_sampler(draw, kernel, Wrap(draw.below(5)));
            std::vector<reference::Lookup> lookups;
            for (int i = 0; i < kWaveLanes; ++i) lookups.push_back(draw.next());
            const WaveCoordinates at = gather(lookups, 0);
            Texture texture("hashed", make_hashed_pyramid(format, 64, 64));
            WaveColor whole;
            sample_wave(texture, sampler, at, kWaveFull, whole);
            for (const WaveMask mask : {0x00000001u, 0x80000000u, 0x0F0F00F0u, uint32_t(draw.bits()())}) {
                WaveCoordinates spoilt = at;
                for (int i = 0; i < kWaveLanes; ++i) {
                    if ((mask >> i & 1) == 0) spoilt.u[i] = spoilt.dudx[i] = std::numeric_limits<float>::quiet_NaN();
                }
                WaveColor part;
                sample_wave(texture, sampler, spoilt, mask, part);
                for (int i = 0; i < kWaveLanes; ++i) {
                    if ((mask >> i & 1) == 0) continue;
                    ASSERT_EQ(lane_of(part, i), lane_of(whole, i)) << describe(sampler) << " lane " << i;
                }
            }
        }
    }
}

TEST_P(SampleWide, MixesAnyTwoKernelsLaneByLane) {
    LookupDraw draw({32, 32, 1}, 6, 12);
    Texture texture("hashed", make_hashed_pyramid(Format::RGBA8Unorm, 32, 32));
    for (const Kernel& magnify : every_kernel()) {
        const Kernel& minify = every_kernel()[size_t(draw.below(int(every_kernel().size())))];
        WaveCoordinates at{};
        for (int i = 0; i < kWaveLanes; ++i) {
            at.u[i] = draw.uniform(-1, 2), at.v[i] = draw.uniform(-1, 2);
            at.dudx[i] = (i % 3 == 0 ? 0.5f : 4.0f) / 32;
        }
        WaveColor mixed, large, small;
        sample_wave(texture, {.magnify = magnify, .minify = minify}, at, kWaveFull, mixed);
        sample_wave(texture, {.magnify = magnify, .minify = magnify}, at, kWaveFull, large);
        sample_wave(texture, {.magnify = minify, .minify = minify}, at, kWaveFull, small);
        for (int i = 0; i < kWaveLanes; ++i) {
            ASSERT_EQ(lane_of(mixed, i), lane_of(i % 3 == 0 ? large : small, i))
                << to_string(magnify) << ' ' << to_string(minify) << ' ' << i;
        }
    }
}

}  // namespace
}  // namespace rawtexel::texunit
