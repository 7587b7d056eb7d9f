// Arrays, volumes and cube maps against the double-precision reference, on every instruction set.
#include "texunit/sample.h"

#include "texunit/simd.h"

#include "tests/reference/texunit/cube_reference.h"
#include "tests/reference/texunit/sampler_reference.h"
#include "tests/stress_scale.h"
#include "tests/texunit/hashed_source.h"
#include "tests/texunit/judged_lookup.h"
#include "tests/texunit/lookup_draw.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>
#include <vector>

namespace rawtexel::texunit {
namespace {

using reference::Lookup;
using reference::Lookup3;
using reference::Shift;

std::unique_ptr<Texture> hashed_texture(Format format, Shape shape) {
    shape.levels = full_level_count(shape.width, shape.height, shape.depth);
    return std::make_unique<Texture>("hashed", std::make_unique<HashedSource>(format, shape));
}

reference::ShapedImage image_of(Texture& texture) {
    const Shape& shape = texture.shape();
    return {shape.width, shape.height, shape.depth, shape.levels, [&texture](int level, int slice, int x, int y) {
                const std::array<float, 4> value = texture.texel(level, slice, x, y);
                return reference::Colour{value[0], value[1], value[2], value[3]};
            }};
}

/// `sample(colour)` on the scalar target against `ask(lane, shift)`, and on every other target against that.
template <class Sample, class Ask>
void hold(const SamplerState& sampler, const Sample& sample, const Ask& ask, const std::vector<Lookup3>& lookups, Tally& tally) {
    ASSERT_TRUE(choose_simd(Simd::Scalar));
    WaveColor colour;
    sample(colour);
    for (int i = 0; i < kWaveLanes; ++i) {
        judge([&](const Shift& shift) { return ask(i, shift); }, sampler, lane_of(colour, i),
              describe(sampler) + describe(lookups[size_t(i)]), tally);
        if (testing::Test::HasFatalFailure()) return;
    }
    for (const Simd simd : available_simd()) {
        choose_simd(simd);
        WaveColor other;
        sample(other);
        ASSERT_TRUE(same_bits(colour, other)) << to_string(simd) << " differs from scalar: " << describe(sampler);
    }
}

constexpr Format kFormats[] = {Format::RGBA8Unorm, Format::RGBA8Srgb, Format::RGBA16Unorm, Format::RGBA16Half, Format::RGBA32Float};

class SampleShapes : public testing::TestWithParam<Format> {
  protected:
    ~SampleShapes() override { choose_simd(Simd::Auto); }

