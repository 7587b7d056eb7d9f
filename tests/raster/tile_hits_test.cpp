// Triangles of a few pixels, which are tested many at a time: held against exact integers, and against one at a time.
#include "raster/edge.h"
#include "tests/raster/drawing.h"
#include "tests/raster/scenes.h"
#include "tests/reference/raster/exact_coverage.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <vector>

namespace rawtexel::raster {
namespace {

using namespace testing;

constexpr int kWidth = 75, kHeight = 61;  // no whole tiles

/// Opaque triangles in many layers, from less than a pixel to a dozen, of which many share a depth; a few large ones, and masked ones.
struct CrowdedScene {
    explicit CrowdedScene(uint32_t seed) : opaque(crowd(seed, 6000)), masked(crowd(seed + 100, 200)) {
        for (const Mesh* mesh : {&opaque, &masked}) {
            Draw& draw = draws.emplace_back(mesh->draw(clip_from_pixels(kWidth, kHeight)));
            draw.first_triangle_id = mesh == &opaque ? 0 : draws[0].triangle_count;
            draw.coverage = mesh == &opaque ? CoverageClass::Opaque : CoverageClass::Masked;
        }
    }
    CrowdedScene(const CrowdedScene&) = delete;
    CrowdedScene& operator=(const CrowdedScene&) = delete;

    static Mesh crowd(uint32_t seed, int count) {
        std::mt19937 random(seed);
        Mesh mesh;
        for (int i = 0; i < count; ++i) {
            const float size = i % 100 == 0 ? 90.0f : i % 10 == 0 ? 12.0f : uniform(random, 0.3f, 4.0f);
            // Large ones lie behind, so that there is something left to draw.
            const float depth = i % 100 == 0 ? 0.1f : uniform(random, 0.2f, 0.8f), slope = i % 3 == 0 ? 0.0f : 0.1f;
            const glm::vec3 middle(uniform(random, -3, kWidth + 3), uniform(random, -3, kHeight + 3), i % 7 == 0 ? 0.5f : depth);
            const auto corner = [&] {
                glm::vec3 at =
                    middle + glm::vec3(uniform(random, -size, size), uniform(random, -size, size), uniform(random, -slope, slope));
                // Some on sample points, where only the top-left rule decides.
                if (i % 5 == 0) at = {std::floor(at.x) + 0.5f, std::floor(at.y) + 0.5f, at.z};
                return at;
            };
            const glm::vec3 a = corner(), b = corner(), c = corner();
            mesh.add(a, b, c);
        }
        return mesh;
    }

