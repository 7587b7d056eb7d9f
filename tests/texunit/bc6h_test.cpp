#include "texunit/bc6h.h"

#include "tests/reference/texunit/bc_bc6h.h"
#include "tests/texunit/every_simd.h"

#include <gtest/gtest.h>

#include <array>
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

}  // namespace
}  // namespace rawtexel::texunit
