#include "texunit/bc7.h"

#include "tests/reference/texunit/bc_bc7.h"
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

using reference::Bc7Fields;
using reference::Block16;

std::string print(const Block16& block) {
    std::ostringstream text;
    text << std::hex << std::setfill('0');
    for (const std::byte b : block) text << std::setw(2) << int(b);
    return text.str();
}

template <class Random>
void randomise(Bc7Fields& f, Random& random) {
    const reference::Bc7Mode& m = reference::bc7_mode(f.mode);
    const auto bits = [&](int count) { return int(random() & ((uint64_t{1} << count) - 1)); };
    for (int subset = 0; subset < m.ns; ++subset) {
        for (int end = 0; end < 2; ++end) {
            for (int channel = 0; channel < 4; ++channel) f.code[subset][end][channel] = bits(channel < 3 ? m.cb : m.ab);
            f.p_bit[subset][end] = bits(end == 0 ? m.epb + m.spb : m.epb);
        }
    }
    for (int i = 0; i < 16; ++i) {
        f.index[i] = bits(m.ib - (reference::bc7_is_anchor(f, i) ? 1 : 0));
        f.second_index[i] = m.ib2 == 0 ? 0 : bits(m.ib2 - (i == 0 ? 1 : 0));
    }
}

using Texels = std::array<std::array<uint8_t, 4>, 16>;

Texels decode(const Block16& block) {
    Texels texels;
    decode_bc7(block.data(), reinterpret_cast<std::byte*>(texels.data()));
    return texels;
}

void expect_equal(const Bc7Fields& fields) {
    const Block16 block = reference::build_bc7(fields);
    const Texels expected = reference::evaluate_bc7(fields);
    on_every_simd([&] {
        const Texels texels = decode(block);
        if (texels == expected) return;
        for (size_t texel = 0; texel < 16; ++texel) {
            ASSERT_EQ(texels[texel], expected[texel])
                << "mode " << fields.mode << " partition " << fields.partition << " rotation " << fields.rotation << " selection "
                << fields.selection << " texel " << texel << " block " << print(block);
        }
    });
}

class Bc7Modes : public testing::TestWithParam<int> {};

TEST_P(Bc7Modes, EqualTheReferenceInEveryPartitionRotationAndIndexSelection) {
    const reference::Bc7Mode& m = reference::bc7_mode(GetParam());
    const int kinds = 1 << (m.pb + m.rb + m.isb);
    const int blocks_each = (100000 + kinds - 1) / kinds;
    std::mt19937_64 random(uint64_t(GetParam()) + 10);
    for (int kind = 0; kind < kinds; ++kind) {
        for (int i = 0; i < blocks_each; ++i) {
            Bc7Fields fields{.mode = GetParam()};
            fields.partition = kind & ((1 << m.pb) - 1);
            fields.rotation = (kind >> m.pb) & ((1 << m.rb) - 1);
            fields.selection = kind >> (m.pb + m.rb);
            randomise(fields, random);
            expect_equal(fields);
            if (HasFatalFailure()) return;
        }
    }
}

TEST_P(Bc7Modes, EqualTheReferenceAtTheExtremesOfEveryField) {
    std::mt19937_64 random(uint64_t(GetParam()) + 20);
    const reference::Bc7Mode& m = reference::bc7_mode(GetParam());
    for (int i = 0; i < 20000 && !HasFatalFailure(); ++i) {
        Bc7Fields fields{.mode = GetParam()};
        fields.partition = int(random() & ((1u << m.pb) - 1));
        fields.rotation = int(random() & ((1u << m.rb) - 1));
        fields.selection = int(random() & ((1u << m.isb) - 1));
        // Draws whose bits are all equal: fields of all zeros or all ones.
        auto extreme = [&] { return (random() >> 63) ? ~uint64_t{0} : uint64_t{0}; };
        randomise(fields, extreme);
        expect_equal(fields);
    }
}

TEST_P(Bc7Modes, SurviveBuildingAndTakingApart) {
    // The reference's own two directions, and so that every one of the 128 bits has a field.
    std::mt19937_64 random(uint64_t(GetParam()) + 30);
    for (int i = 0; i < 2000; ++i) {
        Block16 block;
        const uint64_t bits[2] = {random(), random()};
        std::memcpy(block.data(), bits, 16);
        block[0] = (block[0] & ~std::byte((2 << GetParam()) - 1)) | std::byte(1 << GetParam());
        const Bc7Fields fields = reference::take_apart_bc7(block);
        ASSERT_EQ(fields.mode, GetParam());
        ASSERT_EQ(print(reference::build_bc7(fields)), print(block));
    }
}

INSTANTIATE_TEST_SUITE_P(All, Bc7Modes, testing::Range(0, 8));

TEST(Bc7, ReservedModeIsZeroWhateverFollows) {
    std::mt19937_64 random(5);
    for (int i = 0; i < 1000; ++i) {
        Block16 block;
        const uint64_t bits[2] = {random() & ~uint64_t{0xFF}, random()};
        std::memcpy(block.data(), bits, 16);
        on_every_simd([&] { ASSERT_EQ(decode(block), Texels{}) << print(block); });
    }
}

TEST(Bc7, ReadsBlocksAtAnyAddress) {
    const Block16 block = reference::build_bc7({.mode = 6, .code = {{{1, 2, 3, 4}, {120, 100, 80, 60}}}});
    std::array<std::byte, 17> storage;
    std::memcpy(storage.data() + 1, block.data(), 16);
    Texels shifted;
    decode_bc7(storage.data() + 1, reinterpret_cast<std::byte*>(shifted.data()));
    EXPECT_EQ(shifted, decode(block));
}

}  // namespace
}  // namespace rawtexel::texunit
