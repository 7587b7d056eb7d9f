// What a frame's lookups ask for, under every fetch model.
#include "shading/render.h"

#include "tests/shading/fetch_scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <memory>
#include <numeric>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace rawtexel::shading {
namespace {

using namespace test;

double sum(const Image& image) { return std::accumulate(image.values.begin(), image.values.end(), 0.0); }

/// Looks the base colour up where it is told, and keeps what it finds.
class Relooker final : public LookupListener {
  public:
    explicit Relooker(int width, int height) : colors(width, height, 3) {}
    void begin_tile(int, int) override {}
    void begin_wave(const ListenedWave& wave) override { wave_ = wave; }
    void fragments(const ListenedFragments& fragments) override { let_through_ = fragments.let_through; }
    void lookup(const ListenedLookup& lookup) override {
        if (lookup.slot != kBaseColor || let_through_) return;
        texunit::WaveColor color;
        sample_wave(*lookup.map->texture, lookup.map->sampler, *lookup.at, lookup.lanes, color);
        for (int lane = 0; lane < texunit::kWaveLanes; ++lane) {
            if ((lookup.lanes >> lane & 1) == 0) continue;
            float* const pixel = colors.pixel(wave_.x + lane % texunit::kWaveWidth, wave_.y + lane / texunit::kWaveWidth);
            for (int c = 0; c < 3; ++c) pixel[c] = color.channel[c][lane];
        }
    }
    void drawn(const ListenedDraw&) override {}
    void end_wave() override {}
    void end_sample() override {}
    void end_tile() override {}
    Image colors;

  private:
    ListenedWave wave_;
    bool let_through_ = false;
};

using PerQuad = std::vector<double>;

TEST_F(StackTest, VisibleAsksForWhatIsSeenAndWhatLetsItThrough) {
    add(0.9f, AlphaMode::Mask, 0.0f);
    add(0.5f, AlphaMode::Opaque);
    add(0.7f, AlphaMode::Mask, 0.0f);
    add(0.2f, AlphaMode::Mask, 0.0f);
    add(0.0f, AlphaMode::Opaque);
    EXPECT_EQ(lookups(FetchModel::Visible), (PerQuad{1, 1, 1, 0, 0}));
}

TEST_F(StackTest, ForwardAsksInSceneOrder) {
    add(0.0f, AlphaMode::Opaque);
    add(0.9f, AlphaMode::Mask, 1.0f);
    add(0.5f, AlphaMode::Opaque);
    add(0.3f, AlphaMode::Opaque);
    add(0.7f, AlphaMode::Mask, 1.0f);
    // Far before near is overdraw; MASK comes after all that is opaque, and what it hides is not asked for.
    EXPECT_EQ(lookups(FetchModel::Forward), (PerQuad{1, 1, 1, 0, 0}));
    EXPECT_EQ(lookups(FetchModel::Visible), (PerQuad{0, 1, 0, 0, 0}));
}

TEST_F(StackTest, BlendedLayersAskUpToTheOneThatIsDrawn) {
    add(0.9f, AlphaMode::Blend, 0.25f);
    add(0.8f, AlphaMode::Blend, 0.5f);
    add(0.0f, AlphaMode::Opaque);
    options_.spp = 64;
    const std::vector<double> found = lookups(FetchModel::Visible);
    // Of 64*64*64 samples, all ask the first, 3/4 the second, 3/8 the last; five standard deviations.
    EXPECT_EQ(found[0], 64.0);
    EXPECT_NEAR(found[1], 48.0, 64 * 5 * std::sqrt(0.25 * 0.75 / (64.0 * 64 * 64)));
    EXPECT_NEAR(found[2], 24.0, 64 * 5 * std::sqrt(0.375 * 0.625 / (64.0 * 64 * 64)));
}

/// Where base colours are looked up: u and v by pixel.
class BaseColorPlaces final : public LookupListener {
  public:
    void begin_tile(int, int) override {}
    void begin_wave(const ListenedWave& wave) override { wave_ = wave; }
    void fragments(const ListenedFragments&) override {}
    void lookup(const ListenedLookup& lookup) override {
        for (int lane = 0; lane < texunit::kWaveLanes; ++lane) {
            if (lookup.slot != kBaseColor || (lookup.lanes >> lane & 1) == 0) continue;
            places[{wave_.x + lane % texunit::kWaveWidth, wave_.y + lane / texunit::kWaveWidth}] = {lookup.at->u[lane], lookup.at->v[lane]};
        }
    }
    void drawn(const ListenedDraw&) override {}
    void end_wave() override {}
    void end_sample() override {}
    void end_tile() override {}
    std::map<std::pair<int, int>, glm::vec2> places;

