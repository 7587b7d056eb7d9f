#include "texunit/bc6h.h"

#include "texunit/sample.h"

#include "tests/stress/worst_case.h"
#include "tests/stress_scale.h"
#include "tests/reference/texunit/bc_bc6h.h"
#include "tests/texunit/every_simd.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <iomanip>
#include <random>
#include <sstream>
#include <string>

namespace rawtexel::texunit {
namespace {

using reference::Bc6hBlockFields;
using reference::Block16;

constexpr uint16_t kHalfOne = 0x3C00;

std::string print(const Block16& block) {
    std::ostringstream text;
    text << std::hex << std::setfill('0');
    for (const std::byte b : block) text << std::setw(2) << int(b);
    return text.str();
}

using Halves = std::array<std::array<uint16_t, 4>, 16>;

Halves decode(const Block16& block, bool is_signed) {
    Halves texels;
    (is_signed ? decode_bc6h_sfloat : decode_bc6h_ufloat)(block.data(), reinterpret_cast<std::byte*>(texels.data()));
    return texels;
}

void expect_equal(const Bc6hBlockFields& fields, const Block16& block, bool is_signed) {
    const auto colours = reference::evaluate_bc6h(fields, is_signed);
    Halves expected;
    for (size_t texel = 0; texel < 16; ++texel) expected[texel] = {colours[texel][0], colours[texel][1], colours[texel][2], kHalfOne};
    on_every_simd([&] {
        const Halves texels = decode(block, is_signed);
        if (texels == expected) return;
        for (size_t texel = 0; texel < 16; ++texel) {
            ASSERT_EQ(texels[texel], expected[texel]) << (is_signed ? "signed" : "unsigned") << " mode " << fields.mode << " partition "
                                                      << fields.partition << " texel " << texel << " block " << print(block);
        }
    });
}

void expect_equal(const Bc6hBlockFields& fields) {
    const Block16 block = reference::build_bc6h(fields);
    expect_equal(fields, block, false);
    expect_equal(fields, block, true);
}

template <class Random>
Bc6hBlockFields random_fields(int mode, int partition, Random& random) {
    const reference::Bc6hModeWidths& m = reference::bc6h_mode(mode);
    const auto bits = [&](int count) { return int(random() & ((uint64_t{1} << count) - 1)); };
    Bc6hBlockFields f{.mode = mode, .partition = partition};
    for (int endpoint = 0; endpoint < 2 * m.subsets; ++endpoint) {
        for (int c = 0; c < 3; ++c) f.code[endpoint][c] = bits(endpoint == 0 ? m.endpoint_bits : m.delta_bits[c]);
    }
    for (int i = 0; i < 16; ++i) f.index[i] = bits((m.subsets == 2 ? 3 : 4) - (reference::bc6h_is_anchor(f, i) ? 1 : 0));
    return f;
}

class Bc6hModes : public testing::TestWithParam<int> {
  protected:
    int mode() const { return GetParam(); }
    int partitions() const { return reference::bc6h_mode(mode()).subsets == 2 ? 32 : 1; }
};

TEST_P(Bc6hModes, EqualTheReferenceInEveryPartition) {
    std::mt19937_64 random(uint64_t(mode()) + 100);
    for (int partition = 0; partition < partitions(); ++partition) {
        for (int i = 0; i < 100000 / partitions(); ++i) {
            expect_equal(random_fields(mode(), partition, random));
            if (HasFatalFailure()) return;
        }
    }
}

TEST_P(Bc6hModes, EqualTheReferenceWhereFieldsAreExtremeAndDifferencesWrap) {
    std::mt19937_64 random(uint64_t(mode()) + 200);
    const auto extreme = [&]() -> uint64_t {
        switch (random() % 5) {
            case 0: return 0;
            case 1: return ~uint64_t{0};
            case 2: return 1;
            case 3: return ~uint64_t{1};
            default: return uint64_t{1} << (random() % 16);
        }
    };
    for (int i = 0; i < 10000 && !HasFatalFailure(); ++i) {
        expect_equal(random_fields(mode(), int(random() % uint64_t(partitions())), extreme));
    }
}

TEST_P(Bc6hModes, SurviveBuildingAndTakingApart) {
    std::mt19937_64 random(uint64_t(mode()) + 300);
    const int code = reference::bc6h_mode(mode()).code;
    for (int i = 0; i < 1000; ++i) {
        Block16 block;
        const uint64_t bits[2] = {random(), random()};
        std::memcpy(block.data(), bits, 16);
        block[0] = (block[0] & ~std::byte(code < 2 ? 3 : 31)) | std::byte(code);
        const Bc6hBlockFields fields = reference::take_apart_bc6h(block);
        ASSERT_EQ(fields.mode, mode());
        ASSERT_EQ(print(reference::build_bc6h(fields)), print(block));
    }
}

INSTANTIATE_TEST_SUITE_P(All, Bc6hModes, testing::Range(0, reference::kBc6hModeCount));

TEST(Bc6h, ReservedModesAreOpaqueBlackWhateverFollows) {
    std::mt19937_64 random(6);
    for (const int code : {19, 23, 27, 31}) {
        for (int i = 0; i < 500; ++i) {
            Block16 block;
            const uint64_t bits[2] = {(random() & ~uint64_t{31}) | uint64_t(code), random()};
            std::memcpy(block.data(), bits, 16);
            for (const bool is_signed : {false, true}) {
                for (const auto& texel : decode(block, is_signed))
                    ASSERT_EQ(texel, (std::array<uint16_t, 4>{0, 0, 0, kHalfOne})) << print(block);
            }
        }
    }
}

TEST(Bc6h, LargestUnsignedValueIsTheLargestHalf) {
    Bc6hBlockFields fields{.mode = 10};
    for (auto& endpoint : fields.code) std::fill(std::begin(endpoint), std::end(endpoint), 1023);
    EXPECT_EQ(decode(reference::build_bc6h(fields), false)[0][0], 0x7BFF);
}

TEST(Bc6h, SignedValuesReachMinusInfinityAndNeverMinusZero) {
    Bc6hBlockFields fields{.mode = 13};
    fields.code[0][0] = 0x8000;  // -32768 in the mode of 16-bit endpoints
    fields.code[0][1] = 0xFFFF;  // -1, whose magnitude rounds to zero
    const Halves texels = decode(reference::build_bc6h(fields), true);
    EXPECT_EQ(texels[0][0], 0xFC00);
    EXPECT_EQ(texels[0][1], 0x0000);
}

/// A texture of signed BC6H, black but for one block, of which one texel is minus infinity and the others are finite.
class OneInfiniteTexel final : public TexelSource {
  public:
    static constexpr int kExtent = 16;

