#include "texunit/sample.h"

#include "texunit/memory_source.h"
#include "texunit/simd.h"

#include "tests/stress/worst_case.h"
#include "tests/stress_scale.h"
#include "tests/texunit/hashed_source.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <random>
#include <vector>

namespace rawtexel::texunit {
namespace {

constexpr Kernel kKernels[] = {Kernel::Nearest, Kernel::Bilinear};
constexpr MipMode kMipModes[] = {MipMode::None, MipMode::Nearest, MipMode::Linear};
constexpr Wrap kWraps[] = {Wrap::Repeat, Wrap::MirroredRepeat, Wrap::ClampToEdge};

/// Runs every test on every instruction set.
class Sample : public testing::TestWithParam<Simd> {
  protected:
    Sample() { EXPECT_TRUE(choose_simd(GetParam())); }
    ~Sample() override { choose_simd(Simd::Auto); }
};
INSTANTIATE_TEST_SUITE_P(AllSets, Sample, testing::ValuesIn(available_simd()),
                         [](const auto& parameters) { return std::string(to_string(parameters.param)); });

std::vector<std::byte> repeated(const std::vector<std::byte>& texel, int count) {
    std::vector<std::byte> all;
    for (int i = 0; i < count; ++i) all.insert(all.end(), texel.begin(), texel.end());
    return all;
}

template <class T>
std::vector<std::byte> bytes_of(const std::vector<T>& values) {
    std::vector<std::byte> bytes(values.size() * sizeof(T));
    std::memcpy(bytes.data(), values.data(), bytes.size());
    return bytes;
}

WaveCoordinates random_coordinates(std::mt19937& random, int extent) {
    std::uniform_real_distribution<float> coordinate(-3, 3), log_scale(-2, std::log2(float(extent)) + 1), unit(-1, 1);
    WaveCoordinates at;
    for (int i = 0; i < kWaveLanes; ++i) {
        const float scale = std::exp2(log_scale(random)) / float(extent);
        at.u[i] = coordinate(random), at.v[i] = coordinate(random);
        at.dudx[i] = unit(random) * scale, at.dvdx[i] = unit(random) * scale;
        at.dudy[i] = unit(random) * scale, at.dvdy[i] = unit(random) * scale;
    }
    return at;
}

/// The same lookup in all lanes.
WaveCoordinates uniform_coordinates(float u, float v, float texels_per_pixel, int width, int height) {
    WaveCoordinates at{};
    for (int i = 0; i < kWaveLanes; ++i) {
        at.u[i] = u, at.v[i] = v;
        at.dudx[i] = texels_per_pixel / float(width);
        at.dvdy[i] = texels_per_pixel / float(height);
    }
    return at;
}

/// `values` counts what came back bit for bit.
void expect_constant(Format format, const std::vector<std::byte>& texel, MipStorage mip_storage, std::mt19937& random, uint64_t& values) {
    constexpr int kWidth = 13, kHeight = 6;
    Texture texture("constant", make_memory_source(format, kWidth, kHeight, repeated(texel, kWidth * kHeight)),
                    {.mip_storage = mip_storage});
    const std::array<float, 4> expected = texture.texel(0, 0, 0, 0);
    for (const Kernel kernel : kKernels) {
        for (const MipMode mip : kMipModes) {
            WaveColor colour;
            sample_wave(texture, {.wrap_t = Wrap::ClampToEdge, .magnify = kernel, .minify = Kernel::Bilinear, .mip = mip},
                        random_coordinates(random, kWidth), kWaveFull, colour);
            for (int c = 0; c < 4; ++c) {
                for (int i = 0; i < kWaveLanes; ++i) {
                    ASSERT_EQ(std::bit_cast<uint32_t>(colour.channel[c][i]), std::bit_cast<uint32_t>(expected[size_t(c)]))
                        << info(format).name << " channel " << c << " lane " << i << ": " << colour.channel[c][i] << " for "
                        << expected[size_t(c)];
                }
            }
            values += 4 * kWaveLanes;
        }
    }
}

TEST_P(Sample, LeavesConstantTexturesOfEvery8BitCodeBitEqual) {
    std::mt19937 random(1);
    uint64_t values = 0;
    for (const Format format : {Format::RGBA8Unorm, Format::RGBA8Snorm, Format::RGBA8Srgb}) {
        for (int code = 0; code < 256; ++code) {
            const std::vector<std::byte> texel = {std::byte(code), std::byte(255 - code), std::byte(code * 7), std::byte(code)};
            expect_constant(format, texel, MipStorage::Source, random, values);
            if (code % 16 == 3) expect_constant(format, texel, MipStorage::Float, random, values);
            if (HasFatalFailure()) return;
        }
    }
    tell_tested(values, "constants");
    tell_worst_case("constants_changed", 0);
}

TEST_P(Sample, LeavesConstantTexturesOfWiderFormatsBitEqual) {
    std::mt19937 random(2);
    uint64_t values = 0;
    for (int n = 0; n < 200 * stress_scale(); ++n) {
        std::vector<uint16_t> codes(4), halves(4);
        std::vector<float> floats(4);
        for (size_t c = 0; c < 4; ++c) {
            codes[c] = uint16_t(random());
            halves[c] = uint16_t((random() & 0x8000u) | random() % 0x7C00u);
            floats[c] = std::ldexp(float(random()) - 0x1p31f, int(random() % 150) - 100);
        }
        expect_constant(Format::RGBA16Unorm, bytes_of(codes), MipStorage::Source, random, values);
        expect_constant(Format::RGBA16Half, bytes_of(halves), MipStorage::Source, random, values);
        expect_constant(Format::RGBA32Float, bytes_of(floats), MipStorage::Source, random, values);
        if (HasFatalFailure()) return;
    }
    expect_constant(Format::RGBA32Float,
                    bytes_of(std::vector<float>{std::numeric_limits<float>::max(), -std::numeric_limits<float>::max(), 0x1p-149f, 0}),
                    MipStorage::Source, random, values);
    tell_tested(values, "constants");
    tell_worst_case("constants_changed", 0);
}

TEST_P(Sample, GivesInfinityForConstantInfinityAndWhereItIsMixed) {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    std::mt19937 random(3);
    uint64_t values = 0;
    expect_constant(Format::RGBA32Float, bytes_of(std::vector<float>{kInfinity, -kInfinity, 1, kInfinity}), MipStorage::Source, random,
                    values);
    expect_constant(Format::RGBA16Half, bytes_of(std::vector<uint16_t>{0x7C00, 0xFC00, 0x0001, 0x7BFF}), MipStorage::Source, random,
                    values);

    // Two texels, the second infinite: any weight of it gives infinity, none gives the first.
    Texture texture("mixed", make_memory_source(Format::R32Float, 2, 1, bytes_of(std::vector<float>{3, kInfinity})));
    const SamplerState sampler{.wrap_s = Wrap::ClampToEdge, .wrap_t = Wrap::ClampToEdge, .mip = MipMode::None};
    const auto red = [&](float u) {
        WaveColor colour;
        sample_wave(texture, sampler, uniform_coordinates(u, 0.5f, 0, 2, 1), kWaveFull, colour);
        return colour.channel[0][0];
    };
    EXPECT_EQ(red(0.4f), kInfinity);
    EXPECT_EQ(red(0.6f), kInfinity);
    EXPECT_EQ(red(0.25f), 3);
    EXPECT_EQ(red(0.1f), 3);
}

TEST_P(Sample, ReadsExactlyTheTexelUnderItsCentreWithAnyKernel) {
    constexpr int kWidth = 7, kHeight = 5;
    Texture texture("hashed", make_hashed_pyramid(Format::RGBA8Unorm, kWidth, kHeight));
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
            for (const Kernel kernel : kKernels) {
                for (const Wrap wrap : kWraps) {
                    WaveColor colour;
                    // 7 and 5 have no finite binary inverse, so bilinear may take a last-bit share of the neighbour.
                    sample_wave(texture, {.wrap_s = wrap, .wrap_t = wrap, .magnify = kernel, .minify = kernel},
                                uniform_coordinates((float(x) + 0.5f) / kWidth, (float(y) + 0.5f) / kHeight, 0, kWidth, kHeight), kWaveFull,
                                colour);
                    const std::array<float, 4> expected = texture.texel(0, 0, x, y);
                    for (int c = 0; c < 4; ++c) {
                        ASSERT_NEAR(colour.channel[c][5], expected[size_t(c)], kernel == Kernel::Nearest ? 0 : 2e-6)
                            << x << ',' << y << " channel " << c;
                    }
                }
            }
        }
    }
}

