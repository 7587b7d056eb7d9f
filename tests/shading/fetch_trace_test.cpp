// The trace of a frame: every read in its order, from which all that is counted can be found again.
#include "shading/render.h"
#include "texunit/fetch_trace.h"

#include "tests/shading/fetch_scenes.h"

#include <gtest/gtest.h>
#include <zstd.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace rawtexel::shading {
namespace {

using namespace test;

class FetchTraceTest : public FetchesTest {};
class StackTraceTest : public StackTest {};

std::vector<std::byte> decompress(const std::vector<std::byte>& compressed) {
    std::vector<std::byte> plain(size_t{256} << 20);
    const size_t size = ZSTD_decompress(plain.data(), plain.size(), compressed.data(), compressed.size());
    EXPECT_FALSE(ZSTD_isError(size)) << ZSTD_getErrorName(size);
    plain.resize(ZSTD_isError(size) ? 0 : size);
    return plain;
}

/// A trace read back: its textures' names, and its records.
struct ReadTrace {
    std::vector<std::string> names;
    std::vector<texunit::TraceRecord> records;
};
ReadTrace read_trace(const std::vector<std::byte>& file) {
    const std::vector<std::byte> plain = decompress(file);
    ReadTrace trace;
    if (plain.size() < 12 || std::memcmp(plain.data(), texunit::kTraceMagic.data(), 8) != 0) {
        ADD_FAILURE() << "no trace";
        return trace;
    }
    const std::byte* at = plain.data() + 8;
    const auto number = [&] {
        uint32_t value;
        std::memcpy(&value, at, 4);
        at += 4;
        return value;
    };
    const uint32_t names = number();
    for (uint32_t i = 0; i < names; ++i) {
        const uint32_t size = number();
        trace.names.emplace_back(reinterpret_cast<const char*>(at), size);
        at += size;
    }
    const auto bytes = size_t(plain.data() + plain.size() - at);
    EXPECT_EQ(bytes % sizeof(texunit::TraceRecord), 0u);
    trace.records.resize(bytes / sizeof(texunit::TraceRecord));
    std::memcpy(trace.records.data(), at, trace.records.size() * sizeof(texunit::TraceRecord));
    return trace;
}

/// Tile, sample, wave by the Morton code of its place in the tile, lane.
using CanonicalPlace = std::tuple<int, uint32_t, int, int>;
CanonicalPlace canonical_place(const texunit::TraceRecord& record, int tiles_x) {
    const int x = record.pixel_x % 64, y = record.pixel_y % 64;
    int code = 0;
    for (int bit = 0; bit < 4; ++bit) code |= (x / 8 >> bit & 1) << (2 * bit) | (y / 4 >> bit & 1) << (2 * bit + 1);
    // The column has three bits, the row four: the row's last stands where the column's would.
    if (code >= 128) code -= 64;
    return {record.pixel_y / 64 * tiles_x + record.pixel_x / 64, record.sample, code, y % 4 * 8 + x % 8};
}

TEST_F(FetchTraceTest, HoldsEveryReadInCanonicalOrder) {
    RenderOptions options = busy_options();
    std::vector<std::byte> first;
    for (const int threads : {1, 3}) {
        std::vector<std::byte> file;
        texunit::FetchTraceWriter writer([&](std::span<const std::byte> bytes) { file.insert(file.end(), bytes.begin(), bytes.end()); });
        options.fetches.trace = &writer;
        const RenderResult result = render_with(options, ExecutorKind::Threads, threads);
        writer.end();
        if (threads > 1) {
            EXPECT_TRUE(file == first);
            continue;
        }
        first = file;
        const ReadTrace trace = read_trace(file);
        ASSERT_EQ(trace.names.size(), result.fetches->textures.size());
        for (size_t i = 0; i < trace.names.size(); ++i) EXPECT_EQ(trace.names[i], result.fetches->textures[i]->name());
        ASSERT_EQ(trace.records.size(), result.fetches->total().texels_requested);
        std::set<uint64_t> lines;
        CanonicalPlace before{};
        for (const texunit::TraceRecord& record : trace.records) {
            const CanonicalPlace place = canonical_place(record, 3);
            ASSERT_LE(before, place) << "pixel " << record.pixel_x << ',' << record.pixel_y;
            before = place;
            ASSERT_LT(record.x, result.fetches->textures[record.texture]->levels().width[record.level]);
            ASSERT_LT(record.y, result.fetches->textures[record.texture]->levels().height[record.level]);
            lines.insert(record.decoded / 64);
        }
        texunit::TouchedLines touched;
        for (const auto& levels : result.fetches->measure())
            for (const texunit::TouchedLines& level : levels) touched += level;
        EXPECT_EQ(lines.size(), touched.decoded.of_64());
    }
}

/// A cache as lists of lines, the most recent first.
class ListedCache {
  public:
    ListedCache(uint64_t bytes, int ways, int line_bytes)
        : line_bytes_(uint64_t(line_bytes)), ways_(size_t(ways)), sets_(bytes / (line_bytes_ * ways_)) {}
    bool access(uint64_t address) {
        const uint64_t line = address / line_bytes_;
        std::vector<uint64_t>& set = sets_[line % sets_.size()];
        const auto found = std::find(set.begin(), set.end(), line);
        const bool hit = found != set.end();
        if (hit) set.erase(found);
        set.insert(set.begin(), line);
        if (set.size() > ways_) set.pop_back();
        return hit;
    }

