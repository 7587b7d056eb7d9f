// Whole clusters are left out only with every one of their triangles: the same triangles reach the bins with and without.
#include "tests/raster/drawing.h"
#include "tests/stress/worst_case.h"
#include "tests/stress_scale.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace rawtexel::raster {
namespace {

using namespace testing;

/// A bent patch of cells far from square, so that snapping turns many over where it is seen edge-on or from afar.
Mesh patch(std::mt19937& random) {
    const int columns = 2 + int(random() % 20), rows = 2 + int(random() % 20);
    const float width = std::exp2(uniform(random, -3, 3)), height = std::exp2(uniform(random, -9, 3)), bend = uniform(random, 0, 0.3f);
    Mesh mesh;
    for (int j = 0; j <= rows; ++j)
        for (int i = 0; i <= columns; ++i) {
            const float x = width * (float(i) / float(columns) - 0.5f), y = height * (float(j) / float(rows) - 0.5f);
            mesh.positions.emplace_back(x, y, bend * x * x + 0.01f * bend * uniform(random, -1, 1) * height);
        }
    for (uint32_t j = 0; j < uint32_t(rows); ++j)
        for (uint32_t i = 0; i < uint32_t(columns); ++i) {
            const uint32_t stride = uint32_t(columns) + 1, a = j * stride + i;
            for (const uint32_t v : {a, a + 1, a + stride, a + 1, a + stride + 1, a + stride}) mesh.indices.push_back(v);
        }
    return mesh;
}

std::vector<uint32_t> binned(const Frame& frame) {
    std::vector<uint32_t> ids;
    frame.for_each_triangle([&](uint32_t, const SetupTriangle& triangle) { ids.push_back(triangle.triangle_id); });
    std::sort(ids.begin(), ids.end());
    return ids;
}

TEST(ClusterCull, LeavesNoTriangleOutThatReachesABin) {
    std::mt19937 random(41);
    uint64_t triangles = 0, reached = 0, fewer_by_clusters = 0;
    for (int round = 0; round < 4000 * stress_scale(); ++round) {
        const Mesh mesh = patch(random);
        const bool mirrored = random() % 2 != 0, flat = random() % 4 == 0;
        glm::mat4 object = random_rotation(random);
        if (mirrored) object[0] = -object[0];
        const float distance = std::exp2(uniform(random, -1, 9));
        object[3] = glm::vec4(uniform(random, -0.6f, 0.6f) * distance, uniform(random, -0.6f, 0.6f) * distance, -distance, 1);
        // An orthographic view, or one in perspective.
        const glm::mat4 camera =
            flat ? glm::mat4{0.4f, 0, 0, 0, 0, 0.4f, 0, 0, 0, 0, 1.0f / 1024, 0, 0, 0, 1, 1} : perspective(1.5f, 1, 0.05f);
        Draw draw = mesh.draw(camera * object);
        draw.cull = CullMode::Back;
        draw.front_is_clockwise = mirrored;
        FrameOptions options;
        options.width = 1024;
        options.height = 1024;
        options.filter_radius = 1.5f;
        options.skips.occlusion = false;
        const Frame with(options, {&draw, 1});
        options.skips.clusters = false;
        const Frame without(options, {&draw, 1});
        ASSERT_EQ(binned(with), binned(without)) << "round " << round << ", " << distance << " away";
        triangles += with.counts().triangles;
        reached += with.counts().binned;
        // Of a culled cluster every triangle counts as what its cluster is.
        fewer_by_clusters += with.counts().culled_backface != without.counts().culled_backface;
    }
    EXPECT_GT(reached, triangles / 20);
    tell_tested(triangles, "triangles");
    tell_worst_case("reached_a_bin", reached);
    tell_worst_case("patches_whose_clusters_were_culled_from_behind", fewer_by_clusters);
    tell_worst_case("wrongly_left_out", 0);
}

/// Walls with holes, seams that do not close and overlaps, before a crowd: what shows through is drawn.
TEST(OcclusionStress, ShowsWhatAnyGapInAWallShows) {
    std::mt19937 random(42);
    constexpr float kDeep = 256;
    uint64_t samples = 0, occluded = 0, triangles = 0, seen_through = 0;
    for (int round = 0; round < 150 * stress_scale(); ++round) {
        Mesh wall, crowd;
        const int cells = 1 + int(random() % 30), size = 192;
        const float cell = float(size + 20) / float(cells), gap = random() % 3 == 0 ? 1.0f / 256 : random() % 2 == 0 ? 0.0f : -0.5f;
        for (int j = 0; j < cells; ++j)
            for (int i = 0; i < cells; ++i) {
                if (random() % 100 == 0) continue;
                const bool loose = random() % 20 == 0;
                const float x0 = float(i) * cell - 10, y0 = float(j) * cell - 10, x1 = x0 + cell - (loose ? gap : 0.0f), y1 = y0 + cell;
                const float z = 0.7f + (random() % 8 == 0 ? uniform(random, -0.3f, 0.2f) : 0.0f);
                wall.add({x0, y0, z}, {x0, y1, z}, {x1, y0, z});
                if (random() % 200 != 0) wall.add({x1, y0, z}, {x0, y1, z}, {x1, y1, z});
            }
        for (int i = 0; i < 9000; ++i) {
            // As deep as it is wide, so that what makes a cluster is near one another in depth, too.
            const float x = uniform(random, -5, float(size) + 5), y = uniform(random, -5, float(size) + 5),
                        z = kDeep * uniform(random, 0.1f, 0.72f);
            crowd.add({x, y, z}, {x, y + 4, z}, {x + 4, y, z});
        }
        glm::mat4 flatten(1.0f);
        flatten[2][2] = 1.0f / kDeep;
        std::vector<Draw> draws{crowd.draw(clip_from_pixels(size, size) * flatten), wall.draw(clip_from_pixels(size, size))};
        draws[1].first_triangle_id = draws[0].triangle_count;
        draws[1].cull = CullMode(random() % 2);
        FrameOptions options;
        options.width = options.height = size;
        options.filter_radius = 1.5f;
        const SamplePattern pattern = sample_patterns()[size_t(round) % 5];
        if (!pattern.per_pixel) options.reach = OffsetRange{pattern.frame.x, pattern.frame.x, pattern.frame.y, pattern.frame.y};
        const Frame with(options, draws);
        options.skips.occlusion = false;
        const Picture plain = draw_frame(Frame(options, draws), pattern);
        ASSERT_EQ(draw_frame(with, pattern), plain) << "round " << round << ", " << cells << " cells, gap " << gap;
        samples += plain.id.size();
        occluded += with.counts().culled_occluded;
        triangles += with.counts().triangles;
        seen_through +=
            uint64_t(std::count_if(plain.id.begin(), plain.id.end(), [&](uint32_t id) { return id < draws[1].first_triangle_id; }));
    }
    EXPECT_GT(occluded, triangles / 20);
    EXPECT_GT(seen_through, 1000u);
    tell_tested(samples);
    tell_worst_case("occluded_of_triangles", std::to_string(occluded) + " of " + std::to_string(triangles));
    tell_worst_case("samples_that_show_the_crowd", seen_through);
    tell_worst_case("samples_that_differ", 0);
}

}  // namespace
}  // namespace rawtexel::raster
