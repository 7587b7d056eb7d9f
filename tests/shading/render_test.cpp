#include "shading/render.h"

#include "scene_parts.h"
#include "shading/accumulation.h"
#include "tests/shading/executor_kinds.h"
#include "tests/shading/frame_bits.h"
#include "tests/stress/worst_case.h"
#include "texunit/simd.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <mutex>
#include <numeric>

namespace rawtexel::shading {
namespace {

using namespace test;

Image cropped(const Image& image, const Crop& crop) {
    Image part(crop.width, crop.height, image.channels);
    for (int y = 0; y < crop.height; ++y)
        std::copy_n(image.pixel(crop.x, crop.y + y), size_t(crop.width) * size_t(image.channels), part.pixel(0, y));
    return part;
}

uint64_t total_texels(const RenderResult& result) { return result.fetches->total().texels_requested; }

/// The busy scene: its surfaces are opaque, MASK and BLEND, lit by all kinds of light there are.
class RenderTest : public testing::Test {
  protected:
    static RenderOptions options() {
        RenderOptions options;
        options.width = 165;
        options.height = 101;
        options.camera = busy_camera();
        options.spp = 3;
        options.aovs = {Aov::Depth, Aov::Normal, Aov::Albedo, Aov::Uv, Aov::Lod, Aov::Material, Aov::Texels, Aov::Spp};
        return options;
    }

    RenderResult render_with(const RenderOptions& options, ExecutorKind kind = ExecutorKind::Threads, int threads = 1) const {
        const std::unique_ptr<Executor> executor = make_executor(kind, threads);
        return render(scene_, lighting_, options, *executor);
    }

    static void expect_same(const RenderResult& a, const RenderResult& b, const std::string& what) {
        EXPECT_TRUE(same_bits(a.radiance, b.radiance)) << what;
        ASSERT_EQ(a.layers.size(), b.layers.size()) << what;
        for (size_t i = 0; i < a.layers.size(); ++i)
            EXPECT_TRUE(same_bits(a.layers[i].image, b.layers[i].image)) << a.layers[i].name << ", " << what;
        EXPECT_EQ(a.samples_shaded, b.samples_shaded) << what;
        expect_same_fetches(a, b, what);
    }

    static void expect_same_fetches(const RenderResult& a, const RenderResult& b, const std::string& what) {
        ASSERT_EQ(a.fetches == nullptr, b.fetches == nullptr) << what;
        if (!a.fetches) return;
        EXPECT_EQ(a.fetches->counts, b.fetches->counts) << what;
        EXPECT_EQ(a.fetches->measure(), b.fetches->measure()) << what;
    }

