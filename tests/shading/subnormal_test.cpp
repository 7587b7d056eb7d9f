// Numbers below 2^-126 keep their value: no mode of the processor that flushes them is set, in any thread.
#include "scene_parts.h"
#include "shading/render.h"
#include "tests/stress/worst_case.h"
#include "tests/shading/executor_kinds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>

#if defined(__x86_64__)
#include <xmmintrin.h>
#endif

namespace rawtexel::shading {
namespace {

constexpr float kTiny = 0x1.8p-140f;

Scene tiny_scene() {
    Scene scene;
    scene.textures = {
        test::make_texture(8, 8, [](int x, int y) { return glm::vec4(kTiny * float(1 + (x + y) % 2 * 2), kTiny, kTiny, 1.0f); })};
    Material material = test::unlit(glm::vec4(1.0f));
    material.maps[kBaseColor].texture = 0;
    test::add_object(scene, test::make_quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}), material);
    test::add_object(scene, test::make_quad({-1, 1, 0}, {2, 0, 0}, {0, -2, 0}), material);
    for (Material& one : scene.materials) one.double_sided = true;
    return scene;
}

TEST(Subnormals, ReachTheImageThroughEveryFilterAndMean) {
    const Scene scene = tiny_scene();
    const auto executor = make_executor(ExecutorKind::Threads, 2);
    for (const texunit::Kernel& kernel : {texunit::Kernel(texunit::Kernel::Nearest), texunit::Kernel(texunit::Kernel::Bilinear)}) {
        for (const texunit::MipMode mip : {texunit::MipMode::None, texunit::MipMode::Linear}) {
            for (const int spp : {1, 4, 64}) {
                RenderOptions options;
                options.width = options.height = 40;
                options.camera = test::square_camera();
                options.filter = kernel;
                options.mip = mip;
                options.spp = spp;
                const Image image = render(scene, Lighting(), options, *executor).radiance;
                float least = 1, most = 0;
                for (size_t i = 0; i < image.values.size(); i += 3) {
                    least = std::min(least, image.values[i]), most = std::max(most, image.values[i]);
                    ASSERT_EQ(image.values[i + 1], kTiny) << "a constant channel, " << spp << " samples";
                }
                EXPECT_GE(least, kTiny);
                EXPECT_LE(most, 3 * kTiny);
                EXPECT_GT(most, least);
            }
        }
    }
    tell_worst_case("constants_changed", 0);
}

#if defined(__x86_64__)
TEST(Subnormals, NoThreadFlushesThem) {
    constexpr unsigned kFlushToZero = 0x8000, kDenormalsAreZero = 0x0040;
    for (const ExecutorKind kind : executor_kinds()) {
        const auto executor = make_executor(kind, 3);
        std::atomic<unsigned> modes{0};
        executor->parallel_for(1000, [&](int64_t, int) { modes |= _mm_getcsr(); });
        EXPECT_EQ(modes & (kFlushToZero | kDenormalsAreZero), 0u);
    }
    EXPECT_EQ(_mm_getcsr() & (kFlushToZero | kDenormalsAreZero), 0u);
}
#endif

}  // namespace
}  // namespace rawtexel::shading
