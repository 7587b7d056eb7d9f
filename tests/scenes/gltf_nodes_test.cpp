// The node hierarchy, and the lights and cameras on it.
#include "tests/scenes/gltf_fixture.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include <cmath>

namespace rawtexel::scenes {
namespace {

class GltfNodesTest : public testing::Test {
  protected:
    GltfNodesTest() {
        const int mesh = fixture_.add("meshes", {{"primitives", nlohmann::json::array({quad_primitive(fixture_)})}});
        EXPECT_EQ(mesh, 0);
    }
    shading::Scene scene() { return load_fixture(folder_, fixture_, &warnings_); }
    std::string error() { return load_error(folder_, fixture_); }
    nlohmann::json& node(int i) { return fixture_.json["nodes"][size_t(i)]; }

    static void expect_near(const glm::mat4& found, const glm::mat4& expected) {
        for (int c = 0; c < 4; ++c)
            for (int r = 0; r < 4; ++r) EXPECT_NEAR(found[c][r], expected[c][r], 1e-5f) << "column " << c << " row " << r;
    }

    TemporaryFolder folder_;
    GltfFixture fixture_;
    std::vector<std::string> warnings_;
};

TEST_F(GltfNodesTest, TranslationRotationAndScaleApplyInThisOrderUnderTheParents) {
    const float half = std::sqrt(0.5f);
    fixture_.add_node({{"translation", {1, 2, 3}}, {"rotation", {0, 0, half, half}}, {"scale", {2, 3, -4}}, {"children", {1}}});
    fixture_.add("nodes", {{"mesh", 0}, {"translation", {1, 0, 0}}});
    glm::mat4 expected = glm::translate(glm::mat4(1.0f), {1, 2, 3});
    expected = glm::rotate(expected, glm::radians(90.0f), {0, 0, 1});
    expected = glm::scale(expected, {2, 3, -4});
    expected = glm::translate(expected, {1, 0, 0});
    const glm::mat4 found = scene().instances.at(0).world_from_object;
    expect_near(found, expected);
    EXPECT_LT(glm::determinant(glm::mat3(found)), 0.0f);
}

TEST_F(GltfNodesTest, MatricesAreColumnMajor) {
    fixture_.add_node({{"mesh", 0}, {"matrix", {1, 2, 3, 0, 4, 5, 6, 0, 7, 8, 10, 0, 11, 12, 13, 1}}});
    expect_near(scene().instances.at(0).world_from_object, glm::mat4(1, 2, 3, 0, 4, 5, 6, 0, 7, 8, 10, 0, 11, 12, 13, 1));
    node(0)["matrix"][3] = 0.5;
    EXPECT_TRUE(says(error(), "nodes[0].matrix is not affine"));
    node(0)["matrix"] = {1, 2, 3};
    EXPECT_TRUE(says(error(), "nodes[0].matrix is an array of 3 (allowed: an array of 16)"));
}

TEST_F(GltfNodesTest, QuaternionsAreMadeUnitAndZeroIsRefused) {
    fixture_.add_node({{"mesh", 0}, {"rotation", {0, 0, 3, 3}}});
    expect_near(scene().instances.at(0).world_from_object, glm::rotate(glm::mat4(1.0f), glm::radians(90.0f), {0, 0, 1}));
    node(0)["rotation"] = {0, 0, 0, 0};
    EXPECT_TRUE(says(error(), "nodes[0].rotation is zero"));
}

TEST_F(GltfNodesTest, CyclesAreRefusedWhereverTheyAre) {
    fixture_.add_node({{"mesh", 0}});
    fixture_.add("nodes", {{"children", {2}}});
    fixture_.add("nodes", {{"children", {1}}});
    EXPECT_TRUE(says(error(), "nodes[1] is in a cycle"));
    node(1)["children"] = {1};
    node(2).erase("children");
    EXPECT_TRUE(says(error(), "nodes[1] is in a cycle"));
}

TEST_F(GltfNodesTest, TwoParentsAreRefused) {
    fixture_.add_node({{"children", {2}}});
    fixture_.add_node({{"children", {2}}});
    fixture_.add("nodes", {{"mesh", 0}});
    EXPECT_TRUE(says(error(), "nodes[2] has two parents (nodes[0] and nodes[1])"));
}

TEST_F(GltfNodesTest, AHundredThousandLevelsAreWalkedWithoutRecursion) {
    constexpr int kDepth = 100000;
    fixture_.add_node({{"children", {1}}});
    for (int i = 1; i < kDepth; ++i) fixture_.add("nodes", {{"children", {i + 1}}, {"translation", {1e-3, 0, 0}}});
    fixture_.add("nodes", {{"mesh", 0}});
    const shading::Scene loaded = scene();
    ASSERT_EQ(loaded.instances.size(), 1u);
    EXPECT_NEAR(loaded.instances[0].world_from_object[3].x, 1e-3f * (kDepth - 1), 1e-3f);
}

TEST_F(GltfNodesTest, TransformsThatOverflowAreRefused) {
    fixture_.add_node({{"scale", {1e30, 1, 1}}, {"children", {1}}});
    fixture_.add("nodes", {{"mesh", 0}, {"scale", {1e30, 1, 1}}});
    EXPECT_TRUE(says(error(), "nodes[1] has a transform too large"));
}

TEST_F(GltfNodesTest, TheSceneDecidesWhatIsShown) {
    fixture_.add_node({{"mesh", 0}, {"translation", {1, 0, 0}}});
    fixture_.add("nodes", {{"mesh", 0}, {"translation", {2, 0, 0}}});
    fixture_.json["scenes"].push_back({{"nodes", {1}}});
    EXPECT_EQ(scene().instances.at(0).world_from_object[3].x, 1.0f);
    fixture_.json["scene"] = 1;
    ASSERT_EQ(scene().instances.size(), 1u);
    EXPECT_EQ(scene().instances.at(0).world_from_object[3].x, 2.0f);
    fixture_.json["scene"] = 2;
    EXPECT_TRUE(says(error(), "scene is 2 (allowed: an index of scenes, 0 to 1)"));
    fixture_.json.erase("scene");
    fixture_.json.erase("scenes");
    EXPECT_EQ(scene().instances.size(), 2u);
}

TEST_F(GltfNodesTest, ScenesNameRootsOnce) {
    fixture_.add_node({{"children", {1}}});
    fixture_.add("nodes", {{"mesh", 0}});
    fixture_.json["scenes"][0]["nodes"] = {1};
    EXPECT_TRUE(says(error(), "the scene names nodes[1] (which is a child of nodes[0]"));
    fixture_.json["scenes"][0]["nodes"] = {0, 0};
    EXPECT_TRUE(says(error(), "the scene names nodes[0] twice"));
}

TEST_F(GltfNodesTest, InstancesStandInSceneOrder) {
    fixture_.add_node({{"children", {2, 1}}});
    fixture_.add("nodes", {{"mesh", 0}, {"translation", {1, 0, 0}}});
    fixture_.add("nodes", {{"mesh", 0}, {"translation", {2, 0, 0}}, {"children", {3}}});
    fixture_.add("nodes", {{"mesh", 0}, {"translation", {10, 0, 0}}});
    const shading::Scene loaded = scene();
    std::vector<float> x;
    for (const shading::Instance& instance : loaded.instances) x.push_back(instance.world_from_object[3].x);
    EXPECT_EQ(x, (std::vector<float>{2, 12, 1}));
}

TEST_F(GltfNodesTest, LightsTakePlaceAndDirectionFromTheirNodes) {
    auto& lights = fixture_.json["extensions"]["KHR_lights_punctual"]["lights"];
    lights = {{{"type", "directional"}, {"intensity", 3}, {"color", {1, 0.5, 0.25}}},
              {{"type", "point"}, {"range", 7}},
              {{"type", "spot"}, {"name", "lamp"}, {"spot", {{"innerConeAngle", 0.1}, {"outerConeAngle", 0.4}}}}};
    const float half = std::sqrt(0.5f);
    for (const int i : {0, 1, 2})
        fixture_.add_node({{"translation", {i, 2, 3}},
                           {"rotation", {half, 0, 0, half}},
                           {"scale", {2, 2, 2}},
                           {"extensions", {{"KHR_lights_punctual", {{"light", i}}}}}});
    const shading::Scene loaded = scene();
    ASSERT_EQ(loaded.lights.size(), 3u);
    EXPECT_EQ(loaded.lights[0].type, shading::Light::Type::Directional);
    EXPECT_EQ(loaded.lights[0].intensity, 3.0f);
    EXPECT_EQ(loaded.lights[0].color, glm::vec3(1, 0.5f, 0.25f));
    // -Z turned by 90 degrees about X points along +Y.
    EXPECT_NEAR(glm::distance(loaded.lights[0].direction, glm::vec3(0, 1, 0)), 0.0f, 1e-6f);
    EXPECT_EQ(loaded.lights[1].position, glm::vec3(1, 2, 3));
    EXPECT_EQ(loaded.lights[1].range, 7.0f);
    EXPECT_EQ(loaded.lights[2].name, "lamp");
    EXPECT_EQ(loaded.lights[2].inner_cone, 0.1f);
    EXPECT_EQ(loaded.lights[2].outer_cone, 0.4f);

    lights[2]["spot"]["innerConeAngle"] = 0.5;
    EXPECT_TRUE(says(error(), "the inner must be smaller"));
    lights[2]["spot"]["innerConeAngle"] = -0.5;
    EXPECT_TRUE(says(error(), "innerConeAngle is -0.5"));
    lights[2] = {{"type", "area"}};
    EXPECT_TRUE(says(error(), "type is \"area\" (allowed: directional, point, spot)"));
    // Shown or not.
    lights.push_back({{"type", "spot"}, {"spot", {{"innerConeAngle", 1}, {"outerConeAngle", 0.5}}}});
    lights[2] = {{"type", "point"}};
    EXPECT_TRUE(says(error(), "lights[3].spot has an inner cone of 1 and an outer cone of 0.5 radians (the inner must be smaller)"));
    lights.erase(3);
    lights.erase(2);
    EXPECT_TRUE(says(error(), "light is 2 (allowed: an index of KHR_lights_punctual, 0 to 1)"));
}

TEST_F(GltfNodesTest, CamerasAreRigidWhateverTheirNodesScaleIs) {
    fixture_.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.7}, {"znear", 0.1}}}},
                                {{"type", "orthographic"}, {"orthographic", {{"xmag", 2}, {"ymag", -3}, {"znear", 0}, {"zfar", 10}}}}};
    fixture_.add_node({{"camera", 0}, {"translation", {1, 2, 3}}, {"scale", {3, 0.5, 2}}});
    fixture_.add_node({{"camera", 1}, {"scale", {-1, 1, 1}}});
    const shading::Scene loaded = scene();
    ASSERT_EQ(loaded.cameras.size(), 2u);
    expect_near(loaded.cameras[0].world_from_camera, glm::translate(glm::mat4(1.0f), {1, 2, 3}));
    EXPECT_EQ(loaded.cameras[0].vertical_fov, 0.7f);
    EXPECT_EQ(loaded.cameras[0].znear, 0.1f);
    EXPECT_EQ(loaded.cameras[0].zfar, 0.0f);
    EXPECT_NEAR(glm::determinant(glm::mat3(loaded.cameras[1].world_from_camera)), 1.0f, 1e-6f);
    EXPECT_EQ(loaded.cameras[1].type, shading::Camera::Type::Orthographic);
    EXPECT_EQ(loaded.cameras[1].xmag, 2.0f);
    EXPECT_EQ(loaded.cameras[1].ymag, 3.0f);
    EXPECT_EQ(loaded.cameras[1].zfar, 10.0f);
}

