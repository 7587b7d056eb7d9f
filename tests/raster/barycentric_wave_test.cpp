// Waves of barycentrics in single precision, held against the scalar in double, which interpolate_test.cpp holds against quadruple.
#include "raster/anchor.h"
#include "raster/interpolate.h"
#include "tests/raster/drawing.h"
#include "tests/raster/scenes.h"
#include "tests/reference/raster/exact_coverage.h"
#include "tests/stress/worst_case.h"
#include "tests/stress_scale.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

namespace rawtexel::raster {
namespace {

using namespace testing;

constexpr int kSize = 256;
constexpr double kUlp = 0x1p-24;  ///< half of a last place at 1

/// Lane `lane` of a wave, in the order b1, b2, db1_dx, db2_dx, db1_dy, db2_dy.
std::array<float, 6> lane_of(const BarycentricWave& wave, int lane) {
    return {wave.b1[lane], wave.b2[lane], wave.db1_dx[lane], wave.db2_dx[lane], wave.db1_dy[lane], wave.db2_dy[lane]};
}

/// Calls visit(triangle, x, y, lane) for samples at (x, y) that setup triangles cover, each in a wave of that triangle alone.
template <class Visit>
void for_covered_lanes(const Frame& frame, uint32_t seed, Visit&& visit) {
    std::mt19937 random(seed);
    LatestAnchors latest(frame);
    frame.for_each_triangle([&](uint32_t index, const SetupTriangle& triangle) {
        const reference::SnappedTriangle snapped = reference::snapped(triangle);
        // Waves about points of the triangle, so that slivers are met.
        for (int round = 0; round < 12; ++round) {
            const int edge = int(random() % 3), next = (edge + 1) % 3;
            const double along = uniform(random, 0, 1), inwards = round % 2 == 0 ? 0.0 : uniform(random, 0, 1);
            const auto about = [&](const int32_t(&v)[3]) {
                const double on_edge = v[edge] + along * (v[next] - v[edge]);
                return int(std::floor((on_edge + inwards * (v[(edge + 2) % 3] - on_edge)) / 256));
            };
            const int x = std::clamp(about(triangle.x), 0, kSize - 1) / 8 * 8, y = std::clamp(about(triangle.y), 0, kSize - 1) / 4 * 4;
            SampleOffset offset[32];
            offset[0] = {int32_t(random() % 1024) - 256, int32_t(random() % 1024) - 256};
            for (SampleOffset& one : offset)
                one = round % 4 < 2 ? offset[0] : SampleOffset{int32_t(random() % 1024) - 256, int32_t(random() % 1024) - 256};
            uint32_t setup_index[32];
            std::fill_n(setup_index, 32, index);
            BarycentricWave wave;
            interpolate_wave(frame, setup_index, offset, x, y, 0xFFFFFFFFu, latest, wave);
            for (int lane = 0; lane < 32; ++lane) {
                const int point_x = (x + lane % 8) * 512 + offset[lane].x, point_y = (y + lane / 8) * 512 + offset[lane].y;
                if (reference::covers(snapped, point_x, point_y)) visit(triangle, point_x / 512.0, point_y / 512.0, lane_of(wave, lane));
            }
        }
    });
}

/// What was found of many lanes: units of half a last place at 1, and pixels.
struct WorstLanes {
    uint64_t samples = 0;
    double weight = 0;       ///< of b1 and b2, relative to themselves
    double moved = 0;        ///< how far off the sample the weights are exact, but for a last place
    double slope_moved = 0;  ///< the same of the slopes, but for four last places of the largest
};

/// (x, y): the sample. Slopes change with the square of w, relative to themselves twice as fast.
void judge(const SetupTriangle& triangle, double x, double y, const std::array<float, 6>& got, WorstLanes& worst) {
    const Barycentrics exact = barycentrics(triangle, x, y);
    const auto weigh = [&](double weight, double got_weight, double dx, double dy) {
        const double error = std::abs(got_weight - weight), along = std::hypot(dx, dy);
        worst.weight = std::max(worst.weight, error / std::max(std::abs(weight), 1e-30) / kUlp);
        const double beyond = error - 2 * kUlp * std::max(std::abs(weight), 0x1p-20);
        if (along > 0) worst.moved = std::max(worst.moved, beyond / along);
    };
    weigh(exact.b1, got[0], exact.db1_dx, exact.db1_dy);
    weigh(exact.b2, got[1], exact.db2_dx, exact.db2_dy);

    const double slopes[] = {exact.db1_dx, exact.db2_dx, exact.db1_dy, exact.db2_dy};
    double largest = std::max(std::abs(exact.db1_dx + exact.db2_dx), std::abs(exact.db1_dy + exact.db2_dy)), error = 0;
    for (size_t i = 0; i < 4; ++i) {
        largest = std::max(largest, std::abs(slopes[i]));
        error = std::max(error, std::abs(got[i + 2] - slopes[i]));
    }
    const PerspectiveSlope w = perspective_slope(triangle, x, y);
    const double beyond = error - 8 * kUlp * largest, along = 2 * std::hypot(w.dx, w.dy) * largest;
    if (beyond > 0) worst.slope_moved = std::max(worst.slope_moved, along > 0 ? beyond / along : INFINITY);
    ++worst.samples;
}

/// Triangles of `extent` pixels at most, all before the camera, w up to 1 : `most_w` within one.
Mesh triangles_on_screen(std::mt19937& random, int count, float extent, float most_w) {
    Mesh mesh;
    for (int i = 0; i < count; ++i) {
        const float size = extent * std::exp2(uniform(random, -6, 0)), x = uniform(random, 0, kSize - size),
                    y = uniform(random, 0, kSize - size);
        const auto corner = [&] {
            const float depth = std::pow(most_w, uniform(random, 0, 1));
            const glm::vec2 screen(x + uniform(random, 0, size), y + uniform(random, 0, size));
            return glm::vec3((screen.x / kSize * 2 - 1) * depth, (1 - screen.y / kSize * 2) * depth, -depth);
        };
        mesh.add(corner(), corner(), corner());
    }
    return mesh;
}

TEST(BarycentricWave, OfCompactTrianglesIsTheSamplesOwn) {
    std::mt19937 random(11);
    for (const float most_w : {1.0f, 1.9f}) {
        const Mesh mesh = triangles_on_screen(random, 3000 * stress_scale(), 63, most_w);
        Draw draw = mesh.draw(perspective(1, 1, 0.05f));
        draw.cull = CullMode::None;
        const Frame frame(square_frame(kSize), {&draw, 1});
        WorstLanes worst;
        for_covered_lanes(frame, 12, [&](const SetupTriangle& triangle, double x, double y, const std::array<float, 6>& got) {
            ASSERT_TRUE(triangle.compact);
            judge(triangle, x, y, got, worst);
        });
        EXPECT_GT(worst.samples, 10000u);
        EXPECT_LE(worst.weight, 10) << "w 1 : " << most_w;
        EXPECT_EQ(worst.slope_moved, 0) << "w 1 : " << most_w;
        const std::string of = "_w_1_to_" + std::to_string(most_w).substr(0, 3);
        tell_worst_case("relative_weight_in_half_places" + of, worst.weight);
        tell_worst_case("slope_moved_pixels" + of, worst.slope_moved);
    }
}

TEST(BarycentricWave, OfOtherTrianglesIsThatOfAPointBesideTheSample) {
    std::mt19937 random(13);
    Mesh mesh = triangles_on_screen(random, 1500 * stress_scale(), 4000, 100);
    // Small ones in steep perspective.
    const Mesh steep = triangles_on_screen(random, 1500 * stress_scale(), 63, 1e6f);
    for (size_t i = 0; i < steep.positions.size(); i += 3) mesh.add(steep.positions[i], steep.positions[i + 1], steep.positions[i + 2]);
    // Cut by the near plane, and floors that reach the horizon.
    for (int i = 0; i < 1500 * stress_scale(); ++i) {
        const float size = std::exp2(uniform(random, -1, 16));
        const auto corner = [&] {
            return size * glm::vec3(uniform(random, -1, 1), uniform(random, -0.2f, 0.2f), uniform(random, -1.5f, 0.5f));
        };
        mesh.add(corner(), corner(), corner());
    }
    Draw draw = mesh.draw(perspective(0.9f, 1, 0.05f));
    draw.cull = CullMode::None;
    const Frame frame(square_frame(kSize), {&draw, 1});
    ASSERT_GT(frame.counts().clipped, 100u);
    WorstLanes worst;
    for_covered_lanes(frame, 14, [&](const SetupTriangle& triangle, double x, double y, const std::array<float, 6>& got) {
        if (!triangle.compact) judge(triangle, x, y, got, worst);
    });
    EXPECT_GT(worst.samples, 100000u);
    EXPECT_LE(worst.moved, 0x1p-16);
    EXPECT_LE(worst.slope_moved, 0x1p-16);
    tell_tested(worst.samples, "interpolated samples");
    tell_worst_case("moved_pixels", worst.moved);
    tell_worst_case("slope_moved_pixels", worst.slope_moved);
}

/// Neither the instruction set nor what other lanes show changes a bit of a lane.
TEST(BarycentricWave, OfALaneDependsOnItsTriangleAndPixelAlone) {
    const MixedScene scene(6, 200);
    const Frame frame(square_frame(kSize), scene.draws);
    ASSERT_GT(frame.counts().clipped, 0u);
    std::mt19937 random(7);
    int compact = 0, large = 0;
    for (int round = 0; round < 400; ++round) {
        uint32_t setup_index[32];
        SampleOffset offset[32];
        const uint32_t distinct = uint32_t(1 + random() % 5), base = uint32_t(random());
        uint32_t mask = round % 3 == 0 ? 0xFFFFFFFFu : uint32_t(random()) & uint32_t(random());
        if (round == 1) mask = 0;
        for (int lane = 0; lane < 32; ++lane) {
            setup_index[lane] = (base + uint32_t(random()) % distinct * 31) % frame.triangle_count();
            // What is outside the mask must not even be looked at.
            if ((mask >> lane & 1u) == 0) setup_index[lane] = kNoTriangle;
            // One offset for all, as one jitter of a frame has it, or one for each.
            offset[lane] =
                lane > 0 && round % 4 < 2 ? offset[0] : SampleOffset{int32_t(random() % 1024) - 256, int32_t(random() % 1024) - 256};
        }
        const int x = int(random() % 32) * 8, y = int(random() % 64) * 4;
        BarycentricWave expected{};
        for (uint32_t rest = mask; rest != 0; rest &= rest - 1) {
            const int lane = std::countr_zero(rest);
            LatestAnchors none(frame);
            BarycentricWave alone;
            interpolate_wave(frame, setup_index, offset, x, y, 1u << lane, none, alone);
            expected.b1[lane] = alone.b1[lane];
            expected.b2[lane] = alone.b2[lane];
            expected.db1_dx[lane] = alone.db1_dx[lane];
            expected.db2_dx[lane] = alone.db2_dx[lane];
            expected.db1_dy[lane] = alone.db1_dy[lane];
            expected.db2_dy[lane] = alone.db2_dy[lane];
            ++(frame.triangle(setup_index[lane]).compact ? compact : large);
        }
        for (const int64_t set : instruction_sets()) {
            const UseInstructionSet use(set);
            LatestAnchors latest(frame);
            for (int again = 0; again < 2; ++again) {
                BarycentricWave got;
                std::memset(&got, 0xFF, sizeof(got));
                interpolate_wave(frame, setup_index, offset, x, y, mask, latest, got);
                ASSERT_EQ(std::memcmp(&got, &expected, sizeof(got)), 0) << name_of(set) << ", round " << round << ", mask " << mask;
            }
        }
    }
    EXPECT_GT(compact, 500);
    EXPECT_GT(large, 500);
}

}  // namespace
}  // namespace rawtexel::raster
