// MASK and BLEND: what a stack of layers converges to.
#include "scene_parts.h"
#include "shading/render.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <vector>

namespace rawtexel::shading {
namespace {

using namespace test;

/// Two-sided normal quantile for a family of 100 tests at 1e-6 altogether: 1e-8 each.
constexpr double kBound = 5.73;

class CoverageTest : public testing::Test {
  protected:
    /// A quad over the whole frame at height z whose colour says which layer it is.
    static void add_layer(Scene& scene, int number, float z, Material material) {
        material.unlit = true;
        material.base_color = glm::vec4(glm::vec3(float(number)), material.base_color.a);
        add_object(scene, make_quad({-1, -1, z}, {2, 0, 0}, {0, 2, 0}, material_uv_), material);
    }

    Image render_with(const Scene& scene, RenderOptions options) {
        options.camera = square_camera();
        return render(scene, Lighting{}, options, *executor_).radiance;
    }

    static inline glm::vec2 material_uv_{1.0f};
    std::unique_ptr<Executor> executor_ = make_executor(ExecutorKind::Threads, 2);
};

/// How often each layer was seen among `draws` independent ones, held against its probability.
void expect_shares(const std::map<int, uint64_t>& seen, const std::vector<double>& share, uint64_t draws, const std::string& what) {
    uint64_t found = 0;
    for (size_t layer = 0; layer < share.size(); ++layer) {
        const auto at = seen.find(int(layer));
        const auto count = double(at == seen.end() ? 0 : at->second);
        found += uint64_t(count);
        const double expected = share[layer] * double(draws);
        const double sigma = std::sqrt(expected * (1.0 - share[layer])) + 1e-9;
        EXPECT_LT(std::abs(count - expected), kBound * sigma + 1e-6)
            << what << ": layer " << layer << " seen " << count << " times of " << draws << ", expected " << expected << " +- " << sigma;
    }
    EXPECT_EQ(found, draws) << what << ": something else was seen";
}

void count_layers(const Image& image, std::map<int, uint64_t>& seen) {
    for (size_t i = 0; i < image.values.size(); i += 3) ++seen[int(image.values[i])];
}

/// Layer k of n in front of the others with alpha a_k is seen with probability a_k (1 - a_0) ... (1 - a_(k-1)); the last is opaque.
std::vector<double> stack_shares(const std::vector<float>& alpha) {
    std::vector<double> share;
    double through = 1.0;
    for (const float a : alpha) {
        share.push_back(through * double(a));
        through *= 1.0 - double(a);
    }
    share.push_back(through);
    return share;
}

Scene make_stack(const std::vector<float>& alpha, bool back_to_front, const std::function<void(Scene&, int, float, Material)>& add) {
    Scene scene;
    const int layers = int(alpha.size());
    Material opaque;
    if (!back_to_front) add(scene, layers, -1.0f, opaque);
    for (int i = 0; i < layers; ++i) {
        const int k = back_to_front ? layers - 1 - i : i;
        Material material;
        material.alpha_mode = AlphaMode::Blend;
        material.base_color.a = alpha[size_t(k)];
        add(scene, k, float(layers - k), material);
    }
    if (back_to_front) add(scene, layers, -1.0f, opaque);
    return scene;
}

const std::vector<std::vector<float>> kStacks = {{0.3f, 0.6f}, {0.25f, 0.5f, 0.75f}, {0.1f, 0.2f, 0.15f, 0.3f, 0.05f, 0.4f, 0.5f, 0.35f}};

/// One sample in each of many pixels: are pixels and layers independent?
TEST_F(CoverageTest, BlendsStacksOverPixels) {
    for (const std::vector<float>& alpha : kStacks) {
        for (const bool back_to_front : {false, true}) {
            const Scene scene = make_stack(alpha, back_to_front, add_layer);
            std::map<int, uint64_t> seen;
            RenderOptions options;
            options.width = options.height = 256;
            for (options.seed = 0; options.seed < 4; ++options.seed) count_layers(render_with(scene, options), seen);
            expect_shares(seen, stack_shares(alpha), 4 * 256 * 256,
                          std::to_string(alpha.size()) + " layers" + (back_to_front ? ", back to front" : ""));
        }
    }
}

/// Many samples of one pixel: is each sample a new draw?
TEST_F(CoverageTest, BlendsStacksOverSamples) {
    for (const std::vector<float>& alpha : kStacks) {
        const Scene scene = make_stack(alpha, false, add_layer);
        const std::vector<double> share = stack_shares(alpha);
        double mean = 0, square = 0;
        for (size_t k = 0; k < share.size(); ++k) {
            mean += share[k] * double(k);
            square += share[k] * double(k * k);
        }
        RenderOptions options;
        options.width = 16;
        options.height = 8;
        options.spp = 4096;
        const Image image = render_with(scene, options);
        const double sigma = std::sqrt((square - mean * mean) / options.spp);
        double worst = 0, sum = 0;
        for (size_t i = 0; i < image.values.size(); i += 3) {
            worst = std::max(worst, std::abs(double(image.values[i]) - mean) / sigma);
            sum += double(image.values[i]) - mean;
        }
        EXPECT_LT(worst, kBound) << alpha.size() << " layers: the worst pixel's z";
        EXPECT_LT(std::abs(sum) / sigma / std::sqrt(128.0), kBound) << alpha.size() << " layers: z of the whole image";
    }
}

TEST_F(CoverageTest, BlendsTwoLayersOfOneMeshIndependently) {
    Scene scene;
    add_layer(scene, 2, -1.0f, Material{});
    Mesh mesh = make_quad({-1, -1, 1}, {2, 0, 0}, {0, 2, 0});
    const Mesh lower = make_quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
    mesh.positions.insert(mesh.positions.end(), lower.positions.begin(), lower.positions.end());
    mesh.uv[0].clear();
    mesh.colors.assign(8, glm::vec4(0.0f, 0.0f, 0.0f, 0.5f));
    for (size_t i = 4; i < 8; ++i) mesh.colors[i] = glm::vec4(1.0f, 1.0f, 1.0f, 0.5f);
    for (const uint32_t index : lower.indices) mesh.indices.push_back(index + 4);
    add_object(scene, mesh, unlit(glm::vec4(1.0f), AlphaMode::Blend));
    RenderOptions options;
    options.width = options.height = 512;
    std::map<int, uint64_t> seen;
    count_layers(render_with(scene, options), seen);
    expect_shares(seen, {0.5, 0.25, 0.25}, 512 * 512, "two layers of a mesh");
}

TEST_F(CoverageTest, ShowsAlphaOneAlwaysAndAlphaZeroNever) {
    const Scene scene = make_stack({0.0f, 1.0f}, false, add_layer);
    std::map<int, uint64_t> seen;
    RenderOptions options;
    options.width = options.height = 256;
    count_layers(render_with(scene, options), seen);
    expect_shares(seen, {0.0, 1.0, 0.0}, 256 * 256, "alpha 0 over alpha 1");
}

/// Stripes of half a pixel's width: columns in the upper layer, rows in the lower one.
TEST_F(CoverageTest, MixesTwoMaskLayersByTheirArea) {
    const auto masked = [](int texture) {
        Material material;
        material.alpha_mode = AlphaMode::Mask;
        material.maps[kBaseColor].texture = texture;
        material.maps[kBaseColor].sampler = {
            .magnify = texunit::Kernel::Nearest, .minify = texunit::Kernel::Nearest, .mip = texunit::MipMode::None};
        return material;
    };
    Scene scene;
    scene.textures = {make_texture(2, 1, [](int x, int) { return glm::vec4(1, 1, 1, float(x)); }),
                      make_texture(1, 2, [](int, int y) { return glm::vec4(1, 1, 1, float(y)); })};
    constexpr int kSize = 256;
    // Four periods to the pixel.
    material_uv_ = glm::vec2(4.0f * kSize);
    add_layer(scene, 0, 2.0f, masked(0));
    add_layer(scene, 1, 1.0f, masked(1));
    material_uv_ = glm::vec2(1.0f);
    add_layer(scene, 2, 0.0f, Material{});
    RenderOptions options;
    options.width = options.height = kSize;
    options.pixel_jitter = PixelJitter::Pixel;
    std::map<int, uint64_t> seen;
    for (options.seed = 0; options.seed < 4; ++options.seed) count_layers(render_with(scene, options), seen);
    expect_shares(seen, {0.5, 0.25, 0.25}, 4 * kSize * kSize, "two MASK layers");

    // Within a pixel the sample points are well spread: the mean of 1024 is near its limit everywhere.
    options.width = options.height = 16;
    options.spp = 1024;
    scene.meshes[0].uv[0] = scene.meshes[1].uv[0] = make_quad({}, {}, {}, glm::vec2(64.0f)).uv[0];
    const Image image = render_with(scene, options);
    for (size_t i = 0; i < image.values.size(); i += 3) ASSERT_NEAR(image.values[i], 0.75f, 0.04f) << "pixel " << i / 3;
}

TEST_F(CoverageTest, CutsAtTheProductOfTextureFactorAndVertexColor) {
    RenderOptions options;
    options.width = options.height = 32;
    for (const float factor : {0.49f, 0.5f, 0.51f, 1.0f}) {
        for (const float vertex : {0.4f, 1.0f}) {
            for (const float texel : {0.75f, 1.0f}) {
                Scene scene;
                scene.textures = {make_texture(4, 4, [texel](int, int) { return glm::vec4(1, 1, 1, texel); })};
                Material material = unlit({1, 1, 1, factor}, AlphaMode::Mask);
                material.alpha_cutoff = 0.375f;
                material.maps[kBaseColor].texture = 0;
                Mesh mesh = make_quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
                mesh.colors.assign(4, glm::vec4(1, 1, 1, vertex));
                add_object(scene, mesh, material);
                const bool covers = factor * vertex * texel >= 0.375f;
                const Image image = render_with(scene, options);
                for (const float value : image.values)
                    ASSERT_EQ(value, covers ? 1.0f : 0.0f) << "factor " << factor << " vertex " << vertex << " texel " << texel;
            }
        }
    }
}

/// One lookup per tested fragment, whether it then covers or not; the visible colour costs no other.
TEST_F(CoverageTest, CountsTheLookupOfAFragmentOnce) {
    Scene scene;
    scene.textures = {make_texture(2, 1, [](int x, int) { return glm::vec4(1, 1, 1, float(x)); })};
    Material material = unlit(glm::vec4(1.0f), AlphaMode::Mask);
    material.maps[kBaseColor].texture = 0;
    add_object(scene, make_quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}), material);
    RenderOptions options;
    options.camera = square_camera();
    options.width = options.height = 40;
    options.fetches.count = true;
    const RenderResult result = render(scene, Lighting{}, options, *executor_);
    EXPECT_EQ(result.fetches->counts[0].lookups, uint64_t(40 * 40));
    EXPECT_LT(result.samples_shaded, uint64_t(40 * 40));
    EXPECT_GT(result.samples_shaded, uint64_t(40 * 10));
}

}  // namespace
}  // namespace rawtexel::shading
