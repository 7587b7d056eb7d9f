// Meshes in a plane, whatever their triangles' size, winding and rotation: every sample is hit exactly once; and what T-junctions do.
#include "tests/raster/drawing.h"
#include "tests/stress/worst_case.h"
#include "tests/stress_scale.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace rawtexel::raster {
namespace {

using namespace testing;

constexpr int kSize = 64;

/// Pixels of the frame and their neighbours lie well inside. Vertices leave their lattice by less than would fold a cell; the lattice is
/// turned by any angle, each cell cut along either diagonal, each triangle turned and wound at random.
Mesh turned_grid(std::mt19937& random, float cell) {
    const float angle = uniform(random, 0, 6.2831853f), cosine = std::cos(angle), sine = std::sin(angle);
    const int cells = 2 * int(std::ceil(64.0f / cell)) + 4;  // the frame's diagonal is 91 pixels
    const glm::vec2 shift(uniform(random, 0, cell), uniform(random, 0, cell));
    Mesh mesh;
    for (int j = 0; j <= cells; ++j) {
        for (int i = 0; i <= cells; ++i) {
            const float u = (float(i - cells / 2) + uniform(random, -0.24f, 0.24f)) * cell + shift.x,
                        v = (float(j - cells / 2) + uniform(random, -0.24f, 0.24f)) * cell + shift.y;
            mesh.positions.emplace_back(32 + cosine * u - sine * v, 32 + sine * u + cosine * v, uniform(random, 0.1f, 0.9f));
        }
    }
    const auto add = [&](std::array<uint32_t, 3> triangle) {
        std::rotate(triangle.begin(), triangle.begin() + random() % 3, triangle.end());
        if (random() % 2) std::swap(triangle[0], triangle[1]);
        mesh.indices.insert(mesh.indices.end(), triangle.begin(), triangle.end());
    };
    for (uint32_t j = 0; j < uint32_t(cells); ++j) {
        for (uint32_t i = 0; i < uint32_t(cells); ++i) {
            const uint32_t stride = uint32_t(cells) + 1, a = j * stride + i, b = a + 1, c = a + stride, d = c + 1;
            const bool falling = random() % 2 != 0;
            add(falling ? std::array{a, b, c} : std::array{a, b, d});
            add(falling ? std::array{b, d, c} : std::array{a, d, c});
        }
    }
    return mesh;
}

TEST(Watertight, MeshesTurnedByAnyAngleAreHitOnceAtEverySample) {
    std::mt19937 random(21);
    uint64_t samples = 0, cracks = 0, doubles = 0;
    for (int round = 0; round < 70 * stress_scale(); ++round) {
        // From a quarter of a pixel to thousands; snapping folds cells that are smaller still.
        const float cell = std::exp2(uniform(random, round % 8 == 0 ? -2.0f : 1.0f, 12.5f));
        const Mesh mesh = turned_grid(random, cell);
        Draw draw = mesh.draw(clip_from_pixels(kSize, kSize));
        draw.coverage = CoverageClass::Blended;
        const Frame frame(square_frame(kSize), {&draw, 1});
        for (int repeat = 0; repeat < 200; ++repeat) {
            SamplePattern pattern{{}, repeat % 2 == 0, 768, uint32_t(random())};
            pattern.frame = {2 * int32_t(random() % 768) - 511, 2 * int32_t(random() % 768) - 511};
            const std::vector<int> hits = count_candidates(frame, pattern);
            samples += hits.size();
            cracks += uint64_t(std::count(hits.begin(), hits.end(), 0));
            doubles += uint64_t(std::count_if(hits.begin(), hits.end(), [](int n) { return n > 1; }));
            ASSERT_EQ(cracks + doubles, 0u) << "cells of " << cell << " pixels, round " << round;
            if (cell < 1) break;
        }
    }
    tell_tested(samples);
    tell_worst_case("cracks", cracks);
    tell_worst_case("double_hits", doubles);
}

/// A vertex on an edge that the neighbour does not have: the snapped edge bends by up to half of 1/256 pixel at it, so samples that
/// near to the edge, and no others, may be missed or hit twice.
TEST(Watertight, TJunctionsMissOnlySamplesOnTheirEdge) {
    std::mt19937 random(22);
    uint64_t samples = 0, missed = 0, doubled = 0;
    double farthest = 0;
    for (int round = 0; round < 4000 * stress_scale(); ++round) {
        const auto far = [&](float sign) { return glm::vec3(uniform(random, 0, 64), 32 + sign * uniform(random, 200, 400), 0.5f); };
        const glm::vec3 a(uniform(random, -40, -5), uniform(random, 0, 64), 0.5f),
            b(uniform(random, 70, 100), uniform(random, 0, 64), 0.5f);
        const glm::vec3 middle = glm::mix(a, b, uniform(random, 0.2f, 0.8f)), above = far(-1), below = far(1);
        Mesh mesh;
        mesh.add(a, b, above);
        mesh.add(a, middle, below);
        mesh.add(middle, b, below);
        Draw draw = mesh.draw(clip_from_pixels(kSize, kSize));
        draw.coverage = CoverageClass::Blended;
        const Frame frame(square_frame(kSize), {&draw, 1});
        SamplePattern pattern;
        pattern.frame = {2 * int32_t(random() % 256) + 1, 2 * int32_t(random() % 256) + 1};
        const std::vector<int> hits = count_candidates(frame, pattern);
        for (int y = 0; y < kSize; ++y) {
            for (int x = 0; x < kSize; ++x) {
                const int n = hits[size_t(y * kSize + x)];
                const long double px = x + pattern.frame.x / 512.0L, py = y + pattern.frame.y / 512.0L;
                const long double dx = b.x - a.x, dy = b.y - a.y;
                const long double distance = std::abs(dx * (py - a.y) - dy * (px - a.x)) / std::hypot(dx, dy);
                // Beyond the outer edges of the triangles there is nothing to hit.
                const auto inside = [&](const glm::vec3& p, const glm::vec3& q, const glm::vec3& r) {
                    const auto side = [&](const glm::vec3& s, const glm::vec3& t) {
                        return (t.x - s.x) * (py - s.y) - (t.y - s.y) * (px - s.x);
                    };
                    return (side(p, q) > 1 && side(q, r) > 1 && side(r, p) > 1) || (side(p, q) < -1 && side(q, r) < -1 && side(r, p) < -1);
                };
                if (!inside(a, b, above) && !inside(a, b, below) && distance > 0.01L) continue;
                if (std::abs(px - 32) > 31) continue;
                ++samples;
                if (n == 1) continue;
                ++(n == 0 ? missed : doubled);
                farthest = std::max(farthest, double(distance));
                ASSERT_LE(distance, 1.5L / 256) << n << " hits at " << double(px) << "," << double(py) << " in round " << round;
            }
        }
    }
    tell_tested(samples);
    tell_worst_case("missed_on_the_edge", missed);
    tell_worst_case("doubled_on_the_edge", doubled);
    tell_worst_case("farthest_from_the_edge_in_pixels", farthest);
}

}  // namespace
}  // namespace rawtexel::raster
