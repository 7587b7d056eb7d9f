// Generated textures: repeatable, seamless, and one relief behind all the maps.
#include "scenes/procedural_noise.h"
#include "scenes/procedural_surface.h"

#include "texunit/texture.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <thread>
#include <vector>

namespace rawtexel::scenes {
namespace {

using Block = std::array<uint8_t, 64>;

Block decode(texunit::TexelSource& source, int x, int y) {
    Block block;
    source.decode_block(0, 0, x, y, reinterpret_cast<std::byte*>(block.data()));
    return block;
}

glm::vec3 normal_of(const std::array<float, 4>& texel) { return glm::vec3(texel[0], texel[1], texel[2]) * 2.0f - 1.0f; }

TEST(Noise, RepeatsAndStaysInRange) {
    const glm::ivec2 period(5, 3);
    for (int i = 0; i < 4000; ++i) {
        const glm::vec2 p(float(i % 61) * 0.125f - 2.0f, float(i / 61) * 0.0625f - 1.5f);
        const glm::vec2 next = p + glm::vec2(period);
        EXPECT_EQ(value_noise(p, period, 7), value_noise(next, period, 7)) << p.x << ' ' << p.y;
        EXPECT_EQ(gradient_noise(p, period, 7), gradient_noise(next, period, 7)) << p.x << ' ' << p.y;
        EXPECT_EQ(cells(p, period, 0.8f, 7).id, cells(next, period, 0.8f, 7).id) << p.x << ' ' << p.y;
        EXPECT_LE(std::abs(gradient_noise(p, period, 7)), 1.0f);
        EXPECT_LE(std::abs(fractal_noise(p, period, 4, 7)), 1.0f);
        const float value = value_noise(p, period, 7);
        EXPECT_TRUE(value >= 0.0f && value < 1.0f) << value;
    }
}

TEST(Noise, IsContinuousAcrossTheLattice) {
    const glm::ivec2 period(8);
    for (int i = 0; i < 200; ++i) {
        const float y = float(i) * 0.04f, step = 1e-4f;
        for (const float x : {0.0f, 3.0f, 8.0f}) {
            EXPECT_NEAR(value_noise({x - step, y}, period, 3), value_noise({x + step, y}, period, 3), 1e-3f);
            EXPECT_NEAR(gradient_noise({x - step, y}, period, 3), gradient_noise({x + step, y}, period, 3), 1e-3f);
        }
    }
}

TEST(Noise, CellEdgesAreWhereTheIdChanges) {
    const glm::ivec2 period(6);
    float smallest_jump = 1.0f;
    for (int row = 0; row < 40; ++row) {
        CellPoint before = cells({0.0f, float(row) * 0.15f}, period, 0.7f, 5);
        for (int i = 1; i < 3000; ++i) {
            const CellPoint here = cells({float(i) * 0.002f, float(row) * 0.15f}, period, 0.7f, 5);
            EXPECT_GE(here.edge, 0.0f);
            // Between two samples 0.002 apart the border is no farther than that from either.
            if (here.id != before.id)
                EXPECT_LT(std::max(here.edge, before.edge), 0.0021f);
            else
                smallest_jump = std::min(smallest_jump, here.edge);
            before = here;
        }
    }
    EXPECT_LT(smallest_jump, 0.01f) << "borders were met";
}

TEST(Surface, NormalsAreThoseOfTheRelief) {
    // A plane that rises 3 in 10 to the right and 4 in 10 downwards, metres over metres, on texels that are not square.
    constexpr int kWidth = 96, kHeight = 40;
    SurfaceMaps maps = make_surface_maps({kWidth, kHeight, {2.0f, 5.0f}, [](glm::vec2 p) {
                                              SurfacePoint point;
                                              point.height = 0.3f * 2.0f * p.x + 0.4f * 5.0f * p.y;
                                              return point;
                                          }});
    texunit::Texture normals("normals", std::move(maps.normal));
    const glm::vec3 expected = glm::normalize(glm::vec3(-0.3f, 0.4f, 1.0f));  // +y of the map is up, against the rows
    for (int y = 1; y < kHeight - 1; ++y)
        for (int x = 1; x < kWidth - 1; ++x) {
            const glm::vec3 normal = normal_of(normals.texel(0, 0, x, y));
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(normal[c], expected[c], 1.01f / 255.0f) << x << ' ' << y;
        }
}

TEST(Surface, RepeatsWithoutASeamInItsRelief) {
    constexpr int kSize = 128;
    const auto wave = [](float p) { return std::sin(6.2831853f * p); };
    SurfaceMaps maps = make_surface_maps({kSize, kSize, glm::vec2(1.0f), [&](glm::vec2 p) {
                                              SurfacePoint point;
                                              point.height = 0.05f * wave(p.x);
                                              return point;
                                          }});
    texunit::Texture normals("normals", std::move(maps.normal));
    // The slope is steepest at the seam and equal on both sides of it, and at the borders of the tiles within.
    for (const int x : {0, 64}) {
        const glm::vec3 left = normal_of(normals.texel(0, 0, (x + kSize - 1) % kSize, 5)), right = normal_of(normals.texel(0, 0, x, 5));
        EXPECT_NEAR(left.x, right.x, 1.01f / 255.0f) << x;
    }
    EXPECT_LT(normal_of(normals.texel(0, 0, 0, 5)).x, -0.29f);
    EXPECT_GT(normal_of(normals.texel(0, 0, 64, 5)).x, 0.29f);
}

Surface speckled(int width, int height) {
    return {width, height, glm::vec2(1.0f), [](glm::vec2 p) {
                SurfacePoint point;
                point.color = glm::vec3(value_noise(p * 40.0f, glm::ivec2(40), 1), p);
                point.alpha = p.y;
                point.height = 0.01f * value_noise(p * 30.0f, glm::ivec2(30), 2);
                point.roughness = p.x;
                point.metallic = value_noise(p * 20.0f, glm::ivec2(20), 3);
                point.occlusion = p.y;
                return point;
            }};
}

TEST(Surface, MapsAreTheSameInAnyOrderAndAgain) {
    constexpr int kWidth = 150, kHeight = 70;  // neither whole tiles nor whole blocks
    const int columns = (kWidth + 3) / 4, rows = (kHeight + 3) / 4;
    SurfaceMaps forwards = make_surface_maps(speckled(kWidth, kHeight)), backwards = make_surface_maps(speckled(kWidth, kHeight));
    std::vector<Block> first;
    for (auto* source : {forwards.base_color.get(), forwards.metallic_roughness.get(), forwards.normal.get()})
        for (int i = 0; i < columns * rows; ++i) first.push_back(decode(*source, i % columns, i / columns));
    size_t k = first.size();
    for (auto* source : {backwards.normal.get(), backwards.metallic_roughness.get(), backwards.base_color.get()})
        for (int i = columns * rows - 1; i >= 0; --i) ASSERT_EQ(decode(*source, i % columns, i / columns), first[--k]) << "block " << k;
    // All has been handed out and forgotten; asked again it is made again.
    for (int i = 0; i < columns * rows; ++i) ASSERT_EQ(decode(*forwards.base_color, i % columns, i / columns), first[size_t(i)]);
}

TEST(Surface, MapsAreTheSameFromSeveralThreads) {
    constexpr int kSize = 192, kBlocks = kSize / 4;
    SurfaceMaps alone = make_surface_maps(speckled(kSize, kSize)), shared = make_surface_maps(speckled(kSize, kSize));
    std::array<std::vector<Block>, 3> from_thread;
    std::vector<std::thread> threads;
    const std::array<texunit::TexelSource*, 3> sources{shared.base_color.get(), shared.metallic_roughness.get(), shared.normal.get()};
    for (size_t t = 0; t < 3; ++t)
        threads.emplace_back([&, t] {
            for (int i = 0; i < kBlocks * kBlocks; ++i) from_thread[t].push_back(decode(*sources[t], i % kBlocks, i / kBlocks));
        });
    for (std::thread& thread : threads) thread.join();
    const std::array<texunit::TexelSource*, 3> expected{alone.base_color.get(), alone.metallic_roughness.get(), alone.normal.get()};
    for (size_t t = 0; t < 3; ++t)
        for (int i = 0; i < kBlocks * kBlocks; ++i)
            ASSERT_EQ(from_thread[t][size_t(i)], decode(*expected[t], i % kBlocks, i / kBlocks)) << "map " << t << " block " << i;
}

TEST(Surface, ChannelsAreWhereGltfReadsThem) {
    SurfaceMaps maps = make_surface_maps({4, 4, glm::vec2(1.0f), [](glm::vec2) {
                                              SurfacePoint point;
                                              point.color = {1.0f, 0.5f, 0.0f};
                                              point.alpha = 0.2f;
                                              point.occlusion = 0.4f;
                                              point.roughness = 0.6f;
                                              point.metallic = 0.8f;
                                              return point;
                                          }});
    const Block color = decode(*maps.base_color, 0, 0), finish = decode(*maps.metallic_roughness, 0, 0);
    EXPECT_EQ((std::array{color[0], color[1], color[2], color[3]}), (std::array<uint8_t, 4>{255, 128, 0, 51}));
    EXPECT_EQ((std::array{finish[0], finish[1], finish[2], finish[3]}), (std::array<uint8_t, 4>{102, 153, 204, 255}));
    EXPECT_EQ(maps.base_color->format(), texunit::Format::RGBA8Srgb);
    EXPECT_EQ(maps.metallic_roughness->format(), texunit::Format::RGBA8Unorm);
    EXPECT_EQ(maps.normal->format(), texunit::Format::RGBA8Unorm);
}

}  // namespace
}  // namespace rawtexel::scenes
