// The verifier on arrays, volumes and cube maps: it accepts what our gpu precision returns, refuses what is wrong, and says why.
#include "texunit/legal_interval.h"
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

using reference::Lookup3;

std::unique_ptr<Texture> hashed_texture(Shape shape) {
    shape.levels = full_level_count(shape.width, shape.height, shape.depth);
    return std::make_unique<Texture>("hashed", std::make_unique<HashedSource>(Format::RGBA8Unorm, shape));
}

/// What is looked up where: `layer` of an array, or cube of an array of cubes.
struct ShapedLookup {
    Lookup3 at{};
    float layer = 0;
};

/// The colours of a wave of lookups.
WaveColor sample_shape(Texture& texture, const SamplerState& sampler, const std::vector<ShapedLookup>& lookups) {
    std::vector<Lookup3> places;
    WaveFloat layer;
    for (int i = 0; i < kWaveLanes; ++i) {
        places.push_back(lookups[size_t(i)].at);
        layer[i] = lookups[size_t(i)].layer;
    }
    WaveColor colour;
    const WaveCoordinates3 at = gather(places, 0);
    if (texture.shape().cube) {
        sample_cube_wave(texture, sampler, at, kWaveFull, colour, {.layer = &layer});
    } else if (texture.shape().depth > 1) {
        sample_volume_wave(texture, sampler, at, kWaveFull, colour);
    } else {
        const WaveCoordinates flat{at.position[0], at.position[1], at.dx[0], at.dx[1], at.dy[0], at.dy[1]};
        sample_wave(texture, sampler, flat, kWaveFull, colour, {.layer = &layer});
    }
    return colour;
}

/// Coordinates hard on the arithmetic; layers between any two, on and beyond the ends.
ShapedLookup hard_lookup(LookupDraw& draw, const Shape& shape) {
    ShapedLookup lookup{shape.cube ? draw.next_direction() : draw.next_in_volume()};
    lookup.layer = draw.uniform(-1, float(shape.cubes()) + 1);
    if (draw.below(4) == 0) lookup.layer = std::round(lookup.layer) + 0.5f * float(draw.below(2));
    return lookup;
}

/// Lookups all legal, of which the verifier has something to say but for a few; `lookups` counts what it judged.
void expect_legal(const Shape& shape, const std::function<bool(const Kernel&)>& takes, int judged_lanes, uint64_t& lookups) {
    const auto texture = hashed_texture(shape);
    const JudgedTexture reference = judged(*texture);
    LookupDraw draw({shape.width, shape.height, shape.depth}, texture->shape().levels, uint32_t(shape.width + 7 * shape.depth));
    int asked = 0, open = 0;
    for (const Kernel& kernel : every_kernel()) {
        if (!is_ordinary(kernel) || !takes(kernel)) continue;
        for (int wrap = 0; wrap < 5 * stress_scale(); ++wrap) {
            SamplerState sampler = draw_sampler(draw, kernel, Wrap(wrap % 5));
            if (!is_ordinary(sampler.magnify) || !is_ordinary(sampler.minify) || !takes(sampler.magnify) || !takes(sampler.minify))
                sampler.magnify = sampler.minify = kernel;
            sampler.precision = Precision::Gpu;
            sampler.probes = 1 + draw.below(3);
            if (shape.depth == 1 && !shape.cube) sampler.probes = 1;
            if (draw.below(3) == 0) sampler.lod_bias = draw.uniform(-2, 2);
            if (draw.below(3) == 0) sampler.lod_rule = LodRule::Exact;
            std::vector<ShapedLookup> wave;
            for (int i = 0; i < kWaveLanes; ++i) wave.push_back(hard_lookup(draw, shape));
            const WaveColor colour = sample_shape(*texture, sampler, wave);
            for (int i = 0; i < judged_lanes; ++i) {
                const ShapedLookup& at = wave[size_t(i)];
                const LegalVerdict verdict = judge_lookup(reference, sampler, judged(at.at, at.layer), colour_of(colour, i), kOurs);
                ASSERT_TRUE(verdict.legal) << to_string(verdict, colour_of(colour, i)) << "\n"
                                           << describe(sampler) << describe(at.at) << " layer " << at.layer << " bias " << sampler.lod_bias
                                           << " rule " << to_string(sampler.lod_rule);
                ++asked;
                open += !std::isfinite(verdict.least[0]);
            }
        }
    }
    EXPECT_LE(open * 10, asked) << "lookups of which nothing can be said";
    lookups += uint64_t(asked);
}

