// Materials that blend planes or layers, in whole frames.
#include "shading/render.h"
#include "tests/shading/agreement.h"
#include "tests/shading/frame_bits.h"
#include "tests/shading/scene_parts.h"
#include "texunit/random.h"
#include "texunit/simd.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>

namespace rawtexel::shading {
namespace {

using namespace test;
using texunit::Estimator;
using texunit::Kernel;

constexpr FilteringOptions kListed{.order = FilterOrder::After};
constexpr FilteringOptions kDrawnPlane{.order = FilterOrder::After, .blend = Blend::Draw};
constexpr FilteringOptions kDrawn{.estimator = Estimator::Reservoir};
constexpr FilteringOptions kDrawnTexels{.estimator = Estimator::Reservoir, .blend = Blend::All};

/// 32x32 pixels, lit from the side.
class BranchesTest : public testing::Test {
  protected:
    BranchesTest() {
        options_.width = options_.height = 32;
        options_.camera = square_camera();
        options_.filter = Kernel::Bilinear;
        lighting_.ambient = 0.1f;
        Light& light = lighting_.lights.emplace_back();
        light.direction = glm::normalize(glm::vec3(0.4f, 0.3f, -1.0f));
        light.intensity = 3.0f;
    }

    int add_texture(int extent, uint32_t seed) {
        scene_.textures.push_back(make_noise_texture(extent, extent, seed));
        return int(scene_.textures.size()) - 1;
    }
    Material mapped_material(int extent, uint32_t seed) {
        Material material;
        material.maps[kBaseColor].texture = add_texture(extent, seed);
        material.maps[kMetallicRoughness].texture = add_texture(extent, seed + 1);
        material.maps[kNormal].texture = add_texture(extent, seed + 2);
        return material;
    }
    Material triplanar_material(int sharpness = 3) {
        Material material = mapped_material(12, 1);
        material.triplanar = Triplanar{1.3f, sharpness};
        return material;
    }
    static Mesh filling_quad() {
        Mesh quad = make_quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, glm::vec2(1.37f, 1.21f));
        quad.normals.assign(quad.positions.size(), glm::vec3(0, 0, 1));
        quad.tangents.assign(quad.positions.size(), glm::vec4(1, 0, 0, 1));
        return quad;
    }
    /// Normals that lean to all planes, none of them along an axis.
    static Mesh leaning_quad() {
        Mesh quad = filling_quad();
        for (size_t i = 0; i < quad.normals.size(); ++i) {
            const glm::vec3 p = quad.positions[i];
            quad.normals[i] = glm::normalize(glm::vec3(0.8f + 0.3f * p.x, -0.7f + 0.2f * p.y, 0.9f));
        }
        return quad;
    }

    /// A scene's materials are given first: mixed ones name them by their index.
    uint32_t add_material(const Material& material) {
        scene_.materials.push_back(material);
        return uint32_t(scene_.materials.size()) - 1;
    }
    Material mix(std::vector<uint32_t> materials, int mask) {
        Material mixed;
        mixed.layers = LayerBlend{.materials = std::move(materials), .mask = {}};
        mixed.layers->mask.texture = mask;
        return mixed;
    }

    Image radiance(const FilteringOptions& filtering, uint32_t seed = 0) { return result(filtering, seed).radiance; }
    RenderResult result(const FilteringOptions& filtering, uint32_t seed = 0) {
        options_.filtering = filtering;
        options_.seed = seed;
        EXPECT_EQ(refusal(scene_, options_), "");
        return render(scene_, lighting_, options_, *executor_);
    }
    double texels_per_sample(const FilteringOptions& filtering) {
        options_.fetches.count = true;
        return double(result(filtering).fetches->total().texels_requested) / (32 * 32);
    }
    void expect_mean(const FilteringOptions& drawn, const FilteringOptions& all, uint32_t frames, const char* what) {
        expect_agreement(agreement_of(radiance(all), frames, [&](uint32_t seed) { return radiance(drawn, seed); }), what);
    }

