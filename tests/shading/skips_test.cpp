// Whatever a frame leaves out, the image has the same bits, border pixels included.
#include "shading/skips.h"

#include "frame_bits.h"
#include "scene_parts.h"
#include "shading/cluster_meshes.h"
#include "shading/render.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace rawtexel::shading {
namespace {

using test::same_bits;

/// A closed ball of many triangles, small enough that most of them show no sample, every vertex with a colour and alpha of its own.
Mesh ball(uint32_t material) {
    Mesh mesh;
    mesh.material = material;
    std::mt19937 random(material);
    const auto unit = [&] { return float(random() >> 8) * 0x1p-24f; };
    constexpr uint32_t kRings = 24, kStride = kRings + 1;
    for (uint32_t j = 0; j <= kRings; ++j)
        for (uint32_t i = 0; i <= kRings; ++i) {
            const float turn = 6.2831853f * float(i % kRings) / float(kRings), rise = 3.1415927f * float(j) / float(kRings);
            mesh.positions.push_back(0.4f * glm::vec3(std::cos(turn) * std::sin(rise), std::cos(rise), -std::sin(turn) * std::sin(rise)));
            mesh.colors.emplace_back(unit(), unit(), unit(), unit());
        }
    for (uint32_t j = 0; j < kRings; ++j)
        for (uint32_t i = 0; i < kRings; ++i) {
            const uint32_t a = j * kStride + i;
            for (const uint32_t v : {a, a + kStride, a + 1, a + 1, a + kStride, a + kStride + 1}) mesh.indices.push_back(v);
        }
    return mesh;
}

/// Balls in rows, mirrored here and there, opaque, masked and blended, half of them behind a wall; the right of the image is empty.
Scene balls_and_a_wall() {
    Scene scene;
    for (const AlphaMode mode : {AlphaMode::Opaque, AlphaMode::Opaque, AlphaMode::Mask, AlphaMode::Blend}) {
        Material& material = scene.materials.emplace_back();
        material.unlit = true;
        material.alpha_mode = mode;
        material.double_sided = scene.materials.size() % 2 == 0;
        scene.meshes.push_back(ball(uint32_t(scene.materials.size()) - 1));
    }
    for (int i = 0; i < 40; ++i) {
        glm::mat4 place(1.0f);
        place[0][0] = i % 3 == 0 ? -1.0f : 1.0f;
        place[3] = glm::vec4(0.7f * float(i % 5) - 3.0f, 0.6f * float(i / 5 % 2) - 0.3f, -1.2f * float(i / 10), 1.0f);
        scene.instances.push_back({uint32_t(i % 4), place});
    }
    scene.instances.back().world_from_object[3].x = 500.0f;  // out of view
    Mesh& wall = scene.meshes.emplace_back();
    wall.positions = {{-4, -0.9f, -0.6f}, {0.5f, -0.9f, -0.6f}, {0.5f, 2, -0.6f}, {-4, 2, -0.6f}};
    wall.indices = {0, 1, 2, 0, 2, 3};
    scene.instances.push_back({uint32_t(scene.meshes.size()) - 1, glm::mat4(1.0f)});
    return scene;
}

class SkipsTest : public testing::Test {
  protected:
    SkipsTest() { cluster_meshes(scene_, *one_); }

    static RenderOptions options() {
        RenderOptions options;
        options.width = 75;
        options.height = 37;
        options.tile_size = 32;
        options.camera.vertical_fov = 0.7f;
        options.camera.world_from_camera[3] = glm::vec4(0, 0, 3, 1);
        return options;
    }

    RenderResult render_with(const RenderOptions& options) const { return render(scene_, lighting_, options, *one_); }

