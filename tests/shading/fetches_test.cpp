// What a frame's lookups ask for, under every fetch model.
#include "shading/fetch_account.h"
#include "shading/render.h"
#include "texunit/fetch_trace.h"

#include "tests/shading/executor_kinds.h"
#include "tests/shading/scene_parts.h"

#include <gtest/gtest.h>
#include <zstd.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <memory>
#include <numeric>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <tuple>
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

class FetchesTest : public testing::Test {
  protected:
    RenderResult render_with(const RenderOptions& options, ExecutorKind kind = ExecutorKind::Threads, int threads = 1) const {
        const std::unique_ptr<Executor> executor = make_executor(kind, threads);
        return render(scene_, lighting_, options, *executor);
    }
    static RenderOptions busy_options() {
        RenderOptions options;
        options.width = 165;
        options.height = 101;
        options.camera = busy_camera();
        options.spp = 2;
        options.fetches.count = true;
        return options;
    }

    std::unique_ptr<Executor> one_ = make_executor(ExecutorKind::Threads, 1);
    Scene scene_ = make_busy_scene();
    Lighting lighting_ = busy_lighting(scene_, *one_);
};

/// A stack of full-frame quads, the first the nearest, of 64x64 pixels.
class StackTest : public testing::Test {
  protected:
    StackTest() {
        options_.width = options_.height = 64;
        options_.camera = square_camera();
        options_.fetches.count = true;
    }
    /// Adds a quad at height z with a texture whose alpha is everywhere `alpha`.
    void add(float z, AlphaMode mode, float alpha = 1.0f) {
        scene_.textures.push_back(make_texture(8, 8, [alpha](int, int) { return glm::vec4(0.5f, 0.5f, 0.5f, alpha); }));
        Material material = unlit(glm::vec4(1.0f), mode);
        material.maps[kBaseColor].texture = int(scene_.textures.size()) - 1;
        add_object(scene_, make_quad({-1, -1, z}, {2, 0, 0}, {0, 2, 0}), material);
    }
    /// Lookups per pixel of every quad.
    std::vector<double> lookups(FetchModel model) {
        options_.fetches.model = model;
        const RenderResult result = render(scene_, Lighting{}, options_, *executor_);
        std::vector<double> per_pixel;
        for (const texunit::FetchCounts& counts : result.fetches->counts) per_pixel.push_back(double(counts.lookups) / (64 * 64));
        return per_pixel;
    }