  private:
    ListenedWave wave_;
};

TEST_F(StackTest, QuadsAskForTheirHelpersToo) {
    scene_.textures.push_back(make_noise_texture(64, 64, 1));
    Material material = unlit(glm::vec4(1.0f));
    material.maps[kBaseColor].texture = 0;
    const Mesh whole = make_quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
    const auto places_of = [&](const Scene& scene) {
        BaseColorPlaces listener;
        RenderOptions options = options_;
        options.fetches = {};
        options.fetches.model = options_.fetches.model;
        options.listener = &listener;
        render(scene, Lighting{}, options, *executor_);
        return listener.places;
    };
    Scene full = scene_;
    add_object(full, whole, material);
    options_.fetches.model = FetchModel::Forward;
    const auto everywhere = places_of(full);
    EXPECT_EQ(everywhere.size(), size_t{64 * 64});
    // One triangle over half of the frame, then the other: their diagonal cuts quads in two.
    std::set<bool> cuts;
    for (const size_t first : {size_t{0}, size_t{3}}) {
        Mesh half = whole;
        half.indices.assign(whole.indices.begin() + ptrdiff_t(first), whole.indices.begin() + ptrdiff_t(first) + 3);
        Scene scene = scene_;
        add_object(scene, half, material);
        options_.fetches.model = FetchModel::Forward;
        const RenderResult forward = render(scene, Lighting{}, options_, *executor_);
        options_.fetches.model = FetchModel::Quad;
        const RenderResult quad = render(scene, Lighting{}, options_, *executor_);
        EXPECT_EQ(forward.fetches->counts[0].lookups, forward.samples_shaded);
        const uint64_t covered = forward.samples_shaded;
        // 32 quads lie on the diagonal, each with one or three lanes of four; the top-left rule gives the centres on it to one side.
        const uint64_t expected = covered % 64 == 32 ? covered + 32 * (covered < 2048 ? 3 : 1) : 0;
        EXPECT_EQ(quad.fetches->counts[0].lookups, expected) << covered;
        cuts.insert(covered < 2048);
        // Beyond the edge coordinates go on as the plane does.
        const auto places = places_of(scene);
        EXPECT_EQ(places.size(), expected);
        for (const auto& [pixel, uv] : places) {
            const glm::vec2 plane = everywhere.at(pixel);
            EXPECT_NEAR(uv.x, plane.x, 1e-5) << pixel.first << ',' << pixel.second;
            EXPECT_NEAR(uv.y, plane.y, 1e-5) << pixel.first << ',' << pixel.second;
        }
    }
    EXPECT_EQ(cuts.size(), 2u) << "one lane of four, and three";
}

TEST_F(StackTest, WhatIsDiscardedAsksForItsBaseColourAlone) {
    for (const float alpha : {0.0f, 1.0f}) {
        Scene scene;
        scene.textures.push_back(make_texture(8, 8, [alpha](int, int) { return glm::vec4(0.5f, 0.5f, 0.5f, alpha); }));
        scene.textures.push_back(make_noise_texture(8, 8, 2));
        Material material;
        material.alpha_mode = AlphaMode::Mask;
        material.maps[kBaseColor].texture = 0;
        material.maps[kMetallicRoughness].texture = 1;
        add_object(scene, make_quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}), material);
        for (const FetchModel model : {FetchModel::Visible, FetchModel::Forward}) {
            options_.fetches.model = model;
            const RenderResult result = render(scene, Lighting{}, options_, *executor_);
            EXPECT_EQ(result.fetches->counts[0].lookups, 64u * 64) << to_string(model);
            EXPECT_EQ(result.fetches->counts[1].lookups, alpha > 0 ? 64u * 64 : 0u) << to_string(model);
        }
    }
}

