#include "tests/raster/drawing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <thread>
#include <utility>

namespace rawtexel::raster::testing {

namespace {

uint32_t scramble(uint32_t x) {
    x = (x ^ (x >> 16)) * 0x7feb352du;
    x = (x ^ (x >> 15)) * 0x846ca68bu;
    return x ^ (x >> 16);
}

/// Calls visit(tile x, tile y, visibility) for every tile.
template <class Visit>
void for_each_tile(const Frame& frame, const SamplePattern& pattern, const CoveragePolicy& coverage, Visit&& visit,
                   bool may_leave_blocks = false) {
    const int size = frame.options().tile_size;
    std::vector<SampleOffset> offsets(size_t(size) * size_t(size));
    TileVisibility tile;
    tile.may_leave_blocks = may_leave_blocks;
    for (int tile_y = 0; tile_y < frame.tiles_y(); ++tile_y) {
        for (int tile_x = 0; tile_x < frame.tiles_x(); ++tile_x) {
            TileSamples samples{pattern.frame, nullptr};
            if (pattern.per_pixel) {
                for (int i = 0; i < size * size; ++i) offsets[size_t(i)] = pattern.at(tile_x * size + i % size, tile_y * size + i / size);
                samples.per_pixel = offsets.data();
            }
            draw_tile(frame, tile_x, tile_y, samples, coverage, tile);
            visit(tile_x, tile_y, tile);
        }
    }
}

}  // namespace

void Mesh::add(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    for (const glm::vec3& p : {a, b, c}) {
        indices.push_back(uint32_t(positions.size()));
        positions.push_back(p);
    }
}

Draw Mesh::draw(const glm::mat4& clip_from_object) const {
    Draw draw;
    draw.positions = positions.data();
    draw.vertex_count = uint32_t(positions.size());
    draw.indices = indices.data();
    draw.triangle_count = uint32_t(indices.size() / 3);
    draw.clip_from_object = clip_from_object;
    draw.cull = CullMode::None;
    return draw;
}

glm::mat4 clip_from_pixels(int width, int height) {
    return {2.0f / float(width), 0, 0, 0, 0, -2.0f / float(height), 0, 0, 0, 0, 1, 0, -1, 1, 0, 1};
}

glm::mat4 perspective(float focal, float aspect, float near_plane) {
    return {focal / aspect, 0, 0, 0, 0, focal, 0, 0, 0, 0, 0, -1, 0, 0, near_plane, 0};
}

float uniform(std::mt19937& random, float low, float high) { return low + (high - low) * (float(random() >> 8) * 0x1p-24f); }

SampleOffset SamplePattern::at(int x, int y) const {
    if (!per_pixel) return frame;
    const uint32_t random = scramble(seed ^ scramble(uint32_t(x) * 16384u + uint32_t(y)));
    const auto odd = [&](uint32_t r) { return 2 * int32_t(r % uint32_t(radius)) + 1 - radius; };
    return {256 + odd(random & 0xFFFFu), 256 + odd(random >> 16)};
}

glm::mat4 random_rotation(std::mt19937& random) {
    const auto direction = [&] {
        glm::vec3 v;
        do v = {uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1)};
        while (glm::dot(v, v) > 1 || glm::dot(v, v) < 0.01f);
        return glm::normalize(v);
    };
    const glm::vec3 x = direction(), y = glm::normalize(glm::cross(x, direction())), z = glm::cross(x, y);
    return {glm::vec4(x, 0), glm::vec4(y, 0), glm::vec4(z, 0), glm::vec4(0, 0, 0, 1)};
}

FrameOptions square_frame(int extent) {
    FrameOptions options;
    options.width = options.height = extent;
    options.filter_radius = kPatternRadius;
    return options;
}

std::vector<SamplePattern> sample_patterns() {
    std::vector<SamplePattern> patterns(5);
    patterns[1].frame = {1, 511};
    patterns[2].frame = {-511, 1023};
    patterns[3] = {{}, true, 256, 7};
    patterns[4] = {{}, true, 768, 9};
    return patterns;
}