    std::unique_ptr<Executor> executor_ = make_executor(ExecutorKind::Threads, 1);
    Scene scene_;
    RenderOptions options_;
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
    for (const PixelJitter jitter : {PixelJitter::Frame, PixelJitter::Pixel}) {
        RenderOptions options = busy_options();
        options.fetches = {};
        options.spp = 1;
        options.pixel_jitter = jitter;
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

std::vector<std::byte> decompress(const std::vector<std::byte>& compressed) {
    std::vector<std::byte> plain(size_t{256} << 20);
    const size_t size = ZSTD_decompress(plain.data(), plain.size(), compressed.data(), compressed.size());
    EXPECT_FALSE(ZSTD_isError(size)) << ZSTD_getErrorName(size);
    plain.resize(ZSTD_isError(size) ? 0 : size);
    return plain;
}

/// A trace read back: its textures' names, and its records.
struct ReadTrace {
    std::vector<std::string> names;
    std::vector<texunit::TraceRecord> records;
};
ReadTrace read_trace(const std::vector<std::byte>& file) {
    const std::vector<std::byte> plain = decompress(file);
    ReadTrace trace;
    if (plain.size() < 12 || std::memcmp(plain.data(), texunit::kTraceMagic.data(), 8) != 0) {
        ADD_FAILURE() << "no trace";
        return trace;
    }
    const std::byte* at = plain.data() + 8;
    const auto number = [&] {
        uint32_t value;
        std::memcpy(&value, at, 4);
        at += 4;
        return value;
    };
    const uint32_t names = number();
    for (uint32_t i = 0; i < names; ++i) {
        const uint32_t size = number();
        trace.names.emplace_back(reinterpret_cast<const char*>(at), size);
        at += size;
    }
    const auto bytes = size_t(plain.data() + plain.size() - at);
    EXPECT_EQ(bytes % sizeof(texunit::TraceRecord), 0u);
    trace.records.resize(bytes / sizeof(texunit::TraceRecord));
    std::memcpy(trace.records.data(), at, trace.records.size() * sizeof(texunit::TraceRecord));
    return trace;
}

/// Tile, sample, wave by the Morton code of its place in the tile, lane.
using CanonicalPlace = std::tuple<int, uint32_t, int, int>;
CanonicalPlace canonical_place(const texunit::TraceRecord& record, int tiles_x) {
    const int x = record.pixel_x % 64, y = record.pixel_y % 64;
    int code = 0;
    for (int bit = 0; bit < 4; ++bit) code |= (x / 8 >> bit & 1) << (2 * bit) | (y / 4 >> bit & 1) << (2 * bit + 1);
    // The column has three bits, the row four: the row's last stands where the column's would.
    if (code >= 128) code -= 64;
    return {record.pixel_y / 64 * tiles_x + record.pixel_x / 64, record.sample, code, y % 4 * 8 + x % 8};
}

TEST_F(FetchesTest, AreTracedOneByOneInCanonicalOrder) {
    RenderOptions options = busy_options();
    std::vector<std::byte> first;
    for (const int threads : {1, 3}) {
        std::vector<std::byte> file;
        texunit::FetchTraceWriter writer([&](std::span<const std::byte> bytes) { file.insert(file.end(), bytes.begin(), bytes.end()); });
        options.fetches.trace = &writer;
        const RenderResult result = render_with(options, ExecutorKind::Threads, threads);
        writer.end();
        if (threads > 1) {
            EXPECT_TRUE(file == first);
            continue;
        }
        first = file;
        const ReadTrace trace = read_trace(file);
        ASSERT_EQ(trace.names.size(), result.fetches->textures.size());
        for (size_t i = 0; i < trace.names.size(); ++i) EXPECT_EQ(trace.names[i], result.fetches->textures[i]->name());
        ASSERT_EQ(trace.records.size(), result.fetches->total().texels_requested);
        std::set<uint64_t> lines;
        CanonicalPlace before{};
        for (const texunit::TraceRecord& record : trace.records) {
            const CanonicalPlace place = canonical_place(record, 3);
            ASSERT_LE(before, place) << "pixel " << record.pixel_x << ',' << record.pixel_y;
            before = place;
            ASSERT_LT(record.x, result.fetches->textures[record.texture]->levels().width[record.level]);
            ASSERT_LT(record.y, result.fetches->textures[record.texture]->levels().height[record.level]);
            lines.insert(record.decoded / 64);
        }
        texunit::TouchedLines touched;
        for (const auto& levels : result.fetches->measure())
            for (const texunit::TouchedLines& level : levels) touched += level;
        EXPECT_EQ(lines.size(), touched.decoded.of_64());
    }
}

/// A cache as lists of lines, the most recent first.
class ListedCache {
  public:
    ListedCache(uint64_t bytes, int ways, int line_bytes)
        : line_bytes_(uint64_t(line_bytes)), ways_(size_t(ways)), sets_(bytes / (line_bytes_ * ways_)) {}
    bool access(uint64_t address) {
        const uint64_t line = address / line_bytes_;
        std::vector<uint64_t>& set = sets_[line % sets_.size()];
        const auto found = std::find(set.begin(), set.end(), line);
        const bool hit = found != set.end();
        if (hit) set.erase(found);
        set.insert(set.begin(), line);
        if (set.size() > ways_) set.pop_back();
        return hit;
    }

  private:
    uint64_t line_bytes_;
    size_t ways_;
    std::vector<std::vector<uint64_t>> sets_;
};

/// What somebody finds who replays the stream with nothing but the page that describes it. In the crop the frame's second tile is the
/// first.
TEST_F(FetchesTest, TraceReplayedGivesTheCounters) {
    for (const Crop& crop : {Crop{}, Crop{70, 9, 90, 80}}) {
        RenderOptions options = busy_options();
        options.crop = crop;
        options.fetches.pixel_layers = true;
        texunit::CacheSpec spec;
        spec.l1 = {2048, 2}, spec.l2 = {8192, 4};
        spec.line_bytes = 32;
        spec.cores = 3;
        options.fetches.cache = spec;
        std::vector<std::byte> file;
        texunit::FetchTraceWriter writer([&](std::span<const std::byte> bytes) { file.insert(file.end(), bytes.begin(), bytes.end()); });
        options.fetches.trace = &writer;
        const RenderResult result = render_with(options, ExecutorKind::Threads, 3);
        writer.end();
        const FrameFetches& fetches = *result.fetches;
        const ReadTrace trace = read_trace(file);

        struct Level {
            std::set<std::tuple<int, int, int>> texels, blocks;
            std::set<uint64_t> lines, stored;
            texunit::CacheCounts cache;
        };
        std::map<std::pair<uint32_t, int>, Level> levels;
        std::set<uint64_t> lines, blocks;
        struct Core {
            ListedCache l1, fully;
            std::set<uint64_t> seen;
        };
        std::vector<Core> cores(3, {{2048, 2, 32}, {2048, 2048 / 32, 32}, {}});
        ListedCache l2(8192, 4, 32);
        const Image& whole = fetches.pixel(PixelCount::TexelsRequested);
        const auto layer = [&] { return std::vector<float>(whole.values.size()); };
        std::vector<float> requested = layer(), lines_first = layer(), blocks_first = layer(), l1_miss = layer(), l2_miss = layer();
        for (const texunit::TraceRecord& record : trace.records) {
            const size_t pixel = size_t(record.pixel_y - crop.y) * size_t(whole.width) + size_t(record.pixel_x - crop.x);
            Level& level = levels[{record.texture, record.level}];
            level.texels.insert({record.x, record.y, record.z});
            level.blocks.insert({record.x / 4, record.y / 4, record.z});
            level.lines.insert(record.decoded / 64), level.stored.insert(record.stored / 64);
            ++requested[pixel];
            lines_first[pixel] += lines.insert(record.decoded / 64).second;
            blocks_first[pixel] += blocks.insert(record.decoded / (16u * record.bytes_decoded) * (16u * record.bytes_decoded)).second;
            Core& core = cores[size_t(record.pixel_y / 64 * 3 + record.pixel_x / 64) % 3];
            const bool in_l1 = core.l1.access(record.decoded), in_fully = core.fully.access(record.decoded);
            const bool is_new = core.seen.insert(record.decoded / 32).second;
            texunit::CacheCounts& cache = level.cache;
            cache.l1_hits += in_l1;
            if (in_l1) continue;
            ++cache.l1_misses;
            ++(is_new ? cache.compulsory : in_fully ? cache.conflict : cache.capacity);
            ++l1_miss[pixel];
            const bool in_l2 = l2.access(record.stored);
            ++(in_l2 ? cache.l2_hits : cache.l2_misses);
            l2_miss[pixel] += !in_l2;
        }
        EXPECT_EQ(fetches.pixel(PixelCount::TexelsRequested).values, requested);
        EXPECT_EQ(fetches.pixel(PixelCount::LinesFirst).values, lines_first);
        EXPECT_EQ(fetches.pixel(PixelCount::BlocksFirst).values, blocks_first);
        EXPECT_EQ(fetches.pixel(PixelCount::L1Miss).values, l1_miss);
        EXPECT_EQ(fetches.pixel(PixelCount::L2Miss).values, l2_miss);
        const auto touched = fetches.measure();
        texunit::CacheCounts all;
        for (size_t t = 0; t < touched.size(); ++t) {
            for (size_t l = 0; l < touched[t].size(); ++l) {
                const Level& level = levels[{uint32_t(t), int(l)}];
                EXPECT_EQ(touched[t][l].texels_unique, level.texels.size()) << t << ' ' << l;
                EXPECT_EQ(touched[t][l].blocks_touched, level.blocks.size()) << t << ' ' << l;
                EXPECT_EQ(touched[t][l].decoded.of_64(), level.lines.size()) << t << ' ' << l;
                EXPECT_EQ(fetches.cache[t][l], level.cache) << t << ' ' << l;
                all += level.cache;
            }
        }
        // All kinds of misses are among them.
        EXPECT_GT(std::min({all.l1_hits, all.compulsory, all.capacity, all.conflict, all.l2_hits, all.l2_misses}), 100u);
    }
}

/// Taps that take the border colour read nothing.
TEST_F(StackTest, BordersAreNeitherCountedNorTraced) {
    scene_.textures.push_back(make_noise_texture(8, 8, 1));
    Material material = unlit(glm::vec4(1.0f));
    TextureMap& map = material.maps[kBaseColor];
    map.texture = 0;
    map.sampler.wrap_s = map.sampler.wrap_t = texunit::Wrap::ClampToBorder;
    map.sampler.mip = texunit::MipMode::None;
    map.sampler.magnify = map.sampler.minify = texunit::Kernel::Nearest;
    add_object(scene_, make_quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, glm::vec2(2.0f)), material);
    std::vector<std::byte> file;
    texunit::FetchTraceWriter writer([&](std::span<const std::byte> bytes) { file.insert(file.end(), bytes.begin(), bytes.end()); });
    options_.fetches.trace = &writer;
    const RenderResult result = render(scene_, Lighting{}, options_, *executor_);
    writer.end();
    EXPECT_EQ(result.fetches->total().lookups, 64u * 64);
    EXPECT_EQ(result.fetches->total().texels_requested, 32u * 32);
    EXPECT_EQ(read_trace(file).records.size(), 32u * 32);
}

/// One material with every map, its textures in another order than its maps.
TEST_F(StackTest, FragmentsAskMapByMapAndTapByTap) {
    for (uint32_t seed = 0; seed < kMapSlots; ++seed) scene_.textures.push_back(make_noise_texture(64, 64, seed));
    Material material;
    material.emission = glm::vec3(1.0f);
    const std::vector<uint32_t> textures = {3, 0, 4, 1, 2};
    static constexpr MapSlot kOrder[] = {kBaseColor, kMetallicRoughness, kNormal, kOcclusion, kEmissive};
    for (size_t i = 0; i < textures.size(); ++i) {
        TextureMap& map = material.maps[size_t(kOrder[i])];
        map.texture = int(textures[i]);
        map.sampler.probes = 4;
    }
    // 64 pixels over 150 texels of u and 600 of v: two levels, and probes along v.
    add_object(scene_, make_quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, glm::vec2(150.0f / 64, 600.0f / 64)), material);
    std::vector<std::byte> file;
    texunit::FetchTraceWriter writer([&](std::span<const std::byte> bytes) { file.insert(file.end(), bytes.begin(), bytes.end()); });
    options_.fetches.trace = &writer;
    Lighting lighting;
    lighting.ambient = 1.0f;
    const RenderResult result = render(scene_, lighting, options_, *executor_);
    writer.end();
    const ReadTrace trace = read_trace(file);
    ASSERT_EQ(trace.records.size(), result.fetches->total().texels_requested);
    std::vector<uint32_t> order;
    std::map<int, int> levels;
    const texunit::TraceRecord* before = nullptr;
    int rows_back = 0;
    for (const texunit::TraceRecord& record : trace.records) {
        if (record.pixel_x != 20 || record.pixel_y != 30) continue;
        const bool same_map = before != nullptr && before->texture == record.texture;
        if (!same_map) order.push_back(record.texture);
        if (record.texture == textures[0]) ++levels[record.level];
        if (same_map && before->level == record.level) {
            // A row goes on, a row begins, or the next probe does.
            const bool goes_on = record.y == before->y && record.x == (before->x + 1) % (64 >> record.level);
            rows_back += !goes_on && record.y != (before->y + 1) % (64 >> record.level);
        }
        before = &record;
    }
    EXPECT_EQ(order, textures);
    EXPECT_EQ(levels.size(), 2u) << "levels of one lookup";
    EXPECT_LE(rows_back, 5 * 2 * 4);
}

