// Footprint options from the frame's side: what they do to the level of detail of a floor in perspective.
#include "shading/render.h"

#include "scene_parts.h"
#include "tests/shading/executor_kinds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace rawtexel::shading {
namespace {

using namespace test;

class FrameFootprints : public testing::Test {
  protected:
    FrameFootprints() {
        scene_.textures.push_back(make_noise_texture(256, 256, 3));
        Material material = unlit(glm::vec4(1.0f));
        material.maps[kBaseColor].texture = 0;
        add_object(scene_, make_quad({-40, -1, 4}, {80, 0, 0}, {0, 0, -80}, glm::vec2(40.0f)), material);
    }

    RenderResult render_with(const FootprintOptions& footprint, int spp = 1, int tile_size = 64, int threads = 1,
                             PixelJitter jitter = PixelJitter::Frame, const Crop& crop = {}) const {
        RenderOptions options;
        options.width = 160, options.height = 96;
        options.crop = crop;
        options.camera = busy_camera();
        options.spp = spp;
        options.pixel_jitter = jitter;
        options.tile_size = tile_size;
        options.footprint = footprint;
        options.aovs = {Aov::Lod, Aov::Material};
        const std::unique_ptr<Executor> executor = make_executor(ExecutorKind::Threads, threads);
        return render(scene_, {}, options, *executor);
    }

    static float lod(const RenderResult& result, int x, int y) { return *result.layers[0].image.pixel(x, y); }
    static bool on_floor(const RenderResult& result, int x, int y) { return *result.layers[1].image.pixel(x, y) >= 0; }

    /// Calls `visit(x, y)` for the upper left pixels of the 2x2 quads that the floor fills, with levels between the finest and the
    /// coarsest.
    template <class Visit>
    static int for_each_quad(const RenderResult& result, const Visit& visit) {
        int quads = 0;
        for (int y = 0; y < 96; y += 2) {
            for (int x = 0; x < 160; x += 2) {
                bool inside = true;
                for (const auto& [i, j] : {std::pair{0, 0}, {1, 0}, {0, 1}, {1, 1}}) {
                    inside &= on_floor(result, x + i, y + j) && lod(result, x + i, y + j) > 0.1f && lod(result, x + i, y + j) < 7.9f;
                }
                if (!inside) continue;
                visit(x, y);
                ++quads;
            }
        }
        return quads;
    }

    Scene scene_;
};

float spread(const Image& image, int x, int y) {
    const float values[] = {*image.pixel(x, y), *image.pixel(x + 1, y), *image.pixel(x, y + 1), *image.pixel(x + 1, y + 1)};
    return *std::max_element(values, values + 4) - *std::min_element(values, values + 4);
}

TEST_F(FrameFootprints, OfQuadsAreOneAndNearThePixelsOwn) {
    const RenderResult analytic = render_with({}), quad = render_with({.derivatives = Derivatives::Quad});
    float widest_analytic = 0, widest_quad = 0;
    double difference = 0;
    const int quads = for_each_quad(analytic, [&](int x, int y) {
        widest_analytic = std::max(widest_analytic, spread(analytic.layers[0].image, x, y));
        widest_quad = std::max(widest_quad, spread(quad.layers[0].image, x, y));
        difference += std::abs(lod(quad, x, y) - lod(analytic, x, y));
    });
    ASSERT_GT(quads, 500);
    EXPECT_GT(widest_analytic, 0.02f);
    EXPECT_LT(widest_quad, 0.002f) << "up to the rounding of coordinates";
    EXPECT_LT(difference / quads, 0.1);
    EXPECT_GT(difference / quads, 1e-4) << "differences are not derivatives";
}

TEST_F(FrameFootprints, OfSamplesAreFinerByTheRootOfTheirNumber) {
    const RenderResult pixel = render_with({}), sample = render_with({.area = FootprintArea::Sample}, 16);
    const int quads = for_each_quad(pixel, [&](int x, int y) {
        if (lod(pixel, x, y) > 2.1f) {
            ASSERT_NEAR(lod(sample, x, y), lod(pixel, x, y) - 2, 1e-5);
        }
    });
    ASSERT_GT(quads, 500);
}

TEST_F(FrameFootprints, TakeBiasProbesAndEllipses) {
    const RenderResult plain = render_with({}), biased = render_with({.lod_bias = -0.5f}), probes = render_with({.probes = 16});
    double finer = 0;
    const int quads = for_each_quad(plain, [&](int x, int y) {
        if (lod(plain, x, y) > 0.6f) {
            ASSERT_NEAR(lod(biased, x, y), lod(plain, x, y) - 0.5f, 1e-5);
        }
        ASSERT_LE(lod(probes, x, y), lod(plain, x, y));
        finer += lod(plain, x, y) - lod(probes, x, y);
    });
    EXPECT_GT(finer / quads, 0.5) << "levels that anisotropy gains on a floor";

    // Large footprints are slow by design, so only what lies near.
    const RenderResult ellipse = render_with({.ellipse = 0.2f}, 1, 64, 1, PixelJitter::Frame, {64, 64, 32, 32});
    for (int y = 0; y < 32; ++y) {
        for (int x = 0; x < 32; ++x) ASSERT_EQ(lod(ellipse, x, y), 0) << x << ',' << y;
    }
}

TEST_F(FrameFootprints, GiveTheSameBitsForAnyThreadsAndTileSize) {
    for (const FootprintOptions& footprint :
         {FootprintOptions{.probes = 8, .lod_rule = texunit::LodRule::Exact, .derivatives = Derivatives::Quad},
          FootprintOptions{.ellipse = 0.1f, .area = FootprintArea::Sample}}) {
        const Crop near = footprint.ellipse > 0 ? Crop{40, 60, 80, 36} : Crop{};
        const RenderResult expected = render_with(footprint, 2, 64, 1, PixelJitter::Pixel, near);
        const RenderResult other = render_with(footprint, 2, 32, 3, PixelJitter::Pixel, near);
        EXPECT_EQ(
            std::memcmp(expected.radiance.values.data(), other.radiance.values.data(), expected.radiance.values.size() * sizeof(float)), 0);
    }
}

}  // namespace
}  // namespace rawtexel::shading
