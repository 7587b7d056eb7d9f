// From mesh and material to the surface that is shaded.
#include "scene_parts.h"
#include "shading/render.h"

#include "tests/stress/worst_case.h"
#include "tests/stress_scale.h"

#include <gtest/gtest.h>

#include <cmath>

namespace rawtexel::shading {
namespace {

using namespace test;

class MaterialTest : public testing::Test {
  protected:
    RenderOptions options_ = [] {
        RenderOptions options;
        options.width = options.height = 64;
        options.camera = square_camera();
        options.spp = 2;
        return options;
    }();
    std::unique_ptr<Executor> executor_ = make_executor(ExecutorKind::Threads, 1);

    Image image_of(const Scene& scene) { return render(scene, sunlight(), options_, *executor_).radiance; }
    Image layer_of(const Scene& scene, Aov aov) {
        RenderOptions options = options_;
        options.aovs = {aov};
        return render(scene, sunlight(), options, *executor_).layers[0].image;
    }
    static Lighting sunlight() {
        Lighting lighting;
        Light sun;
        sun.direction = glm::normalize(glm::vec3(0.5f, -0.7f, -1.0f));
        sun.intensity = 3.0f;
        lighting.lights = {sun};
        return lighting;
    }
    static glm::vec3 pixel(const Image& image, int x, int y) { return {image.pixel(x, y)[0], image.pixel(x, y)[1], image.pixel(x, y)[2]}; }
};

double worst_difference(const Image& a, const Image& b) {
    double worst = 0;
    for (size_t i = 0; i < a.values.size(); ++i) worst = std::max(worst, std::abs(double(a.values[i]) - double(b.values[i])));
    return worst;
}

Material bumpy_material() {
    Material material;
    material.roughness = 0.5f;
    material.metallic = 0.2f;
    material.maps[kNormal].texture = 0;
    return material;
}

TEST_F(MaterialTest, ForgetsWholePeriodsOfTextureCoordinates) {
    for (const texunit::Wrap wrap : {texunit::Wrap::Repeat, texunit::Wrap::MirroredRepeat}) {
        std::optional<Image> expected;
        for (const float shift : {0.0f, 2.0f, -2.0f, 1024.0f, 65536.0f, -1048576.0f}) {
            Scene scene;
            scene.textures = {make_noise_texture(64, 64, 5)};
            Material material = unlit(glm::vec4(1.0f));
            material.maps[kBaseColor].texture = 0;
            material.maps[kBaseColor].sampler.wrap_s = material.maps[kBaseColor].sampler.wrap_t = wrap;
            Mesh mesh = make_quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
            // Multiples of 1/8 are exact next to 2^20 too.
            mesh.uv[0] = {{0.125f, 2.5f}, {1.75f, 2.25f}, {1.625f, -0.5f}, {-0.25f, -0.375f}};
            for (glm::vec2& uv : mesh.uv[0]) uv += glm::vec2(shift, -shift);
            add_object(scene, mesh, material);
            const Image image = image_of(scene);
            if (!expected) expected = image;
            EXPECT_EQ(image.values, expected->values) << to_string(wrap) << " shifted by " << shift;
        }
    }
    tell_worst_case("values_that_differ", 0);
}

TEST_F(MaterialTest, TransformsTextureCoordinatesPerMap) {
    const auto scene_with = [](const glm::mat3x2& map_transform, bool on_mesh) {
        Scene scene;
        scene.textures = {make_noise_texture(32, 32, 6)};
        Material material = unlit(glm::vec4(1.0f));
        material.maps[kBaseColor].texture = 0;
        Mesh mesh = make_quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
        if (on_mesh) {
            for (glm::vec2& uv : mesh.uv[0]) uv = map_transform * glm::vec3(uv, 1.0f);
        } else {
            material.maps[kBaseColor].uv_from_vertex = map_transform;
        }
        add_object(scene, mesh, material);
        return scene;
    };
    const glm::mat3x2 transform{1.5f, 0.5f, -0.5f, 2.0f, 0.25f, -0.75f};
    EXPECT_LT(worst_difference(image_of(scene_with(transform, false)), image_of(scene_with(transform, true))), 1e-5);
    EXPECT_GT(worst_difference(image_of(scene_with(transform, false)), image_of(scene_with({1, 0, 0, 1, 0, 0}, true))), 0.1);
}

TEST_F(MaterialTest, ReadsTheUvSetThatTheMapNames) {
    Scene scene;
    scene.textures = {make_noise_texture(32, 32, 6)};
    Material material = unlit(glm::vec4(1.0f));
    material.maps[kBaseColor].texture = 0;
    Mesh mesh = make_quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
    add_object(scene, mesh, material);
    const Image expected = image_of(scene);
    scene.materials[0].maps[kBaseColor].uv_set = 1;
    std::swap(scene.meshes[0].uv[0], scene.meshes[0].uv[1]);
    EXPECT_EQ(image_of(scene).values, expected.values);
    // A set that the mesh lacks reads as 0.
    scene.meshes[0].uv[1].clear();
    const Image flat = image_of(scene);
    EXPECT_EQ(pixel(flat, 5, 5), pixel(flat, 60, 33));
}

TEST_F(MaterialTest, MultipliesFactorTextureAndVertexColor) {
    Scene scene;
    scene.textures = {make_texture(1, 1, [](int, int) { return glm::vec4(0.5f, 0.25f, 1.0f, 1.0f); })};
    Material material = unlit({0.5f, 1.0f, 2.0f, 1.0f});
    material.maps[kBaseColor].texture = 0;
    Mesh mesh = make_quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
    mesh.colors = {{0, 1, 1, 1}, {1, 1, 1, 1}, {1, 0, 1, 1}, {0, 0, 1, 1}};
    add_object(scene, mesh, material);
    const Image image = image_of(scene);
    options_.spp = 1;
    EXPECT_NEAR(image.pixel(16, 48)[0], 0.25f * (16.5f / 64.0f), 4e-3f);
    EXPECT_NEAR(image.pixel(16, 48)[1], 0.25f * (48.5f / 64.0f), 4e-3f);
    EXPECT_NEAR(image.pixel(16, 48)[2], 2.0f, 1e-5f);
}

/// A mirrored instance is the mesh with mirrored positions, normals, tangents, bitangent signs and winding.
TEST_F(MaterialTest, MirrorsWithTheTransform) {
    Scene mirrored;
    mirrored.textures = {make_noise_texture(16, 16, 8)};
    Mesh mesh = make_sphere(24, 16);
    for (const glm::vec3& p : mesh.positions) {
        const glm::vec3 east(p.z, 0.0f, -p.x);
        mesh.tangents.emplace_back(glm::length(east) > 0.01f ? glm::normalize(east) : glm::vec3(1, 0, 0), 1.0f);
    }
    glm::mat4 mirror(1.0f);
    mirror[0][0] = -1.0f;
    Scene baked = mirrored;
    add_object(mirrored, mesh, bumpy_material(), mirror);
    for (size_t i = 0; i < mesh.positions.size(); ++i) {
        mesh.positions[i].x *= -1.0f;
        mesh.normals[i].x *= -1.0f;
        mesh.tangents[i].x *= -1.0f;
        mesh.tangents[i].w *= -1.0f;
    }
    for (size_t i = 0; i < mesh.indices.size(); i += 3) std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
    add_object(baked, mesh, bumpy_material());
    EXPECT_LT(worst_difference(layer_of(mirrored, Aov::Normal), layer_of(baked, Aov::Normal)), 2e-4);
    EXPECT_GT(worst_difference(layer_of(mirrored, Aov::Normal), Image(64, 64, 3)), 0.5) << "nothing was drawn";
    EXPECT_LT(worst_difference(image_of(mirrored), image_of(baked)), 1e-3);
}

TEST_F(MaterialTest, ScalesNormalsByTheInverseTranspose) {
    Scene scene;
    glm::mat4 flattened(1.0f);
    flattened[2][2] = 0.25f;
    add_object(scene, make_sphere(96, 48), Material{}, flattened);
    options_.spp = 1;
    const Image normals = layer_of(scene, Aov::Normal);
    // On the ellipsoid x^2 + y^2 + 16 z^2 = 1 the normal is along (x, y, 16 z).
    for (const glm::ivec2& at : {glm::ivec2(32, 32), glm::ivec2(20, 40), glm::ivec2(45, 22)}) {
        const float x = (float(at.x) + 0.5f) / 32.0f - 1.0f, y = 1.0f - (float(at.y) + 0.5f) / 32.0f;
        const glm::vec3 expected = glm::normalize(glm::vec3(x, y, 4.0f * std::sqrt(1.0f - x * x - y * y)));
        EXPECT_LT(glm::length(pixel(normals, at.x, at.y) - expected), 0.01f) << at.x << "," << at.y;
    }
}

/// The back shows the front's normals turned about, mapped or not.
TEST_F(MaterialTest, TurnsTheBackOfDoubleSidedSurfaces) {
    for (const bool mapped : {false, true}) {
        Scene scene;
        scene.textures = {make_texture(1, 1, [](int, int) { return glm::vec4(0.75f, 0.625f, 0.875f, 1.0f); })};
        Material material = mapped ? bumpy_material() : Material{};
        Mesh mesh = make_quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
        mesh.normals.assign(4, glm::normalize(glm::vec3(0.1f, 0.2f, 1.0f)));
        mesh.tangents.assign(4, glm::vec4(1, 0, 0, 1));
        add_object(scene, mesh, material);
        const glm::vec3 front = pixel(layer_of(scene, Aov::Normal), 20, 20);
        if (mapped) {
            EXPECT_GT(front.x, 0.4f);
        }
        options_.camera.world_from_camera[0] *= -1.0f;
        options_.camera.world_from_camera[2] *= -1.0f;
        options_.camera.world_from_camera[3] = glm::vec4(0, 0, -11, 1);
        EXPECT_EQ(pixel(layer_of(scene, Aov::Normal), 20, 20), glm::vec3(0.0f)) << "the back of a single-sided surface is seen";
        scene.materials[0].double_sided = true;
        const glm::vec3 back = pixel(layer_of(scene, Aov::Normal), 20, 20);
        EXPECT_LT(glm::length(front + back), 1e-5f);
        options_.camera = square_camera();
    }
}

TEST_F(MaterialTest, IsFlatWithoutNormals) {
    Scene scene;
    Mesh mesh = make_quad({-1, -1, 0.5f}, {2, 0, -1}, {0, 2, 0});
    add_object(scene, mesh, Material{});
    const glm::vec3 expected = glm::normalize(glm::vec3(1, 0, 2));
    EXPECT_LT(glm::length(pixel(layer_of(scene, Aov::Normal), 30, 30) - expected), 1e-5f);
    // Zero normals, as some exporters write them, are no normals.
    scene.meshes[0].normals.assign(4, glm::vec3(0.0f));
    EXPECT_LT(glm::length(pixel(layer_of(scene, Aov::Normal), 30, 30) - expected), 1e-5f);
}

/// +X along u, +Y against v, +Z out (glTF 2.0 3.9.3), whatever the mapping's orientation.
TEST_F(MaterialTest, DerivesTheTangentsThatAMeshLacks) {
    for (const bool mirrored_uv : {false, true}) {
        Scene scene;
        scene.textures = {make_texture(1, 1, [](int, int) { return glm::vec4(0.9f, 0.7f, 0.8f, 1.0f); })};
        Mesh mesh = make_quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, {mirrored_uv ? -3.0f : 3.0f, 2.0f});
        mesh.normals.assign(4, glm::vec3(0, 0, 1));
        add_object(scene, mesh, bumpy_material());
        const glm::vec3 derived = pixel(layer_of(scene, Aov::Normal), 10, 40);
        const float sign = mirrored_uv ? -1.0f : 1.0f;
        EXPECT_LT(glm::length(derived - glm::normalize(glm::vec3(sign * 0.8f, 0.4f, 0.6f))), 1e-5f)
            << derived.x << " " << derived.y << " " << derived.z;
        scene.meshes[0].tangents.assign(4, glm::vec4(sign, 0, 0, sign));
        const glm::vec3 given = pixel(layer_of(scene, Aov::Normal), 10, 40);
        EXPECT_LT(glm::length(derived - given), 1e-6f);
    }
}

TEST_F(MaterialTest, KeepsTheNormalWhereTheMappingIsDegenerate) {
    Scene scene;
    scene.textures = {make_texture(1, 1, [](int, int) { return glm::vec4(0.9f, 0.7f, 0.8f, 1.0f); })};
    Mesh mesh = make_quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, {0.0f, 0.0f});
    add_object(scene, mesh, bumpy_material());
    EXPECT_EQ(pixel(layer_of(scene, Aov::Normal), 10, 40), glm::vec3(0, 0, 1)) << "one point";
    scene.meshes[0].uv[0] = {{0, 0}, {1, 1}, {2, 2}, {1, 1}};
    EXPECT_EQ(pixel(layer_of(scene, Aov::Normal), 10, 40), glm::vec3(0, 0, 1)) << "a line";
}