    /// A sampler for `kernel`, and 32 lookups drawn by `next`.
    template <class Next>
    static std::vector<Lookup3> draw_lookups(const Next& next) {
        std::vector<Lookup3> lookups;
        for (int i = 0; i < kWaveLanes; ++i) lookups.push_back(next());
        return lookups;
    }
};
INSTANTIATE_TEST_SUITE_P(Formats, SampleShapes, testing::ValuesIn(kFormats), [](const auto& parameters) {
    std::string name(texunit::info(parameters.param).name);
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
});

TEST_P(SampleShapes, VolumesAgreeWithTheReference) {
    constexpr std::array<int, 3> kExtents[] = {{1, 1, 1}, {5, 3, 7}, {16, 16, 16}, {33, 1, 2}, {2, 70, 40}};
    Tally tally;
    for (const std::array<int, 3>& extents : kExtents) {
        const auto texture = hashed_texture(GetParam(), {.width = extents[0], .height = extents[1], .depth = extents[2]});
        const reference::ShapedImage image = image_of(*texture);
        LookupDraw draw(extents, texture->shape().levels, uint32_t(extents[0]) + uint32_t(GetParam()));
        for (int n = 0; n < stress_scale() * int(every_kernel().size()); ++n) {
            const Kernel& kernel = every_kernel()[size_t(n) % every_kernel().size()];
            if (axis_taps(kernel) > 6 && extents[0] != 5) continue;  // hundreds of taps
            SamplerState sampler = draw_sampler(draw, kernel, Wrap(draw.below(5)));
            if (axis_taps(sampler.magnify) > 6 || axis_taps(sampler.minify) > 6) sampler.mip = MipMode::Nearest;
            if (draw.below(4) == 0) sampler.precision = Precision::Gpu;
            if (draw.below(4) == 0) sampler.lod_rule = LodRule::Exact;
            const auto lookups = draw_lookups([&] { return draw.next_in_volume(); });
            const WaveCoordinates3 at = gather(lookups, 0);
            hold(
                sampler, [&](WaveColor& colour) { sample_volume_wave(*texture, sampler, at, kWaveFull, colour); },
                [&](int i, const Shift& shift) { return reference::sample_volume(image, sampler, lookups[size_t(i)], shift); }, lookups,
                tally);
            if (HasFatalFailure()) return;
        }
    }
    EXPECT_LE(tally.other_decisions * 20, tally.lookups) << "of " << tally.lookups;
    tally.tell();
}

TEST_P(SampleShapes, CubeMapsAgreeWithTheReference) {
    Tally tally;
    for (const int extent : {1, 2, 3, 5, 16, 64}) {
        const auto texture = hashed_texture(GetParam(), {.width = extent, .height = extent, .layers = 12, .cube = true});
        const reference::ShapedImage image = image_of(*texture);
        LookupDraw draw({extent, extent, 1}, texture->shape().levels, uint32_t(extent) + uint32_t(GetParam()));
        for (const Kernel& kernel : every_kernel()) {
            for (int n = 0; n < 2 * stress_scale(); ++n) {
                SamplerState sampler = draw_sampler(draw, kernel, Wrap::ClampToBorder);
                if (draw.below(4) == 0) sampler.precision = Precision::Gpu;
                const auto lookups = draw_lookups([&] { return draw.next_direction(); });
                const WaveCoordinates3 at = gather(lookups, 0);
                WaveFloat cube;
                for (int i = 0; i < kWaveLanes; ++i) cube[i] = float(i % 3) - 0.4f;
                const auto ask = [&](int i, const Shift& shift) {
                    return reference::sample_cube(image, sampler, lookups[size_t(i)], i % 3 == 2 ? 1 : i % 3 == 1, shift);
                };
                hold(
                    sampler, [&](WaveColor& colour) { sample_cube_wave(*texture, sampler, at, kWaveFull, colour, {.layer = &cube}); }, ask,
                    lookups, tally);
                if (HasFatalFailure()) return;
            }
        }
    }
    EXPECT_LE(tally.other_decisions * 20, tally.lookups) << "of " << tally.lookups;
    tally.tell();
}

/// Lookups of generic coordinates and footprints, and what they come to against the reference: how many decide otherwise.
class RandomShapes {
  public:
    RandomShapes(Texture& texture, uint32_t seed) : texture_(texture), image_(image_of(texture)), random_(seed) {}

    /// `sample(sampler, lookups, colour)` looks a wave up, `ask(image, sampler, lookup, shift)` is the reference.
    template <class Sample, class Ask>
    void judge_all(const Sample& sample, const Ask& ask, Tally& tally) {
        std::uniform_real_distribution<float> log_scale(-1, 7);
        LookupDraw draw({texture_.shape().width, texture_.shape().height, texture_.shape().depth}, texture_.shape().levels, 11);
        for (int wave = 0; wave < 4000; ++wave) {
            // Narrow kernels mostly: they decide, wide ones take longer.
            const Kernel minify = wave % 64 == 0 ? Kernel::BSpline : wave % 2 == 0 ? Kernel::Nearest : Kernel::Bilinear;
            SamplerState sampler = draw_sampler(draw, minify, Wrap(draw.below(5)));
            sampler.magnify = Kernel::Bilinear, sampler.minify = minify;
            std::vector<Lookup3> lookups;
            for (int i = 0; i < kWaveLanes; ++i) lookups.push_back(next(std::exp2(log_scale(random_))));
            WaveColor colour;
            sample(sampler, gather(lookups, 0), colour);
            for (int i = 0; i < kWaveLanes; ++i) {
                judge([&](const Shift& shift) { return ask(image_, sampler, lookups[size_t(i)], shift); }, sampler, lane_of(colour, i),
                      describe(sampler) + describe(lookups[size_t(i)]), tally);
                if (testing::Test::HasFatalFailure()) return;
            }
        }
    }

  private:
    /// Derivatives of up to `texels`.
    Lookup3 next(float texels) {
        std::uniform_real_distribution<float> unit(-1, 1);
        const float extents[3] = {float(texture_.shape().width), float(texture_.shape().height), float(texture_.shape().depth)};
        Lookup3 lookup;
        for (size_t axis = 0; axis < 3; ++axis) {
            lookup.position[axis] = 2 * unit(random_);
            lookup.dx[axis] = unit(random_) * texels / extents[axis];
            lookup.dy[axis] = unit(random_) * texels / extents[axis];
        }
        return lookup;
    }