TEST_F(StackTest, WhatIsDiscardedBehindTheSurfaceIsNotVisible) {
    // The first in the scene is looked at first, and hidden by what comes after it.
    add(0.5f, AlphaMode::Mask, 0.0f);
    add(0.9f, AlphaMode::Mask, 1.0f);
    EXPECT_EQ(lookups(FetchModel::Visible), (PerQuad{0, 1}));
    EXPECT_EQ(lookups(FetchModel::Forward), (PerQuad{1, 1}));
}

TEST_F(StackTest, CountsOfAFullFrameQuadAreAnalytic) {
    // 64 pixels over 24.3 texels, at no texel's centre; then 64 pixels over 150 texels: lambda = 1.23.
    scene_.textures.push_back(make_noise_texture(256, 256, 1));
    Material material = unlit(glm::vec4(1.0f));
    material.maps[kBaseColor].texture = 0;
    for (const auto& [texels, levels] : {std::pair{24.3f, 1}, {150.0f, 2}}) {
        Scene scene = scene_;
        add_object(scene, make_quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, glm::vec2(texels / 256)), material);
        for (const auto& [kernel, taps] : {std::pair{texunit::Kernel::Nearest, 1},
                                           {texunit::Kernel::Bilinear, 4},
                                           {texunit::Kernel::Quadratic, 9},
                                           {texunit::Kernel::BSpline, 16},
                                           {texunit::Kernel::mitchell(), 16},
                                           {texunit::Kernel::CatmullRom, 16},
                                           {texunit::Kernel::Lanczos2, 16},
                                           {texunit::Kernel::Lanczos3, 36}}) {
            options_.filter = kernel;
            options_.mip = texunit::MipMode::Linear;
            const RenderResult result = render(scene, Lighting{}, options_, *executor_);
            const texunit::FetchCounts& counts = result.fetches->counts[0];
            EXPECT_EQ(counts.lookups, uint64_t(64 * 64));
            EXPECT_EQ(counts.taps, uint64_t(64 * 64 * taps * levels)) << to_string(kernel) << ' ' << texels;
            EXPECT_EQ(counts.texels_requested, counts.taps);
        }
    }
}

/// So what is counted is what the frame looks up: its coordinates to the last bit.
TEST_F(FetchesTest, ComeFromTheCoordinatesThatTheFrameLooksUp) {
    Scene scene = make_busy_scene();
    for (Material& material : scene.materials) {
        material.unlit = true;
        material.base_color = glm::vec4(1.0f, 1.0f, 1.0f, material.base_color.a);
    }
    for (Mesh& mesh : scene.meshes) mesh.colors.clear();
    const std::pair<PixelJitter, TextureJitter> jitters[] = {{PixelJitter::Frame, TextureJitter::None},
                                                             {PixelJitter::Pixel, TextureJitter::None},
                                                             {PixelJitter::Frame, TextureJitter::Perspective},
                                                             {PixelJitter::Pixel, TextureJitter::Affine}};
    for (const auto& [jitter, texture_jitter] : jitters) {
        RenderOptions options = busy_options();
        options.fetches = {};
        options.spp = 1;
        options.pixel_jitter = jitter;
        options.filtering.texture_jitter = texture_jitter;
        options.background = glm::vec3(0.0f);
        Relooker listener(options.width, options.height);
        options.listener = &listener;
        const std::unique_ptr<Executor> executor = make_executor(ExecutorKind::Threads, 1);
        const RenderResult result = render(scene, Lighting{}, options, *executor);
        int seen = 0;
        for (int y = 0; y < options.height; ++y) {
            for (int x = 0; x < options.width; ++x) {
                const float* const looked_up = listener.colors.pixel(x, y);
                if (looked_up[0] == 0 && looked_up[1] == 0 && looked_up[2] == 0) continue;  // no texture, or nothing seen
                ++seen;
                for (int c = 0; c < 3; ++c) ASSERT_EQ(looked_up[c], result.radiance.pixel(x, y)[c]) << x << ',' << y;
            }
        }
        EXPECT_GT(seen, options.width * options.height / 8);
    }
}