bool any_kernel(const Kernel&) { return true; }
bool few_taps(const Kernel& kernel) { return axis_taps(kernel) <= 3; }

TEST(LegalShapes, HoldOurArrays) {
    uint64_t lookups = 0;
    expect_legal({.width = 37, .height = 64, .layers = 5}, any_kernel, 4, lookups);
    expect_legal({.width = 8, .height = 1, .layers = 2}, any_kernel, 4, lookups);
    tell_tested(lookups, "lookups");
}

TEST(LegalShapes, HoldOurVolumes) {
    uint64_t lookups = 0;
    expect_legal({.width = 33, .height = 16, .depth = 5}, few_taps, 4, lookups);
    expect_legal({.width = 2, .height = 7, .depth = 40}, few_taps, 4, lookups);
    const auto wide = [](const Kernel& kernel) { return kernel == Kernel::BSpline || kernel == Kernel::CatmullRom; };
    expect_legal({.width = 8, .height = 8, .depth = 8}, wide, 2, lookups);
    tell_tested(lookups, "lookups");
}

TEST(LegalShapes, HoldOurCubeMapsAcrossEdgesAndCorners) {
    uint64_t lookups = 0;
    expect_legal({.width = 32, .height = 32, .layers = 6, .cube = true}, any_kernel, 6, lookups);
    expect_legal({.width = 3, .height = 3, .layers = 18, .cube = true}, any_kernel, 6, lookups);
    expect_legal({.width = 1, .height = 1, .layers = 6, .cube = true}, any_kernel, 2, lookups);
    tell_tested(lookups, "lookups");
}

/// Lookups answered rightly and asked wrongly: the difference is the mistake.
class ShapeMistakes : public testing::Test {
  protected:
    using Change = std::function<void(JudgedTexture&, SamplerState&, JudgedLookup&)>;

    static ShapedLookup ordinary(LookupDraw& draw, const Shape& shape) {
        const std::array<int, 3> extents{shape.width, shape.height, shape.depth};
        ShapedLookup lookup;
        const float scale = std::exp2(draw.uniform(-1, 3));
        for (size_t axis = 0; axis < 3; ++axis) {
            lookup.at.position[axis] = shape.cube ? draw.uniform(-1, 1) : draw.uniform(0, 1);
            lookup.at.dx[axis] = draw.uniform(-1, 1) * scale / float(extents[shape.cube ? 0 : axis]);
            lookup.at.dy[axis] = draw.uniform(-1, 1) * scale / float(extents[shape.cube ? 0 : axis]);
        }
        lookup.layer = float(1 + draw.below(std::max(1, shape.cubes() - 2)));
        return lookup;
    }

    /// Of lookups whose question is changed by `change`.
    static Refusals refusals(const Shape& shape, const SamplerState& sampler, const Change& change) {
        const auto texture = hashed_texture(shape);
        LookupDraw draw({shape.width, shape.height, shape.depth}, texture->shape().levels, 9);
        Refusals found;
        for (int wave = 0; wave < 2; ++wave) {
            std::vector<ShapedLookup> lookups;
            for (int i = 0; i < kWaveLanes; ++i) lookups.push_back(ordinary(draw, shape));
            const WaveColor colour = sample_shape(*texture, sampler, lookups);
            for (int i = 0; i < kWaveLanes; ++i) {
                JudgedTexture asked = judged(*texture);
                SamplerState state = sampler;
                JudgedLookup at = judged(lookups[size_t(i)].at, lookups[size_t(i)].layer);
                change(asked, state, at);
                found.count(asked, state, at, colour_of(colour, i), kOurs);
            }
        }
        return found;
    }

