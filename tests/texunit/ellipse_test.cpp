// The exact elliptical filter against nested quadrature in double, on every instruction set.
#include "texunit/ellipse.h"

#include "texunit/memory_source.h"
#include "texunit/sample.h"
#include "texunit/simd.h"

#include "tests/reference/texunit/footprint_reference.h"
#include "tests/stress/worst_case.h"
#include "tests/texunit/hashed_source.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <sstream>

namespace rawtexel::texunit {
namespace {

using reference::Lookup;

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

WaveCoordinates gather(const std::vector<Lookup>& lookups) {
    WaveCoordinates at;
    for (int i = 0; i < kWaveLanes; ++i) {
        const Lookup& one = lookups[size_t(i) % lookups.size()];
        at.u[i] = one.u, at.v[i] = one.v;
        at.dudx[i] = one.dudx, at.dvdx[i] = one.dvdx;
        at.dudy[i] = one.dudy, at.dvdy[i] = one.dvdy;
    }
    return at;
}

Lookup ellipse_lookup(int width, int height, float u, float v, double major, double minor, double turn, double screen) {
    const double c = std::cos(turn), s = std::sin(turn), cx = std::cos(screen), sx = std::sin(screen);
    return {u,
            v,
            float((c * major * cx - s * minor * sx) / width),
            float((s * major * cx + c * minor * sx) / height),
            float((-c * major * sx - s * minor * cx) / width),
            float((-s * major * sx + c * minor * cx) / height)};
}

std::string describe(const Lookup& at) {
    std::ostringstream text;
    text.precision(9);
    text << "u " << at.u << " v " << at.v << " d/dx " << at.dudx << ',' << at.dvdx << " d/dy " << at.dudy << ',' << at.dvdy;
    return text.str();
}

reference::Image image_of(Texture& texture) {
    return {texture.shape().width, texture.shape().height, texture.shape().levels, [&texture](int level, int x, int y) {
                const std::array<float, 4> value = texture.texel(level, 0, x, y);
                return reference::Colour{value[0], value[1], value[2], value[3]};
            }};
}

class EllipticalFilter : public testing::TestWithParam<Simd> {
  protected:
    EllipticalFilter() { EXPECT_TRUE(choose_simd(GetParam())); }
    ~EllipticalFilter() override { choose_simd(Simd::Auto); }
};
INSTANTIATE_TEST_SUITE_P(AllSets, EllipticalFilter, testing::ValuesIn(available_simd()),
                         [](const auto& parameters) { return std::string(to_string(parameters.param)); });

TEST_P(EllipticalFilter, AgreesWithNestedQuadrature) {
    constexpr int kExtent = 64;
    for (const Format format : {Format::RGBA8Unorm, Format::RGBA16Unorm, Format::RGBA32Float}) {
        Texture texture("hashed", make_hashed_pyramid(format, kExtent, kExtent));
        const reference::Image image = image_of(texture);
        std::mt19937 random(5);
        std::uniform_real_distribution<double> unit(0, 1);
        double worst = 0;
        for (int n = 0; n < 6; ++n) {
            const float s2 = std::array{1.0f / 12, 1.0f / 6, 1.0f / 4, 1.0f / 3, 0.5f, 1.0f}[size_t(n)];
            std::vector<Lookup> lookups;
            for (int i = 0; i < kWaveLanes; ++i) {
                const double minor = std::exp2(unit(random) * 6 - 4), ratio = i < 2 ? 1 : std::exp2(unit(random) * 6);
                lookups.push_back(ellipse_lookup(kExtent, kExtent, float(unit(random)), float(unit(random)), minor * ratio, minor,
                                                 i == 2 ? 0 : unit(random) * 6.3, unit(random) * 6.3));
            }
            WaveColor colour;
            FetchCounts counts;
            sample_wave(texture, {.ellipse = s2}, gather(lookups), kWaveFull, colour, &counts);
            uint64_t taps = 0;
            for (int i = 0; i < kWaveLanes; ++i) {
                const auto weights = reference::ellipse_weights(image, double(s2), lookups[size_t(i)]);
                taps += weights.size();
                for (int c = 0; c < 4; ++c) {
                    double expected = 0, largest = 0;
                    for (const reference::WeighedTexel& texel : weights) {
                        const auto wrap = [](long long index) { return int(((index % kExtent) + kExtent) % kExtent); };
                        const double value = image.texel(0, wrap(texel.x), wrap(texel.y))[size_t(c)];
                        expected += texel.weight * value;
                        largest = std::max(largest, std::abs(value));
                    }
                    const double bound = (double(weights.size()) + 8) * 0x1p-24 * largest;
                    const double error = std::abs(colour.channel[c][i] - expected);
                    worst = std::max(worst, error / bound);
                    ASSERT_LE(error, bound) << info(format).name << " S2 " << s2 << ' ' << describe(lookups[size_t(i)]) << " taps "
                                            << weights.size() << " expected " << expected << " found " << colour.channel[c][i];
                }
            }
            // A texel whose corner grazes the cut may fall on either side of it in float.
            EXPECT_NEAR(double(counts.taps), double(taps), 2 + 1e-4 * double(taps)) << s2;
            EXPECT_EQ(counts.taps, counts.texels_requested);
            EXPECT_EQ(counts.lookups, 32u);
        }
        tell_worst_case("worst_in_bounds_" + std::string(info(format).name), worst);
    }
}

TEST_P(EllipticalFilter, GivesTheSameBitsAsScalar) {
    Texture texture("hashed", make_hashed_pyramid(Format::RGBA8Srgb, 100, 37));
    std::mt19937 random(6);
    std::uniform_real_distribution<double> unit(0, 1);
    for (int n = 0; n < 20; ++n) {
        std::vector<Lookup> lookups;
        for (int i = 0; i < kWaveLanes; ++i) {
            const double minor = std::exp2(unit(random) * 5 - 2);
            lookups.push_back(ellipse_lookup(100, 37, float(unit(random)), float(unit(random)), minor * std::exp2(unit(random) * 4), minor,
                                             unit(random) * 6.3, unit(random) * 6.3));
        }
        const SamplerState sampler{.wrap_s = Wrap(n % 5), .wrap_t = Wrap(n / 5 % 5), .ellipse = 0.2f, .border = {0.5f, 2, -1, 0}};
        const WaveMask mask = n % 2 ? kWaveFull : 0x5A5A00F1u;
        WaveColor found, scalar;
        choose_simd(GetParam());
        sample_wave(texture, sampler, gather(lookups), mask, found);
        choose_simd(Simd::Scalar);
        sample_wave(texture, sampler, gather(lookups), mask, scalar);
        ASSERT_EQ(std::memcmp(&found, &scalar, sizeof(found)), 0) << n;
    }
}

TEST_P(EllipticalFilter, LeavesConstantsBitEqualAndStaysWithinItsTexels) {
    std::vector<std::byte> texels(16 * 16 * 4, std::byte(77));
    Texture constant("constant", make_memory_source(Format::RGBA8Srgb, 16, 16, texels));
    Texture hashed("hashed", make_hashed_pyramid(Format::RGBA8Unorm, 16, 16));
    const std::array<float, 4> expected = constant.texel(0, 0, 0, 0);
    std::vector<Lookup> lookups;
    for (int i = 0; i < kWaveLanes; ++i)
        lookups.push_back(ellipse_lookup(16, 16, 0.03f * float(i), 0.9f, 0.1 * (i + 1) * (i + 1), 0.7, i * 0.3, i));
    WaveColor colour;
    sample_wave(constant, {.ellipse = 1.0f / 6}, gather(lookups), kWaveFull, colour);
    for (int i = 0; i < kWaveLanes; ++i) {
        for (int c = 0; c < 4; ++c)
            ASSERT_EQ(std::bit_cast<uint32_t>(colour.channel[c][i]), std::bit_cast<uint32_t>(expected[size_t(c)])) << i;
    }
    sample_wave(hashed, {.ellipse = 1.0f / 6}, gather(lookups), kWaveFull, colour);
    for (int i = 0; i < kWaveLanes; ++i) {
        for (int c = 0; c < 4; ++c) ASSERT_TRUE(colour.channel[c][i] >= 0 && colour.channel[c][i] <= 1) << colour.channel[c][i];
    }
}

TEST_P(EllipticalFilter, HandlesFootprintsWithoutExtentOrWithoutEnd) {
    uint64_t most_taps = 0;
    for (const auto& [width, height] : {std::pair{64, 32}, {1, 64}, {64, 1}, {1, 1}, {7, 3}}) {
        Texture texture("hashed", make_hashed_pyramid(Format::RGBA8Unorm, width, height));
        std::vector<Lookup> lookups;
        for (const float a : {0.0f, 0.01f, 1.0f, 1e5f, 1e30f, 3e38f, kInfinity, kNan, 1e-40f}) {
            lookups.push_back({0.3f, 0.6f, a, 0, 0, a});
            lookups.push_back({0.3f, 0.6f, a, a, 0, 0});
            lookups.push_back({0.3f, 0.6f, a, a, a, -a});
        }
        lookups.push_back({kNan, kInfinity, 0.01f, 0, 0, 0.01f});
        lookups.push_back({1e30f, -1e30f, 0.01f, 0, 0, 0.01f});
        for (const Wrap wrap : {Wrap::Repeat, Wrap::MirroredRepeat, Wrap::ClampToEdge, Wrap::ClampToBorder, Wrap::MirrorOnce}) {
            WaveColor colour;
            FetchCounts counts;
            sample_wave(texture, {.wrap_s = wrap, .wrap_t = wrap, .ellipse = 1.0f / 6}, gather(lookups), kWaveFull, colour, &counts);
            EXPECT_LE(counts.taps, uint64_t(kWaveLanes) * uint64_t(kMostEllipseTexels) * 5 / 4);
            most_taps = std::max(most_taps, counts.taps);
            for (int i = 0; i < kWaveLanes; ++i) {
                for (int c = 0; c < 4; ++c) {
                    ASSERT_TRUE(colour.channel[c][i] >= 0 && colour.channel[c][i] <= 1)
                        << describe(lookups[size_t(i) % lookups.size()]) << ": " << colour.channel[c][i];
                }
            }
        }
    }
    tell_worst_case("most_taps_of_32_lookups", most_taps);
}

TEST_P(EllipticalFilter, CrossesFromMinificationToMagnificationWithoutAStep) {
    Texture texture("hashed", make_hashed_pyramid(Format::RGBA8Unorm, 64, 64));
    float before = 0, largest_step = 0, total = 0;
    for (int step = 0; step <= 2000; ++step) {
        const double length = std::exp2(2 - step * 0.005);
        WaveColor colour;
        sample_wave(texture, {.ellipse = 1.0f / 6}, gather({ellipse_lookup(64, 64, 0.415f, 0.33f, length, length, 0, 0)}), 1, colour);
        const float now = colour.channel[0][0];
        if (step > 0) largest_step = std::max(largest_step, std::abs(now - before)), total += std::abs(now - before);
        before = now;
    }
    EXPECT_LT(largest_step, 0.002f) << "of a path " << total << " long";
    tell_worst_case("largest_step", largest_step);
}

TEST(EllipseGeometry, TakesTheFinestLevelThatStaysBelowItsTexels) {
    LevelTable table;
    ASSERT_TRUE(lay_out_levels({.width = 4096, .height = 4096, .levels = 13}, StorageClass::Packed32, table));
    const auto ellipse = [&](double major, double minor) {
        const Lookup at = ellipse_lookup(4096, 4096, 0.5f, 0.5f, major, minor, 0.4, 0);
        return make_ellipse(table, {.ellipse = 1.0f / 6}, {at.u, at.v, at.dudx, at.dvdx, at.dudy, at.dvdy});
    };
    const auto texels = [](const Ellipse& e) {
        int64_t count = 0;
        for (int row = e.first_row; row <= e.last_row; ++row) {
            const EllipseSpan span = ellipse_span(e, row);
            count += std::max(0, span.last - span.first + 1);
        }
        return count;
    };
    EXPECT_EQ(ellipse(512, 8).level, 0);
    EXPECT_EQ(ellipse(100, 100).level, 0);
    for (const auto& [major, minor] : {std::pair{300.0, 300.0}, {4000.0, 30.0}, {1e5, 1.0}, {1e4, 1e4}, {1e7, 1e7}}) {
        const Ellipse e = ellipse(major, minor);
        EXPECT_GT(e.level, 0) << major;
        EXPECT_LE(texels(e), kMostEllipseTexels * 11 / 10) << major << " x " << minor << " level " << e.level;
        if (e.level < 12) {
            EXPECT_GE(texels(e), kMostEllipseTexels / 8) << major << " x " << minor << " level " << e.level;
        }
    }
}

TEST(EllipseGeometry, WalksWrappedIndicesAsTheSpecificationSays) {
    for (const int extent : {1, 2, 5}) {
        for (const Wrap wrap : {Wrap::Repeat, Wrap::MirroredRepeat, Wrap::ClampToEdge, Wrap::ClampToBorder, Wrap::MirrorOnce}) {
            for (int start = -23; start < 23; ++start) {
                WrapWalk walk(wrap, start, extent);
                for (int i = start; i < start + 30; ++i, walk.next()) {
                    // Vulkan "Wrapping Operation".
                    const auto mod = [](int a, int n) { return ((a % n) + n) % n; };
                    const int fold = mod(i, 2 * extent) - extent;
                    int expected = 0;
                    if (wrap == Wrap::Repeat) expected = mod(i, extent);
                    if (wrap == Wrap::MirroredRepeat) expected = extent - 1 - (fold >= 0 ? fold : -(1 + fold));
                    if (wrap == Wrap::ClampToEdge) expected = std::clamp(i, 0, extent - 1);
                    if (wrap == Wrap::ClampToBorder) expected = i < 0 || i >= extent ? -1 : i;
                    if (wrap == Wrap::MirrorOnce) expected = std::clamp(i >= 0 ? i : -(1 + i), 0, extent - 1);
                    ASSERT_EQ(walk.texel(), expected) << to_string(wrap) << " index " << i << " extent " << extent;
                }
            }
        }
    }
}

}  // namespace
}  // namespace rawtexel::texunit
