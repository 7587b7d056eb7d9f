// The winner at every sample, held against a look at every triangle, and what the coverage policy is promised.
#include "tests/raster/drawing.h"
#include "tests/raster/scenes.h"
#include "tests/reference/raster/exact_visibility.h"
#include "tests/stress/worst_case.h"
#include "tests/stress_scale.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <numeric>

namespace rawtexel::raster {
namespace {

using namespace testing;

FrameOptions frame_options(int width, int height, int tile_size = 64) {
    FrameOptions options;
    options.width = width;
    options.height = height;
    options.tile_size = tile_size;
    options.filter_radius = kPatternRadius;
    return options;
}

/// Bit for bit: ids and depths.
void expect_true_winners(const Frame& frame, const SamplePattern& pattern, uint64_t& samples) {
    const Picture picture = draw_frame(frame, pattern, cover_by_hash);
    const int width = frame.options().width, height = frame.options().height;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const reference::Winner winner = reference::winner_at(frame, x, y, pattern.at(x, y), covers_by_hash);
            const uint32_t id = winner.setup_index == kNoTriangle ? kNoTriangle : frame.triangle(winner.setup_index).triangle_id;
            const size_t pixel = size_t(y) * size_t(width) + size_t(x);
            ASSERT_EQ(picture.id[pixel], id) << "pixel " << x << "," << y << ", depth " << picture.depth[pixel] << " and " << winner.depth;
            ASSERT_EQ(picture.depth[pixel], winner.depth) << "pixel " << x << "," << y;
            ++samples;
        }
    }
    expect_left_blocks_agree(frame, pattern, cover_by_hash);
}

TEST(Visibility, IsTheNearestCoveringTriangleThenTheFirst) {
    uint64_t samples = 0;
    for (uint32_t seed = 1; seed <= uint32_t(6 * stress_scale()); ++seed) {
        const MixedScene scene(seed, 200);
        const Frame frame(frame_options(100, 70), scene.draws);
        ASSERT_GT(frame.counts().clipped, 0u);
        for (const SamplePattern& pattern : sample_patterns()) {
            expect_true_winners(frame, pattern, samples);
            ASSERT_FALSE(HasFatalFailure()) << "seed " << seed;
        }
    }
    tell_tested(samples);
    tell_worst_case("winners_or_depths_that_differ", 0);
}

/// Walls over most of the frame, and in its left half small triangles in front of them and behind.
TEST(Visibility, LeavesBlocksThatOneTriangleFillsUnwritten) {
    for (uint32_t seed = 1; seed <= 8; ++seed) {
        std::mt19937 random(seed);
        const auto at = [&](float left, float right, float depth) {
            return glm::vec3(uniform(random, left, right), uniform(random, -20, 170), depth);
        };
        Mesh walls, small;
        walls.add(at(-90, 0, 0.5f), at(200, 300, 0.6f), at(100, 200, 0.3f));
        walls.add({-100, 400, 0.4f}, {-100, -100, 0.4f}, {500, -100, 0.5f});
        for (int k = 0; k < 40; ++k) {
            const glm::vec3 corner = at(0, 75, uniform(random, 0.2f, 0.8f));
            small.add(corner, corner + glm::vec3(uniform(random, -9, 9), 4, 0), corner + glm::vec3(3, uniform(random, -9, 9), 0.05f));
        }
        const glm::mat4 clip_from_object = clip_from_pixels(150, 150);
        std::vector<Draw> draws{walls.draw(clip_from_object), small.draw(clip_from_object), small.draw(clip_from_object)};
        draws[2].coverage = CoverageClass::Masked;
        draws[1].first_triangle_id = draws[0].triangle_count;
        draws[2].first_triangle_id = draws[0].triangle_count + draws[1].triangle_count;
        const Frame frame(frame_options(150, 150), draws);
        for (const SamplePattern& pattern : sample_patterns()) {
            for (const int64_t set : instruction_sets()) {
                const UseInstructionSet use(set);
                EXPECT_GT(expect_left_blocks_agree(frame, pattern, cover_by_hash), 20u) << "seed " << seed;
            }
        }
    }
}

TEST(Visibility, IsTheSameOnEveryInstructionSet) {
    const MixedScene scene(20, 200);
    const Frame frame(frame_options(100, 70), scene.draws);
    for (const SamplePattern& pattern : sample_patterns()) {
        const Picture expected = draw_frame(frame, pattern, cover_by_hash);
        for (const int64_t set : instruction_sets()) {
            const UseInstructionSet use(set);
            EXPECT_EQ(draw_frame(frame, pattern, cover_by_hash), expected) << name_of(set);
        }
    }
}

