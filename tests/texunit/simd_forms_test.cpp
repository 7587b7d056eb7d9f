// Pieces of vector code that the product never calls alone, on every instruction set: arithmetic, random numbers, per-lane counters.
#include "texunit/random.h"
#include "texunit/sample.h"
#include "texunit/simd.h"

#include "tests/texunit/hashed_source.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/texunit/simd_forms_test.cpp"
#include <hwy/foreach_target.h>

#include "texunit/math-inl.h"
#include "texunit/random-inl.h"
#include "texunit/sample-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rawtexel::texunit {
namespace HWY_NAMESPACE {

void fused(const WaveFloat& a, const WaveFloat& b, const WaveFloat& c, WaveFloat& out) {
    const FloatTag d;
    for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
        hn::Store(fused_multiply_add(hn::Load(d, a.lane + i), hn::Load(d, b.lane + i), hn::Load(d, c.lane + i)), d, out.lane + i);
    }
}

void mixed(const WaveFloat& t, const WaveFloat& a, const WaveFloat& b, WaveFloat& out) {
    const FloatTag d;
    for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
        hn::Store(lerp(hn::Load(d, t.lane + i), hn::Load(d, a.lane + i), hn::Load(d, b.lane + i)), d, out.lane + i);
    }
}

void logarithm(const WaveFloat& x, WaveInt& integer, WaveFloat& fraction) {
    const FloatTag d;
    const IntTag di;
    for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
        hn::Vec<IntTag> whole;
        hn::Vec<FloatTag> part;
        split_log2(hn::Load(d, x.lane + i), whole, part);
        hn::Store(whole, di, integer.lane + i);
        hn::Store(part, d, fraction.lane + i);
    }
}

