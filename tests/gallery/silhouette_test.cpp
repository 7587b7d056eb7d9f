// What is covered, against an independent renderer's picture and against rays cast at spheres.
#include "scenes/builtin.h"
#include "scenes/image_io.h"
#include "scenes/load.h"
#include "shading/camera.h"
#include "shading/executor.h"
#include "shading/render.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace {

using namespace rawtexel;
using shading::Image;

constexpr int kWidth = 640, kHeight = 480;

/// Depth at the pixel centres; 0 where no surface is seen.
Image depth_of(const shading::Scene& scene, const shading::Camera& camera) {
    shading::RenderOptions options;
    options.width = kWidth;
    options.height = kHeight;
    options.camera = camera;
    options.aovs = {shading::Aov::Depth};
    const auto executor = shading::make_executor(shading::ExecutorKind::Threads, 2);
    const shading::RenderResult result = shading::render(scene, shading::Lighting{}, options, *executor);
    return result.layers.at(0).image;
}

/// Pixels that both cover over pixels that either covers.
double overlap(const std::function<bool(int x, int y)>& a, const std::function<bool(int x, int y)>& b) {
    int both = 0, either = 0;
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
            both += a(x, y) && b(x, y);
            either += a(x, y) || b(x, y);
        }
    }
    return double(both) / std::max(either, 1);
}

struct Sphere {
    glm::dvec3 center;
    double radius;
};

bool is_hit(const Sphere& sphere, const glm::dvec3& eye, const glm::dvec3& direction) {
    const glm::dvec3 to_center = sphere.center - eye;
    const double along = glm::dot(to_center, direction);
    return along > 0.0 && glm::dot(to_center, to_center) - along * along < sphere.radius * sphere.radius;
}

TEST(Silhouette, OfBuiltinSpheresIsThatOfRaysCastAtThem) {
    const auto builtin = std::ranges::find(scenes::builtin_scenes(), std::string_view("spheres"), &scenes::BuiltinScene::name);
    ASSERT_NE(builtin, scenes::builtin_scenes().end());
    shading::Scene scene = builtin->make({});
    // Floor and walls, if any, are no spheres.
    std::erase_if(scene.instances, [&](const shading::Instance& instance) { return scene.meshes[instance.mesh].indices.size() < 30000; });
    std::vector<Sphere> spheres;
    for (const shading::Instance& instance : scene.instances) {
        const auto& positions = scene.meshes[instance.mesh].positions;
        const glm::dvec3 center(instance.world_from_object * glm::vec4(0, 0, 0, 1));
        double radius = 0.0;
        for (const glm::vec3& p : positions)
            radius = std::max(radius, glm::length(glm::dvec3(instance.world_from_object * glm::vec4(p, 1)) - center));
        spheres.push_back({center, radius});
    }
    ASSERT_EQ(spheres.size(), 100u);

    const shading::Camera camera = shading::default_camera(scene.bounds(), float(kWidth) / kHeight);
    const Image depth = depth_of(scene, camera);
    const double half = std::tan(double(camera.vertical_fov) / 2.0);
    const glm::dvec3 eye(camera.world_from_camera[3]);
    const auto expected = [&](int x, int y) {
        const glm::dvec3 in_camera((2.0 * (x + 0.5) / kWidth - 1.0) * half * kWidth / kHeight, (1.0 - 2.0 * (y + 0.5) / kHeight) * half,
                                   -1.0);
        const glm::dvec3 direction = glm::normalize(glm::dmat3(camera.world_from_camera) * in_camera);
        return std::ranges::any_of(spheres, [&](const Sphere& sphere) { return is_hit(sphere, eye, direction); });
    };
    const double found = overlap([&](int x, int y) { return depth.pixel(x, y)[0] > 0.0f; }, expected);
    std::printf("  intersection over union %.5f\n", found);
    EXPECT_GE(found, 0.998);
}

TEST(Silhouette, OfTheDutchShipIsThatOfAnotherRenderer) {
    const char* corpus = std::getenv("RAWTEXEL_CORPUS");
    if (!corpus) GTEST_SKIP() << "RAWTEXEL_CORPUS is not set: the ship is not compared with another renderer's picture";
    const std::string folder = std::string(corpus) + "/gltf/";
    const shading::Scene scene = scenes::load_gltf(folder + "dutch_ship/dutch_ship_medium_1k.gltf");
    const shading::Bounds bounds = scene.bounds();
    const glm::vec3 eye = bounds.center() + glm::normalize(glm::vec3(0.8f, 0.35f, 1.0f)) * 2.1f * bounds.radius();
    const Image depth = depth_of(scene, shading::look_at_camera(bounds, eye, bounds.center()));

    const Image picture = scenes::read_image(folder + "reference/dutch_ship_medium_1k.png", false);
    const auto is_background = [&](const float* pixel) {
        constexpr float kBackground[] = {64, 72, 88};
        return std::ranges::all_of(std::vector{0, 1, 2}, [&](int c) { return std::abs(pixel[c] * 255.0f - kBackground[c]) < 0.5f; });
    };
    const double found = overlap([&](int x, int y) { return depth.pixel(x, y)[0] > 0.0f; },
                                 [&](int x, int y) { return !is_background(picture.pixel(x, y)); });
    std::printf("  intersection over union %.4f\n", found);
    EXPECT_GE(found, 0.97);
}

}  // namespace
