// Whatever is left out changes nothing that is seen, and is left out where it should be.
#include "raster/occlusion.h"
#include "tests/raster/drawing.h"
#include "tests/raster/scenes.h"
#include "tests/stress/worst_case.h"
#include "tests/stress_scale.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace rawtexel::raster {
namespace {

using namespace testing;

struct Switch {
    const char* name;
    bool RasterSkips::*on;
};
constexpr std::array kSwitches{Switch{"clusters", &RasterSkips::clusters}, Switch{"frustum", &RasterSkips::frustum},
                               Switch{"backface", &RasterSkips::backface}, Switch{"occlusion", &RasterSkips::occlusion},
                               Switch{"hiz", &RasterSkips::hiz}};

/// Bent walls before and behind crowds of small triangles, closed balls, and a mesh without order; seen from anywhere.
class CrowdedScene {
  public:
    explicit CrowdedScene(uint32_t seed) : random_(seed), meshes_(5) {
        const float bend = uniform(random_, 0, 0.4f), depth = uniform(random_, -3, -1);
        add_sheet(meshes_[0], 1 + int(random_() % 24), 2.5f, [&](float x, float y) { return depth + bend * std::sin(3 * x + y); });
        add_sheet(meshes_[1], 60, 3.0f, [&](float x, float y) { return depth - 1.5f + 0.2f * std::cos(9 * x) * std::sin(7 * y); });
        add_ball(meshes_[2], 40);
        for (int i = 0; i < 400; ++i) {
            const auto any = [&] { return glm::vec3(uniform(random_, -2, 2), uniform(random_, -2, 2), uniform(random_, -8, 0.3f)); };
            const glm::vec3 corner = any();
            meshes_[3].add(corner, corner + 0.1f * any(), corner + 0.1f * any());
        }
        add_sheet(meshes_[4], 7, 1.5f, [&](float x, float) { return depth + 0.3f + 0.1f * x; });
        const glm::mat4 clip = perspective(1.5f, 1, 0.1f);
        const auto at = [&](float x, float y, float z, bool mirrored) {
            return clip * glm::mat4{mirrored ? -1 : 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, x, y, z, 1};
        };
        for (size_t i = 0; i < 5; ++i) add(meshes_[i], clip, CullMode(random_() % 2), false);
        for (int i = 0; i < 12; ++i) {
            const bool mirrored = random_() % 2 != 0;
            add(meshes_[2], at(uniform(random_, -2, 2), uniform(random_, -2, 2), uniform(random_, -6, -0.5f), mirrored), CullMode::Back,
                mirrored);
        }
        draws[4].coverage = CoverageClass::Masked;
        draws[3].coverage = CoverageClass::Blended;
    }
    CrowdedScene(const CrowdedScene&) = delete;
    CrowdedScene& operator=(const CrowdedScene&) = delete;

    std::vector<Draw> draws;

  private:
    void add(const Mesh& mesh, const glm::mat4& clip, CullMode cull, bool mirrored) {
        Draw draw = mesh.draw(clip);
        draw.cull = cull;
        draw.front_is_clockwise = mirrored;
        draw.first_triangle_id = next_id_;
        next_id_ += draw.triangle_count;
        draws.push_back(draw);
    }

    /// Faces the eye.
    template <class Height>
    void add_sheet(Mesh& mesh, int cells, float half, Height&& height) {
        const uint32_t first = uint32_t(mesh.positions.size()), stride = uint32_t(cells) + 1;
        for (int j = 0; j <= cells; ++j)
            for (int i = 0; i <= cells; ++i) {
                const float x = (2 * float(i) / float(cells) - 1) * half, y = (2 * float(j) / float(cells) - 1) * half;
                mesh.positions.emplace_back(x, y, height(x, y));
            }
        for (uint32_t j = 0; j < uint32_t(cells); ++j)
            for (uint32_t i = 0; i < uint32_t(cells); ++i) {
                const uint32_t a = first + j * stride + i;
                for (const uint32_t v : {a, a + 1, a + stride, a + 1, a + stride + 1, a + stride}) mesh.indices.push_back(v);
            }
    }

    void add_ball(Mesh& mesh, int rings) {
        const uint32_t stride = uint32_t(rings) + 1;
        for (int j = 0; j <= rings; ++j)
            for (int i = 0; i <= rings; ++i) {
                const float turn = 6.2831853f * float(i % rings) / float(rings), rise = 3.1415927f * float(j) / float(rings);
                mesh.positions.push_back(0.3f *
                                         glm::vec3(std::cos(turn) * std::sin(rise), std::cos(rise), -std::sin(turn) * std::sin(rise)));
            }
        for (uint32_t j = 0; j < uint32_t(rings); ++j)
            for (uint32_t i = 0; i < uint32_t(rings); ++i) {
                const uint32_t a = j * stride + i;
                for (const uint32_t v : {a, a + stride, a + 1, a + 1, a + stride, a + stride + 1}) mesh.indices.push_back(v);
            }
    }

