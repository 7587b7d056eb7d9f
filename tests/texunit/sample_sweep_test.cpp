// Every kernel, wrap mode, mip mode, storage class and awkward extent against the double-precision reference, on every instruction set.
#include "texunit/sample.h"

#include "texunit/simd.h"

#include "tests/reference/texunit/sampler_reference.h"
#include "tests/stress_scale.h"
#include "tests/texunit/hashed_source.h"
#include "tests/texunit/judged_lookup.h"
#include "tests/texunit/lookup_draw.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace rawtexel::texunit {
namespace {

using reference::Lookup;
using reference::Shift;

/// The texels of `texture`, which decodes them as they are asked for.
reference::ShapedImage image_of(Texture& texture) {
    const Shape& shape = texture.shape();
    return {shape.width, shape.height, shape.depth, shape.levels, [&texture](int level, int slice, int x, int y) {
                const std::array<float, 4> value = texture.texel(level, slice, x, y);
                return reference::Colour{value[0], value[1], value[2], value[3]};
            }};
}

/// One wave on the scalar target against the reference, and on every other target against that.
void sweep_wave(Texture& texture, const SamplerState& sampler, const std::vector<Lookup>& lookups, Tally& tally) {
    const reference::ShapedImage image = image_of(texture);
    const WaveCoordinates at = gather(lookups, 0);
    ASSERT_TRUE(choose_simd(Simd::Scalar));
    WaveColor colour;
    sample_wave(texture, sampler, at, kWaveFull, colour);
    for (int i = 0; i < kWaveLanes; ++i) {
        const Lookup& lookup = lookups[size_t(i)];
        const auto ask = [&](const Shift& shift) { return reference::sample_layer(image, sampler, lookup, 0, shift); };
        judge(ask, sampler, lane_of(colour, i), describe(sampler) + describe(lookup), tally);
        if (testing::Test::HasFatalFailure()) return;
    }
    for (const Simd simd : available_simd()) {
        choose_simd(simd);
        WaveColor other;
        sample_wave(texture, sampler, at, kWaveFull, other);
        ASSERT_TRUE(same_bits(colour, other)) << to_string(simd) << " differs from scalar: " << describe(sampler) << describe(lookups[0]);
    }
}

std::vector<Lookup> draw_lookups(LookupDraw& draw) {
    std::vector<Lookup> lookups;
    for (int i = 0; i < kWaveLanes; ++i) lookups.push_back(draw.next());
    return lookups;
}

class SampleSweep : public testing::TestWithParam<std::tuple<Format, std::pair<int, int>>> {
  protected:
    ~SampleSweep() override { choose_simd(Simd::Auto); }
};

TEST_P(SampleSweep, AgreesWithTheReferenceAndBetweenInstructionSets) {
    const auto& [format, extents] = GetParam();
    const auto [width, height] = extents;
    Texture texture("hashed", make_hashed_pyramid(format, width, height));
    LookupDraw draw({width, height, 1}, texture.shape().levels, uint32_t(width * 31 + height) + uint32_t(format));
    Tally tally;
    for (int n = 0; n < stress_scale() * int(every_kernel().size()); ++n) {
        const Kernel& kernel = every_kernel()[size_t(n) % every_kernel().size()];
        for (int wrap = 0; wrap < 5; ++wrap) {
            SamplerState sampler = draw_sampler(draw, kernel, Wrap(wrap));
            if (draw.below(4) == 0) sampler.precision = Precision::Gpu;
            sweep_wave(texture, sampler, draw_lookups(draw), tally);
            if (HasFatalFailure()) return;
        }
    }
    // These lookups sit on thresholds on purpose; on random ones the next test allows one in 10^5.
    tally.tell();
    EXPECT_LE(tally.other_decisions * 20, tally.lookups) << "of " << tally.lookups;
}

constexpr Format kOnePerClassAndEncoding[] = {Format::RGBA8Unorm,  Format::RG8Snorm,    Format::RGBA8Srgb,
                                              Format::BC1RgbaSrgb, Format::RGBA16Unorm, Format::BC3Srgb,
                                              Format::BC5Snorm,    Format::RGBA16Half,  Format::RGBA32Float};
constexpr std::pair<int, int> kExtents[] = {{1, 1}, {1, 37}, {3, 5}, {17, 1}, {64, 64}, {1000, 3}, {4096, 4096}, {16384, 16384}};

std::string case_name(const testing::TestParamInfo<SampleSweep::ParamType>& parameters) {
    const auto& [format, extents] = parameters.param;
    std::string name(info(format).name);
    std::replace(name.begin(), name.end(), '-', '_');
    return name + "_" + std::to_string(extents.first) + "x" + std::to_string(extents.second);
}
INSTANTIATE_TEST_SUITE_P(Formats, SampleSweep, testing::Combine(testing::ValuesIn(kOnePerClassAndEncoding), testing::ValuesIn(kExtents)),
                         case_name);

TEST(SampleSweepWide, TheWidestGaussiansAgreeWithTheReference) {
    Tally tally;
    for (const auto& [width, height] : {std::pair{1, 1}, {3, 70}, {512, 300}}) {
        Texture texture("hashed", make_hashed_pyramid(Format::RGBA16Half, width, height));
        LookupDraw draw({width, height, 1}, texture.shape().levels, uint32_t(width));
        for (const Kernel& kernel : {Kernel::gaussian(kMostSigma), Kernel::gaussian_point(kMostSigma), Kernel::gaussian(7.7f)}) {
            SamplerState sampler = draw_sampler(draw, kernel, Wrap(draw.below(5)));
            sampler.magnify = sampler.minify = kernel;
            sampler.mip = MipMode::Nearest;
            sweep_wave(texture, sampler, draw_lookups(draw), tally);
            if (HasFatalFailure()) break;
        }
    }
    tally.tell();
    choose_simd(Simd::Auto);
}

TEST(SampleDecisions, DifferFromTheReferenceInAtMostOneOf100000RandomLookups) {
    constexpr int kWidth = 16384, kHeight = 3000;
    Texture texture("hashed", make_hashed_pyramid(Format::RGBA8Unorm, kWidth, kHeight));
    const reference::ShapedImage image = image_of(texture);
    std::mt19937 random(7);
    std::uniform_real_distribution<float> coordinate(-2, 2), log_scale(-1, 13), unit(-1, 1);
    LookupDraw draw({kWidth, kHeight, 1}, texture.shape().levels, 8);
    Tally tally;
    for (int wave = 0; wave < 8000; ++wave) {
        // Narrow kernels mostly: they decide, wide ones take longer.
        const size_t kernel = random() % (wave % 16 == 0 ? every_kernel().size() : 2);
        SamplerState sampler = draw_sampler(draw, every_kernel()[kernel], Wrap(draw.below(5)));
        if (wave % 16 != 0) sampler.magnify = Kernel::Bilinear, sampler.minify = every_kernel()[kernel];
        std::vector<Lookup> lookups;
        for (int i = 0; i < kWaveLanes; ++i) {
            const float scale = std::exp2(log_scale(random));
            lookups.push_back({coordinate(random), coordinate(random), unit(random) * scale / kWidth, unit(random) * scale / kHeight,
                               unit(random) * scale / kWidth, unit(random) * scale / kHeight});
        }
        WaveColor colour;
        sample_wave(texture, sampler, gather(lookups, 0), kWaveFull, colour);
        for (int i = 0; i < kWaveLanes; ++i) {
            const Lookup& lookup = lookups[size_t(i)];
            const auto ask = [&](const Shift& shift) { return reference::sample_layer(image, sampler, lookup, 0, shift); };
            judge(ask, sampler, lane_of(colour, i), describe(sampler) + describe(lookup), tally);
            if (HasFatalFailure()) return;
        }
    }
    EXPECT_LE(tally.other_decisions * 100000, tally.lookups) << tally.other_decisions << " of " << tally.lookups;
    tally.tell();
}

}  // namespace
}  // namespace rawtexel::texunit