TEST_F(FetchesTest, OfASceneWithoutTexturesAreNone) {
    scene_ = Scene{};
    add_object(scene_, make_quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}), unlit(glm::vec4(1.0f)));
    RenderOptions options = busy_options();
    options.camera = square_camera();
    options.fetches.pixel_layers = true;
    options.fetches.cache = texunit::CacheSpec{};
    options.fetches.cache->cores = 256;
    const RenderResult result = render_with(options, ExecutorKind::Threads, 2);
    EXPECT_EQ(result.fetches->total(), texunit::FetchCounts{});
    EXPECT_TRUE(result.fetches->measure().empty());
    EXPECT_EQ(sum(result.fetches->pixel(PixelCount::Samples)), double(result.samples_shaded));
}

TEST_F(FetchesTest, AreTheSameForAnyThreadsAndTileSize) {
    for (const FetchModel model : {FetchModel::Visible, FetchModel::Forward, FetchModel::Quad}) {
        RenderOptions options = busy_options();
        options.fetches.model = model;
        const RenderResult expected = render_with(options);
        ASSERT_GT(expected.fetches->total().texels_requested, 0u);
        for (const int tile_size : {32, 128}) {
            options.tile_size = tile_size;
            for (const ExecutorKind kind : executor_kinds()) {
                const RenderResult other = render_with(options, kind, 3);
                EXPECT_EQ(other.fetches->counts, expected.fetches->counts) << to_string(model) << ' ' << tile_size;
                EXPECT_EQ(other.fetches->measure(), expected.fetches->measure()) << to_string(model) << ' ' << tile_size;
            }
        }
    }
}

TEST_F(StackTest, CountsOfGaussiansFollowFromTheirPhases) {
    constexpr double kTexels = 24.3;
    scene_.textures.push_back(make_noise_texture(256, 256, 1));
    Material material = unlit(glm::vec4(1.0f));
    material.maps[kBaseColor].texture = 0;
    add_object(scene_, make_quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, glm::vec2(float(kTexels) / 256)), material);
    const auto taps = [&](const texunit::Kernel& kernel) {
        options_.filter = kernel;
        return render(scene_, Lighting{}, options_, *executor_).fetches->counts[0].taps;
    };
    // The one reaches every texel that [x - 4 sigma, x + 4 sigma] touches, the other every centre in it.
    uint64_t touched = 0, centres = 0;
    for (int i = 0; i < 64; ++i) {
        const double x = (i + 0.5) / 64 * kTexels, wide = 4 * 0.5, narrow = 4 * double(0.7f);
        touched += uint64_t(std::ceil(x + wide) - std::floor(x - wide));
        centres += uint64_t(std::floor(x + narrow - 0.5) - std::ceil(x - narrow - 0.5) + 1);
    }
    EXPECT_EQ(taps(texunit::Kernel::gaussian(0.5f)), touched * touched);
    EXPECT_EQ(taps(texunit::Kernel::gaussian_point(0.7f)), centres * centres);
}

TEST_F(FetchesTest, OfACropAreThoseOfThatPart) {
    for (const FetchModel model : {FetchModel::Visible, FetchModel::Forward, FetchModel::Quad}) {
        RenderOptions options = busy_options();
        options.fetches.model = model;
        options.fetches.pixel_layers = true;
        options.crop = {};
        const RenderResult whole = render_with(options);
        for (const Crop& crop : {Crop{5, 3, 51, 47}, Crop{63, 31, 2, 3}, Crop{164, 100, 1, 1}}) {
            options.crop = crop;
            const RenderResult part = render_with(options);
            for (const PixelCount count : {PixelCount::TexelsRequested, PixelCount::LinesPixel, PixelCount::Level, PixelCount::Samples}) {
                for (int y = 0; y < crop.height; ++y) {
                    for (int x = 0; x < crop.width; ++x)
                        ASSERT_EQ(*part.fetches->pixel(count).pixel(x, y), *whole.fetches->pixel(count).pixel(crop.x + x, crop.y + y))
                            << to_string(model) << ' ' << to_string(count) << ' ' << x << ',' << y;
                }
            }
        }
    }
}