    std::mt19937 random_;
    std::vector<Mesh> meshes_;
    uint32_t next_id_ = 0;
};

/// A pass's offsets, and what a frame of it may expect.
struct Pass {
    std::string name;
    SamplePattern pattern;
    float radius;
    std::optional<OffsetRange> reach;
};

/// Box, tent and Gaussian; offsets of the frame and of the pixel; border pixels are those of the whole frame.
std::vector<Pass> passes() {
    std::vector<Pass> all;
    for (const float radius : {0.5f, 1.0f, 1.5f}) {
        const int32_t far = int32_t(radius * 512) - 1;
        all.push_back({"centre", {}, radius, OffsetRange{256, 256, 256, 256}});
        all.push_back({"frame", {{256 - far, 256 + far}}, radius, OffsetRange{256 - far, 256 - far, 256 + far, 256 + far}});
        all.push_back({"one of several", {{256 + far, 255}}, radius, OffsetRange{256 - far, 256 + far, 1, 511}});
        all.push_back({"pixel", {{}, true, far, 11}, radius, std::nullopt});
    }
    return all;
}

FrameOptions options_of(const Pass& pass, const RasterSkips& skips, int tile_size = 64) {
    FrameOptions options;
    options.width = 203;
    options.height = 117;
    options.tile_size = tile_size;
    options.filter_radius = pass.radius;
    options.reach = pass.reach;
    options.skips = skips;
    return options;
}

TEST(Skips, ChangeNoPixelWhicheverIsOff) {
    FrameCounts sum;
    uint64_t samples = 0;
    for (uint32_t seed = 1; seed <= uint32_t(3 * stress_scale()); ++seed) {
        const CrowdedScene scene(seed);
        for (const Pass& pass : passes()) {
            RasterSkips none;
            for (const Switch& one : kSwitches) none.*one.on = false;
            const Frame plain(options_of(pass, none), scene.draws);
            const Picture expected = draw_frame(plain, pass.pattern, cover_by_hash);
            // All on, one after the other off, and in the order of the scene.
            samples += expected.id.size() * (kSwitches.size() + 2);
            const Frame skipping(options_of(pass, {}), scene.draws);
            ASSERT_EQ(draw_frame(skipping, pass.pattern, cover_by_hash), expected) << "all on, " << pass.name << ", seed " << seed;
            sum += skipping.counts();
            for (const Switch& one : kSwitches) {
                RasterSkips skips;
                skips.*one.on = false;
                const Frame frame(options_of(pass, skips, 32), scene.draws);
                ASSERT_EQ(draw_frame(frame, pass.pattern, cover_by_hash), expected)
                    << one.name << " off, " << pass.name << ", seed " << seed;
            }
            FrameOptions ordered = options_of(pass, {});
            ordered.scene_order = true;
            ASSERT_EQ(draw_frame(Frame(ordered, scene.draws), pass.pattern, cover_by_hash), expected) << "scene order, " << pass.name;
        }
    }
    EXPECT_GT(sum.culled_frustum, 0u);
    EXPECT_GT(sum.culled_backface, 0u);
    EXPECT_GT(sum.culled_unsampled, 0u);
    EXPECT_GT(sum.culled_occluded, 10000u);
    tell_tested(samples);
    tell_worst_case("culled_occluded", sum.culled_occluded);
    tell_worst_case("samples_that_differ", 0);
}

TEST(Skips, LeaveTheFatesOfAFrameTheSameForAnyThreadsAndTiles) {
    const CrowdedScene scene(9);
    for (const Pass& pass : passes()) {
        const FrameCounts one = Frame(options_of(pass, {}), scene.draws).counts();
        const FrameCounts many = Frame(options_of(pass, {}), scene.draws, threaded_for(5)).counts();
        const FrameCounts small = Frame(options_of(pass, {}, 32), scene.draws).counts();
        for (const auto counter : {&FrameCounts::triangles, &FrameCounts::culled_frustum, &FrameCounts::culled_backface,
                                   &FrameCounts::binned, &FrameCounts::culled_degenerate, &FrameCounts::culled_small,
                                   &FrameCounts::culled_unsampled, &FrameCounts::culled_occluded, &FrameCounts::clipped}) {
            EXPECT_EQ(one.*counter, many.*counter) << pass.name;
            EXPECT_EQ(one.*counter, small.*counter) << pass.name;
        }
    }
}

/// A wall of n x n cells that fills the view, nearer than sheets of 100 x 100.
FrameCounts behind_a_wall(int n, bool gap) {
    Mesh wall, crowd;
    const auto add_grid = [](Mesh& mesh, int cells, float z, bool leave_one_out) {
        const float size = 256.0f / float(cells);
        for (int j = 0; j < cells; ++j)
            for (int i = 0; i < cells; ++i) {
                if (leave_one_out && i == cells / 2 && j == cells / 2) continue;
                const auto at = [&](int x, int y) { return glm::vec3(float(x) * size, float(y) * size, z); };
                mesh.add(at(i, j), at(i, j + 1), at(i + 1, j));
                mesh.add(at(i + 1, j), at(i, j + 1), at(i + 1, j + 1));
            }
    };
    add_grid(wall, n, 0.8f, gap);
    add_grid(crowd, 100, 0.3f, false);
    std::vector<Draw> draws{crowd.draw(clip_from_pixels(256, 256)), wall.draw(clip_from_pixels(256, 256))};
    draws[1].first_triangle_id = draws[0].triangle_count;
    FrameOptions options;
    options.width = options.height = 256;
    options.filter_radius = 0.0f;
    return Frame(options, draws).counts();
}

TEST(Occlusion, HidesAllThatIsBehindAWallOfOneCellOrMany) {
    for (const int cells : {1, 2, 5, 16, 40}) EXPECT_EQ(behind_a_wall(cells, false).culled_occluded, 20000u) << cells << " cells";
}

TEST(Occlusion, LeavesWhatAGapInTheWallShows) {
    for (const int cells : {5, 16, 40}) {
        const uint64_t behind = uint64_t(20000 / (cells * cells));
        EXPECT_LE(behind_a_wall(cells, true).culled_occluded, 20000 - behind) << cells << " cells";
        EXPECT_GE(behind_a_wall(cells, true).culled_occluded, cells < 10 ? 15000u : 18000u) << cells << " cells";
    }
}

}  // namespace
}  // namespace rawtexel::raster
