// Coverage at the limits of its integers, held against 128 bits: triangles about the size where 32 bits take over, at the far corner of the
// largest frame, sampled as far from their pixels as a filter may.
#include "tests/raster/drawing.h"
#include "tests/reference/raster/exact_coverage.h"
#include "tests/stress/worst_case.h"
#include "tests/stress_scale.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace rawtexel::raster {
namespace {

using namespace testing;

constexpr int kTile = 64;

FrameOptions widest_frame() {
    FrameOptions options;
    options.width = options.height = kMaxFrameExtent;
    options.filter_radius = float(kMostFilterRadius);
    options.crop_x = options.crop_y = kMaxFrameExtent - kTile;
    options.crop_width = options.crop_height = kTile;
    return options;
}

TEST(IntegerRange, TrianglesOfEverySizeAreExactAtTheCornerOfTheLargestFrame) {
    std::mt19937 random(31);
    uint64_t samples = 0, covered = 0, small = 0, large = 0;
    std::vector<SampleOffset> offsets(kTile * kTile);
    TileVisibility tile;
    for (int round = 0; round < 1500 * stress_scale(); ++round) {
        // Sizes of a pixel, of 32 give or take what decides, and of the guard band; vertices on 1/256 pixel, as floats hold them here.
        const int kind = int(random() % 4);
        const float size = kind == 0 ? 1.0f : kind == 1 ? 32.0f : kind == 2 ? 32.0f + 1.0f / 128 : 16000.0f;
        const float x = uniform(random, 16384 - 70, 16384 + 4), y = uniform(random, 16384 - 70, 16384 + 4);
        const auto on_grid = [](float v) { return std::round(v * 256.0f) / 256.0f; };
        const auto corner = [&](bool right, bool low) {
            const float spread = random() % 3 == 0 ? uniform(random, 0, size) : 0.0f;
            return glm::vec3(on_grid(x + (right ? size - spread : spread)), on_grid(y + (low ? size - spread : spread)), 0.5f);
        };
        Mesh mesh;
        mesh.add(corner(random() % 2, false), corner(true, random() % 2), corner(false, true));
        const Draw draw = mesh.draw(clip_from_pixels(kMaxFrameExtent, kMaxFrameExtent));
        const Frame frame(widest_frame(), {&draw, 1});
        if (frame.triangle_count() != 1) continue;
        const SetupTriangle& triangle = frame.triangle(0);
        const auto [low, high] = std::minmax({triangle.x[0], triangle.x[1], triangle.x[2]});
        ++(high - low <= 32 * 256 ? small : large);
        const reference::SnappedTriangle snapped = reference::snapped(triangle);
        const int reach = kMostFilterRadius * 512 - 1;
        for (const bool per_pixel : {false, true}) {
            SamplePattern pattern{{}, per_pixel, reach, uint32_t(random())};
            pattern.frame = {256 + (random() % 2 ? reach : -reach), 256 + (random() % 2 ? reach : -reach)};
            const int first = kMaxFrameExtent - kTile, last_tile = kMaxFrameExtent / kTile - 1;
            for (int i = 0; i < kTile * kTile; ++i) offsets[size_t(i)] = pattern.at(first + i % kTile, first + i / kTile);
            draw_tile(
                frame, last_tile, last_tile, {pattern.frame, per_pixel ? offsets.data() : nullptr},
                [](const CandidateWave& wave) { return wave.mask; }, tile);
            for (int i = 0; i < kTile * kTile; ++i) {
                const SampleOffset offset = offsets[size_t(i)];
                const bool expected =
                    reference::covers(snapped, int64_t{first + i % kTile} * 512 + offset.x, int64_t{first + i / kTile} * 512 + offset.y);
                ASSERT_EQ(tile.triangle[size_t(i)] != kNoTriangle, expected)
                    << "pixel " << i % kTile << "," << i / kTile << " offset " << offset.x << "," << offset.y << " round " << round;
                covered += expected;
            }
            samples += kTile * kTile;
        }
    }
    EXPECT_GT(small, 100u);
    EXPECT_GT(large, 100u);
    EXPECT_GT(covered, 10000u);
    tell_tested(samples);
    tell_worst_case("covered", covered);
    tell_worst_case("differences_from_128_bits", 0);
}

}  // namespace
}  // namespace rawtexel::raster
