#include "shading/temporal_sums.h"

#include "scene_parts.h"
#include "shading/render.h"
#include "tests/shading/executor_kinds.h"

#include <gtest/gtest.h>

#include <string>

namespace rawtexel::shading {
namespace {

using namespace test;

class TemporalSumsTest : public testing::Test {
  protected:
    static RenderOptions options() {
        RenderOptions options;
        options.width = 83;
        options.height = 61;
        options.camera = busy_camera();
        return options;
    }

    Image long_render(RenderOptions options, int samples) const {
        options.spp = samples;
        return render(scene_, lighting_, options, *one_).radiance;
    }

    Image mean_of_frames(RenderOptions options, int frames, int samples, Executor& executor) const {
        TemporalSums sums;
        options.sums = &sums;
        options.spp = samples;
        Image mean;
        for (int frame = 0; frame < frames; ++frame) {
            options.first_sample = uint32_t(frame * samples);
            mean = render(scene_, lighting_, options, executor).radiance;
        }
        return mean;
    }

    std::unique_ptr<Executor> one_ = make_executor(ExecutorKind::Threads, 1);
    Scene scene_ = make_busy_scene();
    Lighting lighting_ = busy_lighting(scene_, *one_);
};

TEST_F(TemporalSumsTest, MeansOverFramesHaveTheBitsOfOneLongFrame) {
    RenderOptions options = TemporalSumsTest::options();
    for (const PixelJitter jitter : {PixelJitter::Frame, PixelJitter::Pixel}) {
        options.pixel_jitter = jitter;
        for (const auto& [frames, samples] : {std::pair(1, 5), {5, 1}, {4, 4}, {7, 3}, {2, 17}})
            EXPECT_EQ(mean_of_frames(options, frames, samples, *one_).values, long_render(options, frames * samples).values)
                << frames << " frames of " << samples << " samples, jitter " << to_string(jitter);
    }
}

TEST_F(TemporalSumsTest, AreTheSameForAnyThreadsTilesAndCrop) {
    RenderOptions options = TemporalSumsTest::options();
    const Image expected = long_render(options, 9);
    for (const int tile_size : {32, 128}) {
        options.tile_size = tile_size;
        for (const ExecutorKind kind : executor_kinds())
            EXPECT_EQ(mean_of_frames(options, 3, 3, *make_executor(kind, 3)).values, expected.values) << tile_size;
    }
    options.crop = {17, 5, 40, 50};
    const Image part = mean_of_frames(options, 3, 3, *one_);
    for (int y = 0; y < 50; ++y)
        for (int x = 0; x < 40; ++x)
            for (int c = 0; c < 3; ++c) ASSERT_EQ(part.pixel(x, y)[c], expected.pixel(17 + x, 5 + y)[c]) << x << "," << y;
}

TEST_F(TemporalSumsTest, KeepRadianceWhateverLayersAFrameHas) {
    RenderOptions options = TemporalSumsTest::options();
    TemporalSums sums;
    options.sums = &sums;
    options.spp = 2;
    render(scene_, lighting_, options, *one_);
    options.first_sample = 2;
    options.aovs = {Aov::Depth, Aov::Normal};
    options.coverage = true;
    const RenderResult last = render(scene_, lighting_, options, *one_);
    EXPECT_EQ(last.radiance.values, long_render(TemporalSumsTest::options(), 4).values);
    options.sums = nullptr;
    const RenderResult alone = render(scene_, lighting_, options, *one_);
    for (size_t i = 0; i < 2; ++i) EXPECT_EQ(last.layers[i].image.values, alone.layers[i].image.values) << last.layers[i].name;
    EXPECT_EQ(last.coverage.values, alone.coverage.values);
}

}  // namespace
}  // namespace rawtexel::shading