    OneInfiniteTexel() {
        Bc6hBlockFields fields{.mode = 13};
        fields.code[0][0] = 0x8000;  // -32768 scales to the bits of minus infinity,
        fields.code[1][0] = 7;       // -32768 + 7 to those of -65498
        std::fill(std::begin(fields.index), std::end(fields.index), 7);
        fields.index[5] = 0;
        block_ = reference::build_bc6h(fields);
    }
    Format format() const override { return Format::BC6HSfloat; }
    Shape shape() const override { return {.width = kExtent, .height = kExtent}; }
    uint64_t stored_bytes() const override { return 256; }
    void decode_block(int, int, int block_x, int block_y, std::byte* texels) override {
        decode_bc6h_sfloat((block_x == 1 && block_y == 2 ? block_ : Block16{}).data(), texels);
    }

  private:
    Block16 block_;
};

TEST(Bc6h, MinusInfinityIsSeenWhereItWeighsAndNowhereElse) {
    std::vector<SamplerState> samplers = {
        {.mip = MipMode::None}, {}, {.probes = 16}, {.probes = 16, .probe_variance = 0.25f}, {.ellipse = 0.25f}};
    for (const Kernel kernel : {Kernel::Nearest, Kernel::Quadratic, Kernel::BSpline, Kernel::mitchell(), Kernel::CatmullRom,
                                Kernel::Lanczos3, Kernel::gaussian()}) {
        samplers.push_back({.magnify = kernel, .minify = kernel, .mip = MipMode::None});
    }
    uint64_t lookups = 0;
    on_every_simd([&] {
        std::mt19937 random(7);
        std::uniform_real_distribution<float> unit(0, 1);
        for (const SamplerState& sampler : samplers) {
            Texture texture("infinite", std::make_unique<OneInfiniteTexel>());
            int finite = 0, infinite = 0;
            for (int n = 0; n < 200 * stress_scale(); ++n) {
                WaveCoordinates at;
                for (int i = 0; i < kWaveLanes; ++i) {
                    // Some lookups at texel centres, where neighbours weigh nothing.
                    const auto place = [&] { return n % 2 ? unit(random) : (float(random() % 16) + 0.5f) / 16; };
                    at.u[i] = place(), at.v[i] = place();
                    at.dudx[i] = 0.3f * unit(random), at.dvdx[i] = 0.1f * unit(random);
                    at.dudy[i] = -0.02f * unit(random), at.dvdy[i] = 0.06f * unit(random);
                }
                WaveColor colour;
                sample_wave(texture, sampler, at, kWaveFull, colour);
                for (int i = 0; i < kWaveLanes; ++i) {
                    const float red = colour.channel[0][i];
                    ASSERT_FALSE(std::isnan(red)) << to_string(sampler.magnify) << " at " << at.u[i] << ", " << at.v[i];
                    ++(std::isinf(red) ? infinite : finite);
                }
                lookups += kWaveLanes;
            }
            EXPECT_GT(finite, 0) << to_string(sampler.magnify);
            EXPECT_GT(infinite, 0) << to_string(sampler.magnify);
        }
    });
    tell_tested(lookups, "lookups");
    tell_worst_case("numbers_that_are_none", 0);
}

}  // namespace
}  // namespace rawtexel::texunit