TEST(FetchSequencer, HandsOnInTheOrderOfTilesWhoeverComesFirst) {
    constexpr int kTiles = 40, kStreams = 5;
    std::vector<std::pair<int64_t, uint32_t>> seen;
    FetchSequencer sequencer([&](int64_t tile, const texunit::FetchStream& stream) { seen.emplace_back(tile, stream.pixels[0].sample); });
    const auto work = [&] {
        for (int64_t tile; (tile = sequencer.next_tile()) < kTiles;) {
            for (uint32_t n = 0; n < kStreams; ++n) {
                texunit::FetchStream stream;
                // Some tiles hand in more than may wait.
                stream.pixels.assign(tile % 7 == 3 ? size_t{3} << 20 : 1, {0, 0, n, 0});
                if (tile % 3 == 0) std::this_thread::yield();
                sequencer.hand_in(tile, stream);
                EXPECT_TRUE(stream.empty());
            }
            sequencer.finish(tile);
        }
    };
    std::vector<std::thread> threads;
    for (int i = 0; i < 4; ++i) threads.emplace_back(work);
    for (std::thread& thread : threads) thread.join();
    ASSERT_EQ(seen.size(), size_t(kTiles * kStreams));
    for (size_t i = 0; i < seen.size(); ++i) {
        EXPECT_EQ(seen[i].first, int64_t(i) / kStreams);
        EXPECT_EQ(seen[i].second, i % kStreams);
    }
}

