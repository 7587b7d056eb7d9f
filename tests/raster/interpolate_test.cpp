// Weights and derivatives, held against quadruple precision.
#include "raster/interpolate.h"
#include "tests/raster/drawing.h"
#include "tests/raster/scenes.h"
#include "tests/reference/raster/exact_coverage.h"
#include "tests/reference/raster/exact_interpolation.h"
#include "tests/stress/worst_case.h"
#include "tests/stress_scale.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace rawtexel::raster {
namespace {

using namespace testing;
using reference::Quad;

constexpr int kSize = 64;

/// The unclipped triangle that a setup triangle stems from: of whole triangles the snapped positions, else the exact ones.
void source_vertices(const SetupTriangle& triangle, const Draw& draw, reference::QuadVertex (&vertex)[3]) {
    for (uint32_t i = 0; i < 3; ++i) {
        vertex[i] = reference::to_screen(draw.clip_from_object, draw.positions[draw.indices[3 * triangle.primitive + i]], kSize, kSize);
    }
    if (triangle.bary_over_w != nullptr) return;
    for (int k = 0; k < 3; ++k) {
        reference::QuadVertex& v = vertex[triangle.corner[k]];
        v.x = Quad(triangle.x[k]) / 256 * v.w;
        v.y = Quad(triangle.y[k]) / 256 * v.w;
    }
}

/// Calls visit(triangle, x, y) for some samples that each setup triangle covers.
template <class Visit>
void for_covered_samples(const Frame& frame, int stride, Visit&& visit) {
    frame.for_each_triangle([&](uint32_t i, const SetupTriangle& triangle) {
        const reference::SnappedTriangle snapped = reference::snapped(triangle);
        for (int y = int(i) % stride; y < kSize; y += stride) {
            for (int x = int(i / 7) % stride; x < kSize; x += stride) {
                const SampleOffset offset{256, 256};
                if (reference::covers(snapped, x * 512 + offset.x, y * 512 + offset.y)) visit(triangle, x + 0.5, y + 0.5);
            }
        }
    });
}

struct WorstWeights {
    uint64_t samples = 0;
    double weight = 0, derivative = 0, depth = 0;
};

/// Greatest error of b1 and b2, of their derivatives relative to the size of the terms they are the difference of, and of depth.
WorstWeights worst_against_quadruple(const Frame& frame, std::span<const Draw> draws) {
    WorstWeights worst;
    for_covered_samples(frame, 5, [&](const SetupTriangle& triangle, double x, double y) {
        reference::QuadVertex vertex[3];
        source_vertices(triangle, draws[triangle.draw], vertex);
        const reference::QuadWeights exact = reference::weights_at(vertex, x, y);
        const Barycentrics got = barycentrics(triangle, x, y);
        ++worst.samples;
        worst.weight = std::max({worst.weight, std::abs(double(got.b1 - exact.b[1])), std::abs(double(got.b2 - exact.b[2]))});
        EXPECT_NEAR(double(got.inverse_w / exact.inverse_w), 1.0, 1e-9);

        // Central differences in quadruple: error of order h^2, h = 2^-44 pixel, next to nothing even where w changes a million-
        // fold within a pixel.
        const Quad h = 0x1p-44;
        const reference::QuadWeights right = reference::weights_at(vertex, x + h, y), left = reference::weights_at(vertex, x - h, y);
        const reference::QuadWeights below = reference::weights_at(vertex, x, y + h), above = reference::weights_at(vertex, x, y - h);
        const double got_slopes[4] = {got.db1_dx, got.db2_dx, got.db1_dy, got.db2_dy};
        const Quad exact_slopes[4] = {(right.b[1] - left.b[1]) / (2 * h), (right.b[2] - left.b[2]) / (2 * h),
                                      (below.b[1] - above.b[1]) / (2 * h), (below.b[2] - above.b[2]) / (2 * h)};
        double largest = 0;
        for (const Quad& slope : exact_slopes) largest = std::max(largest, std::abs(double(slope)));
        for (int i = 0; i < 4; ++i)
            worst.derivative = std::max(worst.derivative, std::abs(double(got_slopes[i] - exact_slopes[i])) / largest);

        const double x0 = x - triangle.x[0] / 256.0, y0 = y - triangle.y[0] / 256.0;
        const double depth = triangle.depth_at_origin + (triangle.depth_dx * x0 + triangle.depth_dy * y0);
        worst.depth = std::max(worst.depth, std::abs(double(depth - exact.depth)));
    });
    return worst;
}

void record(const WorstWeights& worst) {
    tell_tested(worst.samples, "interpolated samples");
    tell_worst_case("worst_weight", worst.weight);
    tell_worst_case("worst_derivative", worst.derivative);
    tell_worst_case("worst_depth", worst.depth);
}

TEST(Interpolation, EqualsQuadruplePrecisionOnWholeTriangles) {
    std::mt19937 random(1);
    // All before the camera; w from 0.1 to 1e5 within one triangle, that is 1 : 1e6.
    Mesh mesh;
    for (int i = 0; i < 400 * stress_scale(); ++i) {
        const auto corner = [&] {
            const float depth = std::pow(10.0f, uniform(random, -1, 5));
            return glm::vec3(uniform(random, -1, 1) * depth, uniform(random, -1, 1) * depth, -depth);
        };
        mesh.add(corner(), corner(), corner());
    }
    const Draw draw = mesh.draw(perspective(0.9f, 1, 0.05f));
    const Frame frame(square_frame(kSize), {&draw, 1});
    ASSERT_EQ(frame.counts().clipped, 0u);
    const WorstWeights worst = worst_against_quadruple(frame, {&draw, 1});
    EXPECT_LE(worst.weight, 0x1p-50);
    // The quotient rule cancels about as many digits as the w of the corners differ by.
    EXPECT_LE(worst.derivative, 1e-9);
    EXPECT_LE(worst.depth, 1e-12);
    record(worst);
}

TEST(Interpolation, EqualsQuadruplePrecisionOnClippedTriangles) {
    std::mt19937 random(2);
    Mesh mesh;
    for (int i = 0; i < 600 * stress_scale(); ++i) {
        const float size = std::exp2(uniform(random, -1, 12));
        const auto corner = [&] { return size * glm::vec3(uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1.5f, 0.5f)); };
        mesh.add(corner(), corner(), corner());
    }
    const Draw draw = mesh.draw(perspective(0.9f, 1, 0.05f));
    const Frame frame(square_frame(kSize), {&draw, 1});
    ASSERT_GT(frame.counts().clipped, 100u);
    const WorstWeights worst = worst_against_quadruple(frame, {&draw, 1});
    EXPECT_LE(worst.weight, 1e-12);
    EXPECT_LE(worst.derivative, 1e-11);
    EXPECT_LE(worst.depth, 1e-12);
    record(worst);
}