TEST(Visibility, DoesNotDependOnTileSizeThreadsOrCrop) {
    for (uint32_t seed = 30; seed < 33; ++seed) {
        // More than one batch of triangles.
        const MixedScene scene(seed, 2000);
        for (const SamplePattern& pattern : sample_patterns()) {
            const Picture expected = draw_frame(Frame(frame_options(150, 90), scene.draws), pattern, cover_by_hash);
            for (const int tile_size : {8, 32, 128}) {
                EXPECT_EQ(draw_frame(Frame(frame_options(150, 90, tile_size), scene.draws), pattern, cover_by_hash), expected) << tile_size;
            }
            EXPECT_EQ(draw_frame(Frame(frame_options(150, 90), scene.draws, threaded_for(5)), pattern, cover_by_hash), expected);
            FrameOptions cropped = frame_options(150, 90, 32);
            cropped.crop_x = 41;
            cropped.crop_y = 37;
            cropped.crop_width = 50;
            cropped.crop_height = 1;
            const Picture part = draw_frame(Frame(cropped, scene.draws), pattern, cover_by_hash);
            for (int x = cropped.crop_x; x < cropped.crop_x + cropped.crop_width; ++x) {
                const size_t pixel = size_t(cropped.crop_y * 150 + x);
                ASSERT_EQ(part.id[pixel], expected.id[pixel]) << x;
                ASSERT_EQ(part.depth[pixel], expected.depth[pixel]) << x;
            }
        }
    }
}

TEST(Visibility, DoesNotDependOnTheOrderOfSubmission) {
    const MixedScene scene(40, 200);
    const Picture expected = draw_frame(Frame(frame_options(120, 80), scene.draws), {}, cover_by_hash);
    std::vector<Draw> draws = scene.draws;
    std::mt19937 random(7);
    for (int round = 0; round < 20; ++round) {
        std::shuffle(draws.begin(), draws.end(), random);
        EXPECT_EQ(draw_frame(Frame(frame_options(120, 80), draws), {}, cover_by_hash), expected) << "round " << round;
    }
}

TEST(Visibility, GivesCoplanarCopiesToTheSmallestIdWhateverTheirVertexOrder) {
    std::mt19937 random(8);
    uint64_t samples = 0, covered = 0;
    for (int round = 0; round < 300 * stress_scale(); ++round) {
        // Large and steep, near plane and guard band included, so that depths have many bits to disagree in.
        const float size = std::exp2(uniform(random, -2, 12));
        const auto corner = [&] {
            return glm::vec3(uniform(random, -size, size), uniform(random, -size, size), uniform(random, -2 * size, 0.5f));
        };
        std::array<glm::vec3, 3> p = {corner(), corner(), corner()};
        std::array<int, 3> order = {0, 1, 2};
        Mesh mesh;
        do mesh.add(p[size_t(order[0])], p[size_t(order[1])], p[size_t(order[2])]);
        while (std::next_permutation(order.begin(), order.end()));
        std::vector<Draw> draws;
        for (uint32_t copy = 0; copy < 6; ++copy) {
            Draw draw = mesh.draw(perspective(1.2f, 1, 0.05f));
            draw.indices += 3 * copy;
            draw.triangle_count = 1;
            draw.first_triangle_id = (copy * 5 + 3) % 6;
            draw.coverage = CoverageClass(random() % 3);
            draws.push_back(draw);
        }
        std::shuffle(draws.begin(), draws.end(), random);
        const Picture picture = draw_frame(Frame(frame_options(64, 64), draws), sample_patterns()[round % 5]);
        for (size_t i = 0; i < picture.id.size(); ++i) {
            ASSERT_TRUE(picture.id[i] == 0 || picture.id[i] == kNoTriangle)
                << "id " << picture.id[i] << " at entry " << i << " in round " << round;
            covered += picture.id[i] == 0;
        }
        samples += picture.id.size();
    }
    EXPECT_GT(covered, 50000u);
    tell_tested(samples);
    tell_worst_case("samples_of_another_copy", 0);
}

