#include "scenes/tangents.h"

#include "scenes/load.h"
#include "scenes/mikktspace.h"
#include "tests/reference/scenes/tangent_reference.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <random>

namespace rawtexel::scenes {
namespace {

using shading::Mesh;

std::vector<glm::vec4> corners_of(const Mesh& mesh) {
    return mikktspace_tangents({mesh.positions, mesh.normals, mesh.uv[0], mesh.indices});
}

/// A grid of `n` x `n` quads, each cut along the diagonal that `cut` chooses; the surface and its coordinates are functions of (x, y).
template <class Surface, class Coordinates, class Cut>
Mesh grid(int n, Surface surface, Coordinates coordinates, Cut cut) {
    Mesh mesh;
    for (int y = 0; y <= n; ++y)
        for (int x = 0; x <= n; ++x) {
            mesh.positions.push_back(surface(float(x), float(y)));
            mesh.uv[0].push_back(coordinates(float(x), float(y)));
            constexpr float kStep = 1e-2f;
            const glm::vec3 along_x = surface(float(x) + kStep, float(y)) - surface(float(x) - kStep, float(y));
            const glm::vec3 along_y = surface(float(x), float(y) + kStep) - surface(float(x), float(y) - kStep);
            mesh.normals.push_back(glm::normalize(glm::cross(along_x, along_y)));
        }
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x) {
            const uint32_t a = uint32_t(y * (n + 1) + x), b = a + 1, c = a + uint32_t(n) + 1, d = c + 1;
            const std::array<uint32_t, 6> one = {a, b, d, a, d, c}, other = {a, b, c, b, d, c};
            const auto& chosen = cut(x, y) ? one : other;
            mesh.indices.insert(mesh.indices.end(), chosen.begin(), chosen.end());
        }
    return mesh;
}

glm::vec3 hill(float x, float y) { return {x, y, 0.3f * std::sin(x) + 0.2f * std::cos(0.7f * y)}; }
constexpr auto kAlwaysOne = [](int, int) { return true; };

/// Largest distance between the corners' tangents and the reference's where the latter says something; signs must agree.
double worst_difference(const Mesh& mesh) {
    const auto found = corners_of(mesh);
    const auto expected = reference::corner_tangents(mesh.positions, mesh.normals, mesh.uv[0], mesh.indices);
    double worst = 0.0;
    for (size_t i = 0; i < found.size(); ++i) {
        if (expected[i].w == 0.0) continue;
        EXPECT_EQ(double(found[i].w), expected[i].w) << "corner " << i;
        worst = std::max(worst, glm::distance(glm::dvec3(found[i]), glm::dvec3(expected[i])));
    }
    return worst;
}

TEST(MikkTSpace, AgreesWithTheOriginalOnAMirroredGrid) {
    // mikktspace.c 1.0 (npm mikktspace 1.1.1) on this very mesh, its signs as it gives them.
    constexpr glm::vec4 kOriginal[24] = {
        {-0.993807971f, 0.0993807837f, -0.0496904105f, -1.0f}, {-0.907264650f, -0.0824786127f, -0.412393034f, -1.0f},
        {-0.907264709f, -0.0824786201f, -0.412393063f, -1.0f}, {-0.993807971f, 0.0993807837f, -0.0496904105f, -1.0f},
        {-0.907264709f, -0.0824786201f, -0.412393063f, -1.0f}, {-0.993807971f, 0.0993807763f, -0.0496904068f, -1.0f},
        {0.878458679f, -0.0675737560f, 0.473016173f, 1.0f},    {0.717517614f, 0.0448448472f, 0.695095241f, 1.0f},
        {0.717517555f, 0.0448448434f, 0.695095181f, 1.0f},     {0.878458679f, -0.0675737560f, 0.473016173f, 1.0f},
        {0.717517555f, 0.0448448434f, 0.695095181f, 1.0f},     {0.878458619f, -0.0675737560f, 0.473016113f, 1.0f},
        {-0.993807971f, 0.0993807763f, -0.0496904068f, -1.0f}, {-0.907264709f, -0.0824786201f, -0.412393063f, -1.0f},
        {-0.907264650f, -0.0824786127f, -0.412393034f, -1.0f}, {-0.993807971f, 0.0993807763f, -0.0496904068f, -1.0f},
        {-0.907264650f, -0.0824786127f, -0.412393034f, -1.0f}, {-0.993808031f, 0.0993807837f, -0.0496904142f, -1.0f},
        {0.878458619f, -0.0675737560f, 0.473016113f, 1.0f},    {0.717517555f, 0.0448448434f, 0.695095181f, 1.0f},
        {0.717517614f, 0.0448448472f, 0.695095241f, 1.0f},     {0.878458619f, -0.0675737560f, 0.473016113f, 1.0f},
        {0.717517614f, 0.0448448472f, 0.695095241f, 1.0f},     {0.878458560f, -0.0675737485f, 0.473016083f, 1.0f},
    };
    Mesh mesh = grid(
        2, [](float x, float y) { return glm::vec3(x, y, 0.25f * x * x - 0.5f * y); },
        [](float x, float y) { return glm::vec2(std::abs(x - 1) * 0.5f + 0.125f * y, 0.25f * y); }, kAlwaysOne);
    for (size_t i = 0; i < mesh.normals.size(); ++i) {
        const glm::dvec3 normal(-0.5 * double(mesh.positions[i].x), 0.5, 1.0);
        mesh.normals[i] = glm::vec3(glm::normalize(normal));
    }
    const auto found = corners_of(mesh);
    ASSERT_EQ(found.size(), std::size(kOriginal));
    for (size_t i = 0; i < found.size(); ++i) {
        EXPECT_LE(glm::distance(glm::vec3(found[i]), glm::vec3(kOriginal[i])), 1e-6f) << "corner " << i;
        EXPECT_EQ(found[i].w, kOriginal[i].w) << "corner " << i;
    }
}

TEST(MikkTSpace, AgreesWithTheDefinitionInDoublePrecision) {
    std::mt19937 random(1);
    double worst = 0.0;
    for (int trial = 0; trial < 12; ++trial) {
        const float shear = float(random() % 100) / 200.0f, mirror = float(trial % 3 == 1 ? 3 : -100);
        const auto coordinates = [&](float x, float y) {
            return glm::vec2(std::abs(x - mirror) * 0.2f + shear * y * 0.1f + 0.01f * x * y, 0.3f * y + (trial % 2 ? 0.02f * x * x : 0.0f));
        };
        const Mesh mesh = grid(6, hill, coordinates, [&](int, int) { return random() % 2 == 0; });
        worst = std::max(worst, worst_difference(mesh));
    }
    EXPECT_LE(worst, 2e-6);
    RecordProperty("worst", std::to_string(worst));
}

TEST(MikkTSpace, WeldsVerticesThatAgreeInEverything) {
    const Mesh mesh = grid(
        4, hill, [](float x, float y) { return glm::vec2(x, y * y) * 0.1f; }, kAlwaysOne);
    Mesh separate;
    for (const uint32_t i : mesh.indices) {
        separate.indices.push_back(uint32_t(separate.positions.size()));
        separate.positions.push_back(mesh.positions[i]);
        separate.normals.push_back(mesh.normals[i]);
        separate.uv[0].push_back(mesh.uv[0][i]);
    }
    EXPECT_EQ(corners_of(separate), corners_of(mesh));
}

TEST(MikkTSpace, TheOrderOfTrianglesPlaysNoPart) {
    const Mesh mesh = grid(
        5, hill, [](float x, float y) { return glm::vec2(std::abs(x - 2), y) * 0.1f; }, kAlwaysOne);
    std::vector<size_t> order(mesh.indices.size() / 3);
    std::iota(order.begin(), order.end(), size_t{0});
    std::mt19937 random(2);
    std::ranges::shuffle(order, random);
    Mesh shuffled = mesh;
    for (size_t t = 0; t < order.size(); ++t) std::copy_n(&mesh.indices[3 * order[t]], 3, &shuffled.indices[3 * t]);
    const auto straight = corners_of(mesh), mixed = corners_of(shuffled);
    for (size_t i = 0; i < mixed.size(); ++i) {
        const glm::vec4 expected = straight[3 * order[i / 3] + i % 3];
        EXPECT_LE(glm::distance(glm::vec3(mixed[i]), glm::vec3(expected)), 1e-6f) << i;
        EXPECT_EQ(mixed[i].w, expected.w) << i;
    }
}

TEST(MikkTSpace, AnglesWeighSoThatCuttingATriangleChangesNothing) {
    // A bent fan around vertex 0; its second triangle is cut from vertex 0 to a point on the opposite edge.
    Mesh whole;
    whole.positions = {{0, 0, 0}, {1, 0, 0.3f}, {0.2f, 1, 0}, {-1, 0.4f, 0.5f}};
    whole.normals.assign(4, glm::normalize(glm::vec3(0.1f, -0.2f, 1.0f)));
    whole.uv[0] = {{0, 0}, {1, 0.2f}, {0.3f, 1}, {-0.8f, 0.9f}};
    whole.indices = {0, 1, 2, 0, 2, 3};
    Mesh cut = whole;
    cut.positions.push_back(0.25f * whole.positions[2] + 0.75f * whole.positions[3]);
    cut.normals.push_back(whole.normals[0]);
    cut.uv[0].push_back(0.25f * whole.uv[0][2] + 0.75f * whole.uv[0][3]);
    cut.indices = {0, 1, 2, 0, 2, 4, 0, 4, 3};
    const glm::vec3 before(corners_of(whole)[0]), after(corners_of(cut)[0]);
    EXPECT_LE(glm::distance(before, after), 1e-6f);
}

TEST(MikkTSpace, TrianglesWithoutTextureAreaJoinTheirNeighbours) {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    mesh.normals.assign(4, {0, 0, 1});
    mesh.uv[0] = {{0, 0}, {1, 0}, {1, 1}, {0.5f, 0.5f}};  // the second triangle's coordinates lie on a line
    mesh.indices = {0, 1, 2, 0, 2, 3};
    const auto tangents = corners_of(mesh);
    for (const size_t corner : {0u, 1u, 2u, 3u, 4u}) EXPECT_EQ(tangents[corner], glm::vec4(1, 0, 0, 1)) << corner;
    EXPECT_EQ(tangents[5], glm::vec4(0.0f));  // vertex 3 has no other triangle
}

TEST(MikkTSpace, TrianglesWithoutAreaInSpaceFollowTheirVertices) {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}};
    mesh.normals.assign(3, {0, 0, 1});
    mesh.uv[0] = {{0, 0}, {0, 1}, {-1, 1}};
    mesh.indices = {0, 0, 1, 0, 1, 2};
    const auto tangents = corners_of(mesh);
    for (const size_t corner : {0u, 1u, 2u}) EXPECT_EQ(tangents[corner], tangents[3]) << corner;
}

