// Streams of texel reads: their addresses, who touched first, which core's cache they meet.
#include "texunit/fetch_replay.h"

#include "texunit/fetch_stream.h"
#include "texunit/fetch_trace.h"
#include "texunit/sample.h"
#include "texunit/touched_lines.h"

#include "tests/texunit/hashed_source.h"

#include <gtest/gtest.h>
#include <zstd.h>

#include <array>
#include <cstring>
#include <memory>
#include <random>
#include <set>
#include <tuple>
#include <vector>

namespace rawtexel::texunit {
namespace {

class FetchReplays : public testing::Test {
  protected:
    FetchReplays() {
        for (const Format format :
             {Format::RGBA8Unorm, Format::BC7Unorm, Format::RGBA16Half, Format::R8Unorm, Format::BC1RgbUnorm, Format::RGBA32Float}) {
            owned.push_back(std::make_unique<Texture>("hashed", make_hashed_pyramid(format, 150, 70)));
            textures.push_back(owned.back().get());
        }
    }
    TexelFetch fetch(uint32_t texture, int level, int x, int y) const {
        const Texture& one = *textures[texture];
        return {texture, level, texel_index(one.levels(), one.texel_layout().storage, level, 0, x, y)};
    }
    std::vector<std::unique_ptr<Texture>> owned;
    std::vector<const Texture*> textures;
};

TEST_F(FetchReplays, FindTexelsWhereTheyAreAndNoTwoUnitsAtOnePlace) {
    const TexelAddresses addresses(textures);
    std::set<uint64_t> decoded, stored;
    size_t texels = 0, units = 0;
    for (uint32_t t = 0; t < textures.size(); ++t) {
        const int extent = info(textures[t]->format()).block_extent, bytes = info(textures[t]->format()).bytes_per_block;
        for (int level = 0; level < textures[t]->shape().levels; ++level) {
            const int width = level_extent(150, level), height = level_extent(70, level), columns = (width + extent - 1) / extent;
            units += size_t(columns) * size_t((height + extent - 1) / extent);
            for (int y = 0; y < height; ++y) {
                for (int x = 0; x < width; ++x, ++texels) {
                    const TexelFetch one = fetch(t, level, x, y);
                    const TexelAddresses::Position at = addresses.position(one);
                    ASSERT_EQ(one.texture(), t);
                    ASSERT_EQ(one.level(), level);
                    ASSERT_EQ(at.x, x);
                    ASSERT_EQ(at.y, y);
                    ASSERT_TRUE(decoded.insert(addresses.decoded(one)).second);
                    stored.insert(addresses.stored(one));
                    // Blocks, or texels, row after row.
                    ASSERT_EQ(addresses.stored(one) - addresses.stored(fetch(t, level, 0, 0)),
                              uint64_t(y / extent * columns + x / extent) * uint64_t(bytes));
                }
            }
        }
    }
    EXPECT_EQ(decoded.size(), texels);
    EXPECT_EQ(stored.size(), units);
    EXPECT_LT(*decoded.rbegin(), addresses.decoded_bytes());
}

/// Layers and depth slices, of every level, have places of their own, in memory and in traces.
TEST(SlicedFetches, FindTexelsOfEverySliceWhereTheyAre) {
    const std::array shapes = {Shape{.width = 12, .height = 5, .layers = 3, .levels = 3},
                               Shape{.width = 8, .height = 8, .depth = 8, .levels = 4},
                               Shape{.width = 4, .height = 4, .layers = 12, .levels = 2, .cube = true}};
    std::vector<std::unique_ptr<Texture>> owned;
    std::vector<const Texture*> textures;
    for (const Shape& shape : shapes) {
        for (const Format format : {Format::RGBA8Unorm, Format::BC7Unorm}) {
            owned.push_back(std::make_unique<Texture>("hashed", std::make_unique<HashedSource>(format, shape)));
            textures.push_back(owned.back().get());
        }
    }
    const TexelAddresses addresses(textures);
    FetchStream stream;
    std::set<std::tuple<uint32_t, int, int, int, int>> units;
    std::set<uint64_t> decoded, stored;
    std::vector<int> slices;
    for (uint32_t t = 0; t < textures.size(); ++t) {
        const Shape& shape = textures[t]->shape();
        const int unit = info(textures[t]->format()).block_extent;
        for (int level = 0; level < shape.levels; ++level) {
            for (int slice = 0; slice < slice_count(shape, level); ++slice) {
                for (int y = 0; y < level_extent(shape.height, level); ++y) {
                    for (int x = 0; x < level_extent(shape.width, level); ++x) {
                        const TexelFetch one(t, level,
                                             texel_index(textures[t]->levels(), textures[t]->texel_layout().storage, level, slice, x, y));
                        ASSERT_EQ(addresses.position(one).slice, slice);
                        EXPECT_TRUE(decoded.insert(addresses.decoded(one)).second);
                        stored.insert(addresses.stored(one));
                        units.insert({t, level, slice, x / unit, y / unit});
                        stream.fetches.push_back(one);
                        slices.push_back(slice);
                    }
                }
            }
        }
    }
    EXPECT_EQ(stored.size(), units.size());

    stream.pixels.push_back({7, 9, 0, uint32_t(stream.fetches.size())});
    std::vector<std::byte> file;
    FetchTraceWriter writer([&](std::span<const std::byte> bytes) { file.insert(file.end(), bytes.begin(), bytes.end()); });
    writer.begin(textures);
    writer.add(stream, addresses);
    writer.end();
    std::vector<std::byte> plain(file.size() + (size_t{1} << 20));
    const size_t size = ZSTD_decompress(plain.data(), plain.size(), file.data(), file.size());
    ASSERT_FALSE(ZSTD_isError(size));
    ASSERT_GE(size, stream.fetches.size() * sizeof(TraceRecord));
    const std::byte* at = plain.data() + size - stream.fetches.size() * sizeof(TraceRecord);
    for (size_t i = 0; i < slices.size(); ++i, at += sizeof(TraceRecord)) {
        TraceRecord record;
        std::memcpy(&record, at, sizeof(record));
        ASSERT_EQ(record.z, slices[i]);
        ASSERT_EQ(record.stored, addresses.stored(stream.fetches[i]));
        ASSERT_EQ(record.decoded, addresses.decoded(stream.fetches[i]));
        const Format format = textures[record.texture]->format();
        ASSERT_EQ(record.bytes_stored, info(format).bytes_per_block);
        ASSERT_EQ(record.bytes_decoded, bytes_per_texel(layout(format).storage));
    }
}

TEST_F(FetchReplays, ChargeEveryLineAndBlockOnceToItsFirstToucher) {
    std::mt19937 random(3);
    std::vector<uint64_t> sizes;
    for (const Texture* texture : textures) sizes.push_back(texture->levels().texels);
    TouchedTexels touched(sizes);
    FetchReplay replay(textures, std::nullopt);
    const TexelAddresses addresses(textures);
    std::set<uint64_t> lines, blocks, stored_lines;
    uint64_t all_lines = 0, all_blocks = 0;
    std::vector<FetchReplay::PixelCosts> costs;
    for (uint16_t n = 0; n < 400; ++n) {
        FetchStream stream;
        stream.pixels.push_back({n, 0, 0, 12});
        uint32_t new_lines = 0, new_blocks = 0;
        for (int i = 0; i < 12; ++i) {
            const auto t = uint32_t(random() % textures.size());
            const int level = int(random() % 4);
            const TexelFetch one =
                fetch(t, level, int(random() % unsigned(level_extent(150, level))), int(random() % unsigned(level_extent(70, level))));
            stream.fetches.push_back(one);
            touched.bits(t).mark(one.texel());
            new_lines += lines.insert(addresses.decoded(one) / 64).second;
            new_blocks += blocks.insert(uint64_t{t} << 40 | uint64_t(one.texel()) / 16).second;
            stored_lines.insert(addresses.stored(one) / 64);
        }
        replay.replay(stream, 0, costs);
        ASSERT_EQ(costs.size(), 1u);
        EXPECT_EQ(costs[0].lines_first, new_lines);
        EXPECT_EQ(costs[0].blocks_first, new_blocks);
        all_lines += new_lines, all_blocks += new_blocks;
    }
    TouchedLines sum;
    for (size_t t = 0; t < textures.size(); ++t)
        for (const TouchedLines& level : measure_touched(*textures[t], touched, t)) sum += level;
    EXPECT_EQ(sum.decoded.of_64(), all_lines);
    EXPECT_EQ(sum.blocks_touched, all_blocks);
    EXPECT_EQ(sum.stored.of_64(), stored_lines.size());
}

TEST_F(FetchReplays, GiveEveryTileToItsCore) {
    FetchStream stream;
    stream.pixels.push_back({0, 0, 0, 1});
    stream.fetches.push_back(fetch(1, 0, 5, 5));
    std::vector<FetchReplay::PixelCosts> costs;
    for (const int cores : {1, 2, 3}) {
        CacheSpec spec;
        spec.cores = cores;
        FetchReplay replay(textures, spec);
        uint32_t misses = 0;
        for (uint64_t tile = 0; tile < 6; ++tile) {
            replay.replay(stream, tile, costs);
            misses += costs[0].l1_misses;
            EXPECT_EQ(costs[0].l2_misses, tile == 0 ? 1u : 0u) << "all share the second level";
        }
        EXPECT_EQ(misses, uint32_t(cores));
        EXPECT_EQ(replay.cache_counts()[1][0].l1_hits, uint64_t(6 - cores));
    }
}

/// BC1: two 8x4 pieces of texels are two blocks of 8 bytes in one line of the file, and two lines once decoded.
TEST_F(FetchReplays, LetLevelsHoldWhatTheSpecSays) {
    for (const auto& [l1, l2, l1_misses, l2_misses] : {std::tuple{CacheContent::Decoded, CacheContent::Stored, 2u, 1u},
                                                       {CacheContent::Stored, CacheContent::Stored, 1u, 1u},
                                                       {CacheContent::Decoded, CacheContent::Decoded, 2u, 2u}}) {
        CacheSpec spec;
        spec.l1_holds = l1, spec.l2_holds = l2;
        FetchReplay replay(textures, spec);
        FetchStream stream;
        stream.pixels.push_back({0, 0, 0, 2});
        stream.fetches = {fetch(4, 0, 0, 0), fetch(4, 0, 4, 0)};
        std::vector<FetchReplay::PixelCosts> costs;
        replay.replay(stream, 0, costs);
        EXPECT_EQ(costs[0].l1_misses, l1_misses);
        EXPECT_EQ(costs[0].l2_misses, l2_misses);
    }
}

}  // namespace
}  // namespace rawtexel::texunit
