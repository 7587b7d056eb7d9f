// Anisotropic lookups against the mean of their probes in double precision, on every instruction set.
#include "texunit/footprint.h"
#include "texunit/memory_source.h"
#include "texunit/probe_table.h"
#include "texunit/sample.h"
#include "texunit/simd.h"

#include "tests/reference/texunit/footprint_reference.h"
#include "tests/stress/worst_case.h"
#include "tests/stress_scale.h"
#include "tests/texunit/hashed_source.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>

namespace rawtexel::texunit {
namespace {

using reference::Lookup;

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

Lookup lookup_of(const WaveCoordinates& at, int i) { return {at.u[i], at.v[i], at.dudx[i], at.dvdx[i], at.dudy[i], at.dvdy[i]}; }

WaveCoordinates random_footprints(std::mt19937& random, int width, int height, double largest_ratio) {
    std::uniform_real_distribution<double> unit(0, 1);
    WaveCoordinates at;
    for (int i = 0; i < kWaveLanes; ++i) {
        const double minor = std::exp2(unit(random) * 6 - 2), major = minor * std::pow(largest_ratio, unit(random));
        const double turn = unit(random) * 6.3, c = std::cos(turn), s = std::sin(turn);
        at.u[i] = float(unit(random) * 3 - 1), at.v[i] = float(unit(random) * 3 - 1);
        at.dudx[i] = float(c * major / width), at.dvdx[i] = float(s * major / height);
        at.dudy[i] = float(-s * minor / width), at.dvdy[i] = float(c * minor / height);
    }
    return at;
}

class Probes : public testing::TestWithParam<Simd> {
  protected:
    Probes() { EXPECT_TRUE(choose_simd(GetParam())); }
    ~Probes() override { choose_simd(Simd::Auto); }
};
INSTANTIATE_TEST_SUITE_P(AllSets, Probes, testing::ValuesIn(available_simd()),
                         [](const auto& parameters) { return std::string(to_string(parameters.param)); });

float in_period(Wrap wrap, float u) {
    if (wrap == Wrap::Repeat) return u - std::trunc(u);
    if (wrap == Wrap::MirroredRepeat) return std::fmod(u, 2.0f);
    return u;
}

/// The weighted mean of the probes that measure_footprint names, each a trilinear lookup of the level it names. `rounded`: probes lie at
/// float coordinates.
reference::Sample mean_of_probes(const reference::Image& image, const SamplerState& sampler, const WaveCoordinates& at,
                                 const WaveFootprint& footprint, int i, bool rounded) {
    const ProbeTable& table = sampler.probe_variance > 0 ? gaussian_probes() : uniform_probes();
    const auto moved = [&](Wrap wrap, float coordinate, float place, float axis) {
        const float start = in_period(wrap, coordinate);
        return rounded ? double(std::fma(place, axis, start)) : double(place) * double(axis) + double(start);
    };
    reference::Sample mean;
    for (int n = 0; n < footprint.probes[i]; ++n) {
        const auto place = size_t(kMostProbes * footprint.probes[i] + n);
        const double u = moved(sampler.wrap_s, at.u[i], table.place[place], footprint.axis_u[i]);
        const double v = moved(sampler.wrap_t, at.v[i], table.place[place], footprint.axis_v[i]);
        const reference::Sample probe = reference::linear_sample(image, sampler, u, v, footprint.lod[i]);
        mean.taps += probe.taps;
        mean.largest = std::max(mean.largest, probe.largest);
        for (size_t c = 0; c < 4; ++c) {
            mean.colour[c] += double(table.weight[place]) * probe.colour[c];
            mean.least[c] = n == 0 ? probe.least[c] : std::min(mean.least[c], probe.least[c]);
            mean.most[c] = n == 0 ? probe.most[c] : std::max(mean.most[c], probe.most[c]);
        }
    }
    return mean;
}

/// Packed formats at extents of powers of two take the fast way (texunit/packed_probes-inl.h), whose positions are not rounded to floats.
TEST_P(Probes, GiveTheWeightedMeanOfTheirLookups) {
    std::mt19937 random(11);
    struct Case {
        Format format;
        int width, height;
    };
    double worst = 0;
    for (const Case& one : {Case{Format::RGBA8Unorm, 256, 64},
                            {Format::RGBA8Unorm, 4096, 1024},
                            {Format::RGBA8Unorm, 100, 37},
                            {Format::RGBA8Srgb, 256, 64},
                            {Format::RGBA8Snorm, 16, 512},
                            {Format::RG8Unorm, 64, 64},
                            {Format::R16Unorm, 64, 64},
                            {Format::RGBA16Unorm, 256, 64},
                            {Format::RGBA16Half, 256, 64},
                            {Format::RGBA32Float, 256, 64}}) {
        Texture texture("hashed", make_hashed_pyramid(one.format, one.width, one.height));
        const reference::Image image{one.width, one.height, texture.shape().levels, [&](int level, int x, int y) {
                                         const std::array<float, 4> value = texture.texel(level, 0, x, y);
                                         return reference::Colour{value[0], value[1], value[2], value[3]};
                                     }};
        for (int n = 0; n < 60; ++n) {
            const SamplerState sampler{.wrap_s = Wrap(n % 3),
                                       .wrap_t = Wrap(n / 3 % 3),
                                       .mip = n % 7 == 0 ? MipMode::Nearest : MipMode::Linear,
                                       .probes = std::array{2, 7, 16, 64}[size_t(n % 4)],
                                       .probe_variance = n % 5 == 0 ? 1.0f / 6 : 0.0f,
                                       .lod_rule = n % 2 ? LodRule::Exact : LodRule::D3d};
            const bool packed = texture.texel_layout().storage == StorageClass::Packed32;
            const bool by_mask = one.width != 100 || (sampler.wrap_s == Wrap::ClampToEdge && sampler.wrap_t == Wrap::ClampToEdge);
            const WaveCoordinates at = random_footprints(random, one.width, one.height, 80);
            WaveFootprint footprint;
            measure_footprint(texture.levels(), sampler, at, footprint);
            WaveColor colour, uncounted;
            FetchCounts counts;
            sample_wave(texture, sampler, at, kWaveFull, colour, &counts);
            sample_wave(texture, sampler, at, kWaveFull, uncounted);
            uint64_t taps = 0;
            for (int i = 0; i < kWaveLanes; ++i) {
                const reference::Sample expected = mean_of_probes(image, sampler, at, footprint, i, !(packed && by_mask));
                taps += uint64_t(expected.taps);
                const double bound = ((expected.taps + 8) * 0x1p-24 + 0x1p-20) * expected.largest;
                for (size_t c = 0; c < 4; ++c) {
                    const double error = std::abs(colour.channel[c][i] - expected.colour[c]);
                    worst = std::max(worst, error / bound);
                    ASSERT_LE(error, bound) << info(one.format).name << ' ' << one.width << " sampler " << n << " lane " << i << " probes "
                                            << footprint.probes[i] << " level " << footprint.lod[i];
                    ASSERT_TRUE(colour.channel[c][i] >= expected.least[c] && colour.channel[c][i] <= expected.most[c])
                        << info(one.format).name << " sampler " << n << " lane " << i << " channel " << c << ": " << colour.channel[c][i];
                    ASSERT_EQ(colour.channel[c][i], uncounted.channel[c][i]) << "counting changes nothing";
                }
            }
            EXPECT_EQ(counts.lookups, 32u);
            EXPECT_NEAR(double(counts.taps), double(taps), 0.001 * double(taps)) << "sampler " << n;
        }
    }
    RecordProperty("worst_in_bounds", std::to_string(worst));
}

/// A lazily decoded texture: the quick look at rectangles of blocks must not let a probe read what is not there.
TEST_P(Probes, ReadNothingThatIsNotDecoded) {
    std::mt19937 random(17);
    for (int n = 0; n < 40; ++n) {
        Texture lazy("lazy", make_hashed_pyramid(Format::RGBA8Unorm, 256, 128)),
            whole("whole", make_hashed_pyramid(Format::RGBA8Unorm, 256, 128));
        for (int level = 0; level < whole.shape().levels; ++level) {
            for (int y = 0; y < level_extent(128, level); y += 4) {
                for (int x = 0; x < level_extent(256, level); x += 4) whole.ensure(level, 0, x, y);
            }
        }
        ASSERT_TRUE(whole.complete());
        const SamplerState sampler{.wrap_s = Wrap(n % 3), .wrap_t = Wrap(n / 3 % 3), .probes = 16, .probe_variance = n % 2 ? 0.2f : 0.0f};
        for (int wave = 0; wave < 20; ++wave) {
            // Neighbouring waves, so that some of their blocks are there and others not.
            WaveCoordinates at = random_footprints(random, 256, 128, 20);
            for (int i = 0; i < kWaveLanes; ++i) {
                at.u[i] = 0.4f + 0.01f * float(wave + i % 8), at.v[i] = 0.9f + 0.01f * float(i / 8);
                if (wave % 2) {
                    for (WaveFloat* derivative : {&at.dudx, &at.dvdx, &at.dudy, &at.dvdy}) (*derivative)[i] = (*derivative)[0];
                }
            }
            WaveColor found, expected;
            sample_wave(lazy, sampler, at, kWaveFull, found);
            sample_wave(whole, sampler, at, kWaveFull, expected);
            ASSERT_EQ(std::memcmp(&found, &expected, sizeof(found)), 0) << n << " wave " << wave;
        }
    }
}

TEST_P(Probes, OfEveryNumberLeaveConstantsBitEqual) {
    const std::array<uint16_t, 4> halves = {0x3555, 0x0001, 0xC911, 0x7BFF};
    std::vector<std::byte> half_texels(8 * 8 * sizeof(halves)), byte_texels(8 * 8 * 4);
    for (size_t i = 0; i < 64; ++i) std::memcpy(half_texels.data() + i * sizeof(halves), halves.data(), sizeof(halves));
    for (size_t i = 0; i < byte_texels.size(); ++i) byte_texels[i] = std::byte(i % 4 * 61 + 7);
    std::array<std::unique_ptr<Texture>, 2> textures = {
        std::make_unique<Texture>("half", make_memory_source(Format::RGBA16Half, 8, 8, half_texels)),
        std::make_unique<Texture>("byte", make_memory_source(Format::RGBA8Unorm, 8, 8, byte_texels))};
    for (const std::unique_ptr<Texture>& texture : textures) {
        const std::array<float, 4> expected = texture->texel(0, 0, 0, 0);
        for (int probes = 1; probes <= kMostProbes; ++probes) {
            for (const float variance : {0.0f, 0.2f}) {
                WaveCoordinates at{};
                for (int i = 0; i < kWaveLanes; ++i) {
                    at.u[i] = 0.07f * float(i), at.v[i] = 0.3f;
                    at.dudx[i] = float(probes - 0.5) * 0.16f, at.dvdy[i] = 0.16f;
                }
                WaveColor colour;
                sample_wave(*texture, {.probes = kMostProbes, .probe_variance = variance, .max_lod = 2}, at, kWaveFull, colour);
                for (size_t c = 0; c < 4; ++c) {
                    for (int i = 0; i < kWaveLanes; ++i) {
                        ASSERT_EQ(std::bit_cast<uint32_t>(colour.channel[c][i]), std::bit_cast<uint32_t>(expected[c]))
                            << probes << " probes, channel " << c << " lane " << i;
                    }
                }
            }
        }
    }
}

TEST_P(Probes, GiveTheSameBitsAsScalarWhateverTheMask) {
    Texture texture("hashed", make_hashed_pyramid(Format::RGBA8Unorm, 90, 41));
    std::mt19937 random(12);
    for (int n = 0; n < 60; ++n) {
        const SamplerState sampler{.wrap_s = Wrap(n % 5),
                                   .wrap_t = Wrap(n / 5 % 5),
                                   .probes = 16,
                                   .probe_variance = n % 3 == 0 ? 0.25f : 0.0f,
                                   .lod_rule = n % 2 ? LodRule::Exact : LodRule::D3d,
                                   .precision = n % 7 == 0 ? Precision::Gpu : Precision::Exact,
                                   .border = {1, 0, 2, -1}};
        const WaveCoordinates at = random_footprints(random, 90, 41, 40);
        const WaveMask mask = n % 4 == 0 ? kWaveFull : WaveMask(random()) | 4u;
        WaveColor found, whole;
        choose_simd(GetParam());
        sample_wave(texture, sampler, at, mask, found);
        choose_simd(Simd::Scalar);
        sample_wave(texture, sampler, at, kWaveFull, whole);
        for (int c = 0; c < 4; ++c) {
            for (int i = 0; i < kWaveLanes; ++i) {
                if ((mask >> i & 1) == 0) continue;
                ASSERT_EQ(std::bit_cast<uint32_t>(found.channel[c][i]), std::bit_cast<uint32_t>(whole.channel[c][i])) << n << " lane " << i;
            }
        }
    }
}

TEST_P(Probes, SurviveFootprintsWithoutExtentOrWithoutEnd) {
    uint64_t lookups = 0, most_taps = 0;
    for (const auto& [width, height] : {std::pair{64, 32}, {1, 64}, {64, 1}, {1, 1}}) {
        Texture texture("hashed", make_hashed_pyramid(Format::RGBA8Unorm, width, height));
        const float values[] = {0.0f, -0.0f, 1e-40f, 1e-30f, 0.01f, 1.0f, 1e30f, 3e38f, kInfinity, kNan};
        std::mt19937 random(13);
        for (int n = 0; n < 200 * stress_scale(); ++n) {
            WaveCoordinates at;
            for (WaveFloat* wave : {&at.u, &at.v, &at.dudx, &at.dvdx, &at.dudy, &at.dvdy}) {
                for (int i = 0; i < kWaveLanes; ++i) (*wave)[i] = values[random() % std::size(values)] * (random() % 2 ? -1.0f : 1.0f);
            }
            const SamplerState sampler{.wrap_s = Wrap(n % 5),
                                       .wrap_t = Wrap(n / 5 % 5),
                                       .probes = 64,
                                       .probe_variance = n % 2 ? 1.0f / 6 : 0.0f,
                                       .lod_rule = n & 2 ? LodRule::Exact : LodRule::D3d};
            WaveColor colour;
            FetchCounts counts;
            sample_wave(texture, sampler, at, kWaveFull, colour, &counts);
            EXPECT_LE(counts.taps, uint64_t{32} * 64 * 8);
            most_taps = std::max(most_taps, counts.taps);
            lookups += kWaveLanes;
            for (int c = 0; c < 4; ++c) {
                for (int i = 0; i < kWaveLanes; ++i) {
                    const Lookup one = lookup_of(at, i);
                    ASSERT_TRUE(colour.channel[c][i] >= 0 && colour.channel[c][i] <= 1)
                        << "u " << one.u << " v " << one.v << " d/dx " << one.dudx << ',' << one.dvdx << " d/dy " << one.dudy << ','
                        << one.dvdy;
                }
            }
        }
    }
    tell_tested(lookups, "lookups");
    tell_worst_case("most_taps_of_32_lookups", most_taps);
    tell_worst_case("not_finite_or_out_of_range", 0);
}

/// Sums what the taps say the lookup is.
class TapSum final : public TapSink {
  public:
    void begin_lookup(const Texture& texture, WaveMask) override {
        texture_ = const_cast<Texture*>(&texture);
        for (int i = 0; i < kWaveLanes; ++i) probe_[i] = level_[i] = 1;
    }
    void begin_probe(const WaveFloat& weight) override { probe_ = weight; }
    void begin_level(const WaveFloat& fraction, bool coarser) override {
        for (int i = 0; i < kWaveLanes; ++i) level_[i] = coarser ? fraction[i] : 1 - fraction[i];
    }
    void tap(const WaveTap& tap) override {
        for (int i = 0; i < kWaveLanes; ++i) {
            if ((tap.lanes >> i & 1) == 0) continue;
            const double weight = double((*tap.weight)[i]) * double(level_[i]) * double(probe_[i]);
            total[size_t(i)] += weight;
            const int slice = tap.slice == nullptr ? 0 : (*tap.slice)[i];
            red[size_t(i)] += weight * double(texture_->texel((*tap.level)[i], slice, (*tap.x)[i], (*tap.y)[i])[0]);
        }
    }
    std::array<double, kWaveLanes> total{}, red{};

  private:
    Texture* texture_ = nullptr;
    WaveFloat probe_, level_;
};

TEST_P(Probes, AndEllipsesTellASinkTheTapsThatMakeTheResult) {
    Texture texture("hashed", make_hashed_pyramid(Format::RGBA8Unorm, 64, 64));
    std::mt19937 random(14);
    const WaveCoordinates at = random_footprints(random, 64, 64, 20);
    for (const SamplerState& sampler :
         {SamplerState{.probes = 16}, SamplerState{.probes = 16, .probe_variance = 0.2f}, SamplerState{.ellipse = 0.2f}}) {
        TapSum sum;
        WaveColor colour, plain;
        sample_wave(texture, sampler, at, kWaveFull, colour, LookupExtras{.sink = &sum});
        sample_wave(texture, sampler, at, kWaveFull, plain);
        for (int i = 0; i < kWaveLanes; ++i) {
            EXPECT_NEAR(sum.total[size_t(i)], 1, 1e-5) << i;
            EXPECT_NEAR(sum.red[size_t(i)], colour.channel[0][i], 1e-5) << i;
            EXPECT_EQ(colour.channel[0][i], plain.channel[0][i]) << i;
        }
    }
}

}  // namespace
}  // namespace rawtexel::texunit