  private:
    uint64_t line_bytes_;
    size_t ways_;
    std::vector<std::vector<uint64_t>> sets_;
};

/// What somebody finds who replays the stream with nothing but the page that describes it. In the crop the frame's second tile is the
/// first.
TEST_F(FetchTraceTest, ReplayedGivesTheCounters) {
    for (const Crop& crop : {Crop{}, Crop{70, 9, 90, 80}}) {
        RenderOptions options = busy_options();
        options.crop = crop;
        options.fetches.pixel_layers = true;
        texunit::CacheSpec spec;
        spec.l1 = {2048, 2}, spec.l2 = {8192, 4};
        spec.line_bytes = 32;
        spec.cores = 3;
        options.fetches.cache = spec;
        std::vector<std::byte> file;
        texunit::FetchTraceWriter writer([&](std::span<const std::byte> bytes) { file.insert(file.end(), bytes.begin(), bytes.end()); });
        options.fetches.trace = &writer;
        const RenderResult result = render_with(options, ExecutorKind::Threads, 3);
        writer.end();
        const FrameFetches& fetches = *result.fetches;
        const ReadTrace trace = read_trace(file);

        struct Level {
            std::set<std::tuple<int, int, int>> texels, blocks;
            std::set<uint64_t> lines, stored;
            texunit::CacheCounts cache;
        };
        std::map<std::pair<uint32_t, int>, Level> levels;
        std::set<uint64_t> lines, blocks;
        struct Core {
            ListedCache l1, fully;
            std::set<uint64_t> seen;
        };
        std::vector<Core> cores(3, {{2048, 2, 32}, {2048, 2048 / 32, 32}, {}});
        ListedCache l2(8192, 4, 32);
        const Image& whole = fetches.pixel(PixelCount::TexelsRequested);
        const auto layer = [&] { return std::vector<float>(whole.values.size()); };
        std::vector<float> requested = layer(), lines_first = layer(), blocks_first = layer(), l1_miss = layer(), l2_miss = layer();
        for (const texunit::TraceRecord& record : trace.records) {
            const size_t pixel = size_t(record.pixel_y - crop.y) * size_t(whole.width) + size_t(record.pixel_x - crop.x);
            Level& level = levels[{record.texture, record.level}];
            level.texels.insert({record.x, record.y, record.z});
            level.blocks.insert({record.x / 4, record.y / 4, record.z});
            level.lines.insert(record.decoded / 64), level.stored.insert(record.stored / 64);
            ++requested[pixel];
            lines_first[pixel] += lines.insert(record.decoded / 64).second;
            blocks_first[pixel] += blocks.insert(record.decoded / (16u * record.bytes_decoded) * (16u * record.bytes_decoded)).second;
            Core& core = cores[size_t(record.pixel_y / 64 * 3 + record.pixel_x / 64) % 3];
            const bool in_l1 = core.l1.access(record.decoded), in_fully = core.fully.access(record.decoded);
            const bool is_new = core.seen.insert(record.decoded / 32).second;
            texunit::CacheCounts& cache = level.cache;
            cache.l1_hits += in_l1;
            if (in_l1) continue;
            ++cache.l1_misses;
            ++(is_new ? cache.compulsory : in_fully ? cache.conflict : cache.capacity);
            ++l1_miss[pixel];
            const bool in_l2 = l2.access(record.stored);
            ++(in_l2 ? cache.l2_hits : cache.l2_misses);
            l2_miss[pixel] += !in_l2;
        }
        EXPECT_EQ(fetches.pixel(PixelCount::TexelsRequested).values, requested);
        EXPECT_EQ(fetches.pixel(PixelCount::LinesFirst).values, lines_first);
        EXPECT_EQ(fetches.pixel(PixelCount::BlocksFirst).values, blocks_first);
        EXPECT_EQ(fetches.pixel(PixelCount::L1Miss).values, l1_miss);
        EXPECT_EQ(fetches.pixel(PixelCount::L2Miss).values, l2_miss);
        const auto touched = fetches.measure();
        texunit::CacheCounts all;
        for (size_t t = 0; t < touched.size(); ++t) {
            for (size_t l = 0; l < touched[t].size(); ++l) {
                const Level& level = levels[{uint32_t(t), int(l)}];
                EXPECT_EQ(touched[t][l].texels_unique, level.texels.size()) << t << ' ' << l;
                EXPECT_EQ(touched[t][l].blocks_touched, level.blocks.size()) << t << ' ' << l;
                EXPECT_EQ(touched[t][l].decoded.of_64(), level.lines.size()) << t << ' ' << l;
                EXPECT_EQ(fetches.cache[t][l], level.cache) << t << ' ' << l;
                all += level.cache;
            }
        }
        // All kinds of misses are among them.
        EXPECT_GT(std::min({all.l1_hits, all.compulsory, all.capacity, all.conflict, all.l2_hits, all.l2_misses}), 100u);
    }
}

/// Taps that take the border colour read nothing.
TEST_F(StackTraceTest, BordersAreNeitherCountedNorTraced) {
    scene_.textures.push_back(make_noise_texture(8, 8, 1));
    Material material = unlit(glm::vec4(1.0f));
    TextureMap& map = material.maps[kBaseColor];
    map.texture = 0;
    map.sampler.wrap_s = map.sampler.wrap_t = texunit::Wrap::ClampToBorder;
    map.sampler.mip = texunit::MipMode::None;
    map.sampler.magnify = map.sampler.minify = texunit::Kernel::Nearest;
    add_object(scene_, make_quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, glm::vec2(2.0f)), material);
    std::vector<std::byte> file;
    texunit::FetchTraceWriter writer([&](std::span<const std::byte> bytes) { file.insert(file.end(), bytes.begin(), bytes.end()); });
    options_.fetches.trace = &writer;
    const RenderResult result = render(scene_, Lighting{}, options_, *executor_);
    writer.end();
    EXPECT_EQ(result.fetches->total().lookups, 64u * 64);
    EXPECT_EQ(result.fetches->total().texels_requested, 32u * 32);
    EXPECT_EQ(read_trace(file).records.size(), 32u * 32);
}