    std::unique_ptr<Executor> one_ = make_executor(ExecutorKind::Threads, 1);
    Scene scene_ = balls_and_a_wall();
    Lighting lighting_;
};

TEST_F(SkipsTest, ChangeNoBitWhicheverIsOff) {
    raster::FrameCounts sum;
    for (const int spp : {1, 16, 64})
        for (const PixelFilter filter : {PixelFilter::Box, PixelFilter::Tent, PixelFilter::Gaussian})
            for (const PixelJitter jitter : {PixelJitter::Frame, PixelJitter::Pixel}) {
                RenderOptions options = SkipsTest::options();
                options.spp = spp;
                options.pixel_filter = filter;
                options.pixel_jitter = jitter;
                const RenderResult all = render_with(options);
                sum += all.geometry;
                const std::string what =
                    std::to_string(spp) + " samples, " + std::string(to_string(filter)) + ", " + std::string(to_string(jitter));
                for (const SkipInfo& skip : kSkips) {
                    RenderOptions without = options;
                    without.skips.*skip.on = false;
                    EXPECT_TRUE(same_bits(render_with(without).radiance, all.radiance)) << skip.name << " off, " << what;
                }
                RenderOptions none = options;
                for (const SkipInfo& skip : kSkips) none.skips.*skip.on = false;
                EXPECT_TRUE(same_bits(render_with(none).radiance, all.radiance)) << "all off, " << what;
            }
    EXPECT_GT(sum.culled_frustum, 0u);
    EXPECT_GT(sum.culled_backface, 0u);
    EXPECT_GT(sum.culled_unsampled, 0u);
    EXPECT_GT(sum.culled_occluded, 0u);
    EXPECT_GT(sum.hiz_rejected, 0u);
    EXPECT_GT(sum.tiles_empty, 0u);
}

/// The busy scene with small textures of one colour and of nearly one, and with one that nothing shows.
Scene busy_scene_with_constants() {
    Scene scene = test::make_busy_scene();
    const auto add = [&](int width, int height, const glm::vec4& last) {
        const auto color = [=](int x, int y) { return x == width - 1 && y == height - 1 ? last : glm::vec4(0.7f, 0.6f, 0.3f, 1.0f); };
        scene.textures.push_back(test::make_texture(width, height, color));
        return int(scene.textures.size()) - 1;
    };
    const glm::vec4 same(0.7f, 0.6f, 0.3f, 1.0f);
    const int one = add(1, 1, same), four = add(4, 4, same), nearly = add(4, 3, same * 1.25f);
    scene.materials[0].maps[kEmissive].texture = four;
    scene.materials[0].emission = glm::vec3(0.2f);
    scene.materials[1].maps[kOcclusion].texture = one;
    scene.materials[2].maps[kOcclusion].texture = nearly;
    scene.textures.push_back(test::make_noise_texture(64, 64, 9));
    return scene;
}

constexpr bool Skips::*kOfLookups[] = {&Skips::lazy_files, &Skips::lazy_levels, &Skips::lazy_blocks, &Skips::constant_texels,
                                       &Skips::zero_weight_taps};

TEST(LitSkipsTest, ChangeNoBitOfLightAndTextures) {
    const std::unique_ptr<Executor> two = make_executor(ExecutorKind::Threads, 2);
    const Lighting lighting = test::busy_lighting(busy_scene_with_constants(), *two);
    // A scene of its own for each frame: what has been decoded stays decoded.
    const auto render_anew = [&](const RenderOptions& options) { return render(busy_scene_with_constants(), lighting, options, *two); };
    for (const int spp : {1, 16, 64})
        for (const PixelFilter filter : {PixelFilter::Box, PixelFilter::Tent, PixelFilter::Gaussian})
            for (const PixelJitter jitter : {PixelJitter::Frame, PixelJitter::Pixel}) {
                RenderOptions options;
                options.width = 75;
                options.height = 37;
                options.camera = test::busy_camera();
                options.spp = spp;
                options.pixel_filter = filter;
                options.pixel_jitter = jitter;
                const RenderResult all = render_anew(options);
                for (const SkipInfo& skip : kSkips) {
                    if (std::ranges::none_of(kOfLookups, [&](bool Skips::*of) { return of == skip.on; })) continue;
                    RenderOptions without = options;
                    without.skips.*skip.on = false;
                    EXPECT_TRUE(same_bits(render_anew(without).radiance, all.radiance))
                        << skip.name << " off, " << spp << " samples, " << to_string(filter) << ", " << to_string(jitter);
                }
            }
}

TEST(LitSkipsTest, LeaveAloneWhatNoSampleReads) {
    const std::unique_ptr<Executor> one = make_executor(ExecutorKind::Threads, 1);
    RenderOptions options;
    options.width = 75;
    options.height = 37;
    options.camera = test::busy_camera();
    const auto work = [&](bool Skips::*off) {
        const Scene scene = busy_scene_with_constants();
        RenderOptions asked = options;
        if (off != nullptr) asked.skips.*off = false;
        render(scene, test::busy_lighting(scene, *one), asked, *one);
        std::vector<texunit::TextureWork> done;
        for (const SceneTexture& texture : scene.textures) done.push_back(texture.texture->work());
        return done;
    };
    const auto lazy = work(nullptr), files = work(&Skips::lazy_files), blocks = work(&Skips::lazy_blocks),
               levels = work(&Skips::lazy_levels);
    const size_t unseen = lazy.size() - 1;
    EXPECT_EQ(lazy[unseen].bytes_decoded, 0u);
    EXPECT_EQ(files[unseen].blocks_decoded, 1u);
    EXPECT_EQ(blocks[unseen].blocks_decoded, 16u * 16u);
    EXPECT_EQ(blocks[unseen].blocks_decoded_mips, 0u);
    EXPECT_EQ(levels[unseen].blocks_decoded_mips, 64u + 16u + 4u + 1u + 1u + 1u);
    // The coarser level of what is one colour is never made, nor any of what is not looked up.
    const size_t four = unseen - 2;
    EXPECT_EQ(lazy[four].blocks_decoded, 1u);
    EXPECT_EQ(lazy[four].blocks_decoded_mips, 0u);
    EXPECT_GT(work(&Skips::constant_texels)[four].blocks_decoded_mips, 0u);
}

TEST_F(SkipsTest, ClustersMadeOnceDrawWhatThoseOfAFrameDo) {
    const RenderOptions options = SkipsTest::options();
    const RenderResult once = render_with(options);
    for (Mesh& mesh : scene_.meshes) mesh.clusters = nullptr;
    const RenderResult anew = render_with(options);
    EXPECT_TRUE(same_bits(once.radiance, anew.radiance));
    EXPECT_EQ(once.geometry.binned, anew.geometry.binned);
}

}  // namespace
}  // namespace rawtexel::shading