void numbers(const RandomAddress& first, WaveFloat& wave, Wave<uint32_t>& bits) {
    const hn::ScalableTag<uint32_t> d;
    const uint32_t state = random_state(first.seed, first.sample, first.surface, first.dimension);
    random_wave(state, first.x, first.y, wave);
    for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d))
        hn::Store(random_bits_v(state, columns_v(d, first.x, i), rows_v(d, first.y, i)), d, bits.lane + i);
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::texunit
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rawtexel::texunit {
namespace {

HWY_EXPORT(fused);
HWY_EXPORT(mixed);
HWY_EXPORT(logarithm);
HWY_EXPORT(numbers);

class SimdForms : public testing::TestWithParam<Simd> {
  protected:
    SimdForms() { EXPECT_TRUE(choose_simd(GetParam())); }
    ~SimdForms() override { choose_simd(Simd::Auto); }

    /// Any finite float, subnormals included; near 1 half of the time, where sums cancel.
    float any_float() {
        const auto bits = uint32_t(random_());
        const float value = std::bit_cast<float>(bits);
        if (random_() % 2 == 0) return std::bit_cast<float>((bits & 0x80FFFFFFu) | 0x3F000000u);
        return std::isfinite(value) ? value : 0.75f;
    }
    float unit() { return float(random_() >> 8) * 0x1p-24f; }

    std::mt19937 random_{1};
};
INSTANTIATE_TEST_SUITE_P(AllSets, SimdForms, testing::ValuesIn(available_simd()),
                         [](const auto& parameters) { return std::string(to_string(parameters.param)); });

TEST_P(SimdForms, FusedMultiplyAddRoundsOnce) {
    for (int n = 0; n < 20000; ++n) {
        WaveFloat a, b, c, out;
        for (int i = 0; i < kWaveLanes; ++i) {
            a[i] = any_float(), b[i] = any_float(), c[i] = any_float();
            // Sums that cancel to the last bits, and ties.
            if (i % 4 == 0) c[i] = -a[i] * b[i];
            if (i % 4 == 1) c[i] = std::ldexp(a[i] * b[i], int(random_() % 60) - 30);
            if (!std::isfinite(c[i])) c[i] = 1;
        }
        HWY_DYNAMIC_DISPATCH(fused)(a, b, c, out);
        for (int i = 0; i < kWaveLanes; ++i) {
            const float expected = std::fma(a[i], b[i], c[i]);
            ASSERT_EQ(std::bit_cast<uint32_t>(out[i]), std::bit_cast<uint32_t>(expected))
                << std::hexfloat << a[i] << " * " << b[i] << " + " << c[i] << " = " << expected << ", found " << out[i];
        }
    }
}

TEST_P(SimdForms, LerpKeepsConstantsAndStaysBetweenItsEnds) {
    for (int n = 0; n < 20000; ++n) {
        WaveFloat t, a, b, out;
        for (int i = 0; i < kWaveLanes; ++i) {
            t[i] = i == 0 ? 0.0f : i == 1 ? 1.0f : unit();
            a[i] = unit() - (i % 2 == 0 ? 0.0f : 0.5f);
            b[i] = i % 3 == 0 ? a[i] : i % 3 == 1 ? std::nextafter(a[i], 2.0f) : unit();
        }
        HWY_DYNAMIC_DISPATCH(mixed)(t, a, b, out);
        EXPECT_EQ(out[0], a[0]);
        EXPECT_EQ(out[1], b[1]);
        for (int i = 0; i < kWaveLanes; ++i) {
            ASSERT_GE(out[i], std::min(a[i], b[i])) << std::hexfloat << a[i] << ' ' << b[i] << " at " << t[i];
            ASSERT_LE(out[i], std::max(a[i], b[i])) << std::hexfloat << a[i] << ' ' << b[i] << " at " << t[i];
        }
    }
}

TEST_P(SimdForms, Log2IsGoodTo23Bits) {
    double worst = 0;
    float worst_at = 0;
    for (int n = 0; n < 40000; ++n) {
        WaveFloat x, fraction;
        WaveInt integer;
        for (int i = 0; i < kWaveLanes; ++i) {
            // Across the mantissa, and close to 1 and sqrt(2), where the pieces of the approximation meet.
            const float mantissa = i < 24 ? 1 + unit() : i < 28 ? 1 + unit() * 0x1p-16f : 1.41421356f + (unit() - 0.5f) * 0x1p-16f;
            x[i] = std::ldexp(mantissa, int(random_() % 252) - 126);
        }
        HWY_DYNAMIC_DISPATCH(logarithm)(x, integer, fraction);
        for (int i = 0; i < kWaveLanes; ++i) {
            const double error = std::abs(integer[i] + double(fraction[i]) - std::log2(double(x[i])));
            ASSERT_GE(fraction[i], 0) << x[i];
            ASSERT_LE(fraction[i], 1) << x[i];
            if (error > worst) worst = error, worst_at = x[i];
        }
    }
    EXPECT_LT(worst, 0x1p-23) << "at " << std::hexfloat << worst_at;
    WaveFloat powers, fraction;
    WaveInt integer;
    for (int i = 0; i < kWaveLanes; ++i) powers[i] = std::ldexp(1.0f, 4 * i - 64);
    HWY_DYNAMIC_DISPATCH(logarithm)(powers, integer, fraction);
    for (int i = 0; i < kWaveLanes; ++i) {
        EXPECT_EQ(integer[i], 4 * i - 64);
        EXPECT_EQ(fraction[i], 0) << "powers of two are exact";
    }
}

TEST_P(SimdForms, RandomNumbersAreTheScalarOnes) {
    for (uint32_t n = 0; n < 200; ++n) {
        const RandomAddress first{.x = uint32_t(random_()),
                                  .y = uint32_t(random_()),
                                  .sample = uint32_t(random_()),
                                  .surface = uint32_t(random_()) % 5,
                                  .dimension = Dimension(n % 12),
                                  .seed = n};
        Wave<uint32_t> bits;
        WaveFloat wave;
        HWY_DYNAMIC_DISPATCH(numbers)(first, wave, bits);
        for (int i = 0; i < kWaveLanes; ++i) {
            RandomAddress address = first;
            address.x += uint32_t(i % kWaveWidth), address.y += uint32_t(i / kWaveWidth);
            ASSERT_EQ(bits[i], random_bits(address));
            ASSERT_EQ(wave[i], random_float(address));
        }
    }
}

TEST_P(SimdForms, PixelCountsSumToTheTexturesCounts) {
    Texture texture("hashed", make_hashed_pyramid(Format::RGBA8Unorm, 64, 64));
    WaveCoordinates at{};
    for (int i = 0; i < kWaveLanes; ++i) {
        at.u[i] = unit(), at.v[i] = unit();
        at.dudx[i] = unit() / 8;
    }
    // Lane 3 magnifies on a texel's centre, lane 4 between levels at a generic place, lane 5 is off.
    at.u[3] = at.v[3] = 2.5f / 64, at.dudx[3] = 0;
    at.dudx[4] = 3.0f / 64;
    const WaveMask mask = ~(1u << 5);
    FetchCounts counts;
    Wave<uint32_t> pixel{};
    pixel[4] = 100;
    FetchCounter count;
    count.counts = &counts;
    count.pixel = &pixel;
    WaveFloat lod;
    count_wave(texture, SamplerState{}, at, mask, count, &lod);
    EXPECT_EQ(pixel[3], 1u);
    EXPECT_EQ(pixel[4], 108u);
    EXPECT_EQ(pixel[5], 0u);
    uint64_t sum = 0;
    for (int i = 0; i < kWaveLanes; ++i) sum += pixel[i];
    EXPECT_EQ(counts.texels_requested, sum - 100);
    EXPECT_EQ(counts.taps, counts.texels_requested);
    EXPECT_EQ(counts.lookups, 31u);
    EXPECT_EQ(lod[3], 0);
    EXPECT_NEAR(lod[4], std::log2(3.0), 0x1p-21);
}

}  // namespace
}  // namespace rawtexel::texunit
#endif
