// Waves whose taps fall on a few texels, as under magnification, which vectors read at once (texunit/texel_window-inl.h): the same bits
// as one lane after the other.
#include "tests/texunit/hashed_source.h"
#include "texunit/sample.h"
#include "texunit/simd.h"
#include "texunit/texture.h"

#include <gtest/gtest.h>

#include <cstring>
#include <random>

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

}  // namespace
}  // namespace rawtexel::texunit