    static void expect_refused(const Refusals& found, double least, const std::string& cause) {
        const int named = found.expect(least, cause);
        for (const auto& [name, count] : found.causes) EXPECT_LE(count, named) << found.all_causes();
    }

    static constexpr Shape kArray{.width = 64, .height = 64, .layers = 6};
    static constexpr Shape kVolume{.width = 16, .height = 16, .depth = 16};
    static constexpr Shape kCubes{.width = 32, .height = 32, .layers = 24, .cube = true};
    SamplerState trilinear_{.precision = Precision::Gpu};
    SamplerState bilinear_{.mip = MipMode::None, .precision = Precision::Gpu};
};

TEST_F(ShapeMistakes, AreNotSeenWhereThereAreNone) {
    const Change none = [](JudgedTexture&, SamplerState&, JudgedLookup&) {};
    for (const Shape& shape : {kArray, kVolume, kCubes}) {
        for (const SamplerState& sampler : {trilinear_, bilinear_}) EXPECT_EQ(refusals(shape, sampler, none).refused, 0);
    }
}

TEST_F(ShapeMistakes, OfLayersAreRefusedAndNamed) {
    for (const Shape& shape : {kArray, kCubes}) {
        expect_refused(refusals(shape, trilinear_, [](JudgedTexture&, SamplerState&, JudgedLookup& at) { at.layer += 1; }), 0.99,
                       "layer off by one, the one before");
        expect_refused(refusals(shape, trilinear_, [](JudgedTexture&, SamplerState&, JudgedLookup& at) { at.layer -= 1; }), 0.99,
                       "layer off by one, the one behind");
    }
}

TEST_F(ShapeMistakes, OfVolumesAreRefusedAndNamed) {
    const auto with = [&](const SamplerState& sampler, const std::function<void(SamplerState&, JudgedLookup&)>& change) {
        return refusals(kVolume, sampler, [&](JudgedTexture&, SamplerState& state, JudgedLookup& at) { change(state, at); });
    };
    const auto swap = [](size_t a, size_t b) {
        return [=](SamplerState&, JudgedLookup& at) {
            for (auto* v : {&at.at, &at.dx, &at.dy}) std::swap((*v)[a], (*v)[b]);
        };
    };
    expect_refused(with(trilinear_, swap(1, 2)), 0.95, "v and w swapped");
    expect_refused(with(trilinear_, swap(0, 2)), 0.95, "u and w swapped");
    expect_refused(with(bilinear_, [](SamplerState&, JudgedLookup& at) { at.at[2] = 1 - at.at[2]; }), 0.95, "w flipped");
    expect_refused(with(bilinear_, [](SamplerState&, JudgedLookup& at) { at.at[2] -= 0.5 / 16; }), 0.95, "half a slice behind");
    // What is off by 3/256 of a texel is off by one step too many.
    EXPECT_GE(with(bilinear_, [](SamplerState&, JudgedLookup& at) { at.at[2] += 3.0 / 256 / 16; }).refused, 60);
}

