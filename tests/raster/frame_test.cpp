// Every triangle has one fate, and the right one; bins hold what their tiles need, in order.
#include "raster/frame.h"
#include "tests/raster/drawing.h"
#include "tests/raster/scenes.h"
#include "tests/reference/raster/exact_coverage.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

namespace rawtexel::raster {
namespace {

using namespace testing;

FrameOptions frame_options(int width, int height, float filter_radius = 0.5f) {
    FrameOptions options;
    options.width = width;
    options.height = height;
    options.filter_radius = filter_radius;
    return options;
}

uint64_t fates(const FrameCounts& c) {
    return c.culled_frustum + c.culled_backface + c.culled_degenerate + c.culled_small + c.culled_unsampled + c.culled_occluded +
           c.culled_nonfinite + c.binned;
}

/// One triangle of pixel coordinates in a 64x64 frame.
FrameCounts fate_of(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, CullMode cull = CullMode::None, bool mirrored = false,
                    float filter_radius = 0.5f) {
    Mesh mesh;
    mesh.add(a, b, c);
    Draw draw = mesh.draw(clip_from_pixels(64, 64));
    draw.cull = cull;
    draw.front_is_clockwise = mirrored;
    return Frame(frame_options(64, 64, filter_radius), {&draw, 1}).counts();
}

TEST(Frame, GivesEveryTriangleExactlyOneFate) {
    FrameCounts sum;
    for (uint32_t seed = 1; seed <= 5; ++seed) {
        MixedScene scene(seed, 3000);
        scene.meshes[0].positions[0].x = std::numeric_limits<float>::quiet_NaN();
        scene.meshes[1].positions[1] = scene.meshes[1].positions[0];
        FrameOptions options = frame_options(200, 120, 0.0f);
        if (seed % 2) {
            options.crop_x = 70;
            options.crop_width = options.crop_height = 20;
        }
        const Frame frame(options, scene.draws);
        uint64_t triangles = 0;
        for (const Draw& draw : scene.draws) triangles += draw.triangle_count;
        EXPECT_EQ(frame.counts().triangles, triangles);
        EXPECT_EQ(fates(frame.counts()), triangles) << "seed " << seed;
        std::set<uint32_t> in_bins;
        for (int y = 0; y < frame.tiles_y(); ++y) {
            for (int x = 0; x < frame.tiles_x(); ++x) {
                for (const uint32_t index : frame.bin(x, y)) in_bins.insert(frame.triangle(index).triangle_id);
            }
        }
        EXPECT_EQ(in_bins.size(), frame.counts().binned);
        sum += frame.counts();
    }
    for (const uint64_t seen :
         {sum.culled_frustum, sum.culled_backface, sum.culled_degenerate, sum.culled_small, sum.culled_nonfinite, sum.clipped}) {
        EXPECT_GT(seen, 0u);
    }
}

TEST(Frame, CullsBackFacesBySnappedWindingAndMirroring) {
    const glm::vec3 a(8, 8, 0.5f), b(8, 40, 0.5f), c(40, 8, 0.5f);  // counter-clockwise on the screen, y down
    EXPECT_EQ(fate_of(a, b, c, CullMode::Back).binned, 1u);
    EXPECT_EQ(fate_of(a, c, b, CullMode::Back).culled_backface, 1u);
    EXPECT_EQ(fate_of(a, b, c, CullMode::Back, true).culled_backface, 1u);
    EXPECT_EQ(fate_of(a, c, b, CullMode::Back, true).binned, 1u);
    EXPECT_EQ(fate_of(a, c, b, CullMode::None).binned, 1u);
}

TEST(Frame, TellsFrontFromBackInEveryVertexOrder) {
    const glm::vec3 p[3] = {{8, 8, 0.5f}, {8, 40, 0.5f}, {40, 8, 0.5f}};
    const int orders[6][4] = {{0, 1, 2, 1}, {1, 2, 0, 1}, {2, 0, 1, 1}, {0, 2, 1, 0}, {2, 1, 0, 0}, {1, 0, 2, 0}};
    for (const auto& order : orders) {
        Mesh mesh;
        mesh.add(p[order[0]], p[order[1]], p[order[2]]);
        const Draw draw = mesh.draw(clip_from_pixels(64, 64));
        const Frame frame(frame_options(64, 64), {&draw, 1});
        EXPECT_EQ(frame.triangle(0).front_facing, order[3] == 1);
    }
}

TEST(Frame, CullsTrianglesWithoutAreaOnceSnapped) {
    EXPECT_EQ(fate_of({1, 1, 0.5f}, {9, 9, 0.5f}, {5, 5, 0.5f}).culled_degenerate, 1u);
    EXPECT_EQ(fate_of({1, 1, 0.5f}, {1.0005f, 9, 0.5f}, {1.001f, 5, 0.5f}).culled_degenerate, 1u);
    EXPECT_EQ(fate_of({1, 1, 0.5f}, {1.004f, 9, 0.5f}, {1, 5, 0.5f}).culled_degenerate, 0u);
}

TEST(Frame, CullsAsSmallOnlyWhatNoSamplePointCanHit) {
    std::mt19937 random(1);
    for (const float radius : {0.0f, 0.1f, 0.25f, 0.5f, 1.0f, 1.5f}) {
        const int reach = int(std::ceil(radius * 512));
        uint64_t small = 0;
        for (int i = 0; i < 4000; ++i) {
            const float x = uniform(random, 2, 60), y = uniform(random, 2, 60), size = std::exp2(uniform(random, -7, 1));
            const auto corner = [&] { return glm::vec3(x + uniform(random, -size, size), y + uniform(random, -size, size), 0.5f); };
            const glm::vec3 p[3] = {corner(), corner(), corner()};
            if (fate_of(p[0], p[1], p[2], CullMode::None, false, radius).culled_small == 0) continue;
            ++small;
            reference::SnappedTriangle snapped;
            for (int k = 0; k < 3; ++k) {
                snapped.x[k] = std::lrint(p[k].x * 256.0);
                snapped.y[k] = std::lrint(p[k].y * 256.0);
            }
            // Every sample point near the triangle: centres, and odd offsets within the radius.
            const auto possible = [&](int64_t s) {
                const int64_t within = ((s % 512) + 512) % 512, nearest = std::abs(within - 256);
                return within == 256 || (within % 2 != 0 && (nearest <= reach || 512 - nearest <= reach));
            };
            for (int64_t sy = int64_t((y - size) * 512) - 2; sy <= int64_t((y + size) * 512) + 2; ++sy) {
                for (int64_t sx = int64_t((x - size) * 512) - 2; sx <= int64_t((x + size) * 512) + 2; ++sx) {
                    ASSERT_FALSE(possible(sx) && possible(sy) && reference::covers(snapped, sx, sy))
                        << sx << "," << sy << " radius " << radius;
                }
            }
        }
        EXPECT_EQ(small > 100, radius < 0.5f) << small << " culled at radius " << radius;
        EXPECT_EQ(small == 0, radius >= 0.5f) << small << " culled at radius " << radius;
    }
}

TEST(Frame, CullsAsOutsideOnlyWhatNoSampleOfTheFilterReaches) {
    // Left of the frame by 0.9 pixel: out of reach of samples within 0.5 of the centres, in reach of those within 1.5.
    const glm::vec3 a(-3, -3, 0.5f), b(-0.9f, 30, 0.5f), c(-3, 70, 0.5f);
    EXPECT_EQ(fate_of(a, b, c, CullMode::None, false, 0.5f).culled_frustum, 1u);
    EXPECT_EQ(fate_of(a, b, c, CullMode::None, false, 1.5f).binned, 1u);
    const glm::vec3 d(67, -3, 0.5f), e(64.9f, 30, 0.5f), f(67, 70, 0.5f);
    EXPECT_EQ(fate_of(d, e, f, CullMode::None, false, 0.5f).culled_frustum, 1u);
    EXPECT_EQ(fate_of(d, e, f, CullMode::None, false, 1.5f).binned, 1u);
    EXPECT_EQ(fate_of({8, 8, 1.5f}, {8, 9, 1.5f}, {9, 8, 1.1f}).culled_frustum, 1u) << "before the near plane";
    EXPECT_EQ(fate_of({8, 8, -1}, {8, 9, -1}, {9, 8, -1}).culled_frustum, 1u) << "beyond the far plane";
}

TEST(Frame, SnapsToTheNearestSubpixelTiesToEven) {
    const auto snapped_x = [](float x) {
        Mesh mesh;
        mesh.add({x, 1, 0.5f}, {40, 1, 0.5f}, {40, 40, 0.5f});
        const Draw draw = mesh.draw(clip_from_pixels(64, 64));
        const Frame frame(frame_options(64, 64), {&draw, 1});
        return *std::min_element(frame.triangle(0).x, frame.triangle(0).x + 3);
    };
    EXPECT_EQ(snapped_x(10.0f), 2560);
    EXPECT_EQ(snapped_x(10.0f + 1.0f / 512), 2560);
    EXPECT_EQ(snapped_x(10.0f + 3.0f / 512), 2562);
    EXPECT_EQ(snapped_x(10.0f + 3.01f / 512), 2562);
    EXPECT_EQ(snapped_x(10.0f + 2.99f / 512), 2561);
    EXPECT_EQ(snapped_x(-10.0f - 1.0f / 512), -2560);
}

TEST(Frame, SetsTheSameTriangleUpToTheSameBitsInEveryVertexOrder) {
    std::mt19937 random(2);
    uint64_t clipped = 0;
    for (int round = 0; round < 500; ++round) {
        const float size = std::exp2(uniform(random, -2, 12));
        const auto corner = [&] {
            return glm::vec3(uniform(random, -size, size), uniform(random, -size, size), uniform(random, -2 * size, 0.5f));
        };
        const std::array<glm::vec3, 3> p = {corner(), corner(), corner()};
        std::array<size_t, 3> order = {0, 1, 2};
        std::vector<SetupTriangle> first;
        do {
            Mesh mesh;
            mesh.add(p[order[0]], p[order[1]], p[order[2]]);
            const Draw draw = mesh.draw(perspective(1.2f, 1, 0.05f));
            const Frame frame(frame_options(64, 64), {&draw, 1});
            clipped += frame.counts().clipped;
            if (order == std::array<size_t, 3>{0, 1, 2}) {
                frame.for_each_triangle([&](uint32_t, const SetupTriangle& triangle) { first.push_back(triangle); });
            }
            ASSERT_EQ(frame.triangle_count(), first.size());
            size_t next = 0;
            frame.for_each_triangle([&](uint32_t, const SetupTriangle& b) {
                const SetupTriangle& a = first[next++];
                EXPECT_TRUE(std::ranges::equal(a.x, b.x) && std::ranges::equal(a.y, b.y)) << "round " << round;
                EXPECT_EQ(a.depth_at_origin, b.depth_at_origin) << "round " << round;
                EXPECT_EQ(a.depth_dx, b.depth_dx) << "round " << round;
                EXPECT_EQ(a.depth_dy, b.depth_dy) << "round " << round;
                EXPECT_TRUE(a.depth_min == b.depth_min && a.depth_max == b.depth_max) << "round " << round;
            });
        } while (std::next_permutation(order.begin(), order.end()));
    }
    EXPECT_GT(clipped, 200u);
}

/// Opaque, then masked, then blended; what needs texels in scene order, and opaque geometry where that is asked for.
void expect_ordered_bins(bool scene_order) {
    MixedScene scene(9, 500);
    std::reverse(scene.draws.begin(), scene.draws.end());
    FrameOptions options = frame_options(200, 120);
    options.scene_order = scene_order;
    const Frame frame(options, scene.draws);
    for (int y = 0; y < frame.tiles_y(); ++y) {
        for (int x = 0; x < frame.tiles_x(); ++x) {
            const std::span<const uint32_t> bin = frame.bin(x, y);
            for (size_t i = 1; i < bin.size(); ++i) {
                const SetupTriangle &before = frame.triangle(bin[i - 1]), &after = frame.triangle(bin[i]);
                ASSERT_LE(before.coverage, after.coverage);
                if (before.coverage == CoverageClass::Opaque && after.coverage == CoverageClass::Opaque && !scene_order) {
                    ASSERT_LT(bin[i - 1], bin[i]);
                    continue;
                }
                ASSERT_TRUE(before.coverage != after.coverage || before.triangle_id <= after.triangle_id);
            }
        }
    }
}

TEST(Frame, BinsOpaqueThenMaskedThenBlendedGeometry) { expect_ordered_bins(false); }
TEST(Frame, BinsInSceneOrderWhereAsked) { expect_ordered_bins(true); }

TEST(Frame, IsTheSameForAnyNumberOfThreads) {
    const MixedScene scene(10, 5000);
    const Frame one(frame_options(300, 200), scene.draws);
    for (const int threads : {1, 2, 7}) {
        const Frame other(frame_options(300, 200), scene.draws, threaded_for(threads));
        ASSERT_EQ(other.triangle_count(), one.triangle_count());
        one.for_each_triangle([&](uint32_t i, const SetupTriangle& triangle) {
            ASSERT_EQ(triangle.triangle_id, other.triangle(i).triangle_id);
            ASSERT_EQ(triangle.depth_dx, other.triangle(i).depth_dx);
            ASSERT_EQ(triangle.bary_over_w == nullptr, other.triangle(i).bary_over_w == nullptr);
        });
        for (int y = 0; y < one.tiles_y(); ++y) {
            for (int x = 0; x < one.tiles_x(); ++x) ASSERT_TRUE(std::ranges::equal(one.bin(x, y), other.bin(x, y)));
        }
    }
}

TEST(Frame, BinsOnlyTilesThatTouchTheCrop) {
    Mesh mesh;
    mesh.add({-100, -100, 0.5f}, {2000, -100, 0.5f}, {-100, 2000, 0.5f});
    const Draw draw = mesh.draw(clip_from_pixels(512, 512));
    FrameOptions options = frame_options(512, 512);
    options.crop_x = 100;
    options.crop_y = 200;
    options.crop_width = 29;
    options.crop_height = 1;
    const Frame frame(options, {&draw, 1});
    EXPECT_EQ(frame.counts().tiles, 2u);
    EXPECT_EQ(frame.counts().tiles_empty, 0u);
    for (int y = 0; y < 8; ++y) {
        for (int x = 0; x < 8; ++x) EXPECT_EQ(frame.bin(x, y).size(), y == 3 && (x == 1 || x == 2) ? 1u : 0u) << x << "," << y;
    }
}

TEST(Frame, OfNothingIsEmpty) {
    const Frame frame(frame_options(100, 100), {});
    EXPECT_EQ(frame.counts().triangles, 0u);
    EXPECT_EQ(frame.counts().tiles, 4u);
    EXPECT_EQ(frame.counts().tiles_empty, 4u);
    EXPECT_TRUE(frame.bin(1, 1).empty());
}

TEST(Frame, KeepsItsPiecesWhenMoved) {
    Mesh mesh;
    mesh.add({-3, -1, -5}, {3, -1, -5}, {0, -1, 5});
    const Draw draw = mesh.draw(perspective(1, 1, 0.1f));
    Frame frame(frame_options(64, 64), {&draw, 1});
    ASSERT_EQ(frame.counts().clipped, 1u);
    const Picture before = draw_frame(frame, {});
    const Frame moved(std::move(frame));
    EXPECT_EQ(draw_frame(moved, {}), before);
    EXPECT_NE(moved.triangle(0).bary_over_w, nullptr);
}

}  // namespace
}  // namespace rawtexel::raster