Picture draw_frame(const Frame& frame, const SamplePattern& pattern, const CoveragePolicy& coverage) {
    const int width = frame.options().width, height = frame.options().height;
    Picture picture{std::vector<uint32_t>(size_t(width) * size_t(height), kNoTriangle), std::vector<float>(size_t(width) * size_t(height))};
    for_each_tile(frame, pattern, coverage, [&](int tile_x, int tile_y, const TileVisibility& tile) {
        const int size = tile.tile_size;
        for (int y = tile_y * size; y < std::min(height, (tile_y + 1) * size); ++y) {
            for (int x = tile_x * size; x < std::min(width, (tile_x + 1) * size); ++x) {
                const size_t from = size_t(y - tile_y * size) * size_t(size) + size_t(x - tile_x * size);
                const size_t to = size_t(y) * size_t(width) + size_t(x);
                const uint32_t index = tile.triangle[from];
                picture.id[to] = index == kNoTriangle ? kNoTriangle : frame.triangle(index).triangle_id;
                picture.depth[to] = tile.depth[from];
            }
        }
    });
    return picture;
}

uint64_t expect_left_blocks_agree(const Frame& frame, const SamplePattern& pattern, const CoveragePolicy& coverage) {
    std::vector<TileVisibility> written;
    for_each_tile(frame, pattern, coverage, [&](int, int, const TileVisibility& tile) { written.push_back(tile); });
    uint64_t left = 0, differing = 0;
    const auto compare_tile = [&](int tile_x, int tile_y, const TileVisibility& tile) {
        const TileVisibility& expected = written[size_t(tile_y) * size_t(frame.tiles_x()) + size_t(tile_x)];
        EXPECT_EQ(tile.hiz_rejected, expected.hiz_rejected);
        for (size_t pixel = 0; pixel < expected.triangle.size(); ++pixel) {
            const TileVisibility::Block& block = tile.block_of(int(pixel) % tile.tile_size, int(pixel) / tile.tile_size);
            differing += (block.written ? tile.triangle[pixel] : block.shown) != expected.triangle[pixel];
            differing += block.written && tile.depth[pixel] != expected.depth[pixel];
        }
        for (size_t block = 0; block < tile.block.size(); ++block) {
            differing += tile.block[block].open != expected.block[block].open;
            left += !tile.block[block].written && tile.block[block].shown != kNoTriangle;
        }
    };
    for_each_tile(frame, pattern, coverage, compare_tile, true);
    EXPECT_EQ(differing, 0u) << "entries of tiles whose blocks may be left unwritten";
    return left;
}

Picture draw_frame(const Frame& frame, const SamplePattern& pattern) {
    return draw_frame(frame, pattern, [](const CandidateWave& wave) { return wave.mask; });
}

std::vector<int> count_candidates(const Frame& frame, const SamplePattern& pattern) {
    const int width = frame.options().width, height = frame.options().height;
    std::vector<int> count(size_t(width) * size_t(height));
    // Pieces of one clipped triangle that snapping has turned over may lie on one another: one triangle counts once.
    std::vector<uint32_t> last(count.size(), kNoTriangle);
    const auto note = [&](const CandidateWave& wave) {
        for (uint32_t rest = wave.mask; rest != 0; rest &= rest - 1) {
            const int lane = std::countr_zero(rest);
            const size_t pixel = size_t(wave.y + lane / 8) * size_t(width) + size_t(wave.x + lane % 8);
            count[pixel] += std::exchange(last[pixel], wave.triangle->triangle_id) != wave.triangle->triangle_id;
        }
        return 0u;
    };
    for_each_tile(frame, pattern, note, [](int, int, const TileVisibility&) {});
    return count;
}

ParallelFor threaded_for(int threads) {
    return [threads](int64_t count, const std::function<void(int64_t)>& body) {
        std::atomic<int64_t> next{0};
        const auto work = [&] {
            for (int64_t i; (i = next++) < count;) body(count - 1 - i);
        };
        std::vector<std::thread> workers;
        for (int i = 0; i < threads; ++i) workers.emplace_back(work);
        for (std::thread& worker : workers) worker.join();
    };
}

}  // namespace rawtexel::raster::testing
