#include "cli/view.h"

#include "cli/word_list.h"

#include "cli/option_values.h"

#include <gtest/gtest.h>

#include <cmath>

namespace rawtexel::cli {
namespace {

/// One triangle that spans the box from (-1, 0, -2) to (3, 2, 2), and two cameras: upright, and rolled by 90 degrees.
shading::Scene sample_scene(bool with_cameras) {
    shading::Scene scene;
    shading::Mesh mesh;
    mesh.positions = {{-1, 0, -2}, {3, 2, 2}, {3, 0, -2}};
    mesh.indices = {0, 1, 2};
    scene.meshes.push_back(mesh);
    scene.materials.emplace_back();
    scene.instances.push_back({0, glm::mat4(1.0f)});
    if (!with_cameras) return scene;
    shading::Camera upright = shading::look_at_camera(scene.bounds(), {5, 6, 7}, {1, 1, 0}, 30.0f), rolled = upright;
    upright.name = "front";
    rolled.name = "tilted";
    std::swap(rolled.world_from_camera[0], rolled.world_from_camera[1]);
    rolled.world_from_camera[0] *= -1.0f;
    scene.cameras = {upright, rolled};
    return scene;
}

/// Words as a shell splits them.
ViewOptions parse_view(const std::string& options) {
    RenderRequest request;
    CommandLine line("test", "test");
    declare_render_options(line, request);
    line.parse(split(options, ' '));
    return request.view;
}

ViewOptions camera_named(const std::string& name) {
    ViewOptions options;
    options.camera = name;
    return options;
}

float largest_difference(const glm::mat4& a, const glm::mat4& b) {
    float largest = 0.0f;
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row) largest = std::max(largest, std::abs(a[column][row] - b[column][row]));
    return largest;
}

void expect_pasteable(const shading::Scene& scene, const ViewOptions& options, float aspect) {
    const View view = choose_view(scene, options, aspect), again = choose_view(scene, parse_view(view.options), aspect);
    EXPECT_EQ(again.options, view.options);
    EXPECT_LT(largest_difference(view.camera.world_from_camera, again.camera.world_from_camera), 1e-5f) << view.options;
    EXPECT_NEAR(view.camera.vertical_fov, again.camera.vertical_fov, 1e-6f) << view.options;
}

TEST(View, WhatIsPrintedGivesTheSameCamera) {
    for (const bool with_cameras : {false, true})
        for (const float aspect : {0.5f, 1.0f, 16.0f / 9.0f})
            for (const char* options : {"--fov 45", "--fov 20", "--orbit 30,20", "--orbit -100,-60,2.5", "--orbit 10,90", "--orbit 0,120",
                                        "--eye 9,1,2", "--target 0,1,0", "--eye 1,2,3 --target 0,0,0 --fov 77", "--orbit 30,20 --fov 90"})
                expect_pasteable(sample_scene(with_cameras), parse_view(options), aspect);
    for (const char* name : {"front", "tilted", "0", "1"}) expect_pasteable(sample_scene(true), camera_named(name), 1.5f);
    expect_pasteable(sample_scene(false), {}, 1.5f);
    expect_pasteable(sample_scene(true), {}, 1.5f);
}

TEST(View, ThePrintedDefaultIsBitEqual) {
    const shading::Scene scene = sample_scene(false);
    const View view = choose_view(scene, {}, 1.6f), again = choose_view(scene, parse_view(view.options), 1.6f);
    EXPECT_EQ(view.camera.world_from_camera, again.camera.world_from_camera);
    EXPECT_EQ(view.camera.vertical_fov, again.camera.vertical_fov);
    EXPECT_EQ(view.camera.znear, again.camera.znear);
}

TEST(View, TheScenesFirstCameraComesFirst) {
    const shading::Scene scene = sample_scene(true);
    EXPECT_EQ(choose_view(scene, {}, 1.0f).camera.world_from_camera, scene.cameras[0].world_from_camera);
    EXPECT_EQ(choose_view(scene, camera_named("tilted"), 1.0f).camera.world_from_camera, scene.cameras[1].world_from_camera);
    EXPECT_EQ(choose_view(scene, camera_named("1"), 1.0f).camera.world_from_camera, scene.cameras[1].world_from_camera);
    EXPECT_EQ(choose_view(scene, camera_named("tilted"), 1.0f).options, "--camera 1");
}

TEST(View, AnUnknownCameraNamesTheNearest) {
    try {
        choose_view(sample_scene(true), camera_named("frnot"), 1.0f);
        FAIL();
    } catch (const UsageError& error) {
        EXPECT_STREQ(error.what(), "--camera: unknown value 'frnot', the nearest is 'front' (front tilted)");
    }
    EXPECT_THROW(choose_view(sample_scene(true), camera_named("2"), 1.0f), UsageError);
    EXPECT_THROW(choose_view(sample_scene(false), camera_named("0"), 1.0f), UsageError);
}

TEST(View, TheSphereJustFitsWhateverTheFieldOfView) {
    const shading::Scene scene = sample_scene(false);
    const shading::Bounds bounds = scene.bounds();
    for (const float aspect : {0.4f, 1.0f, 2.0f})
        for (const float fov : {10.0f, 45.0f, 100.0f})
            for (const bool orbit : {false, true}) {
                ViewOptions options;
                options.fov = fov;
                if (orbit) options.orbit = Orbit{20, 30, 1};
                const glm::vec3 eye(choose_view(scene, options, aspect).camera.world_from_camera[3]);
                const float half = glm::radians(fov) / 2, narrow = std::min(half, std::atan(std::tan(half) * aspect));
                EXPECT_NEAR(glm::length(eye - bounds.center()) * std::sin(narrow), bounds.radius(), 1e-4f) << aspect << " " << fov;
            }
}

TEST(View, EyeAndTargetInOnePointAreRefused) {
    EXPECT_THROW(choose_view(sample_scene(false), parse_view("--eye 1,2,3 --target 1,2,3"), 1.0f), UsageError);
    ViewOptions at_centre;
    at_centre.eye = sample_scene(false).bounds().center();
    EXPECT_THROW(choose_view(sample_scene(false), at_centre, 1.0f), UsageError);
}

}  // namespace
}  // namespace rawtexel::cli
