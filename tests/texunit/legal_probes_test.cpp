// The verifier on anisotropic lookups: it accepts our probes in gpu precision, and probes put together one by one; it refuses those of
// other rules and says what they are.
#include "texunit/colour_hull.h"
#include "texunit/footprint.h"
#include "texunit/legal_interval.h"
#include "texunit/probe_table.h"
#include "texunit/sample.h"

#include "tests/stress/worst_case.h"
#include "tests/stress_scale.h"
#include "tests/texunit/hashed_source.h"
#include "tests/texunit/legal_lookups.h"

#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <string>

namespace rawtexel::texunit {
namespace {

std::string describe_probes(const SamplerState& sampler) {
    return describe(sampler) + " probes " + std::to_string(sampler.probes) + ":" + std::to_string(sampler.probe_variance) + " rule " +
           std::string(to_string(sampler.lod_rule)) + " bias " + std::to_string(sampler.lod_bias);
}

/// Derivatives of any ratio up to 100, some of them equal or zero.
reference::Lookup stretched_lookup(LookupDraw& draw, int width, int height) {
    reference::Lookup at = ordinary_lookup(draw, width, height, 3);
    const float shrink = std::exp2(draw.uniform(-7, 0));
    if (draw.below(2) == 0) {
        at.dudx *= shrink, at.dvdx *= shrink;
    } else {
        at.dudy *= shrink, at.dvdy *= shrink;
    }
    if (draw.below(12) == 0) at.dudy = at.dvdx = 0;
    if (draw.below(12) == 0) at.dudy = -at.dvdx * float(height) / float(width), at.dvdy = at.dudx * float(width) / float(height);
    if (draw.below(20) == 0) at.dudx = at.dvdx = 0;
    return at;
}

/// How many lookups the verifier judged.
void expect_legal(const Shape& shape, bool hard, int waves, uint64_t& judged_lookups) {
    Texture texture("hashed", std::make_unique<HashedSource>(Format::RGBA8Unorm, shape));
    const JudgedTexture reference = judged(texture);
    LookupDraw draw({shape.width, shape.height, 1}, shape.levels, uint32_t(shape.width) + hard);
    int asked = 0, open = 0, probed = 0;
    for (int n = 0; n < waves * stress_scale(); ++n) {
        const Kernel kernel = n % 8 == 7 ? Kernel::BSpline : n % 8 == 5 ? Kernel::Nearest : Kernel::Bilinear;
        SamplerState sampler = draw_sampler(draw, kernel, Wrap(draw.below(5)));
        sampler.magnify = draw.below(4) == 0 ? Kernel::Nearest : kernel, sampler.minify = kernel;
        sampler.precision = Precision::Gpu;
        sampler.probes = std::array{2, 4, 16, 7, 64}[size_t(draw.below(5))];
        sampler.lod_rule = LodRule(draw.below(2));
        if (draw.below(3) == 0) sampler.probe_variance = draw.uniform(0.08f, 0.4f);
        if (draw.below(3) == 0) sampler.lod_bias = draw.uniform(-2, 2);
        std::vector<reference::Lookup> lookups;
        for (int i = 0; i < kWaveLanes; ++i) lookups.push_back(hard ? draw.next() : stretched_lookup(draw, shape.width, shape.height));
        WaveFloat layer;
        for (int i = 0; i < kWaveLanes; ++i) layer[i] = draw.uniform(0, float(shape.layers - 1));
        WaveColor colour;
        sample_wave(texture, sampler, gather(lookups, 0), kWaveFull, colour, {.layer = &layer});
        for (int i = 0; i < 5; ++i) {
            const LegalVerdict verdict =
                judge_lookup(reference, sampler, judged(lookups[size_t(i)], layer[i]), colour_of(colour, i), kOurs);
            ASSERT_TRUE(verdict.legal) << to_string(verdict, colour_of(colour, i)) << "\n"
                                       << describe_probes(sampler) << describe(lookups[size_t(i)]) << " layer " << layer[i];
            ++asked;
            open += !std::isfinite(verdict.least[0]);
            probed += verdict.most_probes > 1;
        }
    }
    EXPECT_LE(open * 10, asked) << "lookups of which nothing can be said";
    EXPECT_GE(probed * 3, asked);
    judged_lookups += uint64_t(asked);
}

TEST(LegalProbes, HoldOurAnisotropicLookups) {
    uint64_t lookups = 0;
    expect_legal({.width = 64, .height = 128, .layers = 3, .levels = full_level_count(64, 128)}, false, 40, lookups);
    expect_legal({.width = 1000, .height = 300, .levels = full_level_count(1000, 300)}, false, 40, lookups);
    tell_tested(lookups, "lookups");
}

TEST(LegalProbes, HoldOurAnisotropicLookupsAtAwkwardPlaces) {
    uint64_t lookups = 0;
    expect_legal({.width = 64, .height = 32, .levels = full_level_count(64, 32)}, true, 40, lookups);
    tell_tested(lookups, "lookups");
}

/// Probes put together from isotropic lookups, each of its own sampler: any rule one likes.
class ProbeMistakes : public testing::Test {
  protected:
    /// What the implementation does with a footprint of ours.
    struct Rule {
        int probes;
        float axis_u, axis_v;
        float lod;
        std::function<float(int i, int n)> place = [](int i, int n) { return (float(i) + 0.5f) / float(n) - 0.5f; };
    };
    using Change = std::function<void(Rule&, const reference::Lookup&)>;