TEST(Tangents, BitangentsPointUpInTheImage) {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.normals.assign(3, {0, 0, 1});
    mesh.uv[0] = {{0, 1}, {1, 1}, {0, 0}};  // v runs down
    mesh.indices = {0, 1, 2};
    generate_tangents(mesh, 0);
    for (const glm::vec4& t : mesh.tangents) {
        EXPECT_EQ(glm::vec3(t), glm::vec3(1, 0, 0));
        EXPECT_EQ(t.w * glm::cross(glm::vec3(0, 0, 1), glm::vec3(t)), glm::vec3(0, 1, 0));
    }
}

TEST(Tangents, VerticesOnAMirroredSeamAreSplitAndNothingElseChanges) {
    Mesh mesh = grid(
        4, hill, [](float x, float y) { return glm::vec2(std::abs(x - 2), y) * 0.1f; }, kAlwaysOne);
    mesh.uv[1] = mesh.uv[0];
    mesh.colors.assign(mesh.positions.size(), glm::vec4(0.5f));
    const Mesh before = mesh;
    generate_tangents(mesh, 0);
    EXPECT_EQ(mesh.positions.size(), before.positions.size() + 5);
    for (const size_t length : {mesh.normals.size(), mesh.tangents.size(), mesh.uv[0].size(), mesh.uv[1].size(), mesh.colors.size()})
        EXPECT_EQ(length, mesh.positions.size());
    ASSERT_EQ(mesh.indices.size(), before.indices.size());
    for (size_t i = 0; i < mesh.indices.size(); ++i) {
        EXPECT_EQ(mesh.positions[mesh.indices[i]], before.positions[before.indices[i]]);
        EXPECT_EQ(mesh.normals[mesh.indices[i]], before.normals[before.indices[i]]);
        EXPECT_EQ(mesh.uv[0][mesh.indices[i]], before.uv[0][before.indices[i]]);
        const float middle = (before.positions[before.indices[i / 3 * 3]].x + before.positions[before.indices[i / 3 * 3 + 1]].x +
                              before.positions[before.indices[i / 3 * 3 + 2]].x) /
                             3;
        EXPECT_EQ(mesh.tangents[mesh.indices[i]].w, middle < 2 ? 1.0f : -1.0f) << i;
    }
}