TEST(Visibility, AsksTheCoveragePolicyOnlyForCandidatesInFrontSoFar) {
    const MixedScene scene(50, 200);
    const Frame frame(frame_options(100, 70), scene.draws);
    for (const SamplePattern& pattern : sample_patterns()) {
        std::vector<float> opaque(100 * 70);
        std::vector<Draw> opaque_draws;
        std::copy_if(scene.draws.begin(), scene.draws.end(), std::back_inserter(opaque_draws),
                     [](const Draw& draw) { return draw.coverage == CoverageClass::Opaque; });
        opaque = draw_frame(Frame(frame_options(100, 70), opaque_draws), pattern).depth;
        int waves = 0;
        const auto check = [&](const CandidateWave& wave) {
            ++waves;
            EXPECT_EQ(wave.x % kBlockWidth, 0);
            EXPECT_EQ(wave.y % kBlockHeight, 0);
            EXPECT_NE(wave.mask, 0u);
            EXPECT_EQ(wave.triangle, &frame.triangle(wave.setup_index));
            EXPECT_NE(wave.triangle->coverage, CoverageClass::Opaque);
            for (int lane = 0; lane < 32; ++lane) {
                const int x = wave.x + lane % 8, y = wave.y + lane / 8;
                EXPECT_EQ(wave.offset[lane], pattern.at(x, y)) << "lane " << lane;
                if ((wave.mask >> lane & 1u) == 0) continue;
                EXPECT_TRUE(x < 100 && y < 70);
                const float depth =
                    reference::depth_at(*wave.triangle, int64_t{x} * 512 + wave.offset[lane].x, int64_t{y} * 512 + wave.offset[lane].y);
                EXPECT_GE(depth, opaque[size_t(y * 100 + x)]);
            }
            return cover_by_hash(wave);
        };
        draw_frame(frame, pattern, check);
        EXPECT_GT(waves, 100);
    }
}

TEST(Visibility, SkipsWhatOpaqueGeometryHidesAndCountsIt) {
    // Front to back, full-screen layers: all but the first are hidden everywhere. Back to front nothing is.
    Mesh mesh;
    for (int layer = 0; layer < 5; ++layer) {
        const float z = 0.9f - 0.1f * float(layer);
        mesh.add({-64, -64, z}, {256, -64, z}, {-64, 256, z});
    }
    Draw draw = mesh.draw(clip_from_pixels(64, 64));
    const Frame front_to_back(frame_options(64, 64), {&draw, 1});
    TileVisibility tile;
    tile_visibility_opaque(front_to_back, 0, 0, {}, tile);
    EXPECT_EQ(tile.hiz_rejected, 4u * 64u);
    EXPECT_TRUE(std::all_of(tile.triangle.begin(), tile.triangle.end(), [](uint32_t t) { return t == 0; }));

    std::vector<uint32_t> reversed(mesh.indices.rbegin(), mesh.indices.rend());
    draw.indices = reversed.data();
    const Frame back_to_front(frame_options(64, 64), {&draw, 1});
    tile_visibility_opaque(back_to_front, 0, 0, {}, tile);
    EXPECT_EQ(tile.hiz_rejected, 0u);
    EXPECT_TRUE(std::all_of(tile.triangle.begin(), tile.triangle.end(), [](uint32_t t) { return t == 4; }));
}

TEST(Visibility, LetsAnEarlierTriangleOfEqualDepthThroughWhatHidesTheTile) {
    Mesh mesh;
    for (int copy = 0; copy < 2; ++copy) mesh.add({-64, -64, 0.5f}, {256, -64, 0.5f}, {-64, 256, 0.5f});
    std::vector<Draw> draws(2, mesh.draw(clip_from_pixels(64, 64)));
    draws[0].triangle_count = draws[1].triangle_count = 1;
    draws[0].coverage = CoverageClass::Masked;
    draws[1].first_triangle_id = 1;
    const Picture picture = draw_frame(Frame(frame_options(64, 64), draws), {});
    EXPECT_TRUE(std::all_of(picture.id.begin(), picture.id.end(), [](uint32_t id) { return id == 0; }));
}

TEST(Visibility, HoldsNoTriangleOutsideTheFrame) {
    Mesh mesh;
    mesh.add({-100, -100, 0.5f}, {1000, -100, 0.5f}, {-100, 1000, 0.5f});
    const Draw draw = mesh.draw(clip_from_pixels(64, 64));
    const Frame frame(frame_options(43, 5), {&draw, 1});
    TileVisibility tile;
    for (const SampleOffset offset : {SampleOffset{}, SampleOffset{-511, 1023}}) {
        tile_visibility_opaque(frame, 0, 0, {offset, nullptr}, tile);
        for (int i = 0; i < 64 * 64; ++i) {
            const bool inside = i % 64 < 43 && i / 64 < 5;
            EXPECT_EQ(tile.triangle[size_t(i)], inside ? 0u : kNoTriangle) << "entry " << i;
            EXPECT_EQ(tile.depth[size_t(i)], inside ? 0.5f : 0.0f) << "entry " << i;
        }
    }
}

TEST(Visibility, HoldsATriangleAtTheFarPlane) {
    Mesh mesh;
    mesh.add({-100, -100, 0}, {1000, -100, -0.0f}, {-100, 1000, 0});
    const Draw draw = mesh.draw(clip_from_pixels(8, 8));
    const Picture picture = draw_frame(Frame(frame_options(8, 8), {&draw, 1}), {});
    EXPECT_TRUE(std::all_of(picture.id.begin(), picture.id.end(), [](uint32_t id) { return id == 0; }));
}

}  // namespace
}  // namespace rawtexel::raster
