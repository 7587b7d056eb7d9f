// Waves whose taps fall on a few texels, as under magnification, which vectors read at once (texunit/texel_window-inl.h): the same bits
// as one lane after the other.
#include "tests/texunit/hashed_source.h"
#include "texunit/sample.h"
#include "texunit/simd.h"
#include "texunit/texture.h"

#include <gtest/gtest.h>

#include <cstring>
#include <random>
#include <utility>

namespace rawtexel::texunit {
namespace {

/// A wave of neighbouring pixels, `texels` of the texture apart, anywhere in and around it; its edges are met often.
WaveCoordinates magnified_wave(std::mt19937& random, float texels, int extent) {
    std::uniform_real_distribution<float> around(-1.5f, 2.5f), turn(0.0f, 6.3f);
    const float step = texels / float(extent), angle = turn(random);
    const auto at_edge = [&](float place) { return random() % 3 == 0 ? std::round(place) : place; };
    const float u = at_edge(around(random)), v = at_edge(around(random)), cosine = step * std::cos(angle), sine = step * std::sin(angle);
    WaveCoordinates at{};
    for (int lane = 0; lane < kWaveLanes; ++lane) {
        const auto x = float(lane % kWaveWidth), y = float(lane / kWaveWidth);
        at.u[lane] = u + cosine * x - sine * y;
        at.v[lane] = v + sine * x + cosine * y;
        at.dudx[lane] = cosine, at.dvdx[lane] = sine, at.dudy[lane] = -sine, at.dvdy[lane] = cosine;
    }
    return at;
}

TEST(TexelWindow, GivesTheBitsOfOneLaneAfterTheOther) {
    std::mt19937 random(12);
    int waves = 0;
    for (const Format format : {Format::RGBA8Unorm, Format::RGBA8Srgb, Format::RG8Snorm, Format::R8Unorm, Format::RGBA16Unorm}) {
        const auto texture = std::make_unique<Texture>("hashed", make_hashed_pyramid(format, 64, 24));
        for (const Kernel& kernel :
             {Kernel::Nearest, Kernel::Bilinear, Kernel::Quadratic, Kernel::BSpline, Kernel::CatmullRom, Kernel::Lanczos3}) {
            for (const Wrap wrap : {Wrap::Repeat, Wrap::MirroredRepeat, Wrap::ClampToEdge, Wrap::ClampToBorder, Wrap::MirrorOnce}) {
                for (const float texels : {0.01f, 0.1f, 0.3f, 0.6f, 1.1f}) {
                    const SamplerState sampler{wrap, wrap, kernel, kernel, MipMode::Linear};
                    const WaveCoordinates at = magnified_wave(random, texels, 64);
                    const WaveMask mask = random() % 4 == 0 ? WaveMask(random() | 1u) : kWaveFull;
                    WaveColor scalar{};
                    ASSERT_TRUE(choose_simd(Simd::Scalar));
                    sample_wave(*texture, sampler, at, mask, scalar);
                    for (const Simd set : available_simd()) {
                        WaveColor colour{};
                        ASSERT_TRUE(choose_simd(set));
                        sample_wave(*texture, sampler, at, mask, colour);
                        for (int lane = 0; lane < kWaveLanes; ++lane) {
                            if ((mask >> lane & 1) == 0) continue;
                            for (int c = 0; c < 4; ++c)
                                ASSERT_EQ(colour.channel[c][lane], scalar.channel[c][lane])
                                    << to_string(set) << ' ' << to_string(kernel) << " wrap " << int(wrap) << " format " << int(format)
                                    << ", pixels " << texels << " texels apart, lane " << lane << " channel " << c;
                        }
                        ++waves;
                    }
                    choose_simd(Simd::Auto);
                }
            }
        }
    }
    std::printf("%d waves\n", waves);
}

/// A wave of pixels along the axes, `across` and `down` texels apart, whose first one is at texel (x, y).
WaveCoordinates aimed_wave(float x, float y, float across, float down, int extent) {
    WaveCoordinates at{};
    const float texel = 1.0f / float(extent);
    for (int lane = 0; lane < kWaveLanes; ++lane) {
        at.u[lane] = (x + across * float(lane % kWaveWidth)) * texel;
        at.v[lane] = (y + down * float(lane / kWaveWidth)) * texel;
        at.dudx[lane] = across * texel, at.dvdy[lane] = down * texel;
    }
    return at;
}

// Windows of every shape at every phase of the blocks, each of a texture that nobody has read yet: what is not made is seen.
TEST(TexelWindow, MakesTheBlocksThatItReads) {
    int waves = 0;
    for (const Format format : {Format::RGBA8Srgb, Format::BC1RgbUnorm}) {
        for (const Kernel& kernel : {Kernel::Bilinear, Kernel::BSpline}) {
            for (int phase = 0; phase < 16; ++phase) {
                // Up to 4x4, 8x2, 16x1, 8x4, 16x2 and more texels.
                for (const auto& [across, down] :
                     {std::pair(0.2f, 0.2f), {0.7f, 0.1f}, {1.6f, 0.0f}, {0.7f, 0.6f}, {1.6f, 0.2f}, {0.9f, 0.9f}}) {
                    const SamplerState sampler{Wrap::Repeat, Wrap::Repeat, kernel, kernel, MipMode::None};
                    const WaveCoordinates at = aimed_wave(17.6f + float(phase % 4), 21.6f + float(phase / 4), across, down, 64);
                    WaveColor scalar{};
                    for (const Simd set : available_simd()) {
                        const auto texture = std::make_unique<Texture>("hashed", make_hashed_pyramid(format, 64, 64));
                        WaveColor first{}, again{};
                        ASSERT_TRUE(choose_simd(set));
                        sample_wave(*texture, sampler, at, kWaveFull, first);
                        if (set == available_simd().front()) scalar = first;
                        // Once the level is there, windows may be larger.
                        texture->make_level(0);
                        sample_wave(*texture, sampler, at, kWaveFull, again);
                        for (int lane = 0; lane < kWaveLanes; ++lane)
                            for (int c = 0; c < 4; ++c) {
                                ASSERT_EQ(first.channel[c][lane], scalar.channel[c][lane])
                                    << to_string(set) << ' ' << to_string(kernel) << ' ' << across << " x " << down << ", phase " << phase;
                                ASSERT_EQ(again.channel[c][lane], scalar.channel[c][lane])
                                    << to_string(set) << ' ' << to_string(kernel) << ' ' << across << " x " << down << ", phase " << phase;
                            }
                        ++waves;
                    }
                    choose_simd(Simd::Auto);
                }
            }
        }
    }
    std::printf("%d waves\n", waves);
}

}  // namespace
}  // namespace rawtexel::texunit