TEST_F(MaterialTest, ScalesTheNormalMap) {
    Scene scene;
    scene.textures = {make_texture(1, 1, [](int, int) { return glm::vec4(0.75f, 0.5f, 1.0f, 1.0f); })};
    Mesh mesh = make_quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
    mesh.tangents.assign(4, glm::vec4(1, 0, 0, 1));
    add_object(scene, mesh, bumpy_material());
    for (const float strength : {0.0f, 0.5f, 1.0f, 2.0f}) {
        scene.materials[0].normal_scale = strength;
        const glm::vec3 expected = glm::normalize(glm::vec3(0.5f * strength, 0, 1));
        EXPECT_LT(glm::length(pixel(layer_of(scene, Aov::Normal), 10, 40) - expected), 1e-6f) << "scale " << strength;
    }
}

/// A map is looked up once per shading point, and not at all where its factor makes it irrelevant.
TEST_F(MaterialTest, LooksUpWhatMatters) {
    options_.fetches.count = true;
    options_.spp = 1;
    const auto lookups = [&](const Material& material, const Lighting& lighting) {
        Scene scene;
        for (uint32_t i = 0; i < kMapSlots; ++i) scene.textures.push_back(make_noise_texture(8, 8, i));
        add_object(scene, make_quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}), material);
        const RenderResult result = render(scene, lighting, options_, *executor_);
        std::vector<uint64_t> per_pixel;
        for (const texunit::FetchCounts& counts : result.fetches->counts) per_pixel.push_back(counts.lookups / (64 * 64));
        return per_pixel;
    };
    Material material;
    for (int slot = 0; slot < kMapSlots; ++slot) material.maps[size_t(slot)].texture = slot;
    material.emission = glm::vec3(1.0f);
    Lighting ambient = sunlight();
    ambient.ambient = 0.1f;
    using Counts = std::vector<uint64_t>;
    EXPECT_EQ(lookups(material, ambient), (Counts{1, 1, 1, 1, 1}));
    EXPECT_EQ(lookups(material, sunlight()), (Counts{1, 1, 1, 0, 1})) << "nothing reads the occlusion of punctual light";
    Material plain = material;
    plain.emission = glm::vec3(0.0f);
    plain.metallic = plain.roughness = 0.0f;
    plain.normal_scale = plain.occlusion_strength = 0.0f;
    EXPECT_EQ(lookups(plain, ambient), (Counts{1, 0, 0, 0, 0}));
    plain.base_color = {0, 0, 0, 1};
    EXPECT_EQ(lookups(plain, ambient), (Counts{0, 0, 0, 0, 0}));
    material.unlit = true;
    EXPECT_EQ(lookups(material, ambient), (Counts{1, 0, 0, 0, 0}));
}

