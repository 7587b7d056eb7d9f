// Whatever a frame leaves out, the image has the same bits, border pixels included.
#include "shading/skips.h"

#include "scene_parts.h"
#include "shading/cluster_meshes.h"
#include "shading/render.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

namespace rawtexel::shading {
namespace {

using namespace test;

/// A closed ball of many triangles, small enough that most of them show no sample.
Mesh ball(uint32_t material) {
    Mesh mesh;
    mesh.material = material;
    constexpr uint32_t kRings = 60, kStride = kRings + 1;
    for (uint32_t j = 0; j <= kRings; ++j)
        for (uint32_t i = 0; i <= kRings; ++i) {
            const float turn = 6.2831853f * float(i % kRings) / float(kRings), rise = 3.1415927f * float(j) / float(kRings);
            mesh.positions.push_back(0.4f * glm::vec3(std::cos(turn) * std::sin(rise), std::cos(rise), -std::sin(turn) * std::sin(rise)));
        }
    for (uint32_t j = 0; j < kRings; ++j)
        for (uint32_t i = 0; i < kRings; ++i) {
            const uint32_t a = j * kStride + i;
            for (const uint32_t v : {a, a + kStride, a + 1, a + 1, a + kStride, a + kStride + 1}) mesh.indices.push_back(v);
        }
    return mesh;
}

bool same_bits(const Image& a, const Image& b) {
    return a.values.size() == b.values.size() && std::memcmp(a.values.data(), b.values.data(), a.values.size() * sizeof(float)) == 0;
}

class SkipsTest : public testing::Test {
  protected:
    SkipsTest() {
        // In rows through the busy scene, mirrored here and there; some behind what it holds.
        const uint32_t mesh = uint32_t(scene_.meshes.size());
        scene_.meshes.push_back(ball(scene_.meshes.front().material));
        for (int i = 0; i < 14; ++i) {
            glm::mat4 place(1.0f);
            place[0][0] = i % 3 == 0 ? -1.0f : 1.0f;
            place[3] = glm::vec4(0.9f * float(i % 5) - 1.8f, 0.5f * float(i % 2), -0.8f * float(i / 2), 1.0f);
            scene_.instances.push_back({mesh, place});
        }
        cluster_meshes(scene_, *one_);
    }

    RenderResult render_with(const RenderOptions& options) const { return render(scene_, lighting_, options, *one_); }

    std::unique_ptr<Executor> one_ = make_executor(ExecutorKind::Threads, 1);
    Scene scene_ = make_busy_scene();
    Lighting lighting_ = busy_lighting(scene_, *one_);
};

TEST_F(SkipsTest, ChangeNoBitWhicheverIsOff) {
    raster::FrameCounts sum;
    for (const int spp : {1, 16, 64})
        for (const PixelFilter filter : {PixelFilter::Box, PixelFilter::Tent, PixelFilter::Gaussian})
            for (const PixelJitter jitter : {PixelJitter::Frame, PixelJitter::Pixel}) {
                RenderOptions options;
                options.width = 70;
                options.height = 37;
                options.camera = busy_camera();
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
    EXPECT_GT(sum.hiz_rejected, 0u);
    EXPECT_GT(sum.tiles_empty, 0u);
}

TEST_F(SkipsTest, ClustersMadeOnceDrawWhatThoseOfAFrameDo) {
    RenderOptions options;
    options.width = 70;
    options.height = 37;
    options.camera = busy_camera();
    const RenderResult once = render_with(options);
    for (Mesh& mesh : scene_.meshes) mesh.clusters = nullptr;
    const RenderResult anew = render_with(options);
    EXPECT_TRUE(same_bits(once.radiance, anew.radiance));
    EXPECT_EQ(once.geometry.binned, anew.geometry.binned);
}

}  // namespace
}  // namespace rawtexel::shading
