// Every wrap mode, kernel, mip mode, storage class and awkward extent against the double-precision reference, on every instruction set.
#include "texunit/sample.h"

#include "texunit/simd.h"

#include "tests/reference/texunit/sampler_reference.h"
#include "tests/texunit/hashed_source.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <random>
#include <sstream>
#include <vector>

namespace rawtexel::texunit {
namespace {

using reference::Lookup;

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// Draws lookups that are hard on the arithmetic more often than not.
class LookupDraw {
  public:
    LookupDraw(int width, int height, int levels, uint32_t seed) : width_(width), height_(height), levels_(levels), random_(seed) {}

    Lookup next() {
        const float scale = level_scale();
        Lookup at{coordinate(width_), coordinate(height_), 0, 0, 0, 0};
        at.dudx = derivative(scale, width_);
        at.dvdx = derivative(scale, height_);
        at.dudy = derivative(scale, width_);
        at.dvdy = derivative(scale, height_);
        return at;
    }
    std::mt19937& bits() { return random_; }

  private:
    float uniform(float low, float high) { return std::uniform_real_distribution<float>(low, high)(random_); }
    int below(int n) { return int(random_() % uint32_t(n)); }

    float coordinate(int extent) {
        static constexpr float kAwkward[] = {0.0f,       -0.0f,       1.0f,         -1.0f,        0.5f,   -1e-9f,       1e-9f,
                                             0x1p-149f,  -0x1p-149f,  1 - 0x1p-24f, 1 + 0x1p-23f, 2.0f,   -2.0f,        1e6f,
                                             -1e6f,      1234567.5f,  -98765.25f,   3e38f,        -3e38f, kNan,         kInfinity,
                                             -kInfinity, 16777215.0f, 0.25f,        10.0f,        -10.0f, 3 - 0x1p-22f, 1e-40f};
        switch (below(8)) {
            case 0: return kAwkward[below(int(std::size(kAwkward)))];
            case 1: {
                // Beside a texel's edge or centre.
                float u = (float(below(3 * extent) - extent) + 0.5f * float(below(2))) / float(extent);
                for (int steps = below(4); steps > 0; --steps) u = std::nextafter(u, below(2) ? 4.0f : -4.0f);
                return u;
            }
            case 2: return uniform(-1000, 1000);
            default: return uniform(-2.5f, 2.5f);
        }
    }

    /// Texels a pixel.
    float level_scale() {
        switch (below(6)) {
            case 0: return std::ldexp(1.0f, below(levels_ + 2) - 1);
            case 1: return std::ldexp(1.41421356f, below(levels_ + 2) - 1);
            case 2: return 0.25f;
            default: return std::exp2(uniform(-1, float(levels_)));
        }
    }

    float derivative(float scale, int extent) {
        switch (below(40)) {
            case 0: return kNan;
            case 1: return -kInfinity;
            case 2: return below(2) ? 1e30f : 1e-30f;
            case 3: return -0.0f;
            default: break;
        }
        switch (below(4)) {
            case 0: return 0;
            case 1: return scale / float(extent);
            default: return uniform(-1, 1) * scale / float(extent);
        }
    }