TEST_F(MaterialTest, ReplacesFilterAndMipWhereAsked) {
    Scene scene;
    scene.textures = {make_texture(2, 2, [](int x, int y) { return glm::vec4(float(x ^ y)); })};
    Material material = unlit(glm::vec4(1.0f));
    material.maps[kBaseColor].texture = 0;
    add_object(scene, make_quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}), material);
    options_.spp = 1;
    EXPECT_NE(pixel(image_of(scene), 20, 16), glm::vec3(0.0f));
    options_.filter = texunit::Kernel::Nearest;
    for (const float value : image_of(scene).values) ASSERT_TRUE(value == 0.0f || value == 1.0f) << value;
    // Minified 64 times, the finest level still shows its texels, the pyramid its mean.
    scene.meshes[0].uv[0] = make_quad({}, {}, {}, glm::vec2(1001.0f)).uv[0];
    options_.mip = texunit::MipMode::None;
    for (const float value : image_of(scene).values) ASSERT_TRUE(value == 0.0f || value == 1.0f) << value;
    options_.mip = texunit::MipMode::Linear;
    for (const float value : image_of(scene).values) ASSERT_EQ(value, 0.5f);
}

/// Attributes never leave the range of their corners, on slivers neither: here hundreds of them run from behind the eye into the distance.
TEST_F(MaterialTest, KeepsAttributesOfSliversBetweenTheirCorners) {
    Scene scene;
    Mesh mesh;
    for (int i = 0; i < 600; ++i) {
        const float x = -0.9f + 0.003f * float(i), width = 1e-4f * float(1 + i % 7);
        mesh.positions.insert(mesh.positions.end(), {{x, -0.2f, 0.5f}, {x + width, 0.6f, -1.0f}, {x - width, 0.3f, -1.5f}});
        mesh.colors.insert(mesh.colors.end(), {{2, 1, 1, 1}, {1, 2, 1, 1}, {1, 1, 2, 1}});
        for (int k = 0; k < 3; ++k) mesh.indices.push_back(uint32_t(mesh.indices.size()));
    }
    Material material = unlit(glm::vec4(1.0f));
    material.double_sided = true;
    add_object(scene, mesh, material);
    options_.width = options_.height = 256;
    options_.spp = 1;
    options_.pixel_jitter = PixelJitter::Pixel;
    options_.camera = Camera{};
    options_.camera.vertical_fov = 1.5f;
    uint64_t seen = 0;
    float least = 2, most = 1;
    for (options_.seed = 0; options_.seed < uint32_t(8 * stress_scale()); ++options_.seed) {
        for (const float value : image_of(scene).values) {
            if (value == 0.0f) continue;
            ++seen;
            ASSERT_GE(value, 1.0f);
            ASSERT_LE(value, 2.0f);
            least = std::min(least, value), most = std::max(most, value);
        }
    }
    EXPECT_GT(seen, 1000u);
    tell_tested(seen, "attributes");
    tell_worst_case("least_of_1_and_most_of_2", std::to_string(least) + " " + std::to_string(most));
}

}  // namespace
}  // namespace rawtexel::shading