/// On whole and clipped triangles; where the step leads past the horizon there is nothing to compare with.
TEST(Interpolation, StepsInPerspectiveLeadToTheWeightsThere) {
    std::mt19937 random(5);
    Mesh mesh;
    for (int i = 0; i < 400; ++i) {
        const auto corner = [&] { return 8.0f * glm::vec3(uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -2.0f, 0.2f)); };
        mesh.add(corner(), corner(), corner());
    }
    const Draw draw = mesh.draw(perspective(0.9f, 1, 0.05f));
    const Frame frame(square_frame(kSize), {&draw, 1});
    ASSERT_GT(frame.counts().clipped, 50u);
    double worst = 0;
    int steps = 0, bent = 0;
    for_covered_samples(frame, 5, [&](const SetupTriangle& triangle, double x, double y) {
        const double jx = uniform(random, -1.5f, 1.5f), jy = uniform(random, -1.5f, 1.5f);
        const Barycentrics from = barycentrics(triangle, x, y), to = barycentrics(triangle, x + jx, y + jy);
        const PerspectiveSlope slope = perspective_slope(triangle, x, y);
        const double ratio = 1.0 + slope.dx * jx + slope.dy * jy;
        EXPECT_NEAR(ratio, to.inverse_w / from.inverse_w, 1e-9 * std::max(1.0, std::abs(ratio)));
        if (ratio < 0.05) return;
        const double b1 = from.b1 + (from.db1_dx * jx + from.db1_dy * jy) / ratio,
                     b2 = from.b2 + (from.db2_dx * jx + from.db2_dy * jy) / ratio;
        worst =
            std::max({worst, std::abs(b1 - to.b1) / std::max(1.0, std::abs(to.b1)), std::abs(b2 - to.b2) / std::max(1.0, std::abs(to.b2))});
        ++steps;
        bent += std::abs(ratio - 1.0) > 0.05;
    });
    EXPECT_LE(worst, 1e-11);
    EXPECT_GT(steps, 3000);
    EXPECT_GT(bent, 100);
    RecordProperty("worst_step", ::testing::PrintToString(worst));
}