TEST_P(Sample, InterpolatesHalfWayBetweenTexels) {
    Texture texture("ramp", make_memory_source(Format::R32Float, 4, 1, bytes_of(std::vector<float>{0, 1, 2, 3})));
    const SamplerState clamp{.wrap_s = Wrap::ClampToEdge, .wrap_t = Wrap::ClampToEdge, .mip = MipMode::None};
    SamplerState repeat = clamp, mirror = clamp;
    repeat.wrap_s = Wrap::Repeat;
    mirror.wrap_s = Wrap::MirroredRepeat;
    const auto red = [&](const SamplerState& sampler, float u) {
        WaveColor colour;
        sample_wave(texture, sampler, uniform_coordinates(u, 0.5f, 0, 4, 1), kWaveFull, colour);
        return colour.channel[0][31];
    };
    EXPECT_EQ(red(clamp, 0.5f), 1.5f);
    EXPECT_EQ(red(clamp, 0.0f), 0.0f);
    EXPECT_EQ(red(clamp, 1.0f), 3.0f);
    EXPECT_EQ(red(clamp, -7.0f), 0.0f);
    EXPECT_EQ(red(repeat, 0.0f), 1.5f);
    EXPECT_EQ(red(repeat, 1.0f), 1.5f);
    EXPECT_EQ(red(repeat, -0.25f), 2.5f);
    EXPECT_EQ(red(repeat, 1e6f), 1.5f);
    EXPECT_EQ(red(mirror, 1.0f), 3.0f);
    EXPECT_EQ(red(mirror, 1.25f), 2.5f);
    EXPECT_EQ(red(mirror, -0.25f), 0.5f);
}

