// The verifier accepts what our gpu precision returns, and refuses results that are wrong by little more than it allows.
#include "texunit/legal_interval.h"
#include "texunit/sample.h"

#include "tests/texunit/hashed_source.h"
#include "tests/texunit/legal_lookups.h"
#include "tests/texunit/lookup_draw.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace rawtexel::texunit {
namespace {

using Colour = JudgedColour;

TEST(LegalInterval, HoldsOurGpuPrecisionAtEightBits) {
    constexpr std::pair<int, int> kExtents[] = {{1, 1}, {3, 70}, {64, 64}, {1000, 300}, {8192, 4096}};
    for (const auto& [width, height] : kExtents) {
        Texture texture("hashed", make_hashed_pyramid(Format::RGBA8Unorm, width, height));
        const JudgedTexture reference = judged(texture);
        LookupDraw draw({width, height, 1}, texture.shape().levels, uint32_t(width));
        for (const Kernel& kernel : every_kernel()) {
            if (!is_ordinary(kernel)) continue;
            for (int wrap = 0; wrap < 5; ++wrap) {
                SamplerState sampler = draw_sampler(draw, kernel, Wrap(wrap));
                if (!is_ordinary(sampler.magnify) || !is_ordinary(sampler.minify)) sampler.magnify = sampler.minify = kernel;
                sampler.precision = Precision::Gpu;
                if (draw.below(3) == 0) sampler.lod_bias = draw.uniform(-2, 2);
                if (draw.below(4) == 0) sampler.min_lod = draw.uniform(0, 3), sampler.max_lod = draw.uniform(0, 8);
                std::vector<reference::Lookup> lookups;
                for (int i = 0; i < kWaveLanes; ++i) {
                    lookups.push_back(ordinary_lookup(draw, width, height, texture.shape().levels));
                }
                WaveColor colour;
                sample_wave(texture, sampler, gather(lookups, 0), kWaveFull, colour);
                for (int i = 0; i < 3; ++i) {
                    const LegalVerdict verdict = judge_lookup(reference, sampler, judged(lookups[size_t(i)]), colour_of(colour, i), kOurs);
                    ASSERT_TRUE(verdict.legal) << to_string(verdict, colour_of(colour, i)) << "\n"
                                               << describe(sampler) << describe(lookups[size_t(i)]) << " bias " << sampler.lod_bias
                                               << " lod " << sampler.min_lod << " to " << sampler.max_lod;
                    for (size_t c = 0; c < 4; ++c) {
                        ASSERT_GE(colour_of(colour, i)[c], verdict.least[c] - 1e-5);
                        ASSERT_LE(colour_of(colour, i)[c], verdict.most[c] + 1e-5);
                    }
                }
            }
        }
    }
}

/// Far from the origin a coordinate's bits leave a good part of a texel open, over which curved weights are not linear.
TEST(LegalInterval, HoldsCurvedKernelsFarFromTheOrigin) {
    constexpr int kWidth = 21, kHeight = 12;
    Texture texture("hashed", make_hashed_pyramid(Format::RGBA8Unorm, kWidth, kHeight));
    const JudgedTexture reference = judged(texture);
    LookupDraw draw({kWidth, kHeight, 1}, 1, 17);
    for (const Kernel& kernel : {Kernel(Kernel::Quadratic), Kernel(Kernel::BSpline), Kernel::mitchell(), Kernel(Kernel::CatmullRom)}) {
        const SamplerState sampler{.magnify = kernel, .minify = kernel, .mip = MipMode::None, .precision = Precision::Gpu};
        for (int wave = 0; wave < 2; ++wave) {
            std::vector<reference::Lookup> lookups;
            for (int i = 0; i < kWaveLanes; ++i)
                lookups.push_back({std::exp2(draw.uniform(14, 17)), -std::exp2(draw.uniform(14, 17)), 0, 0, 0, 0});
            WaveColor colour;
            sample_wave(texture, sampler, gather(lookups, 0), kWaveFull, colour);
            for (int i = 0; i < kWaveLanes; ++i) {
                const LegalVerdict verdict = judge_lookup(reference, sampler, judged(lookups[size_t(i)]), colour_of(colour, i), kOurs);
                ASSERT_TRUE(verdict.legal) << to_string(verdict, colour_of(colour, i)) << "\n"
                                           << describe(sampler) << describe(lookups[size_t(i)]);
            }
        }
    }
}

/// How many of many lookups are refused when the sampler that answers is not the one that was asked.
class Mistakes : public testing::Test {
  protected:
    struct Share {
        int refused = 0, asked = 0;
    };

    template <class Answer>
    Share refused(const SamplerState& asked, const Answer& answer, const LegalPrecision& precision = kOurs) {
        LookupDraw draw({64, 64, 1}, texture_.shape().levels, 5);
        const JudgedTexture reference = judged(texture_);
        Share share;
        for (int wave = 0; wave < 4; ++wave) {
            std::vector<reference::Lookup> lookups;
            for (int i = 0; i < kWaveLanes; ++i) lookups.push_back(ordinary_lookup(draw, 64, 64, 5));
            const WaveColor colour = answer(lookups);
            for (int i = 0; i < kWaveLanes; ++i) {
                ++share.asked;
                share.refused += !judge_lookup(reference, asked, judged(lookups[size_t(i)]), colour_of(colour, i), precision).legal;
            }
        }
        return share;
    }

