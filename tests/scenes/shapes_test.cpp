// Solids: closed, wound outwards, with frames that agree with their formulas.
#include "scenes/shapes.h"

#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace rawtexel::scenes {
namespace {

using shading::Mesh;

/// Volume by the divergence theorem: positive when faces look outwards.
double enclosed_volume(const Mesh& mesh) {
    double six_volumes = 0.0;
    for (size_t i = 0; i < mesh.indices.size(); i += 3) {
        const auto at = [&](size_t k) { return glm::dvec3(mesh.positions[mesh.indices[i + k]]); };
        six_volumes += glm::dot(at(0), glm::cross(at(1), at(2)));
    }
    return six_volumes / 6.0;
}

/// Checks what every shape promises; the worst numbers found are printed.
void expect_sound(const Mesh& mesh, const std::string& what) {
    ASSERT_FALSE(mesh.indices.empty()) << what;
    ASSERT_EQ(mesh.normals.size(), mesh.positions.size()) << what;
    ASSERT_EQ(mesh.tangents.size(), mesh.positions.size()) << what;
    ASSERT_EQ(mesh.uv[0].size(), mesh.positions.size()) << what;
    float worst_length = 0.0f, worst_tangent = 0.0f, worst_angle = 0.0f;
    for (size_t i = 0; i < mesh.positions.size(); ++i) {
        worst_length = std::max(worst_length, std::abs(glm::length(mesh.normals[i]) - 1.0f));
        worst_tangent = std::max(worst_tangent, std::abs(glm::length(glm::vec3(mesh.tangents[i])) - 1.0f));
        worst_angle = std::max(worst_angle, std::abs(glm::dot(mesh.normals[i], glm::vec3(mesh.tangents[i]))));
        EXPECT_EQ(std::abs(mesh.tangents[i].w), 1.0f) << what << " point " << i;
    }
    EXPECT_LT(worst_length, 1e-6f) << what;
    EXPECT_LT(worst_tangent, 1e-6f) << what;
    EXPECT_LT(worst_angle, 1e-6f) << what;
}

/// Faces look where their normals do, and tangents where their texture coordinates grow.
void expect_frames_follow_triangles(const Mesh& mesh, const std::string& what) {
    for (size_t i = 0; i < mesh.indices.size(); i += 3) {
        const std::array<uint32_t, 3> v{mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]};
        ASSERT_LT(std::max({v[0], v[1], v[2]}), mesh.positions.size()) << what;
        const glm::dvec3 e1(mesh.positions[v[1]] - mesh.positions[v[0]]), e2(mesh.positions[v[2]] - mesh.positions[v[0]]);
        const glm::dvec3 face = glm::cross(e1, e2);
        const glm::dvec2 t1(mesh.uv[0][v[1]] - mesh.uv[0][v[0]]), t2(mesh.uv[0][v[2]] - mesh.uv[0][v[0]]);
        const double area = t1.x * t2.y - t1.y * t2.x;
        const glm::dvec3 along_u = (e1 * t2.y - e2 * t1.y) / area, up = -(e2 * t1.x - e1 * t2.x) / area;
        for (const uint32_t k : v) {
            const glm::dvec3 normal(mesh.normals[k]), tangent(glm::vec3(mesh.tangents[k]));
            EXPECT_GT(glm::dot(face, normal), 0.0) << what << " triangle " << i / 3;
            if (std::abs(area) < 1e-12) continue;
            EXPECT_GT(glm::dot(tangent, along_u), 0.0) << what << " triangle " << i / 3;
            EXPECT_GT(glm::dot(double(mesh.tangents[k].w) * glm::cross(normal, tangent), up), 0.0) << what << " triangle " << i / 3;
        }
    }
}

std::vector<std::pair<std::string, Mesh>> one_of_each() {
    std::vector<std::pair<std::string, Mesh>> shapes;
    const auto add = [&](const char* name, auto&& append) {
        shapes.emplace_back(name, Mesh{});
        append(shapes.back().second);
    };
    add("rectangle", [](Mesh& m) { append_rectangle(m, {1, 2, 3}, {2, 0, 0}, {0, 1, -1}, {0, 1}, {2, 0}); });
    add("sphere", [](Mesh& m) { append_sphere(m, 2.0f, 24, 13, {3, 1}); });
    add("rounded box", [](Mesh& m) { append_rounded_box(m, {1, -2, 0.5f}, {1, 2, 3}, 0.25f, 1.5f); });
    add("lathe", [](Mesh& m) {
        const std::array<glm::vec2, 6> profile{{{0.5f, 0}, {1, 0.2f}, {1.1f, 0.9f}, {0.6f, 1.2f}, {0.6f, 2}, {0.2f, 2.1f}}};
        append_lathe(m, profile, 20, 2.0f, 1.0f);
    });
    add("tube", [](Mesh& m) {
        const std::array<glm::vec3, 4> path{{{0, 0, 0}, {0.2f, 1, 0}, {0.7f, 1.8f, 0.3f}, {1.6f, 2.2f, 0.2f}}};
        append_tube(m, path, 0.2f, 0.1f, 12, 1.0f, 1.0f);
    });
    add("torus", [](Mesh& m) { append_torus(m, 2.0f, 0.5f, 32, 16, {4, 1}); });
    return shapes;
}