    JudgedColour mean_of_probes(const SamplerState& sampler, const reference::Lookup& at, const Rule& rule) {
        SamplerState one = sampler;
        one.probes = 1;
        one.min_lod = one.max_lod = rule.lod;
        JudgedColour mean{};
        for (int first = 0; first < rule.probes; first += kWaveLanes) {
            std::vector<reference::Lookup> lookups;
            for (int i = 0; i < kWaveLanes; ++i) {
                const float place = rule.place(first + i, rule.probes);
                lookups.push_back({at.u + place * rule.axis_u, at.v + place * rule.axis_v, 0, 0, 0, 0});
            }
            WaveColor colour;
            sample_wave(texture_, one, gather(lookups, 0), kWaveFull, colour);
            for (int i = 0; i < kWaveLanes && first + i < rule.probes; ++i) {
                for (size_t c = 0; c < 4; ++c) mean[c] += colour_of(colour, i)[c] / rule.probes;
            }
        }
        return mean;
    }

    /// Of footprints that take `least` probes or more.
    Refusals refusals(const SamplerState& sampler, int least, const Change& change) {
        LookupDraw draw({128, 128, 1}, texture_.shape().levels, 4);
        Refusals found;
        while (found.asked < 60) {
            std::vector<reference::Lookup> lookups;
            for (int i = 0; i < kWaveLanes; ++i) lookups.push_back(stretched_lookup(draw, 128, 128));
            WaveFootprint footprint;
            measure_footprint(texture_.levels(), sampler, gather(lookups, 0), footprint);
            for (int i = 0; i < kWaveLanes && found.asked < 60; ++i) {
                if (footprint.probes[i] < least || footprint.lod[i] > 4) continue;
                const reference::Lookup& at = lookups[size_t(i)];
                Rule rule{footprint.probes[i], footprint.axis_u[i], footprint.axis_v[i], footprint.lod[i]};
                change(rule, at);
                const JudgedColour colour = mean_of_probes(sampler, at, rule);
                const JudgedTexture reference = judged(texture_);
                found.count(reference, sampler, judged(at), colour, kOurs);
            }
        }
        return found;
    }

    void expect_refused(const Change& change, double least, const std::string& cause, int least_probes = 4) {
        for (const LodRule lod_rule : {LodRule::D3d, LodRule::Exact}) {
            SamplerState sampler = anisotropic_;
            sampler.lod_rule = lod_rule;
            const Refusals found = refusals(sampler, least_probes, change);
            EXPECT_GE(found.expect(least, cause), 6) << found.all_causes();
        }
    }