TEST(Tangents, AreUnitAndPerpendicularWhateverTheMesh) {
    std::mt19937 random(3);
    const auto number = [&] { return float(random() % 7) - 3.0f; };
    for (int trial = 0; trial < 200; ++trial) {
        Mesh mesh;
        for (int i = 0; i < 12; ++i) {
            mesh.positions.push_back({number(), number(), number()});
            const glm::vec3 n(number(), number(), number());
            mesh.normals.push_back(n == glm::vec3(0.0f) ? glm::vec3(0, 1, 0) : glm::normalize(n));
            mesh.uv[0].push_back({number(), number()});
        }
        for (int i = 0; i < 60; ++i) mesh.indices.push_back(uint32_t(random() % 12));
        generate_tangents(mesh, 0);
        for (size_t i = 0; i < mesh.tangents.size(); ++i) {
            EXPECT_NEAR(glm::length(glm::vec3(mesh.tangents[i])), 1.0f, 1e-3f);
            EXPECT_EQ(std::abs(mesh.tangents[i].w), 1.0f);
        }
        for (const uint32_t i : mesh.indices) {
            EXPECT_LT(i, mesh.positions.size());
            EXPECT_NEAR(glm::dot(glm::vec3(mesh.tangents[i]), mesh.normals[i]), 0.0f, 1e-2f) << "trial " << trial;
        }
    }
}

