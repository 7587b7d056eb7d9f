// Animated cameras.
#include "tests/scenes/gltf_fixture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace rawtexel::scenes {
namespace {

using shading::KeyInterpolation;

/// A quad on nodes[0], and a camera on nodes[2], the child of nodes[1].
class GltfCamerasTest : public testing::Test {
  protected:
    GltfCamerasTest() : fixture_(quad_fixture()) {
        fixture_.add("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 0.8}, {"znear", 0.1}}}});
        arm_ = fixture_.add_node({{"translation", {0, 1, 0}}});
        camera_ = fixture_.add("nodes", {{"camera", 0}, {"translation", {0, 0, 2}}});
        fixture_.json["nodes"][size_t(arm_)]["children"] = {camera_};
        times_ = fixture_.add_indices(std::vector<float>{0.5f, 1.0f, 2.0f});
        places_ = fixture_.add_vec3({0, 0, 2, 1, 0, 2, 1, 0, 0});
    }

    /// Adds an animation of one channel.
    nlohmann::json& animate(int node, const char* path, int input, int output, const char* interpolation = nullptr) {
        nlohmann::json sampler = {{"input", input}, {"output", output}};
        if (interpolation) sampler["interpolation"] = interpolation;
        const int index = fixture_.add("animations", {{"channels", {{{"sampler", 0}, {"target", {{"node", node}, {"path", path}}}}}},
                                                      {"samplers", nlohmann::json::array({sampler})}});
        return fixture_.json["animations"][size_t(index)];
    }

    std::string path() { return folder_.write("scene.glb", fixture_.glb()); }
    shading::Scene scene() {
        LoadOptions options;
        options.camera_animations = true;
        options.warn = [&](const std::string& what) { warnings_.push_back(what); };
        return load_gltf(path(), options);
    }
    std::string error() {
        try {
            scene();
        } catch (const InputError& error) {
            EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
            return error.what();
        }
        return "";
    }

    TemporaryFolder folder_;
    GltfFixture fixture_;
    std::vector<std::string> warnings_;
    int arm_ = 0, camera_ = 0, times_ = 0, places_ = 0;
};

TEST_F(GltfCamerasTest, AreReadWhereAskedFor) {
    animate(camera_, "translation", times_, places_)["name"] = "walk";
    const shading::Scene moving = scene();
    ASSERT_EQ(moving.camera_animations.size(), 1u);
    const shading::CameraAnimation& animation = moving.camera_animations.at(0);
    EXPECT_EQ(animation.name, "walk");
    EXPECT_EQ(animation.first_time, 0.5);
    EXPECT_EQ(animation.last_time, 2.0);
    ASSERT_EQ(animation.nodes.size(), 2u);
    EXPECT_FALSE(animation.nodes[0].moves());
    EXPECT_EQ(animation.nodes[1].translations.interpolation, KeyInterpolation::Linear);
    // At rest it is where the file says; moved, its parent's place is added.
    EXPECT_EQ(moving.cameras.at(0).world_from_camera[3], glm::vec4(0, 1, 2, 1));
    EXPECT_EQ(world_from_camera_at(animation, 0.75)[3], glm::vec4(0.5f, 1, 2, 1));
    EXPECT_EQ(world_from_camera_at(animation, 9.0)[3], glm::vec4(1, 1, 0, 1));
    ASSERT_EQ(warnings_.size(), 1u);
    EXPECT_TRUE(says(warnings_[0], "animations move nothing but the camera"));
    EXPECT_TRUE(load_fixture(folder_, fixture_).camera_animations.empty());
}

TEST_F(GltfCamerasTest, MoveWithTheirParentsByTheFirstAnimationThatDoesSo) {
    const int other = fixture_.add_node({{"mesh", 0}});
    animate(other, "translation", times_, places_);
    animate(camera_, "weights", times_, times_);
    const double half = std::sqrt(0.5);
    const int turns = fixture_.add_vec4({0, 0, 0, 1, 0, float(half), 0, float(half), 0, 1, 0, 0});
    animate(arm_, "rotation", times_, turns, "STEP")["name"] = "turn";
    animate(camera_, "translation", times_, places_)["name"] = "walk";
    const shading::CameraAnimation animation = scene().camera_animations.at(0);
    EXPECT_EQ(animation.name, "turn");
    EXPECT_FALSE(animation.nodes[1].moves());
    const glm::vec4 turned = world_from_camera_at(animation, 1.5)[3];
    EXPECT_NEAR(turned.x, 2.0f, 1e-6f);
    EXPECT_NEAR(turned.z, 0.0f, 1e-6f);
    fixture_.json["animations"].clear();
    animate(other, "translation", times_, places_);
    EXPECT_TRUE(scene().camera_animations.empty());
}

TEST_F(GltfCamerasTest, TakeSplinesAndNormalizedRotations) {
    const int tangents = fixture_.add_vec3({0, 0, 0, 0, 0, 2, 1, 0, 0, 0, 0, 0, 1, 0, 2, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0});
    const int turns = fixture_.add_values("VEC4", 4, std::vector<int16_t>{0, 0, 0, 32767, 0, 32767, 0, 0, 0, 0, 0, -32767}, true);
    nlohmann::json& animation = animate(camera_, "translation", times_, tangents, "CUBICSPLINE");
    animation["samplers"].push_back({{"input", times_}, {"output", turns}});
    animation["channels"].push_back({{"sampler", 1}, {"target", {{"node", camera_}, {"path", "rotation"}}}});
    const shading::MovingTransform node = scene().camera_animations.at(0).nodes.at(1);
    EXPECT_EQ(node.translations.interpolation, KeyInterpolation::CubicSpline);
    ASSERT_EQ(node.translations.values.size(), 9u);
    EXPECT_EQ(glm::dvec3(node.translations.values[2]), glm::dvec3(1, 0, 0));
    EXPECT_EQ(node.rotations.values.at(1), glm::dvec4(0, 1, 0, 0));
}

TEST_F(GltfCamerasTest, WithBadKeyFramesAreRefused) {
    const int backwards = fixture_.add_indices(std::vector<float>{0.5f, 2.0f, 1.0f});
    const int twice = fixture_.add_indices(std::vector<float>{0.5f, 0.5f, 1.0f});
    const int early = fixture_.add_indices(std::vector<float>{-1.0f, 0.5f, 1.0f});
    const int endless = fixture_.add_indices(std::vector<float>{0.0f, 0.5f, std::numeric_limits<float>::infinity()});
    const int integers = fixture_.add_indices(std::vector<uint16_t>{0, 1, 2});
    const int zero = fixture_.add_vec4({0, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 0});
    const auto error_of = [&](const char* path, int input, int output, const char* interpolation = nullptr) {
        fixture_.json.erase("animations");
        animate(camera_, path, input, output, interpolation);
        return error();
    };
    EXPECT_EQ(error_of("translation", times_, places_), "");
    EXPECT_TRUE(says(error_of("translation", backwards, places_), "animations[0].samplers[0].input holds 1 after 2 (times must increase)"));
    EXPECT_TRUE(says(error_of("translation", twice, places_), "holds 0.5 after 0.5"));
    EXPECT_TRUE(says(error_of("translation", early, places_), "begins at -1 seconds"));
    EXPECT_TRUE(says(error_of("translation", endless, places_), "holds inf at element 2"));
    EXPECT_TRUE(says(error_of("translation", integers, places_), "samplers[0].input is SCALAR of unsigned 16-bit"));
    EXPECT_TRUE(says(error_of("translation", places_, places_), "samplers[0].input is VEC3 of float"));
    EXPECT_TRUE(says(error_of("translation", times_, times_), "samplers[0].output is SCALAR of float"));
    EXPECT_TRUE(says(error_of("rotation", times_, places_), "samplers[0].output is VEC3 of float"));
    EXPECT_TRUE(says(error_of("rotation", times_, zero), "samplers[0].output is zero at element 1"));
    EXPECT_TRUE(says(error_of("translation", times_, places_, "CUBICSPLINE"), "has 3 elements (allowed: 9"));
    EXPECT_TRUE(says(error_of("translation", times_, places_, "CUBIC"), "interpolation is \"CUBIC\" (allowed: LINEAR, STEP, CUBICSPLINE)"));
}

TEST_F(GltfCamerasTest, WithDamagedAnimationsAreRefused) {
    animate(camera_, "translation", times_, places_);
    const nlohmann::json whole = fixture_.json;
    const auto error_of = [&](const char* pointer, const nlohmann::json& value) {
        fixture_.json = whole;
        fixture_.json[nlohmann::json::json_pointer(pointer)] = value;
        return error();
    };
    EXPECT_TRUE(says(error_of("/animations/0/channels/0/sampler", 1), "animations[0].channels[0].sampler is 1 (allowed: below 1)"));
    EXPECT_TRUE(says(error_of("/animations/0/channels/0/sampler", -1), "animations[0].channels[0].sampler is -1"));
    EXPECT_TRUE(says(error_of("/animations/0/channels/0/target/node", 99), "animations[0].channels[0].target.node is 99"));
    EXPECT_TRUE(says(error_of("/animations/0/samplers/0/input", 99), "animations[0].samplers[0].input is 99"));
    EXPECT_TRUE(says(error_of("/animations/0/samplers/0", "x"), "animations[0].samplers[0] is \"x\""));
    EXPECT_TRUE(says(error_of("/animations", 3), "animations is 3"));
    EXPECT_EQ(error_of("/animations/0/channels/0/target", {{"path", "translation"}}), "");
    fixture_.json = whole;
    fixture_.json["animations"][0]["channels"].push_back(whole["animations"][0]["channels"][0]);
    EXPECT_TRUE(says(error(), "animations[0] has two channels for nodes[2].translation"));
    fixture_.json = whole;
    fixture_.json["nodes"][size_t(camera_)] = {{"camera", 0}, {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}};
    EXPECT_TRUE(says(error(), "animations[0] moves nodes[2] (which has a matrix"));
    // Who does not ask is not told.
    fixture_.json["animations"] = 3;
    EXPECT_EQ(load_error(folder_, fixture_), "");
}

TEST_F(GltfCamerasTest, InDamagedFilesMoveOrAreRefused) {
    const int turns = fixture_.add_vec4({0, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0});
    nlohmann::json& animation = animate(camera_, "translation", times_, places_);
    animation["samplers"].push_back({{"input", times_}, {"output", turns}, {"interpolation", "STEP"}});
    animation["channels"].push_back({{"sampler", 1}, {"target", {{"node", arm_}, {"path", "rotation"}}}});
    const std::vector<std::byte> whole = fixture_.glb();
    LoadOptions options;
    options.camera_animations = true;
    std::mt19937 random(1);
    int moved = 0, refused = 0;
    for (int i = 0; i < 500; ++i) {
        std::vector<std::byte> damaged = whole;
        for (int k = 0; k < 1 + i % 4; ++k) damaged[20 + random() % (damaged.size() - 20)] = std::byte(random() & 0x7f);
        try {
            for (const auto& [index, moving] : load_gltf(folder_.write("damaged.glb", damaged), options).camera_animations) {
                for (const double time : {0.0, 0.7, 1.0, 1e30}) world_from_camera_at(moving, time);
                ++moved;
            }
        } catch (const InputError&) {
            ++refused;
        }
    }
    EXPECT_GT(moved, 20);
    EXPECT_GT(refused, 50);
}

/// Every camera carries its parents: many cameras on a long chain would take memory by the square of the file.
TEST_F(GltfCamerasTest, OnLongChainsTakeNoMoreMemoryThanTheFileAllows) {
    animate(arm_, "translation", times_, places_);
    nlohmann::json& nodes = fixture_.json["nodes"];
    int parent = camera_;
    for (int i = 0; i < 4000; ++i) {
        const int child = int(nodes.size());
        nodes[size_t(parent)]["children"].push_back(child);
        nodes.push_back({{"camera", 0}});
        parent = child;
    }
    EXPECT_TRUE(says(error(), "asks for more memory than its size allows"));
}

}  // namespace
}  // namespace rawtexel::scenes