TEST_F(ShapeMistakes, OfCubeMapsAreRefusedAndNamed) {
    const auto of_faces = [](const std::array<int, 6>& faces) {
        return [=](JudgedTexture& texture, SamplerState&, JudgedLookup&) {
            texture.texel = [=, texel = texture.texel](int level, int slice, int x, int y) {
                return texel(level, slice / 6 * 6 + faces[size_t(slice % 6)], x, y);
            };
        };
    };
    // Half of the lookups meet one of the two faces or touch it across an edge.
    const Refusals swapped = refusals(kCubes, trilinear_, of_faces({1, 0, 2, 3, 4, 5}));
    EXPECT_GE(swapped.refused * 4, swapped.asked) << swapped.refused;
    EXPECT_GE(swapped.causes.count("face +X") + swapped.causes.count("face -X"), 1u);
    expect_refused(
        refusals(kCubes, bilinear_,
                 [](JudgedTexture&, SamplerState&, JudgedLookup& at) { at.at[1] = -at.at[1], at.dx[1] = -at.dx[1], at.dy[1] = -at.dy[1]; }),
        0.95, "direction mirrored in y");
    expect_refused(refusals(kCubes, bilinear_,
                            [](JudgedTexture& texture, SamplerState&, JudgedLookup&) {
                                texture.texel = [texel = texture.texel](int level, int slice, int x, int y) {
                                    return texel(level, slice, y, x);
                                };
                            }),
                   0.95, "");
}

TEST_F(ShapeMistakes, OfTheFaceAreLegalWhereTheDirectionIsTooImpreciseToTell) {
    // Where +X and +Z meet the level of detail depends on the face, by 0.4 here: along z both change s, but +Z changes t as well.
    const auto texture = hashed_texture({.width = 32, .height = 32, .layers = 6, .cube = true});
    const JudgedTexture reference = judged(*texture);
    const auto towards = [](float z) { return Lookup3{{1, 0.9f, z}, {0, 0, 0.11f}, {0, 0, 0}}; };
    const auto answer = [&](float z) {
        return colour_of(sample_shape(*texture, trilinear_, std::vector<ShapedLookup>(kWaveLanes, {towards(z)})), 0);
    };
    const JudgedColour on_x = answer(1 - 0x1p-20f), on_z = answer(1 + 0x1p-20f);
    const JudgedLookup at = judged(towards(1 - 0x1p-20f));
    for (const auto& [bits, either] : {std::pair{19, true}, {22, false}}) {
        LegalPrecision precision = kOurs;
        precision.coordinate_bits = bits;
        EXPECT_TRUE(judge_lookup(reference, trilinear_, at, on_x, precision).legal) << bits;
        EXPECT_EQ(judge_lookup(reference, trilinear_, at, on_z, precision).legal, either) << bits;
    }
}

TEST_F(ShapeMistakes, AtTheEdgesOfFacesAreRefusedAndNamed) {
    // Clamped instead of seamless: looked up within half a texel of an edge.
    const auto texture = hashed_texture({.width = 32, .height = 32, .layers = 6, .cube = true});
    const JudgedTexture reference = judged(*texture);
    LookupDraw draw({32, 32, 1}, texture->shape().levels, 2);
    int refused = 0, named = 0, legal = 0;
    for (int n = 0; n < 40; ++n) {
        // The middle of the texel at the edge of +Z is what clamping reads on both sides of the edge.
        const auto row = int(draw.below(30)) + 1;
        const double s = 1 - draw.uniform(0.1f, 0.4f) / 32, t = (row + 0.5) / 32;
        const JudgedLookup at{.at = {2 * s - 1, 1 - 2 * t, 1}};
        const JudgedColour clamped = reference.texel(0, 4, 31, row);
        const bool is_refused = !judge_lookup(reference, bilinear_, at, clamped, kOurs).legal;
        refused += is_refused;
        named += is_refused && likely_cause(reference, bilinear_, at, clamped, kOurs) == "edges of faces clamped";
        WaveCoordinates3 wave{};
        for (size_t axis = 0; axis < 3; ++axis) wave.position[axis][0] = float(at.at[axis]);
        WaveColor colour;
        sample_cube_wave(*texture, bilinear_, wave, 1, colour);
        legal += judge_lookup(reference, bilinear_, at, colour_of(colour, 0), kOurs).legal;
    }
    EXPECT_EQ(legal, 40);
    EXPECT_GE(refused, 39);
    EXPECT_GE(named, 36);
}

}  // namespace
}  // namespace rawtexel::texunit