TEST(Tangents, OverflowingCoordinatesDoNoHarm) {
    Mesh mesh = grid(
        8, hill, [](float x, float y) { return glm::vec2((x - 3) * 3e37f, (y - 4) * 3e37f); }, kAlwaysOne);
    generate_tangents(mesh, 0, glm::mat3x2{1e30f, -1e30f, 1e30f, 1e30f, 0, 0});
    for (size_t i = 0; i < mesh.tangents.size(); ++i) EXPECT_NEAR(glm::length(glm::vec3(mesh.tangents[i])), 1.0f, 1e-3f) << i;
}

TEST(Tangents, AStarOfManyUnconnectedTrianglesTakesNoTimeSquared) {
    Mesh mesh;
    constexpr uint32_t kTriangles = 200000;
    mesh.positions.push_back({0, 0, 0});
    mesh.uv[0].push_back({0, 0});
    for (uint32_t t = 0; t < kTriangles; ++t) {
        const float a = float(t) * 1e-4f;
        mesh.positions.insert(mesh.positions.end(), {{std::cos(a), std::sin(a), 0}, {2 * std::cos(a), 3 * std::sin(a), float(t)}});
        mesh.uv[0].insert(mesh.uv[0].end(), {{1, float(t)}, {float(t), 1}});
        mesh.indices.insert(mesh.indices.end(), {0, 2 * t + 1, 2 * t + 2});
    }
    mesh.normals.assign(mesh.positions.size(), {0, 0, 1});
    generate_tangents(mesh, 0);
    EXPECT_EQ(mesh.tangents.size(), mesh.positions.size());
}

TEST(Tangents, ManyTrianglesOnOneEdgeTakeNoTimeSquared) {
    Mesh mesh;
    constexpr uint32_t kTriangles = 200000;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}};
    mesh.uv[0] = {{0, 0}, {1, 0}};
    for (uint32_t t = 0; t < kTriangles; ++t) {
        mesh.positions.push_back({float(t % 100), float(t / 100 + 1), 0});
        mesh.uv[0].push_back({0, 1});
        mesh.indices.insert(mesh.indices.end(), {0, 1, t + 2});
    }
    mesh.normals.assign(mesh.positions.size(), {0, 0, 1});
    generate_tangents(mesh, 0);
    EXPECT_EQ(mesh.tangents.size(), mesh.positions.size());
}

TEST(Tangents, OfTheNormalTangentTestAgreeWithTheDefinition) {
    const char* corpus = std::getenv("RAWTEXEL_CORPUS");
    if (!corpus) GTEST_SKIP() << "RAWTEXEL_CORPUS is not set: the tangents of NormalTangentTest are not checked";
    const shading::Scene scene = load_gltf(std::string(corpus) + "/gltf/khronos_tests/NormalTangentTest.glb");
    const Mesh& mesh = scene.meshes.at(0);
    constexpr size_t kPart = 900;  // indices: the reference is slow
    double worst = 0.0;
    for (size_t first = 0; first + kPart <= mesh.indices.size(); first += 6 * kPart) {
        Mesh part = mesh;
        part.indices.assign(mesh.indices.begin() + std::ptrdiff_t(first), mesh.indices.begin() + std::ptrdiff_t(first + kPart));
        worst = std::max(worst, worst_difference(part));
    }
    EXPECT_LE(worst, 2e-5);
}

}  // namespace
}  // namespace rawtexel::scenes
