// Morph targets and skins at rest.
#include "tests/scenes/gltf_fixture.h"

#include <gtest/gtest.h>

#include <cmath>

namespace rawtexel::scenes {
namespace {

class GltfDeformTest : public testing::Test {
  protected:
    shading::Scene scene() { return load_fixture(folder_, fixture_, &warnings_); }
    std::string error() { return load_error(folder_, fixture_); }
    nlohmann::json triangle() { return {{"attributes", {{"POSITION", fixture_.add_vec3({0, 0, 0, 1, 0, 0, 0, 1, 0})}}}}; }

    TemporaryFolder folder_;
    GltfFixture fixture_;
    std::vector<std::string> warnings_;
};

TEST_F(GltfDeformTest, TargetsAreAddedByTheirDefaultWeightsAndSaidOnce) {
    nlohmann::json primitive = triangle();
    primitive["targets"] = {{{"POSITION", fixture_.add_vec3({1, 0, 0, 1, 0, 0, 1, 0, 0})}},
                            {{"POSITION", fixture_.add_vec3({0, 0, 4, 0, 0, 8, 0, 0, 0})}}};
    fixture_.show(primitive);
    EXPECT_EQ(scene().meshes.at(0).positions[1], glm::vec3(1, 0, 0));  // no weights: 0
    fixture_.json["meshes"][0]["weights"] = {2, 0.25};
    EXPECT_EQ(scene().meshes.at(0).positions, (std::vector<glm::vec3>{{2, 0, 1}, {3, 0, 2}, {2, 1, 0}}));
    fixture_.json["nodes"][0]["weights"] = {0, 0.5};
    EXPECT_EQ(scene().meshes.at(0).positions, (std::vector<glm::vec3>{{0, 0, 2}, {1, 0, 4}, {0, 1, 0}}));
    warnings_.clear();
    scene();
    ASSERT_EQ(warnings_.size(), 1u);
    EXPECT_TRUE(says(warnings_[0], "morph targets are drawn at their default weights"));
}

TEST_F(GltfDeformTest, NodesWithOtherWeightsGetMeshesOfTheirOwn) {
    nlohmann::json primitive = triangle();
    primitive["targets"] = {{{"POSITION", fixture_.add_vec3({1, 0, 0, 1, 0, 0, 1, 0, 0})}}};
    fixture_.show(primitive);
    fixture_.add_node({{"mesh", 0}, {"weights", {1}}});
    fixture_.add_node({{"mesh", 0}});
    const shading::Scene loaded = scene();
    ASSERT_EQ(loaded.meshes.size(), 2u);
    EXPECT_EQ(loaded.instances[0].mesh, loaded.instances[2].mesh);
    EXPECT_EQ(loaded.meshes[loaded.instances[1].mesh].positions[0], glm::vec3(1, 0, 0));
}

TEST_F(GltfDeformTest, NormalsMorphAndAreMadeUnitAgain) {
    nlohmann::json primitive = triangle();
    primitive["attributes"]["NORMAL"] = fixture_.add_vec3({0, 0, 1, 0, 0, 1, 0, 0, 1});
    primitive["targets"] = {{{"NORMAL", fixture_.add_vec3({0, 1, 0, 0, 0, 0, 0, 0, 0})}}};
    fixture_.show(primitive);
    fixture_.json["meshes"][0]["weights"] = {1};
    const auto normals = scene().meshes.at(0).normals;
    EXPECT_NEAR(glm::distance(normals[0], glm::vec3(0, std::sqrt(0.5f), std::sqrt(0.5f))), 0.0f, 1e-6f);
    EXPECT_EQ(normals[1], glm::vec3(0, 0, 1));
}

TEST_F(GltfDeformTest, ShortTargetsAreRefused) {
    nlohmann::json primitive = triangle();
    primitive["targets"] = {{{"POSITION", fixture_.add_vec3({1, 0, 0})}}};
    fixture_.show(primitive);
    fixture_.json["meshes"][0]["weights"] = {1};
    EXPECT_TRUE(says(error(), "targets[0].POSITION has 1 elements"));
}

TEST_F(GltfDeformTest, DeformationsThatOverflowAreRefused) {
    nlohmann::json primitive = triangle();
    primitive["targets"] = {{{"POSITION", fixture_.add_vec3({1e38f, 0, 0, 0, 0, 0, 0, 0, 0})}}};
    fixture_.show(primitive);
    fixture_.json["meshes"][0]["weights"] = {1000};
    EXPECT_TRUE(says(error(), "leaves the range of single precision"));
}

/// A triangle on a skin of two joints.
class SkinTest : public GltfDeformTest {
  protected:
    SkinTest() {
        nlohmann::json primitive = triangle();
        primitive["attributes"]["NORMAL"] = fixture_.add_vec3({0, 0, 1, 0, 0, 1, 0, 0, 1});
        primitive["attributes"]["JOINTS_0"] = fixture_.add_values<uint8_t>("VEC4", 4, {0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0});
        primitive["attributes"]["WEIGHTS_0"] = fixture_.add_vec4({1, 0, 0, 0, 1, 0, 0, 0, 0.5f, 0.5f, 0, 0});
        fixture_.show(primitive);  // node 0
        fixture_.json["nodes"][0]["skin"] = 0;
        fixture_.json["nodes"][0]["translation"] = {100, 100, 100};  // plays no part
        fixture_.add_node({{"translation", {0, 0, 2}}});             // joint 0
        fixture_.add_node({{"translation", {10, 0, 0}}});            // joint 1
        fixture_.add("skins", {{"joints", {1, 2}}});
    }
};

TEST_F(SkinTest, VerticesFollowTheirJointsAndNotTheirNode) {
    const shading::Scene loaded = scene();
    EXPECT_EQ(loaded.instances.at(0).world_from_object, glm::mat4(1.0f));
    EXPECT_EQ(loaded.meshes.at(0).positions, (std::vector<glm::vec3>{{0, 0, 2}, {11, 0, 0}, {5, 1, 1}}));
    ASSERT_EQ(warnings_.size(), 1u);
    EXPECT_TRUE(says(warnings_[0], "skinned meshes are drawn as their joints stand in the file"));
}

TEST_F(SkinTest, InverseBindMatricesComeFirst) {
    // Joint 0 was bound where it stands now, joint 1 at (4, 0, 0).
    fixture_.json["skins"][0]["inverseBindMatrices"] = fixture_.add_values<float>(
        "MAT4", 16, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, -2, 1, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -4, 0, 0, 1});
    EXPECT_EQ(scene().meshes.at(0).positions, (std::vector<glm::vec3>{{0, 0, 0}, {7, 0, 0}, {3, 1, 0}}));
}

TEST_F(SkinTest, NormalsTurnWithTheJoints) {
    const float half = std::sqrt(0.5f);
    fixture_.json["nodes"][1]["rotation"] = {half, 0, 0, half};  // 90 degrees about X: Z goes to -Y
    fixture_.json["nodes"][1]["scale"] = {1, 1, 5};
    const auto normals = scene().meshes.at(0).normals;
    EXPECT_NEAR(glm::distance(normals[0], glm::vec3(0, -1, 0)), 0.0f, 1e-6f);
    EXPECT_NEAR(glm::distance(normals[1], glm::vec3(0, 0, 1)), 0.0f, 1e-6f);
}

TEST_F(SkinTest, MirroredJointsKeepTheTrianglesFacing) {
    for (const int joint : {1, 2}) fixture_.json["nodes"][size_t(joint)] = {{"scale", {-1, 1, 1}}};
    const shading::Mesh mesh = scene().meshes.at(0);
    const auto corner = [&](size_t k) { return mesh.positions[mesh.indices[k]]; };
    const glm::vec3 facing = glm::cross(corner(1) - corner(0), corner(2) - corner(0));
    EXPECT_GT(glm::dot(facing, mesh.normals[0]), 0.0f);
}

TEST_F(SkinTest, WeightsThatAreMissingFollowTheFirstJoint) {
    fixture_.json["meshes"][0]["primitives"][0]["attributes"]["WEIGHTS_0"] = fixture_.add_vec4(std::vector<float>(12, 0.0f));
    EXPECT_EQ(scene().meshes.at(0).positions[0], glm::vec3(0, 0, 2));
}

TEST_F(SkinTest, JointsAndMatricesThatDoNotFitAreRefused) {
    auto& attributes = fixture_.json["meshes"][0]["primitives"][0]["attributes"];
    const auto good = attributes;
    attributes["JOINTS_0"] = fixture_.add_values<uint8_t>("VEC4", 4, {0, 0, 0, 0, 2, 0, 0, 0, 0, 1, 0, 0});
    EXPECT_TRUE(says(error(), "JOINTS_0 holds 2 at element 1 (allowed: 0 to 1)"));
    attributes = good;
    attributes.erase("WEIGHTS_0");
    EXPECT_TRUE(says(error(), "has a skin but no JOINTS_0 and WEIGHTS_0"));
    attributes = good;
    attributes["WEIGHTS_0"] = fixture_.add_vec4({1, 0, 0, 0});
    EXPECT_TRUE(says(error(), "WEIGHTS_0 has 1 elements (allowed: as many as POSITION, 3)"));
    attributes = good;
    attributes["JOINTS_0"] = fixture_.add_vec4(std::vector<float>(12, 0.0f));
    EXPECT_TRUE(says(error(), "JOINTS_0 is VEC4 of float (allowed: unsigned integers)"));
    attributes = good;
    fixture_.json["skins"][0]["inverseBindMatrices"] = fixture_.add_values<float>("MAT4", 16, std::vector<float>(16));
    EXPECT_TRUE(says(error(), "inverseBindMatrices has 1 elements (allowed: at least 2"));
    fixture_.json["skins"][0].erase("inverseBindMatrices");
    fixture_.json["skins"][0]["joints"] = {1, 9};
    EXPECT_TRUE(says(error(), "skins[0].joints[1] is 9 (allowed: an index of nodes, 0 to 2)"));
    fixture_.json["skins"][0]["joints"] = nlohmann::json::array();
    EXPECT_TRUE(says(error(), "skins[0] has no joints"));
}

}  // namespace
}  // namespace rawtexel::scenes
