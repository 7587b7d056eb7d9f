#include "cli/camera_path.h"

#include "scenes/load.h"
#include "tests/temporary_folder.h"

#include <gtest/gtest.h>

#include <cmath>

namespace rawtexel::cli {
namespace {

std::vector<shading::CameraKey> keys_of(std::string_view json) { return parse_camera_keys("way.json", json, 45.0f); }

std::string error_of(std::string_view json) {
    try {
        keys_of(json);
    } catch (const scenes::InputError& error) {
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
        return error.what();
    }
    return "";
}

constexpr std::string_view kStraight = R"([1,0,0,0, 0,1,0,0, 0,0,1,0, 4,5,6,1])";

TEST(CameraKeys, AreTargetsOrMatrices) {
    const auto keys = keys_of(R"([{"eye": [1, 2, 3], "target": [0, 0.5, 0], "fov": 60}, {"matrix": )" + std::string(kStraight) + "}]");
    ASSERT_EQ(keys.size(), 2u);
    EXPECT_EQ(*keys[0].eye, glm::dvec3(1, 2, 3));
    EXPECT_EQ(*keys[0].target, glm::dvec3(0, 0.5, 0));
    EXPECT_NEAR(keys[0].vertical_fov, glm::radians(60.0), 1e-12);
    EXPECT_FALSE(keys[1].eye);
    EXPECT_EQ(keys[1].world_from_camera[3], glm::dvec4(4, 5, 6, 1));
    EXPECT_NEAR(keys[1].vertical_fov, glm::radians(45.0), 1e-12) << "the view's";
}

TEST(CameraKeys, ThatAreDamagedAreRefusedInOneLine) {
    EXPECT_EQ(error_of(R"([{"eye": [1, 2, 3], "target": [0, 0, 0]}])"), "");
    for (const auto& [json, part] : std::initializer_list<std::pair<std::string, const char*>>{
             {"", "not valid JSON"},
             {"[{", "not valid JSON"},
             {"\xff", "not valid JSON"},
             {"{}", "is no array of key frames"},
             {"[]", "is no array of key frames"},
             {"[1]", "key 0 is no object"},
             {"[{}]", R"(key 0 has no "eye" and "target", and no "matrix")"},
             {R"([{"eye": [1, 2, 3]}])", R"(has no "eye" and "target")"},
             {R"([{"eye": [1, 2], "target": [0, 0, 0]}])", R"("eye" that is no array of 3 numbers)"},
             {R"([{"eye": [1, 2, "3"], "target": [0, 0, 0]}])", R"("eye" that is no number from -1e15 to 1e15)"},
             {R"([{"eye": [1, 2, 1e99], "target": [0, 0, 0]}])", R"("eye" that is no number)"},
             {R"([{"eye": [1, 2, 1e999], "target": [0, 0, 0]}])", "not valid JSON"},
             {R"([{"eye": [1, 2, 3], "target": [1, 2, 3]}])", "in one point"},
             {R"([{"eye": [1, 2, 3], "target": [0, 0, 0], "fov": 0}])", R"("fov" that is no number from 0.01 to 179)"},
             {R"([{"eye": [1, 2, 3], "target": [0, 0, 0], "fow": 30}])", R"(unknown "fow" (allowed: eye, target, matrix, fov))"},
             {R"([{"matrix": [1, 2, 3]}])", "no array of 16 numbers"},
             {R"([{"matrix": [2,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]}])", "no rotation and translation"},
             {R"([{"matrix": [-1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]}])", "no rotation and translation"},
             {R"([{"matrix": [1,0,0,4, 0,1,0,5, 0,0,1,6, 0,0,0,1]}])", "column by column"},
             {R"([{"eye": [1, 2, 3], "matrix": )" + std::string(kStraight) + "}]", R"(both a "matrix" and an "eye" or "target")"},
             {std::string(100000, '['), "nested deeper than 8 levels"},
             {std::string((16u << 20) + 1, ' '), "allowed: 16 MiB"},
         }) {
        const std::string message = error_of(json);
        EXPECT_TRUE(message.starts_with("way.json: ")) << json.substr(0, 80) << ": " << message;
        EXPECT_NE(message.find(part), std::string::npos) << json.substr(0, 80) << ": " << message;
    }
}

/// A triangle and a camera of the scene's own.
shading::Scene sample_scene() {
    shading::Scene scene;
    shading::Mesh mesh;
    mesh.positions = {{-1, -1, -1}, {1, 1, 1}, {1, -1, -1}};
    mesh.indices = {0, 1, 2};
    scene.meshes.push_back(mesh);
    scene.materials.emplace_back();
    scene.instances.push_back({0, glm::mat4(1.0f)});
    shading::Camera camera;
    camera.name = "front";
    camera.world_from_camera[3] = glm::vec4(0, 0, 5, 1);
    camera.znear = 0.25f;
    scene.cameras = {camera};
    return scene;
}

std::string complaint(const shading::Scene& scene, const ViewOptions& options, const CameraPathOption& path) {
    SequenceOptions sequence;
    sequence.path = path;
    try {
        make_camera_path(sequence, scene, options, choose_view(scene, options, 1.5f));
    } catch (const UsageError& error) {
        return error.what();
    } catch (const scenes::InputError& error) {
        return error.what();
    }
    return "";
}

TEST(MakeCameraPath, GoesAroundWhatTheViewLooksAt) {
    const shading::Scene scene = sample_scene();
    SequenceOptions sequence;
    sequence.path = CameraPathOption{CameraPathKind::Orbit, {}};
    ViewOptions options;
    options.eye = {3, 1, 0};
    options.target = {1, 0, 0};
    const View view = choose_view(scene, options, 1.5f);
    EXPECT_FALSE(view.scene_camera);
    const glm::vec3 across(make_camera_path(sequence, scene, options, view).frame(1, 2).world_from_camera[3]);
    EXPECT_LT(glm::length(across - glm::vec3(-1, 1, 0)), 1e-4f);
    // The scene's own camera keeps its planes and goes around its axis' point level with the scene's centre.
    const View own = choose_view(scene, {}, 1.5f);
    ASSERT_EQ(own.scene_camera, size_t(0));
    const shading::Camera behind = make_camera_path(sequence, scene, {}, own).frame(1, 2);
    EXPECT_LT(glm::length(glm::vec3(behind.world_from_camera[3]) - glm::vec3(0, 0, -5)), 1e-4f);
    EXPECT_EQ(behind.znear, 0.25f);
    sequence.path.reset();
    EXPECT_EQ(make_camera_path(sequence, scene, {}, own).frame(3, 8).world_from_camera, own.camera.world_from_camera);
}

TEST(MakeCameraPath, RefusesWaysThatDoNotFit) {
    shading::Scene scene = sample_scene();
    ViewOptions eye;
    eye.eye = {1, 2, 3};
    const CameraPathOption gltf{CameraPathKind::Gltf, {}};
    EXPECT_EQ(complaint(scene, eye, gltf), "--camera-path gltf says itself where the camera is: --eye makes no sense beside it");
    EXPECT_EQ(complaint(scene, {}, gltf), "--camera-path gltf: no animation of the scene moves its camera 'front'");
    scene.camera_animations[0].nodes.resize(1);
    EXPECT_EQ(complaint(scene, {}, gltf), "");
    scene.cameras.clear();
    scene.camera_animations.clear();
    EXPECT_EQ(complaint(scene, {}, gltf), "--camera-path gltf: the scene has no camera");
    EXPECT_EQ(complaint(scene, eye, {CameraPathKind::File, "way.json"}),
              "--camera-path FILE says itself where the camera is: --eye makes no sense beside it");
    const test::TemporaryFolder folder;
    EXPECT_NE(complaint(scene, {}, {CameraPathKind::File, folder / "none.json"}).find("none.json"), std::string::npos);
}

TEST(CheckCameraPath, RefusesPlacesThatAreNone) {
    shading::CameraPath path = shading::still_path({});
    EXPECT_NO_THROW(check_camera_path(path, 3, "way"));
    for (const float bad : {std::nanf(""), HUGE_VALF, 1e16f}) {
        path.at = [bad](double t) {
            shading::Camera camera;
            if (t > 0.5) camera.world_from_camera[3][1] = bad;
            return camera;
        };
        EXPECT_THROW(check_camera_path(path, 3, "way"), scenes::InputError) << bad;
    }
}

}  // namespace
}  // namespace rawtexel::cli
