// Triangles cut by the near plane, the guard band and worse: held against quadruple precision, and closed meshes that must stay closed.
#include "raster/clip.h"
#include "tests/raster/drawing.h"
#include "tests/reference/raster/exact_interpolation.h"
#include "tests/stress/worst_case.h"
#include "tests/stress_scale.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace rawtexel::raster {
namespace {

using namespace testing;

constexpr int kSize = 64;

/// The caller's x, y, w are those of clip space; the depth is 1/2 everywhere.
const glm::mat4 kClipFromXyw = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0.5f, 1, 0, 0, 0, 0};

struct Agreement {
    uint64_t inside = 0, outside = 0;

    void operator+=(const Agreement& other) { inside += other.inside, outside += other.outside; }
    void tell() const {
        EXPECT_GT(inside, 10000u);
        EXPECT_GT(outside, 10000u);
        tell_tested(inside + outside);
        tell_worst_case("samples_on_the_wrong_side", 0);
    }
};

/// Every sample that is clear of the triangle's border is covered if and only if it lies inside.
Agreement expect_right_side(const glm::vec3 (&corner)[3], const glm::mat4& clip_from_object) {
    Mesh mesh;
    mesh.add(corner[0], corner[1], corner[2]);
    const Draw draw = mesh.draw(clip_from_object);
    const Frame frame(square_frame(kSize), {&draw, 1});
    const Picture picture = draw_frame(frame, {});
    reference::QuadVertex vertex[3];
    for (int i = 0; i < 3; ++i) vertex[i] = reference::to_screen(clip_from_object, corner[i], kSize, kSize);
    const reference::VisiblePart visible(vertex);
    Agreement agreement;
    for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x) {
            const reference::Side side = visible.side_of(x + 0.5, y + 0.5, 1.0 / 256);
            if (side == reference::Side::OnBorder) continue;
            const bool covered = picture.id[size_t(y * kSize + x)] != kNoTriangle;
            EXPECT_EQ(covered, side == reference::Side::Inside)
                << "pixel " << x << "," << y << " of (" << corner[0].x << " " << corner[0].y << " " << corner[0].z << ") (" << corner[1].x
                << " " << corner[1].y << " " << corner[1].z << ") (" << corner[2].x << " " << corner[2].y << " " << corner[2].z << ")";
            if (covered != (side == reference::Side::Inside)) return agreement;
            ++(covered ? agreement.inside : agreement.outside);
        }
    }
    return agreement;
}

TEST(Clip, KeepsCoverageRightForVerticesFarBeyondTheGuardBand) {
    std::mt19937 random(1);
    Agreement sum;
    for (int i = 0; i < 400 * stress_scale(); ++i) {
        glm::vec3 corner[3];
        for (glm::vec3& v : corner) {
            const float far = std::pow(10.0f, uniform(random, 0, 30)), angle = uniform(random, 0, 6.2831853f);
            v = {32 + far * std::cos(angle), 32 + far * std::sin(angle), 0.5f};
        }
        sum += expect_right_side(corner, clip_from_pixels(kSize, kSize));
        ASSERT_FALSE(HasFailure()) << "triangle " << i;
    }
    sum.tell();
}

TEST(Clip, KeepsCoverageRightForVerticesBehindTheEyeAndAtExtremeW) {
    std::mt19937 random(2);
    const float w[] = {1e-30f, -1e-30f, 0.0f, -0.0f, 1.0f, -1.0f, 0.25f, 1e30f, 1e-3f};
    Agreement sum;
    for (int i = 0; i < 2000 * stress_scale(); ++i) {
        glm::vec3 corner[3];
        for (glm::vec3& v : corner) {
            v.z = w[random() % std::size(w)];
            const float scale = random() % 4 == 0 ? 1.0f : std::max(std::abs(v.z), 1e-30f);
            v.x = scale * uniform(random, -2, 2);
            v.y = scale * uniform(random, -2, 2);
        }
        sum += expect_right_side(corner, kClipFromXyw);
        ASSERT_FALSE(HasFailure()) << "triangle " << i;
    }
    sum.tell();
}

