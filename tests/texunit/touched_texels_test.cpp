#include "texunit/sample.h"
#include "texunit/touched_lines.h"

#include "tests/texunit/hashed_source.h"

#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <random>
#include <set>

namespace rawtexel::texunit {
namespace {

using TexelPlace = std::array<int, 4>;  ///< level, slice, x, y

/// Every texel that the taps name, one by one.
class TexelSet final : public TapSink {
  public:
    void begin_lookup(const Texture&, WaveMask) override {}
    void begin_probe(const WaveFloat&) override {}
    void begin_level(const WaveFloat&, bool) override {}
    void tap(const WaveTap& tap) override {
        for (int lane = 0; lane < kWaveLanes; ++lane) {
            if (((tap.lanes & ~tap.border) >> lane & 1) == 0) continue;
            texels.insert({(*tap.level)[lane], tap.slice == nullptr ? 0 : (*tap.slice)[lane], (*tap.x)[lane], (*tap.y)[lane]});
            ++requested;
            ++by_level[size_t((*tap.level)[lane])];
        }
    }
    std::set<TexelPlace> texels;
    uint64_t requested = 0;
    std::array<uint64_t, kMaxLevels> by_level{};
};

/// The texels of a set, found again from its bits.
std::set<TexelPlace> texels_of(const Texture& texture, const TouchedTexels& touched) {
    std::set<TexelPlace> texels;
    touched.for_each_group(0, [&](int32_t first, uint32_t bits) {
        for (int i = 0; i < 32; ++i) {
            if ((bits >> i & 1) == 0) continue;
            const int32_t index = first + i;
            const BlockPosition block = locate_block(texture.levels(), texture.texel_layout().storage, index / kTexelsPerBlock);
            texels.insert({block.level, block.slice, 4 * block.x + index % 4, 4 * block.y + index / 4 % 4});
        }
    });
    return texels;
}

WaveCoordinates random_wave(std::mt19937& random, float spread, float footprint) {
    std::uniform_real_distribution<float> unit(-1, 1);
    WaveCoordinates at;
    const float u = unit(random), v = unit(random);
    for (int lane = 0; lane < kWaveLanes; ++lane) {
        at.u[lane] = u + spread * unit(random), at.v[lane] = v + spread * unit(random);
        at.dudx[lane] = footprint * unit(random), at.dvdx[lane] = footprint * unit(random);
        at.dudy[lane] = footprint * unit(random), at.dvdy[lane] = footprint * unit(random);
    }
    return at;
}

TEST(TouchedTexels, AreThoseThatTheTapsName) {
    std::mt19937 random(3);
    for (const Format format : {Format::RGBA8Unorm, Format::RGBA16Unorm, Format::RGBA16Half, Format::RGBA32Float}) {
        for (const Wrap wrap : {Wrap::Repeat, Wrap::ClampToBorder, Wrap::MirroredRepeat}) {
            for (SamplerState sampler : {SamplerState{}, SamplerState{.magnify = Kernel::Nearest, .minify = Kernel::Nearest},
                                         SamplerState{.magnify = Kernel::BSpline, .minify = Kernel::Lanczos3}, SamplerState{.probes = 8},
                                         SamplerState{.ellipse = 0.2f}}) {
                sampler.wrap_s = wrap;
                Texture texture("hashed", make_hashed_pyramid(format, 300, 90));
                TouchedTexels touched(std::array{texture.levels().texels});
                TexelSet expected;
                FetchCounts counts;
                FetchCounter counter;
                counter.counts = &counts;
                counter.touched = touched.bits(0);
                for (int n = 0; n < 12; ++n) {
                    const WaveCoordinates at = random_wave(random, 0.05f, n % 2 == 0 ? 0.001f : 0.05f);
                    const WaveMask mask = n % 3 == 0 ? 0x0F0F0001u : kWaveFull;
                    record_wave(texture, sampler, at, mask, expected);
                    count_wave(texture, sampler, at, mask, counter);
                }
                EXPECT_EQ(texels_of(texture, touched), expected.texels) << info(format).name;
                EXPECT_EQ(counts.texels_requested, expected.requested);
                EXPECT_EQ(counts.level_texels, expected.by_level);
                EXPECT_EQ(texture.work().blocks_decoded, 0u) << "who only listens reads nothing";
            }
        }
    }
}

TEST(TouchedTexels, MergeToTheirUnion) {
    const std::array<uint64_t, 3> texels = {40, 3 * TouchedBits::kTexelsPerChunk, 1};
    TouchedTexels one(texels), other(texels);
    one.bits(0).mark(3);
    one.bits(1).mark(5);
    other.bits(1).mark(6);
    other.bits(1).mark(int32_t(2 * TouchedBits::kTexelsPerChunk + 31));
    other.bits(2).mark(0);
    one.merge(other);
    std::map<std::pair<size_t, int32_t>, uint32_t> groups;
    for (size_t texture = 0; texture < 3; ++texture)
        one.for_each_group(texture, [&](int32_t first, uint32_t bits) { groups[{texture, first}] = bits; });
    const std::map<std::pair<size_t, int32_t>, uint32_t> expected = {
        {{0, 0}, 8u}, {{1, 0}, 0x60u}, {{1, int32_t(2 * TouchedBits::kTexelsPerChunk)}, 1u << 31}, {{2, 0}, 1u}};
    EXPECT_EQ(groups, expected);
}

/// Lines by definition: a set of addresses divided by the line's size.
struct SlowLines {
    std::array<std::set<uint64_t>, kLineBytes.size()> lines;
    void add(uint64_t address) {
        for (size_t size = 0; size < kLineBytes.size(); ++size) lines[size].insert(address / uint64_t(kLineBytes[size]));
    }
    LineCounts count() const { return {{lines[0].size(), lines[1].size(), lines[2].size()}}; }
};

TEST(TouchedLines, AreDistinctLinesOfEveryLayout) {
    std::mt19937 random(5);
    for (const Format format :
         {Format::RGBA8Srgb, Format::R8Unorm, Format::RGBA16Unorm, Format::RGBA32Float, Format::BC1RgbaUnorm, Format::BC7Unorm}) {
        Texture texture("hashed", make_hashed_pyramid(format, 200, 120));
        TouchedTexels touched(std::array{texture.levels().texels});
        const int bytes = bytes_per_texel(texture.texel_layout().storage), extent = info(format).block_extent;
        for (int level = 0; level < texture.shape().levels; ++level) {
            const int width = level_extent(200, level), height = level_extent(120, level);
            SlowLines own;
            std::array<SlowLines, kAddressLayouts.size()> decoded, stored;
            std::set<std::pair<int, int>> texels, blocks;
            for (int n = 0; n < 150; ++n) {
                const int x = int(random() % unsigned(width)), y = int(random() % unsigned(height));
                const int32_t index = texel_index(texture.levels(), texture.texel_layout().storage, level, 0, x, y);
                touched.bits(0).mark(index);
                texels.insert({x, y});
                blocks.insert({x / 4, y / 4});
                own.add(uint64_t(index) * uint64_t(bytes));
                for (size_t i = 0; i < kAddressLayouts.size(); ++i) {
                    decoded[i].add(SliceAddresses(kAddressLayouts[i], width, height, bytes).offset(x, y));
                    stored[i].add(SliceAddresses(kAddressLayouts[i], (width + extent - 1) / extent, (height + extent - 1) / extent,
                                                 info(format).bytes_per_block)
                                      .offset(x / extent, y / extent));
                }
            }
            const TouchedLines found = measure_touched(texture, touched, 0)[size_t(level)];
            EXPECT_EQ(found.texels_unique, texels.size());
            EXPECT_EQ(found.blocks_touched, blocks.size());
            EXPECT_EQ(found.texel_bytes, texels.size() * size_t(bytes));
            EXPECT_EQ(found.decoded, own.count()) << info(format).name << " level " << level;
            EXPECT_EQ(found.stored, stored[0].count()) << info(format).name << " level " << level;
            for (size_t i = 0; i < kAddressLayouts.size(); ++i) {
                EXPECT_EQ(found.decoded_as[i], decoded[i].count()) << info(format).name << ' ' << to_string(kAddressLayouts[i]);
                EXPECT_EQ(found.stored_as[i], stored[i].count()) << info(format).name << ' ' << to_string(kAddressLayouts[i]);
            }
        }
    }
}

}  // namespace
}  // namespace rawtexel::texunit