    std::unique_ptr<Executor> one_ = make_executor(ExecutorKind::Threads, 1);
    Scene scene_ = make_busy_scene();
    Lighting lighting_ = busy_lighting(scene_, *one_);
};

TEST_F(RenderTest, GivesTheSameBitsForAnyThreadsAndTileSize) {
    for (const PixelJitter jitter : {PixelJitter::Frame, PixelJitter::Pixel}) {
        RenderOptions options = RenderTest::options();
        options.pixel_jitter = jitter;
        options.pixel_filter = jitter == PixelJitter::Pixel ? PixelFilter::Gaussian : PixelFilter::Box;
        options.fetches.count = true;
        const RenderResult expected = render_with(options);
        EXPECT_GT(total_texels(expected), 0u);
        for (const int tile_size : {32, 64, 128}) {
            options.tile_size = tile_size;
            for (const ExecutorKind kind : executor_kinds())
                for (const int threads : {1, 2, 3})
                    expect_same(render_with(options, kind, threads), expected,
                                std::to_string(threads) + (kind == ExecutorKind::Tbb ? " TBB" : "") + " threads, tiles of " +
                                    std::to_string(tile_size));
        }
    }
    tell_worst_case("values_that_differ", 0);
}

TEST_F(RenderTest, GivesACropTheBitsOfThatPart) {
    RenderOptions options = RenderTest::options();
    for (const PixelJitter jitter : {PixelJitter::Frame, PixelJitter::Pixel}) {
        options.pixel_jitter = jitter;
        options.crop = {};
        const RenderResult whole = render_with(options);
        for (const Crop& crop : {Crop{0, 0, 1, 1}, Crop{63, 31, 2, 2}, Crop{17, 5, 101, 90}, Crop{164, 100, 1, 1}}) {
            options.crop = crop;
            const RenderResult part = render_with(options);
            EXPECT_TRUE(same_bits(part.radiance, cropped(whole.radiance, crop))) << crop.x << "," << crop.y;
            for (size_t i = 0; i < part.layers.size(); ++i)
                EXPECT_TRUE(same_bits(part.layers[i].image, cropped(whole.layers[i].image, crop)))
                    << part.layers[i].name << " " << crop.x << "," << crop.y;
        }
    }
}

TEST_F(RenderTest, CountsACropAsItsShareOfTheWhole) {
    RenderOptions options = RenderTest::options();
    options.fetches.count = true;
    const RenderResult whole = render_with(options);
    uint64_t texels = 0, samples = 0;
    for (const Crop& crop : {Crop{0, 0, 70, 101}, Crop{70, 0, 95, 33}, Crop{70, 33, 95, 68}}) {
        options.crop = crop;
        const RenderResult part = render_with(options);
        texels += total_texels(part);
        samples += part.samples_shaded;
    }
    EXPECT_EQ(texels, total_texels(whole));
    EXPECT_EQ(samples, whole.samples_shaded);
}

TEST_F(RenderTest, CountsWithoutChangingTheImage) {
    RenderOptions options = RenderTest::options();
    options.aovs.clear();
    const RenderResult plain = render_with(options);
    EXPECT_EQ(plain.fetches, nullptr);
    options.fetches.count = true;
    const RenderResult counted = render_with(options);
    EXPECT_TRUE(same_bits(plain.radiance, counted.radiance));
    EXPECT_EQ(counted.fetches->counts.size(), scene_.textures.size());
}

TEST_F(RenderTest, ChargesEveryTexelToItsPixel) {
    RenderOptions options = RenderTest::options();
    options.aovs = {Aov::Texels};
    options.fetches.count = true;
    options.spp = 4;  // so that the means are exact
    const RenderResult result = render_with(options);
    const PixelValues& texels = result.layers[0].image.values;
    EXPECT_EQ(uint64_t(4.0 * std::accumulate(texels.begin(), texels.end(), 0.0)), total_texels(result));
}

/// So no sample changes when more are asked for, and an image may be made in parts.
TEST_F(RenderTest, MakesPartsThatAddUpToTheWhole) {
    RenderOptions options = RenderTest::options();
    options.aovs.clear();
    for (const PixelJitter jitter : {PixelJitter::Frame, PixelJitter::Pixel}) {
        options.pixel_jitter = jitter;
        options.first_sample = 0;
        options.spp = 13;
        const Image whole = render_with(options).radiance;
        SampleTree sums(whole.values.size());
        options.spp = 1;
        for (const uint32_t sample : {12u, 3u, 4u, 0u, 11u, 1u, 2u, 5u, 8u, 6u, 7u, 10u, 9u}) {
            options.first_sample = sample;
            sums.add(sample, render_with(options).radiance.values);
        }
        std::vector<float> mean(whole.values.size());
        sums.mean(0, mean);
        EXPECT_EQ(mean, whole.values) << to_string(jitter);
    }
}

TEST_F(RenderTest, SeesTheSameOnEveryInstructionSet) {
    RenderOptions options = RenderTest::options();
    options.fetches.count = true;
    std::optional<RenderResult> expected;
    double most = 0;
    const texunit::Simd before = texunit::chosen_simd();
    for (const texunit::Simd simd : texunit::available_simd()) {
        ASSERT_TRUE(texunit::choose_simd(simd));
        RenderResult result = render_with(options);
        if (!expected) {
            expected = std::move(result);
            continue;
        }
        const std::string name(to_string(simd));
        EXPECT_EQ(result.samples_shaded, expected->samples_shaded) << name;
        expect_same_fetches(result, *expected, name);
        for (const size_t layer : {size_t(4), size_t(5), size_t(6)})
            EXPECT_TRUE(same_bits(result.layers[layer].image, expected->layers[layer].image)) << result.layers[layer].name << " " << name;
        double worst = 0;
        for (size_t i = 0; i < result.radiance.values.size(); ++i) {
            const double a = double(result.radiance.values[i]), b = double(expected->radiance.values[i]);
            worst = std::max(worst, std::abs(a - b) / std::max(std::abs(b), 1e-3));
        }
        most = std::max(most, worst);
        EXPECT_LT(worst, 1e-5) << name << " against " << to_string(texunit::available_simd().front());
    }
    texunit::choose_simd(before);
    tell_worst_case("radiance_off_by", most);
}

TEST_F(RenderTest, MeasuresDepthAlongTheViewAxis) {
    RenderOptions options;
    options.width = options.height = 16;
    options.aovs = {Aov::Depth, Aov::Normal, Aov::Material, Aov::Uv, Aov::Albedo, Aov::Spp};
    options.spp = 2;
    Scene scene;
    add_object(scene, make_quad({-5, -5, 0}, {5, 0, 0}, {0, 10, 0}), unlit({0.25f, 0.5f, 1.0f, 1.0f}));
    options.camera.world_from_camera[3] = glm::vec4(0, 0, 4, 1);
    const RenderResult result = render(scene, Lighting{}, options, *one_);
    const auto layer = [&](size_t i, int x) { return result.layers[i].image.pixel(x, 8); };
    // The quad covers the left half of the frame.
    EXPECT_NEAR(layer(0, 2)[0], 4.0f, 1e-5f);
    EXPECT_EQ(layer(0, 13)[0], 0.0f);
    EXPECT_EQ(glm::vec3(layer(1, 2)[0], layer(1, 2)[1], layer(1, 2)[2]), glm::vec3(0, 0, 1));
    EXPECT_EQ(layer(2, 2)[0], 0.0f);
    EXPECT_EQ(layer(2, 13)[0], -1.0f);
    EXPECT_GT(layer(3, 5)[0], layer(3, 2)[0]);
    EXPECT_EQ(layer(4, 2)[1], 0.5f);
    EXPECT_EQ(layer(5, 2)[0], 2.0f);
    EXPECT_EQ(result.samples_shaded, uint64_t(16 * 8 * 2));
    EXPECT_EQ(result.layers[0].channel_names, std::vector<std::string>{"Z"});
}

TEST_F(RenderTest, FillsTheBackgroundAsAsked) {
    RenderOptions options;
    options.width = 70;
    options.height = 40;
    options.spp = 2;
    const Scene empty;
    EXPECT_EQ(render(empty, Lighting{}, options, *one_).radiance.values, std::vector<float>(70 * 40 * 3, 0.0f));
    options.background = glm::vec3(0.5f, 0.25f, 2.0f);
    const Image flat = render(empty, Lighting{}, options, *one_).radiance;
    EXPECT_EQ(glm::vec3(flat.pixel(69, 39)[0], flat.pixel(69, 39)[1], flat.pixel(69, 39)[2]), *options.background);
    options.background.reset();
    options.spp = 1;
    Lighting lighting;
    lighting.environment = lighting_.environment;
    const Image sky = render(empty, lighting, options, *one_).radiance;
    // Sample 0 lies at the pixel's centre.
    for (const glm::ivec2& at : {glm::ivec2(0, 0), glm::ivec2(35, 20), glm::ivec2(69, 7)}) {
        const float half_height = std::tan(0.5f * options.camera.vertical_fov), half_width = half_height * 70.0f / 40.0f;
        const glm::vec3 along(half_width * ((float(at.x) + 0.5f) / 35.0f - 1.0f), half_height * (1.0f - (float(at.y) + 0.5f) / 20.0f),
                              -1.0f);
        const glm::vec3 expected = lighting_.environment->radiance(glm::normalize(along));
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(sky.pixel(at.x, at.y)[c], expected[c], 2e-5f) << at.x << "," << at.y;
    }
}

TEST_F(RenderTest, TellsWhichShareOfAPixelIsCovered) {
    // The left half of the frame and half of the pixel at x = 8; sample points are spread evenly, so 64 of them tell a half within 1/16.
    Scene scene;
    add_object(scene, make_quad({-1, -1, 0}, {1.0625f, 0, 0}, {0, 2, 0}), unlit(glm::vec4(0.5f, 0.5f, 0.5f, 1.0f)));
    RenderOptions options;
    options.width = options.height = 16;
    options.camera = square_camera();
    options.spp = 64;
    options.background = glm::vec3(0.0f);
    EXPECT_TRUE(render(scene, Lighting{}, options, *one_).coverage.values.empty());
    options.coverage = true;
    const RenderResult result = render(scene, Lighting{}, options, *one_);
    ASSERT_EQ(result.coverage.channels, 1);
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x) {
            const float share = result.coverage.pixel(x, y)[0];
            if (x == 8)
                EXPECT_NEAR(share, 0.5f, 1.0f / 16.0f);
            else
                EXPECT_EQ(share, x < 8 ? 1.0f : 0.0f) << x;
            EXPECT_EQ(result.radiance.pixel(x, y)[1], 0.5f * share);  // over black
        }
}

TEST_F(RenderTest, ReportsProgressUpToOne) {
    RenderOptions options = RenderTest::options();
    options.tile_size = 32;
    std::mutex mutex;
    std::vector<double> shares;
    const std::unique_ptr<Executor> executor = make_executor(ExecutorKind::Threads, 2);
    render(scene_, lighting_, options, *executor, [&](double share) {
        const std::lock_guard lock(mutex);
        shares.push_back(share);
    });
    ASSERT_EQ(shares.size(), size_t(6 * 4));
    EXPECT_EQ(*std::max_element(shares.begin(), shares.end()), 1.0);
    EXPECT_GT(*std::min_element(shares.begin(), shares.end()), 0.0);
}

/// Good to look at until its third block is asked for.
class DamagedSource final : public texunit::TexelSource {
  public:
    texunit::Format format() const override { return texunit::Format::RGBA8Unorm; }
    texunit::Shape shape() const override { return {.width = 64, .height = 64}; }
    uint64_t stored_bytes() const override { return 64 * 64 * 4; }
    void decode_block(int, int, int block_x, int block_y, std::byte* texels) override {
        if (block_x + block_y > 3) throw texunit::TextureError("damaged.png: truncated");
        std::memset(texels, 0x80, 64);
    }
};

TEST_F(RenderTest, TellsOfATextureThatProvesDamaged) {
    for (const AlphaMode mode : {AlphaMode::Opaque, AlphaMode::Mask}) {
        Scene scene;
        scene.textures.resize(1);
        scene.textures[0].texture = std::make_shared<texunit::Texture>("damaged.png", std::make_unique<DamagedSource>());
        Material material = unlit(glm::vec4(1.0f), mode);
        material.maps[kBaseColor].texture = 0;
        add_object(scene, make_quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}), material);
        RenderOptions options;
        options.width = options.height = 256;
        options.tile_size = 32;
        options.camera = square_camera();
        for (const ExecutorKind kind : executor_kinds()) {
            const std::unique_ptr<Executor> executor = make_executor(kind, 2);
            try {
                render(scene, Lighting{}, options, *executor);
                ADD_FAILURE() << "nothing was thrown";
            } catch (const texunit::TextureError& error) {
                EXPECT_NE(std::string(error.what()).find("damaged.png"), std::string::npos) << error.what();
            }
        }
    }
}