/// Cuts of edges so long that a coordinate of the cut is the difference of huge ones: it must not leave its plane, or the edge between two
/// such cuts crosses the frame.
TEST(Clip, KeepsCutsOfHugeEdgesOnTheirPlanes) {
    const glm::vec3 far[3] = {{1.8052520919719594e+28f, -2.6904611280319121e+26f, 0.5f},
                              {-1.1879824931979838e+26f, -3.9262515866771271e+25f, 0.5f},
                              {6.1853654661580666e+20f, 1.1640801578460759e+21f, 0.5f}};
    EXPECT_GT(expect_right_side(far, clip_from_pixels(kSize, kSize)).inside, 4000u);
    const glm::vec3 without_w[3] = {{0.7205359935760498f, 0.78201413154602051f, -0.0f},
                                    {-1.6079726219177246f, -1.9114632606506348f, 1e-30f},
                                    {-1.2683906601022348e-30f, -2.4359774134067667e-31f, -0.0f}};
    EXPECT_GT(expect_right_side(without_w, kClipFromXyw).inside, 4000u);

    std::mt19937 random(9);
    uint64_t cuts = 0;
    double farthest = 0;
    for (int i = 0; i < 20000 * stress_scale(); ++i) {
        std::array<ScreenVertex, 3> triangle;
        for (ScreenVertex& v : triangle) {
            const auto any = [&] { return double(uniform(random, -1, 1)) * std::pow(10.0, double(uniform(random, 0, 30))); };
            v = {any(), any(), 0.5, 1.0};
        }
        ClipPolygon polygon(triangle);
        polygon.clip((1u << kClipPlanes) - 1);
        for (const ScreenVertex& v : polygon.vertices()) {
            farthest = std::max({farthest, std::abs(v.x / v.w) - double(kGuardBand), std::abs(v.y / v.w) - double(kGuardBand)});
            ++cuts;
        }
    }
    EXPECT_LE(farthest, 1e-9);
    tell_tested(cuts, "cuts");
    tell_worst_case("pixels_beyond_the_guard_band", farthest);
}

TEST(Clip, DiscardsAndCountsTrianglesWithVerticesThatAreNotFinite) {
    const float infinity = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
    for (const float bad : {infinity, -infinity, nan}) {
        for (int component = 0; component < 3; ++component) {
            Mesh mesh;
            mesh.add({0, 0, 1}, {1, 0, 1}, {0, 1, 1});
            mesh.positions[1][component] = bad;
            const Draw draw = mesh.draw(kClipFromXyw);
            const Frame frame(square_frame(kSize), {&draw, 1});
            EXPECT_EQ(frame.counts().culled_nonfinite, 1u) << bad << " in component " << component;
            EXPECT_EQ(frame.triangle_count(), 0u);
        }
    }
    tell_worst_case("triangles_let_through", 0);
}

bool same_bits(const ScreenVertex& p, const ScreenVertex& q) { return std::memcmp(&p, &q, sizeof(p)) == 0; }

TEST(Clip, CutsASharedEdgeAtTheSameBitsFromBothSides) {
    std::mt19937 random(3);
    const auto vertex = [&] {
        const auto any = [&] { return double(uniform(random, -1, 1)) * std::pow(10.0, double(uniform(random, -3, 20))); };
        return ScreenVertex{any(), any(), any(), any()};
    };
    int cut_edges = 0;
    for (int i = 0; i < 20000 * stress_scale(); ++i) {
        const ScreenVertex a = vertex(), b = vertex();
        // Without a third corner that differs in place, all that is left of the edge a-b stands in both polygons.
        ClipPolygon one({a, b, a}), other({b, a, b});
        one.clip((1u << kClipPlanes) - 1);
        other.clip((1u << kClipPlanes) - 1);
        ASSERT_EQ(one.vertices().empty(), other.vertices().empty());
        cut_edges += !one.vertices().empty() && (outside_planes(a) | outside_planes(b)) != 0;
        for (const ScreenVertex& p : one.vertices()) {
            const bool found =
                std::any_of(other.vertices().begin(), other.vertices().end(), [&](const ScreenVertex& q) { return same_bits(p, q); });
            ASSERT_TRUE(found) << "edge " << i << ": " << p.x << " " << p.y << " " << p.z << " " << p.w;
        }
    }
    EXPECT_GT(cut_edges, 1000);
    tell_tested(uint64_t(cut_edges), "cut_edges");
    tell_worst_case("cuts_that_differ", 0);
}

/// The faces of a box, each a grid of n x n cells cut along random diagonals.
Mesh box_mesh(std::mt19937& random, const glm::vec3& half, int n) {
    Mesh mesh;
    for (int axis = 0; axis < 3; ++axis) {
        for (const float sign : {-1.0f, 1.0f}) {
            const auto point = [&](int i, int j) {
                glm::vec3 p;
                p[axis] = sign * half[axis];
                p[(axis + 1) % 3] = (2.0f * float(i) / float(n) - 1) * half[(axis + 1) % 3];
                p[(axis + 2) % 3] = (2.0f * float(j) / float(n) - 1) * half[(axis + 2) % 3];
                return p;
            };
            for (int i = 0; i < n; ++i) {
                for (int j = 0; j < n; ++j) {
                    const glm::vec3 a = point(i, j), b = point(i + 1, j), c = point(i, j + 1), d = point(i + 1, j + 1);
                    if (random() % 2) {
                        mesh.add(a, b, c);
                        mesh.add(c, b, d);
                    } else {
                        mesh.add(b, a, d);
                        mesh.add(a, c, d);
                    }
                }
            }
        }
    }
    return mesh;
}