TEST(Shapes, HaveUnitFramesThatFollowTheirTriangles) {
    for (const auto& [name, mesh] : one_of_each()) {
        expect_sound(mesh, name);
        expect_frames_follow_triangles(mesh, name);
    }
}

TEST(Shapes, KeepTheirFramesWhenMovedTurnedAndMirrored) {
    for (const auto& [name, part] : one_of_each()) {
        for (const glm::vec3 scale : {glm::vec3(1, 1, 1), glm::vec3(-1, 2, 0.5f), glm::vec3(-1, -2, -3)}) {
            const glm::mat4 turn = glm::rotate(glm::translate(glm::mat4(1.0f), {3, 4, 5}), 1.1f, glm::normalize(glm::vec3(1, 2, 3)));
            Mesh mesh;
            append_mesh(mesh, part, glm::scale(turn, scale));
            const std::string what = name + " scaled by " + std::to_string(scale.x);
            expect_sound(mesh, what);
            expect_frames_follow_triangles(mesh, what);
        }
    }
}

TEST(Shapes, EncloseTheirVolume) {
    Mesh sphere, box, torus;
    append_sphere(sphere, 2.0f, 200, 100, {1, 1});
    EXPECT_NEAR(enclosed_volume(sphere), 4.0 / 3.0 * glm::pi<double>() * 8.0, 0.03);
    append_rounded_box(box, {5, 6, 7}, {1, 2, 3}, 1e-4f, 1.0f);
    EXPECT_NEAR(enclosed_volume(box), 48.0, 1e-2);
    append_torus(torus, 2.0f, 0.5f, 256, 128, {1, 1});
    EXPECT_NEAR(enclosed_volume(torus), 2.0 * glm::pi<double>() * glm::pi<double>() * 2.0 * 0.25, 0.01);
}

TEST(Shapes, SphereHasTheTrianglesItSays) {
    for (const auto& [around, rings] : {std::pair{100, 101}, std::pair{3, 2}, std::pair{17, 9}}) {
        Mesh mesh;
        append_sphere(mesh, 1.0f, around, rings, {1, 1});
        EXPECT_EQ(mesh.indices.size() / 3, size_t(2 * around * (rings - 1))) << around << " x " << rings;
    }
}

TEST(Shapes, UnusedPointsGoAndNothingElse) {
    Mesh mesh;
    append_sphere(mesh, 1.0f, 12, 6, {1, 1});
    tint(mesh, [](glm::vec3 p, glm::vec3) { return p; });
    Mesh compact = mesh;
    drop_unused_points(compact);
    EXPECT_LT(compact.positions.size(), mesh.positions.size());
    ASSERT_EQ(compact.indices.size(), mesh.indices.size());
    std::vector<bool> used(compact.positions.size());
    for (size_t i = 0; i < mesh.indices.size(); ++i) {
        const uint32_t a = mesh.indices[i], b = compact.indices[i];
        used[b] = true;
        EXPECT_EQ(mesh.positions[a], compact.positions[b]);
        EXPECT_EQ(mesh.normals[a], compact.normals[b]);
        EXPECT_EQ(mesh.tangents[a], compact.tangents[b]);
        EXPECT_EQ(mesh.uv[0][a], compact.uv[0][b]);
        EXPECT_EQ(mesh.colors[a], compact.colors[b]);
    }
    for (const bool u : used) EXPECT_TRUE(u);
}

TEST(Shapes, SettledUnitsStayWhenNormalisedAgain) {
    uint32_t state = 1;
    const auto random = [&] {
        state = state * 1664525u + 1013904223u;
        return float(state >> 8) * 0x1p-24f - 0.5f;
    };
    for (int i = 0; i < 100000; ++i) {
        const glm::vec3 v(random(), random(), random());
        if (glm::length(v) < 1e-3f) continue;
        const glm::vec3 unit = settled_unit(v);
        const glm::dvec3 exact(unit);
        ASSERT_EQ(glm::vec3(exact / glm::length(exact)), unit) << v.x << ' ' << v.y << ' ' << v.z;
    }
}

}  // namespace
}  // namespace rawtexel::scenes
