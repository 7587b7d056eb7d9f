// Primitives: modes, indices, which vertices remain, normals and colours.
#include "tests/scenes/gltf_fixture.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace rawtexel::scenes {
namespace {

class GltfMeshTest : public testing::Test {
  protected:
    shading::Mesh mesh() { return load_fixture(folder_, fixture_, &warnings_).meshes.at(0); }
    std::string error() { return load_error(folder_, fixture_); }
    nlohmann::json& primitive() { return fixture_.json["meshes"][0]["primitives"][0]; }

    /// x of the corners of every triangle.
    static std::vector<std::array<float, 3>> triangles(const shading::Mesh& mesh) {
        std::vector<std::array<float, 3>> result;
        for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
            result.push_back(
                {mesh.positions[mesh.indices[i]].x, mesh.positions[mesh.indices[i + 1]].x, mesh.positions[mesh.indices[i + 2]].x});
        return result;
    }

    /// Vertices 0, 1, 2, … on a parabola, told apart by x.
    int parabola(int count) {
        std::vector<float> positions;
        for (int i = 0; i < count; ++i) positions.insert(positions.end(), {float(i), float(i * i), 0.0f});
        return fixture_.add_vec3(positions);
    }

    TemporaryFolder folder_;
    GltfFixture fixture_;
    std::vector<std::string> warnings_;
};

using Triangles = std::vector<std::array<float, 3>>;

TEST_F(GltfMeshTest, EveryTriangleModeMakesItsTriangles) {
    const int positions = parabola(6);
    fixture_.show({{"attributes", {{"POSITION", positions}}}});
    EXPECT_EQ(triangles(mesh()), (Triangles{{0, 1, 2}, {3, 4, 5}}));
    primitive()["mode"] = 5;  // p_i = v_i, v_{i+1+i%2}, v_{i+2-i%2}
    EXPECT_EQ(triangles(mesh()), (Triangles{{0, 1, 2}, {1, 3, 2}, {2, 3, 4}, {3, 5, 4}}));
    primitive()["mode"] = 6;  // p_i = v_{i+1}, v_{i+2}, v_0
    EXPECT_EQ(triangles(mesh()), (Triangles{{1, 2, 0}, {2, 3, 0}, {3, 4, 0}, {4, 5, 0}}));
}

TEST_F(GltfMeshTest, IncompleteTrianglesAreLeftOutAndTold) {
    const int positions = parabola(6);
    fixture_.show({{"attributes", {{"POSITION", positions}}}});
    mesh();
    EXPECT_TRUE(warnings_.empty());
    for (const auto& indices : {std::vector<uint16_t>{0, 1, 2, 3}, {0, 1, 2, 3, 4}}) {
        primitive()["indices"] = fixture_.add_indices<uint16_t>(indices);
        warnings_.clear();
        EXPECT_EQ(triangles(mesh()), (Triangles{{0, 1, 2}}));
        ASSERT_EQ(warnings_.size(), 1u);
        EXPECT_TRUE(says(warnings_[0], "incomplete triangles are left out"));
    }
    primitive()["mode"] = 5;  // a strip may have any number above 2
    warnings_.clear();
    EXPECT_EQ(triangles(mesh()).size(), 3u);
    EXPECT_TRUE(warnings_.empty());
}

TEST_F(GltfMeshTest, NothingToDrawIsTold) {
    load_fixture(folder_, fixture_, &warnings_);
    ASSERT_EQ(warnings_.size(), 1u);
    EXPECT_TRUE(says(warnings_[0], "there is nothing to draw"));
    const int positions = parabola(6), indices = fixture_.add_indices<uint16_t>({0, 1});
    fixture_.show({{"attributes", {{"POSITION", positions}}}, {"indices", indices}, {"mode", 6}});
    warnings_.clear();
    load_fixture(folder_, fixture_, &warnings_);
    ASSERT_EQ(warnings_.size(), 2u);
    EXPECT_TRUE(says(warnings_[0], "incomplete triangles are left out"));
    EXPECT_TRUE(says(warnings_[1], "there is nothing to draw"));
}

TEST_F(GltfMeshTest, TexturesWithoutTheirCoordinatesAreTold) {
    fixture_.add("textures", {{"source", fixture_.add_image(test_png(), "image/png")}});
    fixture_.add("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}, {"texCoord", 1}}}}}});
    auto quad = quad_primitive(fixture_);
    quad["material"] = 0;
    fixture_.show(quad);
    load_fixture(folder_, fixture_, &warnings_);
    EXPECT_TRUE(warnings_.empty()) << warnings_[0];
    primitive()["attributes"].erase("TEXCOORD_1");
    load_fixture(folder_, fixture_, &warnings_);
    ASSERT_EQ(warnings_.size(), 1u);
    EXPECT_TRUE(says(warnings_[0], "meshes without TEXCOORD_1 show one point"));
}

TEST_F(GltfMeshTest, ScenesBeyondTheirReachAreRefused) {
    const int positions = fixture_.add_vec3({0, 0, 0, 1, 0, 0, 0, 1, 0}),
              huge = fixture_.add_vec3({-3e38f, -3e38f, 0, 3e38f, 0, 0, 0, 3e38f, 0});
    fixture_.show({{"attributes", {{"POSITION", positions}}}});
    nlohmann::json& node = fixture_.json["nodes"][0];
    EXPECT_EQ(error(), "");
    node["scale"] = {1e14, 1e14, 1e14};
    EXPECT_EQ(error(), "");
    node["scale"] = {1, 1e30, 1};
    EXPECT_TRUE(says(error(), "the scene reaches 1e+30 metres (allowed: below 1e15)"));
    node["scale"] = {1, 1, 1};
    node["translation"] = {0, 0, -2e15};
    EXPECT_TRUE(says(error(), "the scene reaches 2e+15 metres (allowed: below 1e15)"));
    node.erase("translation");
    primitive()["attributes"]["POSITION"] = huge;
    EXPECT_TRUE(says(error(), "the scene reaches 3e+38 metres"));
    node["scale"] = {1e-30, 1e-30, 1e-30};
    EXPECT_EQ(error(), "");
    // What is not drawn reaches nowhere.
    fixture_.add_node({{"translation", {1e30, 0, 0}}});
    EXPECT_EQ(error(), "");
}

TEST_F(GltfMeshTest, EveryIndexTypeIsRead) {
    const int positions = parabola(4);
    fixture_.show({{"attributes", {{"POSITION", positions}}}});
    primitive()["indices"] = fixture_.add_indices<uint8_t>({3, 1, 0});
    EXPECT_EQ(triangles(mesh()), (Triangles{{3, 1, 0}}));
    primitive()["indices"] = fixture_.add_indices<uint16_t>({3, 1, 0});
    EXPECT_EQ(triangles(mesh()), (Triangles{{3, 1, 0}}));
    primitive()["indices"] = fixture_.add_indices<uint32_t>({3, 1, 0});
    EXPECT_EQ(triangles(mesh()), (Triangles{{3, 1, 0}}));
    primitive()["indices"] = fixture_.add_indices<int16_t>({3, 1, 0});
    EXPECT_TRUE(says(error(), "indices is SCALAR of signed 16-bit"));
    primitive()["indices"] = fixture_.add_indices<uint16_t>({3, 1, 4});
    EXPECT_TRUE(says(error(), "indices holds 4 at element 2 (allowed: 0 to 3)"));
    primitive()["indices"] = fixture_.add_indices<uint8_t>({3, 1, 255});
    EXPECT_TRUE(says(error(), "indices holds 255"));
}

TEST_F(GltfMeshTest, StripsAndFansAreIndexedToo) {
    const int positions = parabola(5);
    fixture_.show({{"attributes", {{"POSITION", positions}}}, {"indices", fixture_.add_indices<uint8_t>({4, 3, 2, 1})}, {"mode", 5}});
    EXPECT_EQ(triangles(mesh()), (Triangles{{4, 3, 2}, {3, 1, 2}}));
}

TEST_F(GltfMeshTest, AnIncompleteLastTriangleIsLeftOut) {
    fixture_.show({{"attributes", {{"POSITION", parabola(5)}}}});
    EXPECT_EQ(triangles(mesh()), (Triangles{{0, 1, 2}}));
    EXPECT_EQ(mesh().positions.size(), 3u);
}

TEST_F(GltfMeshTest, OnlyVerticesInUseRemainInTheirOrder) {
    for (const int count : {8, 5000}) {
        GltfFixture fresh;
        std::swap(fixture_, fresh);
        fixture_.show(
            {{"attributes", {{"POSITION", parabola(count)}}}, {"indices", fixture_.add_indices<uint16_t>({uint16_t(count - 1), 2, 5})}});
        const shading::Mesh loaded = mesh();
        ASSERT_EQ(loaded.positions.size(), 3u);
        EXPECT_EQ(loaded.positions[0].x, 2.0f);
        EXPECT_EQ(loaded.positions[1].x, 5.0f);
        EXPECT_EQ(loaded.positions[2].x, float(count - 1));
        EXPECT_EQ(triangles(loaded), (Triangles{{float(count - 1), 2, 5}}));
    }
}

TEST_F(GltfMeshTest, PointsAndLinesAreLeftOutAndSaidOnce) {
    const int positions = parabola(6);
    for (const int mode : {0, 1, 2, 3}) fixture_.show({{"attributes", {{"POSITION", positions}}}, {"mode", mode}});
    const shading::Scene scene = load_fixture(folder_, fixture_, &warnings_);
    EXPECT_TRUE(scene.meshes.empty());
    EXPECT_TRUE(scene.instances.empty());
    ASSERT_EQ(warnings_.size(), 2u);
    EXPECT_TRUE(says(warnings_[0], "points and lines are left out"));
    EXPECT_TRUE(says(warnings_[1], "there is nothing to draw"));
    fixture_.json["meshes"][0]["primitives"][0]["mode"] = 7;
    EXPECT_TRUE(says(error(), "mode is 7 (allowed: 0 POINTS, 1 LINES, 2 LINE_LOOP, 3 LINE_STRIP, 4 TRIANGLES, "));
}

TEST_F(GltfMeshTest, PositionIsRequired) {
    fixture_.show({{"attributes", {{"NORMAL", parabola(3)}}}});
    EXPECT_TRUE(says(error(), "meshes[0].primitives[0] has no POSITION"));
}

TEST_F(GltfMeshTest, PrimitivesBecomeMeshesAndNodesShareThem) {
    const int positions = parabola(3);
    const nlohmann::json one = {{"attributes", {{"POSITION", positions}}}};
    fixture_.add("meshes", {{"name", "pair"}, {"primitives", {one, one}}});
    fixture_.add_node({{"mesh", 0}});
    fixture_.add_node({{"mesh", 0}, {"translation", {1, 2, 3}}});
    const shading::Scene scene = load_fixture(folder_, fixture_);
    ASSERT_EQ(scene.meshes.size(), 2u);
    EXPECT_EQ(scene.meshes[0].name, "pair 0");
    EXPECT_EQ(scene.meshes[1].name, "pair 1");
    ASSERT_EQ(scene.instances.size(), 4u);
    for (size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(scene.instances[i].mesh, i % 2);
        EXPECT_EQ(scene.instances[i].world_from_object[3].x, i < 2 ? 0.0f : 1.0f);
    }
}

TEST_F(GltfMeshTest, ColoursOfThreeComponentsAreOpaque) {
    fixture_.show({{"attributes", {{"POSITION", parabola(3)}, {"COLOR_0", fixture_.add_vec3({1, 0, 0, 0, 1, 0, 0, 0, 0.5f})}}}});
    const shading::Mesh loaded = mesh();
    EXPECT_EQ(loaded.colors, (std::vector<glm::vec4>{{1, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 0.5f, 1}}));
}

TEST_F(GltfMeshTest, NormalsAreMadeUnitAndMissingOnesFollowTheTriangles) {
    const int positions = fixture_.add_vec3({0, 0, 0, 1, 0, 0, 0, 1, 0});
    fixture_.show({{"attributes", {{"POSITION", positions}, {"NORMAL", fixture_.add_vec3({0, 3, 4, 0, 0, 0, 1, 0, 0})}}}});
    const shading::Mesh loaded = mesh();
    EXPECT_NEAR(glm::distance(loaded.normals[0], glm::vec3(0, 0.6f, 0.8f)), 0.0f, 1e-7f);
    EXPECT_EQ(loaded.normals[1], glm::vec3(0, 0, 1));
    EXPECT_EQ(loaded.normals[2], glm::vec3(1, 0, 0));
}

TEST_F(GltfMeshTest, FurtherCoordinateSetsAreSaidOnceAndLeftOut) {
    nlohmann::json primitive = quad_primitive(fixture_);
    primitive["attributes"]["TEXCOORD_2"] = primitive["attributes"]["TEXCOORD_0"];
    fixture_.show(primitive);
    fixture_.show(primitive);
    load_fixture(folder_, fixture_, &warnings_);
    EXPECT_EQ(std::ranges::count_if(warnings_, [](const std::string& w) { return w.find("beyond the second set") != w.npos; }), 1);
}

/// A quad whose material has a normal map.
class NormalMappedTest : public GltfMeshTest {
  protected:
    void show(nlohmann::json primitive) {
        fixture_.add("textures", {{"source", fixture_.add_image(test_png(), "image/png")}});
        primitive["material"] = fixture_.add("materials", {{"normalTexture", {{"index", 0}}}});
        fixture_.show(primitive);
    }
};

TEST_F(NormalMappedTest, TangentsAreGeneratedWhereTheFileHasNone) {
    show(quad_primitive(fixture_));
    const shading::Mesh loaded = mesh();
    // u runs along +x and v along -y: the bitangent against v is +y, the frame right-handed.
    EXPECT_EQ(loaded.tangents, std::vector<glm::vec4>(4, glm::vec4(1, 0, 0, 1)));
}

TEST_F(NormalMappedTest, GivenTangentsAreKeptAndMadeUnit) {
    nlohmann::json primitive = quad_primitive(fixture_);
    primitive["attributes"]["TANGENT"] = fixture_.add_vec4({0, 2, 0, -1, 0, 1, 0, -1, 0, 1, 0, 1, 0, 1, 0, 0.5f});
    show(primitive);
    EXPECT_EQ(mesh().tangents, (std::vector<glm::vec4>{{0, 1, 0, -1}, {0, 1, 0, -1}, {0, 1, 0, 1}, {0, 1, 0, 1}}));
}

TEST_F(NormalMappedTest, WithoutANormalMapNoTangentsAreKept) {
    nlohmann::json primitive = quad_primitive(fixture_);
    primitive["attributes"]["TANGENT"] = fixture_.add_vec4(std::vector<float>(16, 1.0f));
    fixture_.show(primitive);
    EXPECT_TRUE(mesh().tangents.empty());
}

TEST_F(NormalMappedTest, TangentsFollowTheTextureTransform) {
    show(quad_primitive(fixture_));
    fixture_.json["materials"][0]["normalTexture"]["extensions"]["KHR_texture_transform"] = {{"scale", {-1, 1}}};
    EXPECT_EQ(mesh().tangents, std::vector<glm::vec4>(4, glm::vec4(-1, 0, 0, -1)));
}

TEST_F(NormalMappedTest, WithoutNormalsTheTrianglesAreFlatAndOfTheirOwn) {
    nlohmann::json primitive = quad_primitive(fixture_);
    primitive["attributes"].erase("NORMAL");
    show(primitive);
    const shading::Mesh loaded = mesh();
    EXPECT_EQ(loaded.positions.size(), 6u);
    EXPECT_EQ(loaded.normals, std::vector<glm::vec3>(6, glm::vec3(0, 0, 1)));
    EXPECT_EQ(loaded.tangents, std::vector<glm::vec4>(6, glm::vec4(1, 0, 0, 1)));
}

TEST_F(NormalMappedTest, WithoutCoordinatesTangentsArePerpendicularToTheNormals) {
    nlohmann::json primitive = quad_primitive(fixture_);
    primitive["attributes"].erase("TEXCOORD_0");
    show(primitive);
    const shading::Mesh loaded = mesh();
    ASSERT_TRUE(loaded.tangents.empty() || loaded.tangents.size() == loaded.positions.size());
    for (size_t i = 0; i < loaded.tangents.size(); ++i)
        EXPECT_NEAR(glm::dot(glm::vec3(loaded.tangents[i]), loaded.normals[i]), 0.0f, 1e-6f);
}

TEST_F(GltfMeshTest, ManyPrimitivesOnTheSameBytesAreRefusedBeforeMemoryRunsOut) {
    // 20 000 meshes of 300 000 vertices each would take 70 GB; the file has 4 MB.
    const int positions = fixture_.add_vec3(std::vector<float>(900000, 0.5f));
    nlohmann::json primitives = nlohmann::json::array();
    for (int i = 0; i < 20000; ++i) primitives.push_back({{"attributes", {{"POSITION", positions}}}});
    fixture_.add("meshes", {{"primitives", primitives}});
    fixture_.add_node({{"mesh", 0}});
    EXPECT_TRUE(says(error(), "asks for more memory than its size allows"));
}

}  // namespace
}  // namespace rawtexel::scenes