TEST(Clip, LeavesAClosedMeshClosedAroundACameraInsideIt) {
    std::mt19937 random(4);
    uint64_t samples = 0, clipped = 0;
    for (int round = 0; round < 120 * stress_scale(); ++round) {
        const float size = std::exp2(uniform(random, -2, 18));
        const glm::vec3 half = size * glm::vec3(uniform(random, 0.5f, 2), uniform(random, 0.5f, 2), uniform(random, 0.5f, 2));
        const Mesh mesh = box_mesh(random, half, 1 + int(random() % 12));
        glm::mat4 object(1.0f);
        for (int i = 0; i < 3; ++i) object[3][i] = uniform(random, -0.9f, 0.9f) * half[i];
        // The nearest wall stays beyond the corners of the near plane.
        const float near_plane = 0.01f * size, focal = uniform(random, 0.5f, 3);
        const glm::mat4 clip = perspective(focal, 1, near_plane) * random_rotation(random) * object;
        Draw draw = mesh.draw(clip);
        draw.coverage = CoverageClass::Blended;
        const Frame frame(square_frame(kSize), {&draw, 1});
        clipped += frame.counts().clipped;
        for (const SamplePattern& pattern : sample_patterns()) {
            const std::vector<int> hits = count_candidates(frame, pattern);
            const auto wrong = std::find_if(hits.begin(), hits.end(), [](int n) { return n != 1; });
            ASSERT_EQ(wrong, hits.end()) << *wrong << " hits at pixel " << (wrong - hits.begin()) % kSize << ","
                                         << (wrong - hits.begin()) / kSize << " in round " << round;
            samples += hits.size();
        }
    }
    EXPECT_GT(clipped, 100u);
    tell_tested(samples);
    tell_worst_case("samples_not_hit_once", 0);
}

TEST(Clip, SlicesAMeshAtTheNearPlaneWithoutHolesOrDoubleHits) {
    std::mt19937 random(5);
    uint64_t samples = 0, clipped = 0, covered = 0;
    for (int round = 0; round < 60 * stress_scale(); ++round) {
        // A floor that passes under the eye, a little deeper than the near plane or not even that.
        const float below = uniform(random, 0.01f, 2), near_plane = 0.5f, extent = 1000;
        const int n = 2 + int(random() % 30);
        Mesh mesh;
        const auto at = [&](int i, int j) {
            return glm::vec3((2 * float(i) / float(n) - 1) * extent, -below, (2 * float(j) / float(n) - 1) * extent);
        };
        for (int i = 0; i < n; ++i) {
            for (int j = 0; j < n; ++j) {
                mesh.add(at(i, j), at(i + 1, j), at(i, j + 1));
                mesh.add(at(i, j + 1), at(i + 1, j), at(i + 1, j + 1));
            }
        }
        const float tilt = uniform(random, -1.2f, 1.2f), turn = uniform(random, 0, 6.2831853f);
        const glm::mat4 pitch = {1, 0, 0, 0, 0, std::cos(tilt), std::sin(tilt), 0, 0, -std::sin(tilt), std::cos(tilt), 0, 0, 0, 0, 1};
        const glm::mat4 yaw = {std::cos(turn), 0, -std::sin(turn), 0, 0, 1, 0, 0, std::sin(turn), 0, std::cos(turn), 0, 0, 0, 0, 1};
        const glm::mat4 clip = perspective(1, 1, near_plane) * pitch * yaw;
        Draw draw = mesh.draw(clip);
        draw.coverage = CoverageClass::Blended;
        const Frame frame(square_frame(kSize), {&draw, 1});
        clipped += frame.counts().clipped;
        // The whole floor as its two halves; a sample near the diagonal between them is left out twice.
        reference::QuadVertex half[2][3];
        const glm::vec3 corner[2][3] = {{at(0, 0), at(n, 0), at(0, n)}, {at(0, n), at(n, 0), at(n, n)}};
        for (int h = 0; h < 2; ++h) {
            for (int i = 0; i < 3; ++i) half[h][i] = reference::to_screen(clip, corner[h][i], kSize, kSize);
        }
        const reference::VisiblePart first_half(half[0]), second_half(half[1]);
        const std::vector<int> hits = count_candidates(frame, {});
        for (int y = 0; y < kSize; ++y) {
            for (int x = 0; x < kSize; ++x) {
                // Inner vertices are rounded to float, which bends the floor's screen edges a little.
                const reference::Side first = first_half.side_of(x + 0.5, y + 0.5, 1.0 / 64);
                const reference::Side second = second_half.side_of(x + 0.5, y + 0.5, 1.0 / 64);
                if (first == reference::Side::OnBorder || second == reference::Side::OnBorder) continue;
                const int expected = first == reference::Side::Inside || second == reference::Side::Inside;
                ++samples;
                covered += uint64_t(expected);
                ASSERT_EQ(hits[size_t(y * kSize + x)], expected) << "pixel " << x << "," << y << " in round " << round;
            }
        }
    }
    EXPECT_GT(clipped, 100u);
    EXPECT_GT(covered, 10000u);
    tell_tested(samples);
    tell_worst_case("samples_off", 0);
}

}  // namespace
}  // namespace rawtexel::raster