    Texture texture_{"hashed", make_hashed_pyramid(Format::RGBA8Unorm, 128, 128)};
    SamplerState anisotropic_{.probes = 16, .precision = Precision::Gpu};
};

TEST_F(ProbeMistakes, AreNotSeenWhereThereAreNone) {
    for (const LodRule rule : {LodRule::D3d, LodRule::Exact}) {
        anisotropic_.lod_rule = rule;
        const Refusals found = refusals(anisotropic_, 2, [](Rule&, const reference::Lookup&) {});
        EXPECT_EQ(found.refused, 0) << "of " << found.asked;
    }
}

TEST_F(ProbeMistakes, OfNumberAxisAndLevelAreRefusedAndNamed) {
    expect_refused([](Rule& rule, const reference::Lookup&) { rule.probes = (rule.probes + 1) / 2; }, 0.9, "half as many probes");
    expect_refused([](Rule& rule, const reference::Lookup&) { rule.probes *= 2; }, 0.9, "twice as many probes");
    expect_refused([](Rule& rule, const reference::Lookup&) { rule.probes = 1; }, 0.95, "one probe at the level of many");
    expect_refused([](Rule& rule, const reference::Lookup&) { rule.lod += std::log2(float(rule.probes)); }, 0.9, "", 4);
}

TEST_F(ProbeMistakes, OfATenthOfALevelAreRefused) {
    const Refusals found = refusals(anisotropic_, 2, [](Rule& rule, const reference::Lookup&) { rule.lod += 0.1f; });
    EXPECT_GE(found.refused, 45) << "of " << found.asked;
}

TEST_F(ProbeMistakes, OfTheAxisAreRefusedAndNamed) {
    SamplerState sampler = anisotropic_;
    const Refusals found = refusals(sampler, 4, [](Rule& rule, const reference::Lookup& at) {
        const bool is_x = rule.axis_u == at.dudx && rule.axis_v == at.dvdx;
        rule.axis_u = is_x ? at.dudy : at.dudx, rule.axis_v = is_x ? at.dvdy : at.dvdx;
    });
    EXPECT_GE(found.refused, 54) << "of " << found.asked;
    EXPECT_GE(found.causes.at("probes along the other axis"), 9);
}

TEST_F(ProbeMistakes, OfTheLevelOfTheLongerAxisAreRefusedAndNamed) {
    const Refusals found = refusals(anisotropic_, 4, [](Rule& rule, const reference::Lookup& at) {
        rule.lod = 0.5f * std::log2(std::max(at.dudx * at.dudx + at.dvdx * at.dvdx, at.dudy * at.dudy + at.dvdy * at.dvdy)) + 7;
    });
    EXPECT_GE(found.refused, 54) << "of " << found.asked;
    EXPECT_GE(found.causes.at("probes at the level of the longer axis"), 9);
}

TEST_F(ProbeMistakes, OfPlacesAreRefused) {
    // Probes from end to end of the axis, and from its middle on.
    const Refusals ends = refusals(anisotropic_, 4, [](Rule& rule, const reference::Lookup&) {
        rule.place = [](int i, int n) { return float(i) / float(n - 1) - 0.5f; };
    });
    EXPECT_GE(ends.refused, 54) << "of " << ends.asked;
    const Refusals shifted = refusals(anisotropic_, 4, [](Rule& rule, const reference::Lookup&) {
        rule.place = [](int i, int n) { return float(i) / float(n) - 0.5f; };
    });
    EXPECT_GE(shifted.refused, 54) << "of " << shifted.asked;
}

TEST_F(ProbeMistakes, OfTheIsotropicLookupAreNamed) {
    LookupDraw draw({128, 128, 1}, texture_.shape().levels, 6);
    std::vector<reference::Lookup> lookups;
    for (int i = 0; i < kWaveLanes; ++i) {
        const float u = draw.uniform(0, 1), v = draw.uniform(0, 1);
        lookups.push_back({u, v, 9.0f / 128, 4.0f / 128, -0.4f / 128, 0.9f / 128});
    }
    SamplerState isotropic = anisotropic_;
    isotropic.probes = 1;
    WaveColor colour;
    sample_wave(texture_, isotropic, gather(lookups, 0), kWaveFull, colour);
    int named = 0;
    for (int i = 0; i < kWaveLanes; ++i) {
        EXPECT_FALSE(judge_lookup(judged(texture_), anisotropic_, judged(lookups[size_t(i)]), colour_of(colour, i), kOurs).legal);
        named += likely_cause(judged(texture_), anisotropic_, judged(lookups[size_t(i)]), colour_of(colour, i), kOurs) ==
                 "isotropic, at the level of the longer axis";
    }
    EXPECT_GE(named, 28);
}

TEST_F(ProbeMistakes, OfANormalLineAreRefused) {
    SamplerState asked = anisotropic_;
    asked.probe_variance = 1.0f / 6;
    LookupDraw draw({128, 128, 1}, texture_.shape().levels, 8);
    int refused = 0, legal = 0;
    std::vector<reference::Lookup> lookups;
    for (int i = 0; i < kWaveLanes; ++i)
        lookups.push_back({draw.uniform(0, 1), draw.uniform(0, 1), 12.0f / 128, 7.0f / 128, -0.6f / 128, 1.1f / 128});
    const auto colour_with = [&](const SamplerState& sampler) {
        WaveColor colour;
        sample_wave(texture_, sampler, gather(lookups, 0), kWaveFull, colour);
        return colour;
    };
    SamplerState wider = asked;
    wider.probe_variance = 1.0f / 5;
    const WaveColor right = colour_with(asked), uniform = colour_with(anisotropic_), wide = colour_with(wider);
    for (int i = 0; i < kWaveLanes; ++i) {
        const JudgedLookup at = judged(lookups[size_t(i)]);
        legal += judge_lookup(judged(texture_), asked, at, colour_of(right, i), kOurs).legal;
        refused += !judge_lookup(judged(texture_), asked, at, colour_of(uniform, i), kOurs).legal;
        refused += !judge_lookup(judged(texture_), asked, at, colour_of(wide, i), kOurs).legal;
    }
    EXPECT_EQ(legal, kWaveLanes);
    EXPECT_GE(refused, 2 * kWaveLanes - 2);
}

TEST(ColourHull, TellsColoursApartThatEveryChannelByItselfAllows) {
    // From black to white and from half grey to half grey: the sum of halves is grey between 1/4 and 3/4.
    ColourPatch greys, grey;
    for (size_t n = 0; n < 4; ++n) greys.corner[n].fill(n % 2 == 0 ? 0 : 1), grey.corner[n].fill(0.5);
    ColourHull sum;
    sum.add(0.5, {&greys, 1});
    sum.add(0.5, {&grey, 1});
    const auto excess = [&](const JudgedColour& colour) { return ColourHull::excess(sum, sum, {0, 1}, colour, 0.01); };
    EXPECT_EQ(excess({0.3, 0.3, 0.3, 0.3}), 0);
    EXPECT_EQ(excess({0.75, 0.75, 0.75, 0.75}), 0);
    EXPECT_NEAR(excess({0.8, 0.8, 0.8, 0.8}), 5, 1e-9);
    // Red and blue as far from grey as may be: each is off by half their distance.
    EXPECT_NEAR(excess({0.3, 0.5, 0.5, 0.7}), 20, 1e-9);
    EXPECT_EQ(sum.least(), (JudgedColour{0.25, 0.25, 0.25, 0.25}));
    EXPECT_EQ(sum.most(), (JudgedColour{0.75, 0.75, 0.75, 0.75}));

    // Mixed with black, one share must explain all channels.
    ColourPatch black;
    ColourHull none, red;
    ColourPatch reds;
    for (Colour& corner : reds.corner) corner = {1, 0, 0, 1};
    none.add(1, {&black, 1});
    red.add(1, {&reds, 1});
    EXPECT_LE(ColourHull::excess(none, red, {0.2, 0.6}, {0.43, 0, 0, 0.43}, 0.01), 1e-3);
    EXPECT_NEAR(ColourHull::excess(none, red, {0.2, 0.6}, {0.3, 0, 0, 0.5}, 0.01), 10, 1e-3);
    EXPECT_NEAR(ColourHull::excess(none, red, {0.2, 0.6}, {0.7, 0, 0, 0.7}, 0.01), 10, 1e-3);
}

}  // namespace
}  // namespace rawtexel::texunit