TEST_P(Sample, PicksLevelsByTheLongerDerivative) {
    Texture texture("hashed", make_hashed_pyramid(Format::R32Float, 64, 64));
    const auto red = [&](const SamplerState& sampler, float texels_per_pixel) {
        WaveColor colour;
        WaveCoordinates at = uniform_coordinates(0.3f, 0.6f, texels_per_pixel, 64, 64);
        for (int i = 0; i < kWaveLanes; ++i) at.dvdy[i] *= 0.1f;
        sample_wave(texture, sampler, at, kWaveFull, colour);
        return colour.channel[0][0];
    };
    const auto texel = [&](int level) {
        const int extent = 64 >> level;
        return texture.texel(level, 0, int(0.3f * float(extent)), int(0.6f * float(extent)))[0];
    };
    const SamplerState nearest{.magnify = Kernel::Nearest, .minify = Kernel::Nearest, .mip = MipMode::Nearest};
    EXPECT_EQ(red(nearest, 0.5f), texel(0));
    EXPECT_EQ(red(nearest, 1.4f), texel(0));
    EXPECT_EQ(red(nearest, 1.5f), texel(1));
    EXPECT_EQ(red(nearest, 4.0f), texel(2));
    EXPECT_EQ(red(nearest, 1000.0f), texel(6));
    EXPECT_EQ(red(nearest, std::numeric_limits<float>::quiet_NaN()), texel(6))
        << "a derivative that is not a number means the coarsest level";
    // Half-way the finer level wins (ceil(lambda + 1/2) - 1): rho^2 = 1 + 1 and 4 + 4 are lambda = 1/2 and 3/2 exactly.
    for (const int level : {0, 1}) {
        WaveCoordinates at = uniform_coordinates(0.3f, 0.6f, 0, 64, 64);
        for (int i = 0; i < kWaveLanes; ++i) at.dudx[i] = at.dvdx[i] = float(level + 1) / 64;
        WaveColor colour;
        sample_wave(texture, nearest, at, kWaveFull, colour);
        EXPECT_EQ(colour.channel[0][0], texel(level));
    }
    // lambda = 0 exactly still magnifies.
    SamplerState mixed = nearest;
    mixed.minify = Kernel::Bilinear;
    EXPECT_EQ(red(mixed, 1.0f), texel(0));
    EXPECT_NE(red(mixed, 1.01f), texel(0));
    SamplerState linear = nearest;
    linear.mip = MipMode::Linear;
    EXPECT_EQ(red(linear, 4.0f), texel(2));
    const float middle = std::exp2(2.5f);
    EXPECT_NEAR(red(linear, middle), 0.5 * (texel(2) + texel(3)), 1e-6 * (std::abs(texel(2)) + std::abs(texel(3))));
}