TEST_F(GltfNodesTest, ImpossibleCamerasAreRefused) {
    fixture_.add_node({{"camera", 0}});
    const auto refused = [&](nlohmann::json camera) {
        fixture_.json["cameras"] = nlohmann::json::array({std::move(camera)});
        return error();
    };
    EXPECT_NE(refused({{"type", "perspective"}, {"perspective", {{"yfov", 0}, {"znear", 0.1}}}}), "");
    EXPECT_NE(refused({{"type", "perspective"}, {"perspective", {{"yfov", 3.2}, {"znear", 0.1}}}}), "");
    EXPECT_NE(refused({{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0}}}}), "");
    EXPECT_TRUE(says(refused({{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 2}, {"zfar", 1}}}}), "far plane"));
    EXPECT_NE(refused({{"type", "perspective"}}), "");
    EXPECT_NE(refused({{"type", "fisheye"}}), "");
    EXPECT_TRUE(says(refused({{"type", "orthographic"}, {"orthographic", {{"xmag", 0}, {"ymag", 1}, {"znear", 0}, {"zfar", 1}}}}),
                     "magnification"));
    EXPECT_EQ(refused({{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}}), "");
}

TEST_F(GltfNodesTest, TheSceneMayAskForItsSurroundings) {
    fixture_.add_node({{"mesh", 0}});
    EXPECT_EQ(scene().environment, shading::EnvironmentRequest::Unspecified);
    auto& extras = fixture_.json["scenes"][0]["extras"];
    extras["rawtexel"]["environment"] = "sky";
    EXPECT_EQ(scene().environment, shading::EnvironmentRequest::Sky);
    extras["rawtexel"]["environment"] = "none";
    EXPECT_EQ(scene().environment, shading::EnvironmentRequest::None);
    extras["rawtexel"]["environment"] = "fog";
    EXPECT_TRUE(says(error(), "allowed: sky, none"));
    extras = "something else entirely";
    EXPECT_EQ(scene().environment, shading::EnvironmentRequest::Unspecified);
    extras = {{"rawtexel", 3}};
    EXPECT_TRUE(says(error(), "scenes[0].extras.rawtexel is 3"));
}

}  // namespace
}  // namespace rawtexel::scenes