TEST_F(FetchesTest, GrowFromVisibleToForwardToQuads) {
    RenderOptions options = busy_options();
    std::vector<uint64_t> lookups;
    for (const FetchModel model : {FetchModel::Visible, FetchModel::Forward, FetchModel::Quad}) {
        options.fetches.model = model;
        lookups.push_back(render_with(options).fetches->total().lookups);
    }
    EXPECT_LT(lookups[0], lookups[1]);
    EXPECT_LT(lookups[1], lookups[2]);
}

TEST_F(FetchesTest, SumOverPixelsToTheCounters) {
    for (const FetchModel model : {FetchModel::Visible, FetchModel::Forward, FetchModel::Quad}) {
        RenderOptions options = busy_options();
        options.fetches.model = model;
        options.fetches.pixel_layers = true;
        std::string error;
        options.fetches.cache = texunit::parse_cache_spec("l1=4K:4,l2=32K:8,cores=2", error);
        const RenderResult result = render_with(options);
        const FrameFetches& fetches = *result.fetches;
        texunit::TouchedLines touched;
        for (const auto& levels : fetches.measure())
            for (const texunit::TouchedLines& level : levels) touched += level;
        texunit::CacheCounts cache;
        for (const auto& levels : fetches.cache)
            for (const texunit::CacheCounts& level : levels) cache += level;
        EXPECT_EQ(sum(fetches.pixel(PixelCount::TexelsRequested)), double(fetches.total().texels_requested)) << to_string(model);
        EXPECT_EQ(sum(fetches.pixel(PixelCount::LinesFirst)), double(touched.decoded.of_64()));
        EXPECT_EQ(sum(fetches.pixel(PixelCount::BlocksFirst)), double(touched.blocks_touched));
        EXPECT_EQ(sum(fetches.pixel(PixelCount::L1Miss)), double(cache.l1_misses));
        EXPECT_EQ(sum(fetches.pixel(PixelCount::L2Miss)), double(cache.l2_misses));
        EXPECT_EQ(sum(fetches.pixel(PixelCount::Samples)), double(result.samples_shaded));
        EXPECT_GE(sum(fetches.pixel(PixelCount::LinesPixel)), double(touched.decoded.of_64()));
        EXPECT_EQ(cache.l1_hits + cache.l1_misses, fetches.total().texels_requested);
        EXPECT_EQ(cache.l2_hits + cache.l2_misses, cache.l1_misses);
        EXPECT_EQ(cache.compulsory + cache.capacity + cache.conflict, cache.l1_misses);
        for (const float anisotropy : fetches.pixel(PixelCount::Anisotropy).values) EXPECT_TRUE(anisotropy == 0 || anisotropy >= 1);
    }
}

TEST_F(FetchesTest, OrderedAccountsDoNotDependOnThreadsOrTileSize) {
    RenderOptions options = busy_options();
    options.fetches.pixel_layers = true;
    options.fetches.cache = texunit::CacheSpec{};
    options.fetches.cache->l1 = {1024, 2};
    options.fetches.cache->cores = 3;
    const RenderResult expected = render_with(options);
    for (const int tile_size : {32, 128}) {
        options.tile_size = tile_size;
        for (const ExecutorKind kind : executor_kinds()) {
            const RenderResult other = render_with(options, kind, 3);
            EXPECT_EQ(other.fetches->cache, expected.fetches->cache) << tile_size;
            for (int i = 0; i < kPixelCounts; ++i) {
                EXPECT_EQ(other.fetches->pixels[size_t(i)].values, expected.fetches->pixels[size_t(i)].values) << to_string(PixelCount(i));
            }
            EXPECT_EQ(other.radiance.values, expected.radiance.values);
        }
    }
}

}  // namespace
}  // namespace rawtexel::shading