TEST_P(Sample, MixesKernelsLaneByLane) {
    Texture texture("hashed", make_hashed_pyramid(Format::RGBA8Unorm, 32, 32));
    std::mt19937 random(11);
    const WaveCoordinates at = random_coordinates(random, 32);
    for (const MipMode mip : kMipModes) {
        WaveColor mixed, nearest, bilinear;
        sample_wave(texture, {.magnify = Kernel::Nearest, .minify = Kernel::Bilinear, .mip = mip}, at, kWaveFull, mixed);
        sample_wave(texture, {.magnify = Kernel::Nearest, .minify = Kernel::Nearest, .mip = mip}, at, kWaveFull, nearest);
        sample_wave(texture, {.magnify = Kernel::Bilinear, .minify = Kernel::Bilinear, .mip = mip}, at, kWaveFull, bilinear);
        int magnified = 0;
        for (int i = 0; i < kWaveLanes; ++i) {
            const float rho = 32 * std::max(std::hypot(at.dudx[i], at.dvdx[i]), std::hypot(at.dudy[i], at.dvdy[i]));
            magnified += rho <= 1;
            for (int c = 0; c < 4; ++c) {
                ASSERT_EQ(mixed.channel[c][i], (rho <= 1 ? nearest : bilinear).channel[c][i]) << "lane " << i << " rho " << rho;
            }
        }
        EXPECT_GT(magnified, 0);
        EXPECT_LT(magnified, kWaveLanes);
    }
}

TEST_P(Sample, DependsOnNothingOutsideItsLane) {
    std::mt19937 random(5);
    for (const Format format : {Format::RGBA8Srgb, Format::RGBA16Unorm, Format::RGBA16Half, Format::RGBA32Float}) {
        const WaveCoordinates at = random_coordinates(random, 64);
        Texture texture("hashed", make_hashed_pyramid(format, 64, 64));
        WaveColor whole;
        sample_wave(texture, {}, at, kWaveFull, whole);
        for (const WaveMask mask : {0x00000001u, 0x80000000u, 0x0F0F00F0u, uint32_t(random())}) {
            WaveCoordinates spoilt = at;
            for (int i = 0; i < kWaveLanes; ++i) {
                if ((mask >> i & 1) == 0) spoilt.u[i] = spoilt.dudx[i] = std::numeric_limits<float>::quiet_NaN();
            }
            Texture fresh("hashed", make_hashed_pyramid(format, 64, 64));
            WaveColor part;
            sample_wave(fresh, {}, spoilt, mask, part);
            for (int i = 0; i < kWaveLanes; ++i) {
                for (int c = 0; c < 4; ++c) {
                    if ((mask >> i & 1) != 0) {
                        ASSERT_EQ(part.channel[c][i], whole.channel[c][i]) << "lane " << i << " of mask " << std::hex << mask;
                    }
                    ASSERT_TRUE(std::isfinite(part.channel[c][i])) << "lane " << i << " of mask " << std::hex << mask;
                }
            }
        }
    }
}