TEST(FetchSequencer, PassesOnWhatTheConsumerThrowsWhileOthersWait) {
    // A full disk, say, at the last stream of the tile that is due.
    FetchSequencer sequencer([](int64_t tile, const texunit::FetchStream&) {
        if (tile == 1) throw std::runtime_error("full");
    });
    const int64_t due = sequencer.next_tile(), next = sequencer.next_tile(), last = sequencer.next_tile();
    texunit::FetchStream stream;
    stream.pixels.assign(1, {});
    sequencer.hand_in(next, stream);
    std::thread waiter([&] {
        texunit::FetchStream large;
        large.pixels.assign(size_t{32} << 20, {});
        sequencer.hand_in(last, large);
    });
    try {
        sequencer.finish(due);
        ADD_FAILURE() << "nothing thrown";
    } catch (const std::runtime_error&) {
        sequencer.abandon();
    }
    waiter.join();
}

TEST(FetchSequencer, LetsEveryoneGoWhenATileFails) {
    FetchSequencer sequencer([](int64_t, const texunit::FetchStream&) {});
    const int64_t failing = sequencer.next_tile(), waiting = sequencer.next_tile();
    std::thread waiter([&] {
        for (int n = 0; n < 3; ++n) {
            texunit::FetchStream stream;
            stream.pixels.assign(size_t{6} << 20, {});
            sequencer.hand_in(waiting, stream);
        }
        sequencer.finish(waiting);
    });
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    EXPECT_EQ(failing, 0);
    sequencer.abandon();
    waiter.join();
}

}  // namespace
}  // namespace rawtexel::shading