    Mesh opaque, masked;
    std::vector<Draw> draws;
};

FrameOptions frame_options(int tile_size, bool hiz) {
    FrameOptions options;
    options.width = kWidth;
    options.height = kHeight;
    options.tile_size = tile_size;
    options.filter_radius = kPatternRadius;
    options.skips.hiz = hiz;
    return options;
}

std::vector<SampleOffset> frame_offsets() {
    std::vector<SampleOffset> offsets;
    for (const SamplePattern& pattern : sample_patterns())
        if (!pattern.per_pixel) offsets.push_back(pattern.frame);
    return offsets;
}

template <class Visit>
void for_each_tile(const Frame& frame, Visit&& visit) {
    for (int y = 0; y < frame.tiles_y(); ++y)
        for (int x = 0; x < frame.tiles_x(); ++x) visit(x, y);
}

bool covers_pixel(const Frame& frame, uint32_t setup_index, int x, int y, SampleOffset offset) {
    const int64_t sample_x = int64_t{x} * kSampleOne + offset.x, sample_y = int64_t{y} * kSampleOne + offset.y;
    return reference::covers(reference::snapped(frame.triangle(setup_index)), sample_x, sample_y);
}

struct HitCounts {
    uint64_t tiny = 0, covered = 0, left_out = 0;
};

/// Holds the hits of the tile drawn last, and what is no hit, against exact integers.
void expect_exact_hits(const Frame& frame, int tile_x, int tile_y, SampleOffset offset, const TileVisibility& tile, HitCounts& counts) {
    const int size = frame.options().tile_size, left = tile_x * size, top = tile_y * size;
    const int right = std::min(left + size, kWidth), bottom = std::min(top + size, kHeight);
    size_t next = 0;
    for (const uint32_t index : frame.bin(tile_x, tile_y)) {
        const bool is_hit = next < tile.hits.size() && tile.hits[next].setup_index == index;
        const TileVisibility::Hit hit = is_hit ? tile.hits[next++] : TileVisibility::Hit{};
        if (is_hit && !hit.tiny) continue;
        const SampleBox box = bounds_of(frame.triangle(index));
        int drawn_pixels = 0;
        for (int y = std::max(top, int(box.y_min / kSampleOne) - 2); y < std::min<int>(bottom, int(box.y_max / kSampleOne) + 3); ++y) {
            for (int x = std::max(left, int(box.x_min / kSampleOne) - 2); x < std::min<int>(right, int(box.x_max / kSampleOne) + 3); ++x) {
                const int column = x - left - hit.first_x, row = y - top - hit.first_y;
                const bool inside = is_hit && column >= 0 && row >= 0 && x - left <= hit.last_x && y - top <= hit.last_y;
                const bool drawn = inside && (hit.covered >> (TileVisibility::Hit::kTiny * row + column) & 1u) != 0;
                ASSERT_EQ(drawn, covers_pixel(frame, index, x, y, offset)) << "triangle " << index << ", pixel " << x << "," << y;
                drawn_pixels += drawn;
            }
        }
        ASSERT_EQ(drawn_pixels, std::popcount(hit.covered)) << "triangle " << index << " covers pixels that are not the tile's";
        counts.covered += uint64_t(drawn_pixels);
        counts.tiny += is_hit;
        counts.left_out += !is_hit;
    }
    ASSERT_EQ(next, tile.hits.size());
}

TEST(TileHits, CoverWhatExactIntegersSayOnEveryInstructionSet) {
    const CrowdedScene scene(1);
    for (const int tile_size : {64, 8}) {
        const Frame frame(frame_options(tile_size, true), scene.draws);
        for (const int64_t set : instruction_sets()) {
            const UseInstructionSet use(set);
            HitCounts counts;
            TileVisibility tile;
            for_each_tile(frame, [&](int x, int y) {
                for (const SampleOffset offset : frame_offsets()) {
                    if (HasFatalFailure()) return;
                    draw_tile(frame, x, y, {offset, nullptr}, cover_by_hash, tile);
                    if (!frame.bin(x, y).empty()) expect_exact_hits(frame, x, y, offset, tile, counts);
                }
            });
            ASSERT_FALSE(HasFatalFailure()) << name_of(set) << ", tiles of " << tile_size;
            EXPECT_GT(counts.tiny, 3000u);
            EXPECT_GT(counts.covered, 5000u);
            EXPECT_GT(counts.left_out, 1000u);
        }
    }
}

/// Pixels that each have an offset go one triangle at a time, also where all offsets are the same.
TEST(TileHits, DrawWhatOneTriangleAtATimeDraws) {
    uint64_t rejected = 0;
    for (uint32_t seed = 1; seed <= 3; ++seed) {
        const CrowdedScene scene(seed);
        for (const int tile_size : {64, 24, 8}) {
            for (const bool hiz : {true, false}) {
                const Frame frame(frame_options(tile_size, hiz), scene.draws);
                for (const int64_t set : instruction_sets()) {
                    const UseInstructionSet use(set);
                    TileVisibility many, one;
                    for_each_tile(frame, [&](int x, int y) {
                        for (const SampleOffset offset : frame_offsets()) {
                            const std::vector<SampleOffset> same(size_t(tile_size) * size_t(tile_size), offset);
                            draw_tile(frame, x, y, {offset, nullptr}, cover_by_hash, many);
                            draw_tile(frame, x, y, {offset, same.data()}, cover_by_hash, one);
                            ASSERT_EQ(many.triangle, one.triangle) << name_of(set) << ", tile " << x << "," << y << " of " << tile_size;
                            ASSERT_EQ(many.depth, one.depth);
                            ASSERT_EQ(many.covered, one.covered);
                            ASSERT_EQ(many.hiz_rejected, one.hiz_rejected);
                            for (size_t b = 0; b < many.block.size(); ++b) {
                                ASSERT_EQ(many.block[b].open, one.block[b].open) << "block " << b;
                                ASSERT_EQ(many.block[b].nearest, one.block[b].nearest) << "block " << b;
                            }
                            rejected += many.hiz_rejected;
                        }
                    });
                }
            }
        }
    }
    EXPECT_GT(rejected, 0u);
}

TEST(TileHits, AreDrawnAlikeWhereBlocksMayBeLeftUnwritten) {
    for (const int tile_size : {64, 24, 8}) {
        const CrowdedScene scene(5);
        const Frame frame(frame_options(tile_size, true), scene.draws);
        for (const int64_t set : instruction_sets()) {
            const UseInstructionSet use(set);
            for (const SamplePattern& pattern : sample_patterns()) expect_left_blocks_agree(frame, pattern, cover_by_hash);
        }
    }
}

/// Whoever hears of opaque waves gets them all, and the same picture.
TEST(TileHits, LeaveNothingUnheard) {
    const CrowdedScene scene(4);
    const Frame frame(frame_options(64, false), scene.draws);
    TileVisibility quiet, told;
    for_each_tile(frame, [&](int x, int y) {
        std::vector<float> nearest(64 * 64);
        draw_tile(frame, x, y, {}, cover_by_hash, quiet);
        draw_tile_telling(
            frame, x, y, {}, cover_by_hash,
            [&](const CandidateWave& wave) {
                for (size_t lane = 0; lane < 32; ++lane) {
                    if ((wave.mask >> lane & 1u) == 0) continue;
                    const size_t at = (size_t(wave.y % 64) + lane / 8) * 64 + size_t(wave.x % 64) + lane % 8;
                    nearest[at] = std::max(nearest[at], wave.depth[lane]);
                }
            },
            told);
        ASSERT_EQ(quiet.triangle, told.triangle);
        ASSERT_EQ(quiet.depth, told.depth);
        for (size_t i = 0; i < nearest.size(); ++i) {
            const uint32_t seen = quiet.triangle[i];
            if (seen != kNoTriangle && frame.triangle(seen).coverage == CoverageClass::Opaque) {
                ASSERT_EQ(nearest[i], quiet.depth[i]);
            }
        }
    });
}

}  // namespace
}  // namespace rawtexel::raster