    int width_, height_, levels_;
    std::mt19937 random_;
};

WaveCoordinates gather(const std::vector<Lookup>& lookups, size_t first) {
    WaveCoordinates at;
    for (int i = 0; i < kWaveLanes; ++i) {
        const Lookup& one = lookups[first + size_t(i)];
        at.u[i] = one.u, at.v[i] = one.v;
        at.dudx[i] = one.dudx, at.dvdx[i] = one.dvdx;
        at.dudy[i] = one.dudy, at.dvdy[i] = one.dvdy;
    }
    return at;
}

std::string describe(const SamplerState& sampler, const Lookup& at) {
    std::ostringstream text;
    text.precision(9);
    text << to_string(sampler.wrap_s) << ',' << to_string(sampler.wrap_t) << " magnify " << to_string(sampler.magnify) << " minify "
         << to_string(sampler.minify) << " mip " << to_string(sampler.mip) << " u " << at.u << " v " << at.v << " d/dx " << at.dudx << ','
         << at.dvdx << " d/dy " << at.dudy << ',' << at.dvdy;
    return text.str();
}

/// How far `colour` is from what the reference allows, in units of the bound: at most 1 passes.
double excess(const reference::Sample& expected, const float (&colour)[4]) {
    const double bound = (expected.taps + 8) * 0x1p-24 * expected.largest + (expected.mixes_levels ? 0x1p-20 * expected.largest : 0);
    double worst = 0;
    for (size_t c = 0; c < 4; ++c) {
        const double error = std::abs(colour[c] - expected.colour[c]);
        if (!(error <= bound)) return kInfinity;
        if (bound > 0) worst = std::max(worst, error / bound);
        if (colour[c] < expected.least[c] || colour[c] > expected.most[c]) return kInfinity;
    }
    return worst;
}

struct Tally {
    uint64_t lookups = 0, other_decisions = 0;
    double worst = 0;
    std::string worst_case;
};

/// Holds one result against the reference, and where it does not agree against the decisions next to it.
void judge(const reference::Image& image, const SamplerState& sampler, const Lookup& at, const float (&colour)[4], Tally& tally) {
    const reference::Sample expected = reference::sample(image, sampler, at);
    double unit = excess(expected, colour);
    if (unit > 1) {
        ++tally.other_decisions;
        unit = std::min(excess(reference::sample(image, sampler, at, 0x1p-20), colour),
                        excess(reference::sample(image, sampler, at, -0x1p-20), colour));
    }
    ++tally.lookups;
    if (unit > tally.worst) {
        tally.worst = unit;
        tally.worst_case = describe(sampler, at);
    }
    ASSERT_LE(unit, 1) << describe(sampler, at) << "\n lambda " << expected.lambda << " taps " << expected.taps << " expected "
                       << expected.colour[0] << ' ' << expected.colour[1] << ' ' << expected.colour[2] << ' ' << expected.colour[3]
                       << "\n found " << colour[0] << ' ' << colour[1] << ' ' << colour[2] << ' ' << colour[3] << "\n between "
                       << expected.least[0] << " and " << expected.most[0];
}

SamplerState sampler_number(uint32_t n) {
    SamplerState sampler;
    sampler.wrap_s = Wrap(n % 3), n /= 3;
    sampler.wrap_t = Wrap(n % 3), n /= 3;
    sampler.magnify = Kernel{KernelKind(n % 2)}, n /= 2;
    sampler.minify = Kernel{KernelKind(n % 2)}, n /= 2;
    sampler.mip = MipMode(n % 3);
    return sampler;
}
constexpr uint32_t kSamplers = 3 * 3 * 2 * 2 * 3;

bool same_bits(const WaveColor& a, const WaveColor& b) {
    for (int c = 0; c < 4; ++c) {
        for (int i = 0; i < kWaveLanes; ++i) {
            if (std::bit_cast<uint32_t>(a.channel[c][i]) != std::bit_cast<uint32_t>(b.channel[c][i])) return false;
        }
    }
    return true;
}

class SampleSweep : public testing::TestWithParam<std::tuple<Format, std::pair<int, int>>> {
  protected:
    ~SampleSweep() override { choose_simd(Simd::Auto); }
};

TEST_P(SampleSweep, AgreesWithTheReferenceAndBetweenInstructionSets) {
    const auto& [format, extents] = GetParam();
    const auto [width, height] = extents;
    Texture texture("hashed", make_hashed_pyramid(format, width, height));
    const int levels = texture.shape().levels;
    const reference::Image image{width, height, levels, [&](int level, int x, int y) {
                                     const std::array<float, 4> value = texture.texel(level, 0, x, y);
                                     return reference::Colour{value[0], value[1], value[2], value[3]};
                                 }};
    LookupDraw draw(width, height, levels, uint32_t(width * 31 + height) + uint32_t(format));
    Tally tally;
    for (uint32_t n = 0; n < kSamplers; ++n) {
        const SamplerState sampler = sampler_number(n);
        std::vector<Lookup> lookups;
        for (int i = 0; i < kWaveLanes; ++i) lookups.push_back(draw.next());
        const WaveCoordinates at = gather(lookups, 0);

        ASSERT_TRUE(choose_simd(Simd::Scalar));
        WaveColor colour;
        sample_wave(texture, sampler, at, kWaveFull, colour);
        for (int i = 0; i < kWaveLanes; ++i) {
            const float lane[4] = {colour.channel[0][i], colour.channel[1][i], colour.channel[2][i], colour.channel[3][i]};
            judge(image, sampler, lookups[size_t(i)], lane, tally);
            if (HasFatalFailure()) return;
        }
        for (const Simd simd : available_simd()) {
            choose_simd(simd);
            WaveColor other;
            sample_wave(texture, sampler, at, kWaveFull, other);
            ASSERT_TRUE(same_bits(colour, other)) << to_string(simd) << " differs from scalar: " << describe(sampler, lookups[0]);
        }
    }
    // These lookups sit on thresholds on purpose; on random ones the next test allows one in 10^5.
    RecordProperty("other_decisions", int(tally.other_decisions));
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

TEST(SampleDecisions, DifferFromTheReferenceInAtMostOneOf100000RandomLookups) {
    constexpr int kWidth = 16384, kHeight = 3000;
    Texture texture("hashed", make_hashed_pyramid(Format::RGBA8Unorm, kWidth, kHeight));
    const reference::Image image{kWidth, kHeight, texture.shape().levels, [&](int level, int x, int y) {
                                     const std::array<float, 4> value = texture.texel(level, 0, x, y);
                                     return reference::Colour{value[0], value[1], value[2], value[3]};
                                 }};
    std::mt19937 random(7);
    std::uniform_real_distribution<float> coordinate(-2, 2), log_scale(-1, 13), unit(-1, 1);
    Tally tally;
    for (int wave = 0; wave < 8000; ++wave) {
        const SamplerState sampler = sampler_number(uint32_t(random() % kSamplers));
        std::vector<Lookup> lookups;
        for (int i = 0; i < kWaveLanes; ++i) {
            const float scale = std::exp2(log_scale(random));
            lookups.push_back({coordinate(random), coordinate(random), unit(random) * scale / kWidth, unit(random) * scale / kHeight,
                               unit(random) * scale / kWidth, unit(random) * scale / kHeight});
        }
        WaveColor colour;
        sample_wave(texture, sampler, gather(lookups, 0), kWaveFull, colour);
        for (int i = 0; i < kWaveLanes; ++i) {
            const float lane[4] = {colour.channel[0][i], colour.channel[1][i], colour.channel[2][i], colour.channel[3][i]};
            judge(image, sampler, lookups[size_t(i)], lane, tally);
            if (HasFatalFailure()) return;
        }
    }
    EXPECT_LE(tally.other_decisions * 100000, tally.lookups) << tally.other_decisions << " of " << tally.lookups;
    RecordProperty("worst_in_bounds", std::to_string(tally.worst));
}

}  // namespace
}  // namespace rawtexel::texunit