TEST_P(Sample, TouchesNoBlockForAnEmptyMaskAndOnlyOneForOneNearestLane) {
    Texture texture("hashed", make_hashed_pyramid(Format::RGBA8Unorm, 256, 256));
    WaveColor colour;
    std::mt19937 random(6);
    sample_wave(texture, {}, random_coordinates(random, 256), 0, colour);
    EXPECT_EQ(texture.work().blocks_decoded, 0u);
    sample_wave(texture, {.magnify = Kernel::Nearest, .minify = Kernel::Nearest, .mip = MipMode::Nearest}, random_coordinates(random, 256),
                1u << 17, colour);
    EXPECT_EQ(texture.work().blocks_decoded, 1u);

    // The centre of a block's last texel: the neighbours in the next blocks have weight 0.
    Texture fresh("hashed", make_hashed_pyramid(Format::RGBA8Unorm, 256, 256));
    sample_wave(fresh, {}, uniform_coordinates(3.5f / 256, 3.5f / 256, 1, 256, 256), kWaveFull, colour);
    EXPECT_EQ(fresh.work().blocks_decoded, 1u);
}

TEST_P(Sample, CountsTapsOfWeightZeroNowhere) {
    Texture texture("hashed", make_hashed_pyramid(Format::RGBA8Unorm, 16, 16));
    const auto counted = [&](const SamplerState& sampler, float u, float v, float texels_per_pixel, WaveMask mask) {
        FetchCounts counts;
        WaveColor plain, counting;
        const WaveCoordinates at = uniform_coordinates(u, v, texels_per_pixel, 16, 16);
        sample_wave(texture, sampler, at, mask, plain);
        sample_wave(texture, sampler, at, mask, counting, &counts);
        EXPECT_EQ(std::memcmp(&plain, &counting, sizeof(plain)), 0) << "counting changes the result";
        return counts;
    };
    const SamplerState trilinear;
    const SamplerState nearest{.magnify = Kernel::Nearest, .minify = Kernel::Nearest, .mip = MipMode::None};
    const float generic = 0.37f, centre = 5.5f / 16;
    EXPECT_EQ(counted(nearest, generic, generic, 3, kWaveFull), (FetchCounts{32, 32, 32, {32}}));
    EXPECT_EQ(counted(trilinear, generic, generic, 1, kWaveFull), (FetchCounts{32, 128, 128, {128}})) << "lambda 0: one level";
    EXPECT_EQ(counted(trilinear, generic, generic, 3, kWaveFull), (FetchCounts{32, 256, 256, {0, 128, 128}}));
    EXPECT_EQ(counted(trilinear, centre, generic, 1, kWaveFull), (FetchCounts{32, 64, 64, {64}})) << "on a texel's column: two taps";
    EXPECT_EQ(counted(trilinear, centre, centre, 1, 0xFFu), (FetchCounts{8, 8, 8, {8}}));
    EXPECT_EQ(counted(trilinear, generic, generic, 3, 0), (FetchCounts{0, 0, 0}));
    EXPECT_EQ(counted(trilinear, generic, generic, 1e9f, 1), (FetchCounts{1, 4, 4, {0, 0, 0, 0, 4}}))
        << "one level, of one texel: each tap reads it";
}