TEST(Interpolation, GivesSnappedVerticesTheirOwnAttributes) {
    const MixedScene scene(3);
    const Frame frame(square_frame(kSize), scene.draws);
    int whole = 0;
    frame.for_each_triangle([&](uint32_t, const SetupTriangle& triangle) {
        if (triangle.bary_over_w != nullptr) return;
        ++whole;
        for (int k = 0; k < 3; ++k) {
            const Barycentrics at = barycentrics(triangle, triangle.x[k] / 256.0, triangle.y[k] / 256.0);
            EXPECT_EQ(float(at.b1), triangle.corner[k] == 1 ? 1.0f : 0.0f);
            EXPECT_EQ(float(at.b2), triangle.corner[k] == 2 ? 1.0f : 0.0f);
            EXPECT_NEAR(at.inverse_w / triangle.inverse_w[size_t(k)], 1.0, 1e-14);
        }
    });
    EXPECT_GT(whole, 50);
}

TEST(Interpolation, NeverLeavesTheVerticesRangeOnWholeTriangles) {
    std::mt19937 random(4);
    Mesh mesh;
    for (int i = 0; i < 3000 * stress_scale(); ++i) {
        // Slivers and crumbs, where a plane in floating point would overshoot.
        const float x = uniform(random, 0, kSize), y = uniform(random, 0, kSize), length = std::exp2(uniform(random, -4, 11)),
                    angle = uniform(random, 0, 6.3f);
        const glm::vec3 a(x, y, 0.5f), b = a + length * glm::vec3(std::cos(angle), std::sin(angle), 0);
        const float width = std::exp2(uniform(random, -7, 1));
        mesh.add(a, b, (a + b) * 0.5f + glm::vec3(uniform(random, -width, width), uniform(random, -width, width), 0.4f));
    }
    const Draw draw = mesh.draw(clip_from_pixels(kSize, kSize));
    const Frame frame(square_frame(kSize), {&draw, 1});
    uint64_t samples = 0;
    double beyond = 0;
    for_covered_samples(frame, 1, [&](const SetupTriangle& triangle, double x, double y) {
        const Barycentrics at = barycentrics(triangle, x, y);
        EXPECT_GE(at.b1, 0.0);
        EXPECT_GE(at.b2, 0.0);
        EXPECT_LE(at.b1 + at.b2, 1.0 + 0x1p-51);
        beyond = std::max(beyond, at.b1 + at.b2 - 1.0);
        ++samples;
    });
    EXPECT_GT(samples, 1000u);
    tell_tested(samples, "interpolated samples");
    tell_worst_case("weights_beyond_one", beyond);
}

TEST(Interpolation, LeavesTheVerticesRangeOnPiecesByNoMoreThanSnappingMoves) {
    std::mt19937 random(5);
    Mesh mesh;
    for (int i = 0; i < 1500 * stress_scale(); ++i) {
        const float size = std::exp2(uniform(random, -1, 12));
        const auto corner = [&] { return size * glm::vec3(uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1.5f, 0.5f)); };
        mesh.add(corner(), corner(), corner());
    }
    const Draw draw = mesh.draw(perspective(0.9f, 1, 0.05f));
    const Frame frame(square_frame(kSize), {&draw, 1});
    uint64_t samples = 0;
    double outside = 0;
    for_covered_samples(frame, 1, [&](const SetupTriangle& triangle, double x, double y) {
        if (triangle.bary_over_w == nullptr) return;
        const Barycentrics at = barycentrics(triangle, x, y);
        const double b[3] = {1 - at.b1 - at.b2, at.b1, at.b2};
        const double dx[3] = {-at.db1_dx - at.db2_dx, at.db1_dx, at.db2_dx}, dy[3] = {-at.db1_dy - at.db2_dy, at.db1_dy, at.db2_dy};
        for (int i = 0; i < 3; ++i)
            EXPECT_GE(b[i], -(std::abs(dx[i]) + std::abs(dy[i])) / 256 - 1e-9) << "weight " << i << " at " << x << "," << y;
        outside = std::max({outside, -b[0], -b[1], -b[2]});
        ++samples;
    });
    EXPECT_GT(samples, 10000u);
    tell_tested(samples, "interpolated samples");
    tell_worst_case("weights_below_zero", outside);
}

}  // namespace
}  // namespace rawtexel::raster