/// One material with every map, its textures in another order than its maps.
TEST_F(StackTraceTest, FragmentsAskMapByMapAndTapByTap) {
    for (uint32_t seed = 0; seed < kMapSlots; ++seed) scene_.textures.push_back(make_noise_texture(64, 64, seed));
    Material material;
    material.emission = glm::vec3(1.0f);
    const std::vector<uint32_t> textures = {3, 0, 4, 1, 2};
    static constexpr MapSlot kOrder[] = {kBaseColor, kMetallicRoughness, kNormal, kOcclusion, kEmissive};
    for (size_t i = 0; i < textures.size(); ++i) {
        TextureMap& map = material.maps[size_t(kOrder[i])];
        map.texture = int(textures[i]);
        map.sampler.probes = 4;
    }
    // 64 pixels over 150 texels of u and 600 of v: two levels, and probes along v.
    add_object(scene_, make_quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, glm::vec2(150.0f / 64, 600.0f / 64)), material);
    std::vector<std::byte> file;
    texunit::FetchTraceWriter writer([&](std::span<const std::byte> bytes) { file.insert(file.end(), bytes.begin(), bytes.end()); });
    options_.fetches.trace = &writer;
    Lighting lighting;
    lighting.ambient = 1.0f;
    const RenderResult result = render(scene_, lighting, options_, *executor_);
    writer.end();
    const ReadTrace trace = read_trace(file);
    ASSERT_EQ(trace.records.size(), result.fetches->total().texels_requested);
    std::vector<uint32_t> order;
    std::map<int, int> levels;
    const texunit::TraceRecord* before = nullptr;
    int rows_back = 0;
    for (const texunit::TraceRecord& record : trace.records) {
        if (record.pixel_x != 20 || record.pixel_y != 30) continue;
        const bool same_map = before != nullptr && before->texture == record.texture;
        if (!same_map) order.push_back(record.texture);
        if (record.texture == textures[0]) ++levels[record.level];
        if (same_map && before->level == record.level) {
            // A row goes on, a row begins, or the next probe does.
            const bool goes_on = record.y == before->y && record.x == (before->x + 1) % (64 >> record.level);
            rows_back += !goes_on && record.y != (before->y + 1) % (64 >> record.level);
        }
        before = &record;
    }
    EXPECT_EQ(order, textures);
    EXPECT_EQ(levels.size(), 2u) << "levels of one lookup";
    EXPECT_LE(rows_back, 5 * 2 * 4);
}

}  // namespace
}  // namespace rawtexel::shading
