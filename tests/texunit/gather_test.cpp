// Gathers and the decoding of packed texels, lane by lane, on every instruction set.
#include "texunit/format.h"
#include "texunit/simd.h"
#include "texunit/srgb.h"
#include "texunit/texel_value.h"
#include "texunit/wave.h"

#include <gtest/gtest.h>

#include <bit>
#include <random>
#include <string>
#include <vector>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/texunit/gather_test.cpp"
#include <hwy/foreach_target.h>

#include "texunit/gather-inl.h"
#include "texunit/packed_texels-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rawtexel::texunit {
namespace HWY_NAMESPACE {

template <int words>
void gather_wave(const float* base, const WaveInt& index, WaveFloat* out) {
    const FloatTag d;
    for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
        FloatVec record[words];
        gather_records<words>(base, hn::Load(IntTag(), index.lane + i), record);
        for (int k = 0; k < words; ++k) hn::Store(record[k], d, out[k].lane + i);
    }
}

void gather_records_here(int words, const float* base, const WaveInt& index, WaveFloat* out) {
    switch (words) {
        case 1: return gather_wave<1>(base, index, out);
        case 2: return gather_wave<2>(base, index, out);
        case 3: return gather_wave<3>(base, index, out);
        default: return gather_wave<4>(base, index, out);
    }
}

void decode_here(const TexelLayout& layout, const Wave<uint32_t>& word, WaveFloat* out) {
    const FloatTag d;
    with_fields(layout.fields, [&](auto constant) HWY_ATTR {
        const PackedDecoder<decltype(constant)::value> decoder(layout);
        for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
            FloatVec value[4];
            decoder.values(hn::Load(hn::RebindToUnsigned<IntTag>(), word.lane + i), value);
            for (int c = 0; c < 4; ++c) hn::Store(value[c], d, out[c].lane + i);
        }
    });
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::texunit
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rawtexel::texunit {
namespace {

HWY_EXPORT(gather_records_here);
HWY_EXPORT(decode_here);

class Gathers : public testing::TestWithParam<Simd> {
  protected:
    Gathers() { EXPECT_TRUE(choose_simd(GetParam())); }
    ~Gathers() override { choose_simd(Simd::Auto); }
};
INSTANTIATE_TEST_SUITE_P(Simd, Gathers, testing::ValuesIn(available_simd()),
                         [](const auto& set) { return std::string(to_string(set.param)); });

TEST_P(Gathers, ReadTheWordsOfEveryLanesRecordAndNoneBeyond) {
    std::mt19937 random(11);
    for (int words = 1; words <= 4; ++words) {
        // Exactly as long as its records: sanitizers see a word too many.
        std::vector<float> values(size_t(words) * 37);
        for (size_t i = 0; i < values.size(); ++i) values[i] = float(i) + 0.25f;
        for (int round = 0; round < 50; ++round) {
            WaveInt index;
            for (int lane = 0; lane < kWaveLanes; ++lane) index[lane] = round == 0 ? 36 * words : int(random() % 37) * words;
            WaveFloat out[4];
            HWY_DYNAMIC_DISPATCH(gather_records_here)(words, values.data(), index, out);
            for (int lane = 0; lane < kWaveLanes; ++lane)
                for (int k = 0; k < words; ++k) ASSERT_EQ(out[k][lane], values[size_t(index[lane] + k)]) << words << ' ' << lane;
        }
    }
}

TEST(PackedFieldsOf, FormatsAreKnownWhereTheirTexelsAreFourBytes) {
    for (const FormatInfo& about : all_formats()) {
        const bool rgba8 = about.format == Format::RGBA8Unorm || about.format == Format::BC7Unorm;
        const bool srgb8 = about.format == Format::RGBA8Srgb || about.format == Format::BC7Srgb;
        EXPECT_EQ(layout(about.format).fields, rgba8   ? PackedFields::Unorm8
                                               : srgb8 ? PackedFields::Srgb8
                                                       : PackedFields::Any)
            << about.name;
    }
}

TEST_P(Gathers, DecodeEveryCodeOfEveryChannelToTheTablesFloat) {
    const TexelLayout& srgb = layout(Format::RGBA8Srgb);
    ASSERT_EQ(srgb.fields, PackedFields::Srgb8);
    for (uint32_t code = 0; code < 256; ++code) {
        Wave<uint32_t> word;
        for (uint32_t lane = 0; lane < kWaveLanes; ++lane)
            word[int(lane)] = code | ((code * 7 + lane) & 0xFF) << 8 | ((code + lane * 37) & 0xFF) << 16 | (255 - code) << 24;
        WaveFloat out[4];
        HWY_DYNAMIC_DISPATCH(decode_here)(srgb, word, out);
        for (int lane = 0; lane < kWaveLanes; ++lane) {
            for (int c = 0; c < 3; ++c)
                ASSERT_EQ(std::bit_cast<uint32_t>(out[c][lane]), std::bit_cast<uint32_t>(srgb8_table()[word[lane] >> (8 * c) & 0xFF]));
            ASSERT_EQ(out[3][lane], float((255 - code) / 255.0));
        }
    }
}

TEST_P(Gathers, DecodeAllPackedFormatsAsTheirLayoutsSay) {
    std::mt19937 random(12);
    for (const FormatInfo& about : all_formats())
        for (const BcRounding rounding : {BcRounding::Exact, BcRounding::Ideal8}) {
            const TexelLayout& of = layout(about.format, rounding);
            if (of.storage != StorageClass::Packed32) continue;
            SCOPED_TRACE(about.name);
            for (int round = 0; round < 200; ++round) {
                Wave<uint32_t> word{};
                for (int lane = 0; lane < kWaveLanes; ++lane)
                    for (int c = 0; c < 4; ++c) {
                        // Fields that a decoder produces.
                        const auto number = uint32_t(random());
                        const uint32_t field = of.is_signed ? number : number % (uint32_t(of.denominator[c]) + 1);
                        word[lane] |= (field & of.mask[c]) << of.shift[c];
                    }
                WaveFloat out[4];
                HWY_DYNAMIC_DISPATCH(decode_here)(of, word, out);
                for (int lane = 0; lane < kWaveLanes; ++lane) {
                    const std::array<float, 4> texel = load_texel(of, reinterpret_cast<const std::byte*>(&word[lane]));
                    for (size_t c = 0; c < 4; ++c) ASSERT_EQ(out[c][lane], texel[c]) << lane << ' ' << c;
                }
            }
        }
}

}  // namespace
}  // namespace rawtexel::texunit
#endif