    WaveColor sample(const SamplerState& sampler, const std::vector<reference::Lookup>& lookups) {
        WaveColor colour;
        sample_wave(texture_, sampler, gather(lookups, 0), kWaveFull, colour);
        return colour;
    }

    template <class Change>
    Share refused_with(const SamplerState& asked, const Change& change, const LegalPrecision& precision = kOurs) {
        return refused(
            asked,
            [&](std::vector<reference::Lookup> lookups) {
                SamplerState answering = asked;
                for (reference::Lookup& at : lookups) change(answering, at);
                return sample(answering, lookups);
            },
            precision);
    }

    Texture texture_{"hashed", make_hashed_pyramid(Format::RGBA8Unorm, 64, 64)};
    SamplerState trilinear_{.precision = Precision::Gpu};
    SamplerState bilinear_{.mip = MipMode::None, .precision = Precision::Gpu};
    SamplerState nearest_{.magnify = Kernel::Nearest, .minify = Kernel::Nearest, .mip = MipMode::Nearest, .precision = Precision::Gpu};
};

TEST_F(Mistakes, AreNotSeenWhereThereAreNone) {
    for (const SamplerState& sampler : {trilinear_, bilinear_, nearest_}) {
        EXPECT_EQ(refused_with(sampler, [](SamplerState&, reference::Lookup&) {}).refused, 0);
        EXPECT_EQ(
            refused_with(sampler, [](SamplerState& answering, reference::Lookup&) { answering.precision = Precision::Exact; }).refused, 0)
            << "the exact result is legal too";
    }
}

TEST_F(Mistakes, OfAFewStepsAreRefused) {
    const auto expect_refused = [&](const char* what, const Share& share, double least) {
        EXPECT_GE(share.refused, least * share.asked) << what << ": " << share.refused << " of " << share.asked;
    };
    // 3/256 of a texel is one step too many for bilinear lookups.
    const auto moved = [](SamplerState&, reference::Lookup& at) { at.u += 3.0f / 256 / 64; };
    expect_refused("coordinates", refused_with(bilinear_, moved), 0.95);
    expect_refused("level of detail", refused_with(trilinear_, [](SamplerState& s, reference::Lookup&) { s.lod_bias = 6.0f / 256; }), 0.6);
    expect_refused("kernel", refused_with(bilinear_, [](SamplerState& s, reference::Lookup&) { s.magnify = s.minify = Kernel::BSpline; }),
                   0.99);
    expect_refused("half a texel", refused_with(nearest_, [](SamplerState&, reference::Lookup& at) { at.u += 0.5f / 64; }), 0.15);
    expect_refused("wrap", refused_with(bilinear_, [](SamplerState& s, reference::Lookup&) { s.wrap_s = Wrap::MirrorOnce; }), 0.2);
    expect_refused("mip mode", refused_with(trilinear_, [](SamplerState& s, reference::Lookup&) { s.mip = MipMode::Nearest; }), 0.6);
    expect_refused("swapped channels",
                   refused(bilinear_,
                           [&](const std::vector<reference::Lookup>& lookups) {
                               WaveColor colour = sample(bilinear_, lookups);
                               std::swap(colour.channel[0], colour.channel[2]);
                               return colour;
                           }),
                   0.99);
    // An 8-bit result that is off by two codes where one is allowed.
    LegalPrecision codes = kOurs;
    codes.colour_threshold = 1.0 / 255;
    expect_refused("two codes",
                   refused(
                       bilinear_,
                       [&](const std::vector<reference::Lookup>& lookups) {
                           WaveColor colour = sample(bilinear_, lookups);
                           for (int i = 0; i < kWaveLanes; ++i) colour.channel[3][i] += 6.0f / 255;
                           return colour;
                       },
                       codes),
                   0.95);
}

TEST_F(Mistakes, AreMeasuredByTheClosestLegalColour) {
    const JudgedTexture reference = judged(texture_);
    const JudgedLookup at{.at = {10.5 / 64, 20.5 / 64, 0}};
    const Colour texel = reference.texel(0, 0, 10, 20);
    Colour wrong = texel;
    wrong[1] += 0.01;
    LegalPrecision precision = kOurs;
    precision.subtexel_bits = 20;
    precision.colour_threshold = 1e-3;
    const LegalVerdict verdict = judge_lookup(reference, bilinear_, at, wrong, precision);
    EXPECT_FALSE(verdict.legal);
    EXPECT_NEAR(verdict.excess, 10, 0.1);
    EXPECT_NEAR(verdict.closest[1], texel[1], 1e-4);
    EXPECT_NE(to_string(verdict, wrong).find("not legal"), std::string::npos);
    EXPECT_TRUE(judge_lookup(reference, bilinear_, at, texel, precision).legal);
}

TEST_F(Mistakes, OfTheScaleFactorAreLegalWithinTheSpecifiedBounds) {
    // Vulkan allows rho up to sqrt(2) times the sum of components, at least half a level more than the length; not five times as much.
    LegalPrecision lenient = kOurs;
    lenient.approximate_scale = true;
    const auto biased = [](float bias) { return [=](SamplerState& s, reference::Lookup&) { s.lod_bias = bias; }; };
    EXPECT_EQ(refused_with(trilinear_, biased(0.4f), lenient).refused, 0);
    const Share large = refused_with(trilinear_, biased(2.5f), lenient);
    EXPECT_GE(large.refused * 4, large.asked * 3);
}

}  // namespace
}  // namespace rawtexel::texunit