TEST_P(Sample, WithoutAlphaKeepsTheBitsOfColour) {
    std::mt19937 random(13);
    for (const Format format : {Format::RGBA8Unorm, Format::RGBA8Srgb, Format::RGBA8Snorm, Format::RGBA16Unorm, Format::RGBA32Float}) {
        Texture texture("hashed", make_hashed_pyramid(format, 64, 32));
        for (int round = 0; round < 300; ++round) {
            SamplerState sampler;
            sampler.mip = kMipModes[random() % 3];
            sampler.wrap_s = sampler.wrap_t = round % 5 == 0 ? Wrap::ClampToBorder : kWraps[random() % 3];
            sampler.magnify = kKernels[random() % 2];
            sampler.probes = round % 7 == 0 ? 8 : 1;
            WaveCoordinates at = random_coordinates(random, 64);
            // Waves of neighbours fall into windows of a few texels (texunit/texel_window-inl.h).
            for (int i = 0; round % 3 != 0 && i < kWaveLanes; ++i) {
                const float step = 0.01f * float(round % 3);
                at.u[i] = at.u[0] + step * float(i % kWaveWidth), at.v[i] = at.v[0] + step * float(i / kWaveWidth);
                at.dudx[i] = at.dvdy[i] = step, at.dudy[i] = at.dvdx[i] = 0;
            }
            WaveColor with, without;
            sample_wave(texture, sampler, at, kWaveFull, with);
            sampler.reads_alpha = false;
            sample_wave(texture, sampler, at, kWaveFull, without);
            for (int c = 0; c < 3; ++c) {
                ASSERT_EQ(std::memcmp(&without.channel[c], &with.channel[c], sizeof with.channel[c]), 0)
                    << info(format).name << " round " << round << " channel " << c;
            }
        }
    }
}

TEST_P(Sample, OfAlikeTexturesIsThatOfEachToTheBit) {
    std::mt19937 random(11);
    for (const int extent : {64, 37}) {
        // Different fields of a word, and two textures that are read again: by then their blocks are there.
        std::vector<std::unique_ptr<Texture>> together, apart;
        for (const Format format : {Format::RGBA8Unorm, Format::RGBA8Srgb, Format::RGBA8Snorm})
            for (auto* list : {&together, &apart})
                list->push_back(std::make_unique<Texture>("hashed", make_hashed_pyramid(format, extent, 32)));
        for (int round = 0; round < 300; ++round) {
            SamplerState sampler;
            sampler.mip = kMipModes[random() % 3];
            sampler.wrap_s = kWraps[random() % 3];
            sampler.wrap_t = round % 5 == 0 ? Wrap::ClampToBorder : kWraps[random() % 3];
            sampler.lod_bias = round % 7 == 0 ? 0.7f : 0.0f;
            sampler.precision = round % 3 == 0 ? Precision::Gpu : Precision::Exact;
            ASSERT_TRUE(can_sample_alike(*together[0], sampler));
            WaveCoordinates at = random_coordinates(random, extent);
            if (round % 4 == 0) at = uniform_coordinates(at.u[0], at.v[0], 0.3f, extent, 32);
            const WaveMask mask = round % 2 == 0 ? kWaveFull : uint32_t(random()) | 1u << random() % 32;
            WaveColor got[3], expected[3];
            WaveFloat lod, expected_lod;
            AlikeTextures textures;
            for (size_t k = 0; k < 3; ++k) textures.add(*together[k], got[k]);
            sample_alike_wave(textures, sampler, at, mask, round % 2 == 0 ? &lod : nullptr);
            for (size_t k = 0; k < 3; ++k) {
                sample_wave(*apart[k], sampler, at, mask, expected[k], {.lod = k == 0 && round % 2 == 0 ? &expected_lod : nullptr});
                for (int i = 0; i < kWaveLanes; ++i) {
                    if ((mask >> i & 1) == 0) continue;
                    for (int c = 0; c < 4; ++c)
                        ASSERT_EQ(got[k].channel[c][i], expected[k].channel[c][i]) << "texture " << k << ", round " << round;
                    if (k == 0 && round % 2 == 0) {
                        ASSERT_EQ(lod[i], expected_lod[i]) << "round " << round;
                    }
                }
            }
        }
    }
}

TEST_P(Sample, OfAlikeTexturesIsBilinearFlatAndOfWords) {
    Texture words("words", make_hashed_pyramid(Format::RGBA8Unorm, 8, 8)), floats("floats", make_hashed_pyramid(Format::RGBA32Float, 8, 8));
    EXPECT_TRUE(can_sample_alike(words, {}));
    EXPECT_FALSE(can_sample_alike(floats, {}));
    EXPECT_FALSE(can_sample_alike(words, {.magnify = Kernel::Nearest}));
    EXPECT_FALSE(can_sample_alike(words, {.probes = 2}));
}

}  // namespace
}  // namespace rawtexel::texunit
