// Which sample points a triangle covers, held against 128-bit integers, and meshes without cracks or double hits.
#include "tests/raster/drawing.h"
#include "tests/reference/raster/exact_coverage.h"
#include "tests/stress/worst_case.h"
#include "tests/stress_scale.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace rawtexel::raster {
namespace {

using namespace testing;

FrameOptions frame_options(int width, int height) {
    FrameOptions options;
    options.width = width;
    options.height = height;
    options.filter_radius = kPatternRadius;
    return options;
}

/// How many were held against exact integers, and how many of them are covered.
struct ExactSamples {
    uint64_t tested = 0, covered = 0;

    void tell() const {
        EXPECT_GT(covered, 0u);
        tell_tested(tested);
        tell_worst_case("covered", covered);
        tell_worst_case("differences_from_128_bits", 0);
    }
};

/// Holds pictures of each of the mesh's triangles, by every pattern, against the exact coverage of its snapped vertices.
void expect_exact_coverage(const Mesh& mesh, const FrameOptions& options, ExactSamples& samples) {
    for (size_t t = 0; t + 2 < mesh.indices.size(); t += 3) {
        Draw draw = mesh.draw(clip_from_pixels(options.width, options.height));
        draw.indices += t;
        draw.triangle_count = 1;
        const Frame frame(options, {&draw, 1});
        const glm::vec3* v[3];
        reference::SnappedTriangle snapped;
        for (int i = 0; i < 3; ++i) {
            v[i] = &mesh.positions[mesh.indices[t + size_t(i)]];
            snapped.x[i] = std::lrint(v[i]->x * 256.0);
            snapped.y[i] = std::lrint(v[i]->y * 256.0);
        }
        for (const SamplePattern& pattern : sample_patterns()) {
            const Picture picture = draw_frame(frame, pattern);
            for (int y = 0; y < options.height; ++y) {
                for (int x = 0; x < options.width; ++x) {
                    const SampleOffset offset = pattern.at(x, y);
                    const bool expected = reference::covers(snapped, int64_t{x} * 512 + offset.x, int64_t{y} * 512 + offset.y);
                    const bool drawn = picture.id[size_t(y) * size_t(options.width) + size_t(x)] != kNoTriangle;
                    ASSERT_EQ(drawn, expected) << "pixel " << x << "," << y << " offset " << offset.x << "," << offset.y << " triangle ("
                                               << v[0]->x << "," << v[0]->y << ") (" << v[1]->x << "," << v[1]->y << ") (" << v[2]->x << ","
                                               << v[2]->y << ")";
                    samples.covered += expected;
                }
            }
            samples.tested += picture.id.size();
        }
    }
}

glm::vec3 random_point(std::mt19937& random, float x, float y, float spread) {
    return {uniform(random, x - spread, x + spread), uniform(random, y - spread, y + spread), 0.5f};
}

TEST(Coverage, EqualsExactIntegersForRandomTrianglesOfEverySize) {
    std::mt19937 random(1);
    ExactSamples samples;
    for (const float size : {0.02f, 0.1f, 0.7f, 3.0f, 20.0f, 150.0f, 1000.0f, 5000.0f}) {
        Mesh mesh;
        for (int i = 0; i < 40 * stress_scale(); ++i) {
            const float x = uniform(random, -3, 67), y = uniform(random, -3, 35);
            mesh.add(random_point(random, x, y, size), random_point(random, x, y, size), random_point(random, x, y, size));
        }
        expect_exact_coverage(mesh, frame_options(64, 32), samples);
        if (HasFatalFailure()) return;
    }
    samples.tell();
}

TEST(Coverage, EqualsExactIntegersForVerticesOnSamplePointsAndAxisParallelEdges) {
    std::mt19937 random(2);
    // Vertices on multiples of half a pixel put many sample points exactly on edges and on vertices.
    const auto lattice = [&] { return glm::vec3(float(int(random() % 36) - 2) * 0.5f, float(int(random() % 36) - 2) * 0.5f, 0.5f); };
    Mesh mesh;
    for (int i = 0; i < 600 * stress_scale(); ++i) mesh.add(lattice(), lattice(), lattice());
    ExactSamples samples;
    expect_exact_coverage(mesh, frame_options(16, 16), samples);
    samples.tell();
}

TEST(Coverage, EqualsExactIntegersForSlivers) {
    std::mt19937 random(3);
    Mesh mesh;
    for (int i = 0; i < 200 * stress_scale(); ++i) {
        // 3000 pixels long and some 1/256 pixel wide, through the frame in any direction.
        const float angle = uniform(random, 0, 6.2831853f), x = uniform(random, 0, 64), y = uniform(random, 0, 32),
                    width = uniform(random, 0, 0.01f);
        const glm::vec3 along(1500 * std::cos(angle), 1500 * std::sin(angle), 0),
            across(-width * std::sin(angle), width * std::cos(angle), 0);
        const glm::vec3 middle(x, y, 0.5f);
        mesh.add(middle - along, middle + along, middle + across);
    }
    ExactSamples samples;
    expect_exact_coverage(mesh, frame_options(64, 32), samples);
    samples.tell();
}

TEST(Coverage, EqualsExactIntegersAcrossTheWidestFrame) {
    Mesh mesh;
    mesh.add({-30000, 7.4921875f, 0.5f}, {32767, 8.50390625f, 0.5f}, {31000, -20000, 0.5f});
    mesh.add({0, 0, 0.5f}, {16384, 16, 0.5f}, {0, 16, 0.5f});
    mesh.add({16384, 0.5f, 0.5f}, {0, 0.50390625f, 0.5f}, {16384, 15.5f, 0.5f});
    ExactSamples samples;
    expect_exact_coverage(mesh, frame_options(16384, 16), samples);
    samples.tell();
}

TEST(Coverage, HoldsOnEveryInstructionSet) {
    std::mt19937 random(4);
    Mesh mesh;
    for (int i = 0; i < 300; ++i) {
        const float size = std::exp2(uniform(random, -3, 12)), x = uniform(random, 0, 100), y = uniform(random, 0, 70);
        mesh.add(random_point(random, x, y, size), random_point(random, x, y, size) + glm::vec3(0, 0, 0.2f),
                 random_point(random, x, y, size) + glm::vec3(0, 0, 0.1f));
    }
    const Draw draw = mesh.draw(clip_from_pixels(128, 64));
    const Frame frame(frame_options(100, 60), {&draw, 1});
    for (const SamplePattern& pattern : sample_patterns()) {
        const Picture expected = draw_frame(frame, pattern);
        ASSERT_GE(instruction_sets().size(), 2u);
        for (const int64_t set : instruction_sets()) {
            const UseInstructionSet use(set);
            EXPECT_EQ(draw_frame(frame, pattern), expected) << name_of(set);
        }
    }
}

TEST(Coverage, OfTheDrtkQuadHasNoHoleOnItsDiagonal) {
    // facebookresearch/DRTK issue 9, where float edge functions leave the whole diagonal unhit.
    Mesh mesh;
    mesh.positions = {{0.5f, 0.49993896f, 0.5f}, {0.5f, 6.5f, 0.5f}, {6.5000610f, 0.4999390f, 0.5f}, {6.5f, 6.5f, 0.5f}};
    mesh.indices = {0, 1, 2, 3, 2, 1};
    Draw draw = mesh.draw(clip_from_pixels(8, 8));
    draw.coverage = CoverageClass::Blended;
    const Frame frame(frame_options(8, 8), {&draw, 1});
    const std::vector<int> hits = count_candidates(frame, {});
    // Snapped, the quad reaches from centre 0 to centre 6: top and left edges count, right and bottom ones do not.
    for (int y = 0; y < 8; ++y) {
        for (int x = 0; x < 8; ++x) EXPECT_EQ(hits[size_t(y) * 8 + size_t(x)], x < 6 && y < 6 ? 1 : 0) << "pixel " << x << "," << y;
    }
}

/// A planar mesh larger than the frame: a grid whose vertices move by less than half a cell, each cell cut along either diagonal, every
/// triangle turned and rotated at random.
Mesh jittered_grid(std::mt19937& random, float cell, float width, float height, float lattice) {
    const int columns = int(std::ceil(width / cell)) + 3, rows = int(std::ceil(height / cell)) + 3;
    Mesh mesh;
    const auto on_lattice = [&](float v) { return lattice > 0 ? std::round(v / lattice) * lattice : v; };
    for (int j = 0; j <= rows; ++j) {
        for (int i = 0; i <= columns; ++i) {
            const float x = (float(i) - 1 + uniform(random, -0.24f, 0.24f)) * cell - 2,
                        y = (float(j) - 1 + uniform(random, -0.24f, 0.24f)) * cell - 2;
            mesh.positions.emplace_back(on_lattice(x), on_lattice(y), uniform(random, 0.1f, 0.9f));
        }
    }
    const auto add = [&](std::array<uint32_t, 3> triangle) {
        std::rotate(triangle.begin(), triangle.begin() + random() % 3, triangle.end());
        if (random() % 2) std::swap(triangle[0], triangle[1]);
        mesh.indices.insert(mesh.indices.end(), triangle.begin(), triangle.end());
    };
    for (int j = 0; j < rows; ++j) {
        for (int i = 0; i < columns; ++i) {
            const uint32_t a = uint32_t(j * (columns + 1) + i), b = a + 1, c = a + uint32_t(columns) + 1, d = c + 1;
            if (random() % 2) {
                add({a, b, c});
                add({b, d, c});
            } else {
                add({a, b, d});
                add({a, d, c});
            }
        }
    }
    return mesh;
}

TEST(Coverage, OfAMeshIsExactlyOneAtEverySample) {
    std::mt19937 random(5);
    uint64_t samples = 0;
    for (const float cell : {0.1f, 0.3f, 1.0f, 2.5f, 10.0f, 60.0f, 400.0f, 5000.0f}) {
        for (const float lattice : {0.0f, 0.5f}) {
            if (lattice > 0 && cell < 2.0f) continue;  // would fold the mesh over
            const int size = cell < 0.5f ? 16 : 64;
            const Mesh mesh = jittered_grid(random, cell, float(size) + 4, float(size) + 4, lattice);
            Draw draw = mesh.draw(clip_from_pixels(size, size));
            draw.coverage = CoverageClass::Blended;
            const Frame frame(frame_options(size, size), {&draw, 1});
            for (const SamplePattern& pattern : sample_patterns()) {
                const std::vector<int> hits = count_candidates(frame, pattern);
                samples += hits.size();
                const auto wrong = std::find_if(hits.begin(), hits.end(), [](int n) { return n != 1; });
                ASSERT_EQ(wrong, hits.end()) << *wrong << " hits at pixel " << (wrong - hits.begin()) % size << ","
                                             << (wrong - hits.begin()) / size << ", cell " << cell << ", lattice " << lattice;
            }
        }
    }
    tell_tested(samples);
    tell_worst_case("samples_not_hit_once", 0);
}

TEST(Coverage, OfAFanAboutAPixelCentreIsExactlyOne) {
    std::mt19937 random(6);
    for (int round = 0; round < 50 * stress_scale(); ++round) {
        const int spokes = 3 + int(random() % 20);
        const glm::vec3 hub(8.5f, 8.5f, 0.5f);
        Mesh mesh;
        std::vector<glm::vec3> rim;
        for (int i = 0; i < spokes; ++i) {
            const float angle = 6.2831853f * (float(i) + uniform(random, 0, 0.5f)) / float(spokes), radius = uniform(random, 40, 400);
            rim.push_back(hub + glm::vec3(radius * std::cos(angle), radius * std::sin(angle), 0));
        }
        for (int i = 0; i < spokes; ++i) mesh.add(hub, rim[size_t(i)], rim[size_t(i + 1) % rim.size()]);
        Draw draw = mesh.draw(clip_from_pixels(16, 16));
        draw.coverage = CoverageClass::Masked;
        const Frame frame(frame_options(16, 16), {&draw, 1});
        EXPECT_EQ(count_candidates(frame, {})[8 * 16 + 8], 1) << spokes << " spokes, round " << round;
    }
}

}  // namespace
}  // namespace rawtexel::raster