    Texture& texture_;
    reference::ShapedImage image_;
    std::mt19937 random_;
};

TEST(ShapeDecisions, OfVolumesDifferFromTheReferenceInAtMostOneOf100000RandomLookups) {
    const auto texture = hashed_texture(Format::RGBA8Unorm, {.width = 100, .height = 60, .depth = 40});
    Tally tally;
    RandomShapes(*texture, 3)
        .judge_all([&](const SamplerState& sampler, const WaveCoordinates3& at,
                       WaveColor& colour) { sample_volume_wave(*texture, sampler, at, kWaveFull, colour); },
                   reference::sample_volume, tally);
    tally.tell();
    EXPECT_LE(tally.other_decisions * 100000, tally.lookups) << tally.other_decisions << " of " << tally.lookups;
}

TEST(ShapeDecisions, OfCubeMapsDifferFromTheReferenceInAtMostOneOf100000RandomLookups) {
    const auto texture = hashed_texture(Format::RGBA8Unorm, {.width = 200, .height = 200, .layers = 6, .cube = true});
    Tally tally;
    RandomShapes(*texture, 4)
        .judge_all([&](const SamplerState& sampler, const WaveCoordinates3& at,
                       WaveColor& colour) { sample_cube_wave(*texture, sampler, at, kWaveFull, colour); },
                   [](const reference::ShapedImage& image, const SamplerState& sampler, const Lookup3& lookup, const Shift& shift) {
                       return reference::sample_cube(image, sampler, lookup, 0, shift);
                   },
                   tally);
    tally.tell();
    EXPECT_LE(tally.other_decisions * 100000, tally.lookups) << tally.other_decisions << " of " << tally.lookups;
}

TEST_P(SampleShapes, ArraysReadTheNearestLayer) {
    const auto texture = hashed_texture(GetParam(), {.width = 20, .height = 11, .layers = 5});
    const reference::ShapedImage image = image_of(*texture);
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    const std::pair<float, int> layers[] = {
        {0, 0},    {0.5f, 0},  {0.50001f, 1}, {1.5f, 2},  {2.5f, 2},      {3.49f, 3},      {4, 4},
        {4.7f, 4}, {1e30f, 4}, {-0.4f, 0},    {-2e9f, 0}, {kInfinity, 4}, {-kInfinity, 0}, {std::numeric_limits<float>::quiet_NaN(), 0}};
    LookupDraw draw({20, 11, 1}, texture->shape().levels, 3);
    Tally tally;
    for (const Kernel& kernel : every_kernel()) {
        const SamplerState sampler = draw_sampler(draw, kernel, Wrap(draw.below(5)));
        std::vector<Lookup> flat;
        std::vector<Lookup3> shown(kWaveLanes);
        WaveFloat layer;
        std::vector<int> expected;
        for (int i = 0; i < kWaveLanes; ++i) {
            flat.push_back(draw.next());
            layer[i] = layers[size_t(i) % std::size(layers)].first;
            expected.push_back(layers[size_t(i) % std::size(layers)].second);
            shown[size_t(i)].position = {flat.back().u, flat.back().v, layer[i]};
        }
        const WaveCoordinates at = gather(flat, 0);
        hold(
            sampler, [&](WaveColor& colour) { sample_wave(*texture, sampler, at, kWaveFull, colour, LookupExtras{.layer = &layer}); },
            [&](int i, const Shift& shift) { return reference::sample_layer(image, sampler, flat[size_t(i)], expected[size_t(i)], shift); },
            shown, tally);
        if (HasFatalFailure()) return;
    }
    tally.tell();
}

/// A direction on face `face` at (s, t), 0..1 on the face.
Lookup3 towards(int face, float s, float t) {
    static constexpr int kAxes[6][3][3] = {{{0, 0, -1}, {0, -1, 0}, {1, 0, 0}}, {{0, 0, 1}, {0, -1, 0}, {-1, 0, 0}},
                                           {{1, 0, 0}, {0, 0, 1}, {0, 1, 0}},   {{1, 0, 0}, {0, 0, -1}, {0, -1, 0}},
                                           {{1, 0, 0}, {0, -1, 0}, {0, 0, 1}},  {{-1, 0, 0}, {0, -1, 0}, {0, 0, -1}}};
    Lookup3 at{};
    for (size_t axis = 0; axis < 3; ++axis) {
        at.position[axis] =
            float(kAxes[face][0][axis]) * (2 * s - 1) + float(kAxes[face][1][axis]) * (2 * t - 1) + float(kAxes[face][2][axis]);
    }
    return at;
}

/// Approaching an edge or a corner from every face that meets there, filtered colours meet too.
TEST(CubeMaps, AreSeamlessAcrossEdgesAndCorners) {
    constexpr int kExtent = 8;
    const auto texture = hashed_texture(Format::RGBA32Float, {.width = kExtent, .height = kExtent, .layers = 6, .cube = true});
    double largest = 0;
    for (int face = 0; face < 6; ++face) {
        for (int y = 0; y < kExtent; ++y) {
            for (int x = 0; x < kExtent; ++x) {
                for (const float channel : texture->texel(0, face, x, y)) largest = std::max(largest, std::abs(double(channel)));
            }
        }
    }
    const auto colour_at = [&](const Kernel& kernel, const Lookup3& at) {
        WaveColor colour;
        sample_cube_wave(*texture, {.magnify = kernel, .minify = kernel, .mip = MipMode::None}, gather({std::vector<Lookup3>(32, at)}, 0),
                         1, colour);
        return lane_of(colour, 0);
    };
    constexpr float kStep = 1e-5f;
    const Kernel kernels[] = {Kernel::Bilinear,   Kernel::Quadratic, Kernel::BSpline,
                              Kernel::CatmullRom, Kernel::Lanczos3,  Kernel::gaussian()};
    for (const Kernel& kernel : kernels) {
        // A step of 2e-5 of a face is 1.6e-4 texels; no kernel here is steeper than 3 a texel along an axis. A corner is no limit point of
        // wide kernels, which see it differently from each face.
        const double bound = 2 * kStep * kExtent * 3 * 2 * largest;
        for (int face = 0; face < 6; ++face) {
            for (float along = 0.01f; along < 1; along += 0.07f) {
                if (kernel != Kernel::Bilinear && (along < 0.45f || along > 0.55f)) continue;
                for (int edge = 0; edge < 4; ++edge) {
                    const auto place = [&](float across) {
                        const float a = edge % 2 == 0 ? across : 1 - across;
                        return edge < 2 ? towards(face, a, along) : towards(face, along, a);
                    };
                    const LaneColour inside = colour_at(kernel, place(kStep)), outside = colour_at(kernel, place(-kStep));
                    for (size_t c = 0; c < 4; ++c) {
                        ASSERT_NEAR(inside[c], outside[c], bound)
                            << to_string(kernel) << " face " << face << " edge " << edge << " at " << along;
                    }
                }
            }
        }
    }
    for (int corner = 0; corner < 8; ++corner) {
        const float x = corner & 1 ? 1.0f : -1.0f, y = corner & 2 ? 1.0f : -1.0f, z = corner & 4 ? 1.0f : -1.0f;
        const LaneColour from_x = colour_at(Kernel::Bilinear, {{x * (1 + kStep), y, z}, {}, {}});
        const LaneColour from_y = colour_at(Kernel::Bilinear, {{x, y * (1 + kStep), z}, {}, {}});
        const LaneColour from_z = colour_at(Kernel::Bilinear, {{x, y, z * (1 + kStep)}, {}, {}});
        for (size_t c = 0; c < 4; ++c) {
            EXPECT_NEAR(from_x[c], from_y[c], 4 * kStep * kExtent * largest) << "corner " << corner;
            EXPECT_NEAR(from_x[c], from_z[c], 4 * kStep * kExtent * largest) << "corner " << corner;
        }
    }
}

TEST(CubeMaps, TiesGoToZThenY) {
    const auto texture = hashed_texture(Format::RGBA8Unorm, {.width = 4, .height = 4, .layers = 6, .cube = true});
    const SamplerState nearest{.magnify = Kernel::Nearest, .minify = Kernel::Nearest, .mip = MipMode::None};
    const auto expect_face = [&](std::array<float, 3> direction, int face, int x, int y) {
        WaveColor colour;
        sample_cube_wave(*texture, nearest, gather({std::vector<Lookup3>(32, Lookup3{direction, {}, {}})}, 0), 1, colour);
        const std::array<float, 4> texel = texture->texel(0, face, x, y);
        for (size_t c = 0; c < 4; ++c) {
            EXPECT_EQ(lane_of(colour, 0)[c], texel[c]) << direction[0] << ',' << direction[1] << ',' << direction[2];
        }
    };
    expect_face({1, 1, 1}, 4, 3, 0);
    expect_face({1, 1, 0.5f}, 2, 3, 3);
    expect_face({1, 0.5f, -1}, 5, 0, 1);
    expect_face({-1, -1, 0.9f}, 3, 0, 0);
    expect_face({1, 0.1f, 0.1f}, 0, 1, 1);
    expect_face({0, 0, 0}, 4, 2, 2);
    expect_face({1e-30f, 2e-30f, -3e-30f}, 5, 1, 0);
}

TEST(SampleConstant, ShapesComeBackBitEqualThroughNarrowKernelsAndCloseThroughWideOnes) {
    class Constant final : public TexelSource {
      public:
        explicit Constant(const Shape& shape) : shape_(shape) {}
        Format format() const override { return Format::RGBA32Float; }
        Shape shape() const override { return shape_; }
        uint64_t stored_bytes() const override { return 16; }
        void decode_block(int, int, int, int, std::byte* texels) override {
            const float value[4] = {0.1f, -1234.5678f, 3e-30f, 0.7f};
            for (int i = 0; i < 16; ++i) std::memcpy(texels + 16 * i, value, sizeof(value));
        }

      private:
        Shape shape_;
    };
    constexpr float kValue[4] = {0.1f, -1234.5678f, 3e-30f, 0.7f};
    Texture flat("constant", std::make_unique<Constant>(Shape{.width = 13, .height = 6, .levels = 4}));
    Texture volume("constant", std::make_unique<Constant>(Shape{.width = 13, .height = 6, .depth = 9, .levels = 4}));
    Texture cube("constant", std::make_unique<Constant>(Shape{.width = 6, .height = 6, .layers = 6, .levels = 3, .cube = true}));
    for (const Simd simd : available_simd()) {
        choose_simd(simd);
        LookupDraw draw({13, 6, 9}, 4, 1);
        for (const Kernel& kernel : every_kernel()) {
            for (int n = 0; n < 12; ++n) {
                SamplerState sampler = draw_sampler(draw, kernel, Wrap(n % 5));
                sampler.magnify = sampler.minify = kernel;
                for (size_t c = 0; c < 4; ++c) sampler.border[c] = kValue[c];
                std::vector<Lookup> lookups;
                std::vector<Lookup3> lookups3, directions;
                for (int i = 0; i < kWaveLanes; ++i) {
                    lookups.push_back(draw.next());
                    lookups3.push_back(draw.next_in_volume());
                    directions.push_back(draw.next_direction());
                }
                WaveColor colours[3];
                sample_wave(flat, sampler, gather(lookups, 0), kWaveFull, colours[0]);
                sample_volume_wave(volume, sampler, gather(lookups3, 0), kWaveFull, colours[1]);
                sample_cube_wave(cube, sampler, gather(directions, 0), kWaveFull, colours[2]);
                const int taps = axis_taps(kernel);
                const bool extreme = kernel.kind == KernelKind::Mitchell && std::abs(kernel.b) > 1;
                for (int shape = 0; shape < 3; ++shape) {
                    const int count = shape == 1 ? taps * taps * taps : taps * taps;
                    for (int i = 0; i < kWaveLanes; ++i) {
                        for (size_t c = 0; c < 4; ++c) {
                            const float found = lane_of(colours[shape], i)[c];
                            const double bound =
                                is_narrow_kernel(kernel) ? 0.0 : double(std::abs(kValue[c])) * count * 0x1p-24 * (extreme ? 40.0 : 1.0);
                            ASSERT_NEAR(found, kValue[c], bound)
                                << "shape " << shape << ' ' << describe(sampler) << " on " << to_string(simd)
                                << (shape == 0 ? describe(lookups[size_t(i)]) : describe((shape == 1 ? lookups3 : directions)[size_t(i)]));
                        }
                    }
                }
            }
        }
    }
    choose_simd(Simd::Auto);
}

}  // namespace
}  // namespace rawtexel::texunit