    Scene scene_;
    Lighting lighting_;
    RenderOptions options_;
    std::unique_ptr<Executor> executor_ = make_executor(ExecutorKind::Threads, 1);
};

// --- planes

/// Each side of a cube turned to the camera: upright, unmirrored, its normal map lit as one on plain coordinates.
TEST_F(BranchesTest, APlaneFacedAloneIsThatPlaneMappedByCoordinates) {
    Material triplanar = triplanar_material();
    triplanar.maps[kNormal].uv_from_vertex = {0.8f, 0.6f, -0.6f, 0.8f, 0.1f, 0.2f};
    Material plain = triplanar;
    plain.triplanar.reset();
    const glm::vec3 sides[][2] = {{{1, 0, 0}, {0, 1, 0}},  {{-1, 0, 0}, {0, 1, 0}}, {{0, 1, 0}, {0, 0, -1}},
                                  {{0, -1, 0}, {0, 0, 1}}, {{0, 0, 1}, {0, 1, 0}},  {{0, 0, -1}, {0, 1, 0}}};
    for (const auto& [normal, up] : sides) {
        const glm::vec3 right = glm::cross(up, normal);
        const glm::mat4 to_camera = glm::transpose(glm::mat4(glm::mat3(right, up, normal)));
        Mesh quad = make_quad(0.25f * normal - right - up, 2.0f * right, 2.0f * up);
        quad.normals.assign(quad.positions.size(), normal);
        for (size_t i = 0; i < quad.positions.size(); ++i)
            quad.uv[0][i] = 1.3f * glm::vec2(glm::dot(quad.positions[i], right), -glm::dot(quad.positions[i], up));
        const auto image = [&](const Material& material, const FilteringOptions& filtering) {
            scene_.meshes.clear(), scene_.instances.clear(), scene_.materials.clear();
            add_object(scene_, quad, material, to_camera);
            return radiance(filtering);
        };
        const Image expected = image(plain, {});
        for (const FilteringOptions& filtering : {FilteringOptions{}, FilteringOptions{.blend = Blend::Draw}})
            EXPECT_LT(largest_difference(image(triplanar, filtering), expected), 2e-4)
                << "normal (" << normal.x << ", " << normal.y << ", " << normal.z << "), blend " << to_string(filtering.effective_blend());
    }
}

TEST_F(BranchesTest, DrawnPlanesConvergeToAllPlanes) {
    add_object(scene_, leaning_quad(), triplanar_material());
    const Image listed = radiance(kListed);
    EXPECT_GT(largest_difference(listed, radiance({})), 0.01) << "shading should not be affine";
    expect_mean(kDrawnPlane, kListed, 800, "one plane, all of its taps");
    expect_mean(kDrawn, kListed, 1500, "one plane, one texel");
    expect_mean(kDrawnTexels, kListed, 800, "all planes, one texel of each");
    FilteringOptions stbn = kDrawn;
    stbn.noise = texunit::Noise::Stbn;
    stbn.taps = 2;
    expect_mean(stbn, kListed, 800, "one plane, two texels, stbn");
}

TEST_F(BranchesTest, OrderOfPlanesChangesNothingWhereShadingIsAffine) {
    Material material = unlit(glm::vec4(0.7f, 0.9f, 1.1f, 1));
    material.maps[kBaseColor].texture = add_texture(16, 5);
    material.triplanar = Triplanar{2.0f, 2};
    add_object(scene_, leaning_quad(), material);
    EXPECT_LT(largest_difference(radiance({}), radiance(kListed)), 2e-6);
    expect_mean(kDrawn, {}, 800, "unlit");
}

TEST_F(BranchesTest, ADrawnPlaneDemandsExactlyAThird) {
    add_object(scene_, leaning_quad(), triplanar_material());
    EXPECT_EQ(texels_per_sample({}), 3 * 3 * 4);
    EXPECT_EQ(texels_per_sample(kListed), 3 * 3 * 4);
    EXPECT_EQ(texels_per_sample(kDrawnPlane), 3 * 4);
    EXPECT_EQ(texels_per_sample(kDrawnTexels), 3 * 3);
    EXPECT_EQ(texels_per_sample(kDrawn), 3);
    options_.filter = std::nullopt;
    const double mipmapped = texels_per_sample({});
    EXPECT_GE(mipmapped, 3 * 3 * 4);
    for (const FetchModel model : {FetchModel::Forward, FetchModel::Quad}) {
        options_.fetches.model = model;
        EXPECT_EQ(texels_per_sample(kDrawnTexels), 3 * texels_per_sample(kDrawn)) << to_string(model);
    }
}

/// Policies may shade the taps of one material where all others are filtered first.
TEST_F(BranchesTest, APolicyShadesThePlanesOfItsMaterial) {
    Material material = triplanar_material();
    add_object(scene_, leaning_quad(), material);
    const Image listed = radiance(kListed);
    scene_.materials[0].policy.order = FilterOrder::After;
    EXPECT_LT(largest_difference(radiance({}), listed), 1e-6);
    scene_.meshes.clear(), scene_.instances.clear();
    const uint32_t plain = add_material(mapped_material(16, 5));
    const Material mixed = mix({plain, 0}, add_texture(8, 31));
    add_object(scene_, leaning_quad(), mixed);
    EXPECT_TRUE(std::ranges::any_of(radiance({}).values, [](float v) { return v > 0; }));
}

// --- layers

TEST_F(BranchesTest, LayersOfOneMaterialAreThatMaterial) {
    const uint32_t first = add_material(mapped_material(16, 1));
    const Material one = scene_.materials[first];
    const uint32_t second = add_material(one);
    const int mask = add_texture(8, 9);
    const Material mixed = mix({first, second, first}, mask);
    const auto image = [&](const Material& material, const FilteringOptions& filtering) {
        scene_.meshes.clear(), scene_.instances.clear();
        Mesh quad = filling_quad();
        quad.tangents.clear();
        add_object(scene_, quad, material);
        return radiance(filtering);
    };
    for (const FilteringOptions& filtering : {FilteringOptions{}, kListed})
        EXPECT_LT(largest_difference(image(mixed, filtering), image(one, filtering)), 1e-5) << to_string(filtering.effective_order());
    EXPECT_EQ(image(mixed, kDrawn).values, image(one, kDrawn).values);
}

TEST_F(BranchesTest, DrawnLayersConvergeToAllLayers) {
    const uint32_t rough = add_material(mapped_material(16, 1)), fine = add_material(mapped_material(24, 11));
    Material steep = triplanar_material();
    const uint32_t projected = add_material(steep);
    const Material mixed = mix({rough, fine, projected}, add_texture(8, 31));
    add_object(scene_, leaning_quad(), mixed);
    expect_mean(kDrawn, kListed, 1500, "one layer, one texel");
    expect_mean(kDrawnPlane, kListed, 1000, "one layer, all of its taps");
    scene_.meshes.clear(), scene_.instances.clear();
    Mesh quad = leaning_quad();
    for (size_t i = 0; i < quad.positions.size(); ++i)
        quad.colors.emplace_back(0.5f + 0.5f * quad.positions[i].x, 0.4f, 0.3f + 0.2f * quad.positions[i].y, 0.5f);
    add_object(scene_, quad, mix({rough, fine, projected}, -1));
    expect_mean(kDrawn, kListed, 1500, "one layer by vertex colours, one texel");
}

TEST_F(BranchesTest, OnlyTheDrawnLayersMapsAreFetched) {
    const uint32_t first = add_material(mapped_material(16, 1)), second = add_material(mapped_material(16, 11));
    add_object(scene_, filling_quad(), mix({first, second}, add_texture(8, 31)));
    constexpr int kMask = 4;  // texels: the weights are filtered whatever the estimator
    EXPECT_EQ(texels_per_sample({}), kMask + 2 * 3 * 4);
    EXPECT_EQ(texels_per_sample(kDrawnTexels), kMask + 2 * 3);
    EXPECT_EQ(texels_per_sample(kDrawnPlane), kMask + 3 * 4);
    EXPECT_EQ(texels_per_sample(kDrawn), kMask + 3);
}

TEST_F(BranchesTest, LayersWithoutWeightShowTheFirst) {
    const uint32_t red = add_material(unlit(glm::vec4(1, 0, 0, 1))), blue = add_material(unlit(glm::vec4(0, 0, 1, 1)));
    scene_.textures.push_back(make_texture(2, 2, [](int, int) { return glm::vec4(0, 0, 1, 1); }));
    add_object(scene_, filling_quad(), mix({red, blue}, int(scene_.textures.size()) - 1));
    for (const FilteringOptions& filtering : {FilteringOptions{}, kListed, kDrawn}) {
        const Image image = radiance(filtering);
        EXPECT_EQ(image.pixel(7, 9)[0], 1);
        EXPECT_EQ(image.pixel(7, 9)[2], 0);
    }
}

// --- shadows

/// A receiver under casters strewn texel by texel: penumbra everywhere. What one test shows is lit or not, with the filter's probability.
TEST_F(BranchesTest, OneShadowTestConvergesToTheWholeFilter) {
    Material white;
    white.metallic = 0;
    add_object(scene_, leaning_quad(), white);
    lighting_.ambient = 0;
    const Image lit = radiance({});
    ShadowMap map = make_shadow_frame(lighting_.lights[0].direction, glm::vec3(0), 1.6f, 40);
    for (size_t i = 0; i < map.depth.size(); ++i) map.depth[i] = texunit::random_float({.x = uint32_t(i)}) < 0.5f ? 0.9f : 0.0f;
    lighting_.shadow = std::make_shared<ShadowMap>(map);
    const Image filtered = radiance({});
    constexpr uint32_t kFrames = 1000;
    for (const texunit::Noise noise : {texunit::Noise::White, texunit::Noise::Blue}) {
        std::vector<double> seen(filtered.values.size());
        for (uint32_t seed = 1; seed <= kFrames; ++seed) {
            const Image one = radiance({.noise = noise, .shadow_taps = ShadowTaps::One}, seed);
            for (size_t i = 0; i < seen.size(); ++i) {
                ASSERT_TRUE(one.values[i] == 0 || std::abs(one.values[i] / lit.values[i] - 1) < 1e-5f) << one.values[i];
                seen[i] += double(one.values[i] / lit.values[i]) / kFrames;
            }
        }
        double chi_square = 0, largest = 0, pixels = 0;
        for (size_t i = 0; i < seen.size(); i += 3) {
            const double share = double(filtered.values[i] / lit.values[i]);
            if (share < 0.02 || share > 0.98) continue;  // too few events for a normal distribution
            const double z = (seen[i] - share) / std::sqrt(share * (1 - share) / kFrames);
            chi_square += z * z, largest = std::max(largest, std::abs(z)), ++pixels;
        }
        std::printf("%s: %g pixels, chi^2/dof %.3f, largest |z| %.2f\n", std::string(to_string(noise)).c_str(), pixels, chi_square / pixels,
                    largest);
        EXPECT_GT(pixels, 700);
        EXPECT_LT(largest, 6.6);
        EXPECT_NEAR(chi_square / pixels, 1, 4.9 * std::sqrt(2 / pixels));
    }
}

// --- bits

/// The busy scene, every other material of it triplanar, and a layered ball.
Scene make_branched_scene() {
    Scene scene = make_busy_scene();
    const size_t others = scene.materials.size();
    for (size_t i = 0; i < others; ++i) {
        Material& material = scene.materials[i];
        if (material.alpha_mode == AlphaMode::Opaque && !material.unlit && i % 2 == 0) material.triplanar = Triplanar{0.7f, 4};
    }
    uint32_t lit[2] = {};
    for (uint32_t i = 0, found = 0; i < others && found < 2; ++i)
        if (scene.materials[i].alpha_mode == AlphaMode::Opaque && !scene.materials[i].unlit) lit[found++] = i;
    Material mixed;
    mixed.layers = LayerBlend{.materials = {lit[0], lit[1]}, .mask = {}};
    mixed.layers->mask.texture = 0;
    add_object(scene, make_sphere(20, 12), mixed, glm::translate(glm::mat4(1.0f), glm::vec3(0.3f, 1.2f, 0.5f)));
    return scene;
}

RenderOptions branched_options(const FilteringOptions& filtering) {
    RenderOptions options;
    options.width = 165;
    options.height = 101;
    options.camera = busy_camera();
    options.spp = 3;
    options.filtering = filtering;
    options.filtering.shadow_taps = ShadowTaps::One;
    return options;
}

TEST(BranchBits, DoNotDependOnTilesThreadsAndCrops) {
    const Scene scene = make_branched_scene();
    const std::unique_ptr<Executor> one = make_executor(ExecutorKind::Threads, 1);
    const Lighting lighting = busy_lighting(scene, *one);
    for (const FilteringOptions& filtering : {FilteringOptions{}, kListed, kDrawnPlane, kDrawn, kDrawnTexels}) {
        const RenderOptions options = branched_options(filtering);
        expect_bits_of_tiles_threads_and_crops(scene, lighting, options, std::string(to_string(filtering.effective_blend())));
    }
}

TEST(BranchBits, DoNotDependOnTheInstructionSet) {
    const Scene scene = make_branched_scene();
    const std::unique_ptr<Executor> executor = make_executor(ExecutorKind::Threads, 1);
    const Lighting lighting = busy_lighting(scene, *executor);
    for (const FilteringOptions& filtering : {FilteringOptions{}, kListed, kDrawn}) {
        const RenderOptions options = branched_options(filtering);
        PixelValues first;
        for (const texunit::Simd simd : texunit::available_simd()) {
            ASSERT_TRUE(texunit::choose_simd(simd));
            const Image image = render(scene, lighting, options, *executor).radiance;
            if (first.empty()) first = image.values;
            EXPECT_EQ(image.values, first) << to_string(simd);
        }
        texunit::choose_simd(texunit::Simd::Auto);
    }
}

}  // namespace
}  // namespace rawtexel::shading