TEST(ResolveLighting, PutsTheShadowCasterFirst) {
    const std::unique_ptr<Executor> executor = make_executor(ExecutorKind::Threads, 1);
    const Scene scene = make_busy_scene();
    const Lighting lit = busy_lighting(scene, *executor);
    ASSERT_EQ(lit.lights.size(), 2u);
    EXPECT_EQ(lit.lights[0].type, Light::Type::Directional);
    ASSERT_NE(lit.shadow, nullptr);
    const Lighting plain = resolve_lighting(scene, lit.lights, 0.0f, nullptr, false, *executor);
    EXPECT_EQ(plain.shadow, nullptr);
    Light lamp;
    lamp.type = Light::Type::Point;
    EXPECT_EQ(resolve_lighting(scene, {lamp}, 0.0f, nullptr, true, *executor).shadow, nullptr);
    EXPECT_EQ(resolve_lighting(Scene{}, {Light{}}, 0.0f, nullptr, true, *executor).shadow, nullptr);
}

/// Seen from above, the shadow of the half-transparent quad is half as dark as that of the opaque one.
TEST(ResolveLighting, LetsLightThroughBlendedAndMaskedCasters) {
    const std::unique_ptr<Executor> executor = make_executor(ExecutorKind::Threads, 2);
    const auto shadowed = [&](const Material& caster) {
        Scene scene;
        scene.textures = {make_texture(2, 1, [](int x, int) { return glm::vec4(1.0f, 1.0f, 1.0f, float(x)); })};
        add_object(scene, make_quad({-4, 0, 4}, {8, 0, 0}, {0, 0, -8}), Material{});
        add_object(scene, make_quad({-1, 1, 1}, {2, 0, 0}, {0, 0, -2}, {4, 1}), caster);
        Light sun;
        sun.direction = {0, -1, 0};
        const Lighting lighting = resolve_lighting(scene, {sun}, 0.0f, nullptr, true, *executor);
        // Mean visibility of the floor under the caster.
        double sum = 0;
        for (int y = 0; y < 100; ++y)
            for (int x = 0; x < 100; ++x)
                sum += double(shadow_visibility(*lighting.shadow, {-0.9f + 0.018f * float(x), 0.0f, -0.9f + 0.018f * float(y)}, {0, 1, 0}));
        return sum / 1e4;
    };
    Material caster;
    EXPECT_NEAR(shadowed(caster), 0.0, 1e-6);
    caster.alpha_mode = AlphaMode::Blend;
    caster.base_color.a = 0.25f;
    EXPECT_NEAR(shadowed(caster), 0.75, 0.01);
    caster = Material{};
    caster.alpha_mode = AlphaMode::Mask;
    caster.maps[kBaseColor].texture = 0;
    caster.maps[kBaseColor].sampler.magnify = caster.maps[kBaseColor].sampler.minify = texunit::Kernel::Nearest;
    caster.maps[kBaseColor].sampler.mip = texunit::MipMode::None;
    EXPECT_NEAR(shadowed(caster), 0.5, 0.02);
}

}  // namespace
}  // namespace rawtexel::shading
