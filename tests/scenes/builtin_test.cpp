// The built-in scenes: sound geometry, and each shows what it was made for.
#include "scenes/builtin.h"

#include "scenes/load.h"
#include "scenes/tangents.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <set>
#include <string>

namespace rawtexel::scenes {
namespace {

using shading::Scene;

Scene make(std::string_view name) {
    for (const BuiltinScene& scene : builtin_scenes())
        if (scene.name == name) return scene.make({});
    ADD_FAILURE() << "no scene " << name;
    return {};
}

bool finite(float v) { return std::isfinite(v); }

template <class Vector>
void expect_finite(const std::vector<Vector>& values, const std::string& what) {
    for (const Vector& v : values)
        for (int c = 0; c < int(Vector::length()); ++c) ASSERT_TRUE(finite(v[c])) << what;
}

template <class T>
void expect_empty_or_one_per_point(const std::vector<T>& values, const shading::Mesh& mesh, const char* attribute) {
    EXPECT_TRUE(values.empty() || values.size() == mesh.positions.size()) << mesh.name << ' ' << attribute;
}

void expect_sound(const Scene& scene, const shading::Mesh& mesh) {
    const std::string what = scene.name + ": " + mesh.name;
    ASSERT_LT(mesh.material, scene.materials.size()) << what;
    ASSERT_EQ(mesh.indices.size() % 3, 0u) << what;
    ASSERT_FALSE(mesh.indices.empty()) << what;
    for (const uint32_t index : mesh.indices) ASSERT_LT(index, mesh.positions.size()) << what;
    ASSERT_EQ(mesh.normals.size(), mesh.positions.size()) << what;
    expect_empty_or_one_per_point(mesh.tangents, mesh, "tangents");
    expect_empty_or_one_per_point(mesh.colors, mesh, "colors");
    expect_finite(mesh.positions, what);
    for (const auto& uv : mesh.uv) {
        expect_empty_or_one_per_point(uv, mesh, "uv");
        expect_finite(uv, what);
    }
    for (const glm::vec3& normal : mesh.normals) ASSERT_NEAR(glm::length(normal), 1.0f, 1e-6f) << what;
    for (size_t i = 0; i < mesh.tangents.size(); ++i) {
        ASSERT_NEAR(glm::length(glm::vec3(mesh.tangents[i])), 1.0f, 1e-6f) << what;
        ASSERT_NEAR(glm::dot(glm::vec3(mesh.tangents[i]), mesh.normals[i]), 0.0f, 1e-6f) << what;
        ASSERT_EQ(std::abs(mesh.tangents[i].w), 1.0f) << what;
    }
    for (const glm::vec4& color : mesh.colors) {
        ASSERT_GE(std::min({color.x, color.y, color.z}), 0.0f) << what;
        ASSERT_EQ(color.w, 1.0f) << what;
    }
}

void expect_map_has_what_it_needs(const Scene& scene, const shading::Mesh& mesh, const shading::TextureMap& map, bool srgb) {
    ASSERT_LT(size_t(map.texture), scene.textures.size()) << mesh.name;
    EXPECT_EQ(scene.textures[size_t(map.texture)].srgb, srgb) << mesh.name;
}

void expect_maps_have_what_they_need(const Scene& scene, const shading::Mesh& mesh, uint32_t index) {
    const shading::Material& material = scene.materials[index];
    if (material.layers) {
        for (const uint32_t layer : material.layers->materials) expect_maps_have_what_they_need(scene, mesh, layer);
        const shading::TextureMap& mask = material.layers->mask;
        if (mask.texture >= 0) expect_map_has_what_it_needs(scene, mesh, mask, false);
        return;
    }
    for (size_t slot = 0; slot < shading::kMapSlots; ++slot) {
        const shading::TextureMap& map = material.maps[slot];
        if (map.texture < 0) continue;
        expect_map_has_what_it_needs(scene, mesh, map, slot == shading::kBaseColor || slot == shading::kEmissive);
        EXPECT_EQ(mesh.uv[size_t(map.uv_set)].empty(), material.triplanar.has_value()) << mesh.name << ", uv set " << map.uv_set;
    }
}

class Builtin : public testing::TestWithParam<size_t> {};

TEST_P(Builtin, HasSoundGeometryAndMaterials) {
    const Scene scene = builtin_scenes()[GetParam()].make({});
    EXPECT_EQ(scene.name, builtin_scenes()[GetParam()].name);
    for (const shading::Mesh& mesh : scene.meshes) {
        expect_sound(scene, mesh);
        expect_maps_have_what_they_need(scene, mesh, mesh.material);
        EXPECT_EQ(mesh.tangents.empty(), map_with_tangents(scene.materials, mesh.material) == nullptr) << mesh.name;
    }
    std::set<uint32_t> drawn;
    for (const shading::Instance& instance : scene.instances) {
        ASSERT_LT(instance.mesh, scene.meshes.size());
        drawn.insert(instance.mesh);
        EXPECT_NE(glm::determinant(instance.world_from_object), 0.0f);
    }
    EXPECT_EQ(drawn.size(), scene.meshes.size()) << "every mesh is placed";
    EXPECT_FALSE(scene.cameras.empty());
    EXPECT_NE(scene.environment, shading::EnvironmentRequest::Unspecified);
    for (const shading::Light& light : scene.lights) EXPECT_NEAR(glm::length(light.direction), 1.0f, 1e-6f);
}

TEST_P(Builtin, IsTheSameEveryTime) {
    const BuiltinScene& builtin = builtin_scenes()[GetParam()];
    const Scene a = builtin.make({}), b = builtin.make({});
    ASSERT_EQ(a.meshes.size(), b.meshes.size());
    for (size_t i = 0; i < a.meshes.size(); ++i) {
        EXPECT_EQ(a.meshes[i].positions, b.meshes[i].positions);
        EXPECT_EQ(a.meshes[i].uv, b.meshes[i].uv);
        EXPECT_EQ(a.meshes[i].colors, b.meshes[i].colors);
        EXPECT_EQ(a.meshes[i].indices, b.meshes[i].indices);
    }
    ASSERT_EQ(a.textures.size(), b.textures.size());
    for (size_t i = 0; i < a.textures.size(); ++i) {
        const texunit::Shape& shape = a.textures[i].texture->shape();
        const int x = 17 % shape.width, y = 33 % shape.height;
        EXPECT_EQ(a.textures[i].texture->texel(0, 0, x, y), b.textures[i].texture->texel(0, 0, x, y)) << a.textures[i].image_name;
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, Builtin, testing::Range(size_t{0}, builtin_scenes().size()), [](const auto& tested) {
    std::string name(builtin_scenes()[tested.param].name);
    std::erase(name, '-');
    return name;
});

TEST(Builtin, AreThoseOfTheManual) {
    std::vector<std::string_view> names;
    for (const BuiltinScene& scene : builtin_scenes()) {
        names.push_back(scene.name);
        EXPECT_FALSE(scene.description.empty());
    }
    const std::vector<std::string_view> expected{"plane",     "spheres", "magnify", "metal-edge", "bumps",    "foliage",
                                                 "triplanar", "layers",  "font",    "shadow",     "courtyard"};
    EXPECT_EQ(names, expected);
}

TEST(Builtin, PlaneReachesTheHorizonOnTwoTriangles) {
    const Scene scene = make("plane");
    EXPECT_EQ(scene.triangle_count(), 2u);
    EXPECT_TRUE(scene.materials[0].unlit);
    const texunit::Shape& shape = scene.textures[0].texture->shape();
    EXPECT_EQ(std::pair(shape.width, shape.height), std::pair(2048, 2048));
    // Seen from the camera the far edge is less than a pixel of 720 below the horizon.
    const float eye = scene.cameras[0].world_from_camera[3].y, below = eye / scene.bounds().upper.x;
    EXPECT_LT(below / scene.cameras[0].vertical_fov * 720.0f, 1.0f);
}

TEST(Builtin, SpheresAreAHundredOfTwentyThousandTriangles) {
    const Scene scene = make("spheres");
    int spheres = 0;
    for (const shading::Instance& instance : scene.instances) spheres += scene.meshes[instance.mesh].indices.size() == 3 * 20000;
    EXPECT_EQ(spheres, 100);
    EXPECT_EQ(scene.triangle_count(), 2000000u + 2u) << "and a floor";
    const auto has_maps = [](const shading::Material& m) {
        return m.maps[shading::kBaseColor].texture >= 0 && m.maps[shading::kNormal].texture >= 0 &&
               m.maps[shading::kMetallicRoughness].texture >= 0;
    };
    EXPECT_TRUE(std::all_of(scene.materials.begin(), scene.materials.end(), has_maps));
    const auto metals = std::count_if(scene.materials.begin(), scene.materials.end(), [](const auto& m) { return m.metallic == 1.0f; });
    EXPECT_GE(metals, 3);
    EXPECT_GE(std::ssize(scene.materials) - metals, 3);
}

TEST(Builtin, MagnifyEnlargesATexelToThirtyPixels) {
    const Scene scene = make("magnify");
    EXPECT_EQ(scene.triangle_count(), 2u);
    const texunit::Shape& shape = scene.textures[0].texture->shape();
    EXPECT_EQ(std::pair(shape.width, shape.height), std::pair(64, 64));
    const shading::Camera& camera = scene.cameras[0];
    EXPECT_EQ(camera.type, shading::Camera::Type::Orthographic);
    const float metres_per_texel = (scene.bounds().upper.x - scene.bounds().lower.x) / 64.0f;
    EXPECT_NEAR(720.0f / (2.0f * camera.ymag) * metres_per_texel, 30.0f, 1e-3f);
    EXPECT_NEAR(1280.0f / (2.0f * camera.xmag) * metres_per_texel, 30.0f, 1e-3f);
}

TEST(Builtin, MetalEdgeFlipsBetweenFullMetalAndATwentiethFromTexelToTexel) {
    const Scene scene = make("metal-edge");
    const shading::Material& material = scene.materials[0];
    texunit::Texture& color = *scene.textures[size_t(material.maps[shading::kBaseColor].texture)].texture;
    texunit::Texture& finish = *scene.textures[size_t(material.maps[shading::kMetallicRoughness].texture)].texture;
    int metals = 0, flips = 0;
    const int width = color.shape().width, height = color.shape().height;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const float metallic = finish.texel(0, 0, x, y)[2];
            ASSERT_TRUE(metallic == 0.0f || metallic == 1.0f) << x << ' ' << y;
            const auto base = color.texel(0, 0, x, y);
            if (metallic == 1.0f)
                EXPECT_EQ(base[0], 1.0f);
            else
                EXPECT_NEAR(base[0], 0.05f, 0.01f);
            metals += metallic == 1.0f;
            flips += x > 0 && metallic != finish.texel(0, 0, x - 1, y)[2];
        }
    EXPECT_GT(metals, width * height / 5);
    EXPECT_LT(metals, width * height * 4 / 5);
    EXPECT_GT(flips, width * height / 4) << "texel to texel, not in large patches only";
}

TEST(Builtin, BumpsAreSteepAndGlossy) {
    const Scene scene = make("bumps");
    const shading::Material& material = scene.materials[0];
    texunit::Texture& normals = *scene.textures[size_t(material.maps[shading::kNormal].texture)].texture;
    texunit::Texture& finish = *scene.textures[size_t(material.maps[shading::kMetallicRoughness].texture)].texture;
    int tilted = 0, glossy = 0;
    constexpr int kSamples = 4096;
    for (int i = 0; i < kSamples; ++i) {
        const int x = (i * 131) % normals.shape().width, y = (i * 197) % normals.shape().height;
        tilted += normals.texel(0, 0, x, y)[2] * 2.0f - 1.0f < std::cos(0.17f);
        glossy += finish.texel(0, 0, x, y)[1] < 0.2f;
    }
    EXPECT_GT(tilted, kSamples / 3) << "more than ten degrees";
    EXPECT_GT(glossy, kSamples / 2);
}

TEST(Builtin, FoliageIsMaskedCards) {
    const Scene scene = make("foliage");
    uint64_t masked = 0;
    for (const shading::Instance& instance : scene.instances) {
        const shading::Mesh& mesh = scene.meshes[instance.mesh];
        if (scene.materials[mesh.material].alpha_mode == shading::AlphaMode::Mask) masked += mesh.indices.size() / 3;
    }
    EXPECT_GT(masked, scene.triangle_count() / 2);
    for (const shading::Material& material : scene.materials) {
        if (material.alpha_mode != shading::AlphaMode::Mask) continue;
        texunit::Texture& color = *scene.textures[size_t(material.maps[shading::kBaseColor].texture)].texture;
        int open = 0, covered = 0;
        for (int i = 0; i < 4096; ++i) {
            const float alpha = color.texel(0, 0, (i * 131) % color.shape().width, (i * 197) % color.shape().height)[3];
            open += alpha == 0.0f;
            covered += alpha == 1.0f;
        }
        EXPECT_GT(open, 400) << material.name;
        EXPECT_GT(covered, 400) << material.name;
        EXPECT_GT(open + covered, 3600) << material.name << " has hard edges";
    }
}

TEST(Builtin, TriplanarAndLayersBlend) {
    const auto triplanar = [](const Scene& scene) {
        uint64_t triangles = 0;
        for (const shading::Instance& instance : scene.instances) {
            const shading::Mesh& mesh = scene.meshes[instance.mesh];
            if (scene.materials[mesh.material].triplanar) triangles += mesh.indices.size() / 3;
        }
        return triangles;
    };
    const Scene stones = make("triplanar"), path = make("layers");
    EXPECT_GT(triplanar(stones), stones.triangle_count() / 2);
    EXPECT_GT(triplanar(path), 0u);
    const shading::Material& ground = path.materials[path.meshes[0].material];
    ASSERT_TRUE(ground.layers);
    EXPECT_EQ(ground.layers->materials.size(), 3u);
    texunit::Texture& mask = *path.textures[size_t(ground.layers->mask.texture)].texture;
    for (int channel = 0; channel < 3; ++channel) {
        int pure = 0;
        for (int i = 0; i < 4096; ++i) pure += mask.texel(0, 0, (i * 131) % 512, (i * 197) % 512)[size_t(channel)] > 0.99f;
        EXPECT_GT(pure, 40) << "layer " << channel;
    }
}

/// Along rows of the map alpha changes by no more than a texel's way: it is a distance, not a picture.
TEST(Builtin, FontIsASlopeThatAHalfCuts) {
    const Scene scene = make("font");
    const shading::Material& ink = scene.materials[0];
    EXPECT_EQ(ink.alpha_mode, shading::AlphaMode::Mask);
    EXPECT_EQ(ink.alpha_cutoff, 0.5f);
    texunit::Texture& map = *scene.textures[size_t(ink.maps[shading::kBaseColor].texture)].texture;
    int inside = 0;
    for (int y = 0; y < map.shape().height; ++y)
        for (int x = 1; x < map.shape().width; ++x) {
            const float alpha = map.texel(0, 0, x, y)[3], before = map.texel(0, 0, x - 1, y)[3];
            ASSERT_LE(std::abs(alpha - before), 0.5f / 0.3f / 14.0f + 2.0f / 255.0f) << x << ' ' << y;
            inside += alpha > 0.5f;
        }
    EXPECT_GT(inside, map.shape().width * map.shape().height / 20);
}

TEST(Builtin, CourtyardHasABitOfEverything) {
    const Scene scene = make("courtyard");
    EXPECT_GE(scene.triangle_count(), 100000u);
    EXPECT_LE(scene.triangle_count(), 300000u);
    EXPECT_EQ(scene.environment, shading::EnvironmentRequest::Sky);
    ASSERT_FALSE(scene.lights.empty());
    EXPECT_EQ(scene.lights[0].type, shading::Light::Type::Directional);
    std::set<shading::AlphaMode> modes;
    std::set<size_t> slots, uv_sets;
    bool emits = false, metal = false;
    for (const shading::Material& material : scene.materials) {
        modes.insert(material.alpha_mode);
        emits = emits || material.emission.x > 1.0f;
        metal = metal || (material.metallic == 1.0f && material.maps[shading::kMetallicRoughness].texture >= 0);
        for (size_t slot = 0; slot < shading::kMapSlots; ++slot)
            if (material.maps[slot].texture >= 0) {
                slots.insert(slot);
                uv_sets.insert(size_t(material.maps[slot].uv_set));
            }
    }
    EXPECT_EQ(modes.size(), 3u);
    EXPECT_TRUE(emits);
    EXPECT_TRUE(metal);
    EXPECT_EQ(uv_sets.size(), 2u);
    EXPECT_TRUE(slots.contains(shading::kNormal) && slots.contains(shading::kOcclusion) && slots.contains(shading::kMetallicRoughness));
}

}  // namespace
}  // namespace rawtexel::scenes
