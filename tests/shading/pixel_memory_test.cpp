#include "shading/image.h"

#include "shading/executor.h"
#include "shading/render.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>
#include <new>
#include <thread>
#include <utility>
#include <vector>

namespace rawtexel::shading {
namespace {

constexpr int kLargeSide = 1200;  // of three channels: 17 MB, which comes from the system

TEST(PixelMemory, ImagesStartAtZeroEvenWhereAnotherOneWas) {
    for (const int side : {1, 100, kLargeSide}) {
        {
            Image before(side, side, 3);
            std::ranges::fill(before.values, 7.0f);
        }
        const Image image(side, side, 3);
        ASSERT_EQ(image.values.size(), size_t(side) * size_t(side) * 3);
        EXPECT_TRUE(std::ranges::all_of(image.values, [](float value) { return value == 0.0f; })) << side;
    }
}

TEST(PixelMemory, TheBlockGivenBackLastIsUsedAgainForItsSizeAlone) {
#ifdef __SANITIZE_ADDRESS__
    GTEST_SKIP() << "sanitizers get all memory from the heap";
#endif
    const float* first = nullptr;
    {
        const Image image = Image::unwritten(kLargeSide, kLargeSide, 3);
        first = image.values.data();
    }
    const Image larger = Image::unwritten(2 * kLargeSide, kLargeSide, 3);
    EXPECT_NE(larger.values.data(), first);
    const Image same = Image::unwritten(kLargeSide, kLargeSide, 3);
    EXPECT_EQ(same.values.data(), first);
}

TEST(PixelMemory, CopiesAndMovesAsValuesDo) {
    Image image(3, 2, 1);
    for (size_t i = 0; i < image.values.size(); ++i) image.values[i] = float(i);
    Image copy = image;
    EXPECT_TRUE(copy.values == image.values);
    copy.values[1] = 9;
    EXPECT_FALSE(copy.values == image.values);
    const Image moved = std::move(copy);
    EXPECT_EQ(moved.values[1], 9.0f);
    EXPECT_TRUE(copy.values.empty());  // NOLINT: moved from on purpose
    image = moved;
    EXPECT_TRUE(image.values == moved.values);
    EXPECT_TRUE(Image().values.empty());
}

TEST(PixelMemory, RefusesMoreThanThereIs) {
    EXPECT_THROW(PixelValues(SIZE_MAX / 8), std::bad_alloc);
    EXPECT_THROW(PixelValues(SIZE_MAX / 2), std::bad_alloc);
}

TEST(PixelMemory, ThreadsNeverShareABlock) {
    std::vector<std::thread> threads;
    for (int t = 0; t < 4; ++t) {
        threads.emplace_back([t] {
            for (int round = 0; round < 20; ++round) {
                Image image = Image::unwritten(kLargeSide, kLargeSide, 1);
                for (size_t i = 0; i < image.values.size(); i += 512) image.values[i] = float(t);
                for (size_t i = 0; i < image.values.size(); i += 512) ASSERT_EQ(image.values[i], float(t));
            }
        });
    }
    for (std::thread& thread : threads) thread.join();
}

TEST(PixelMemory, FramesWriteEveryPixelOfMemoryThatHeldAnything) {
    const std::unique_ptr<Executor> executor = make_executor(ExecutorKind::Threads, 2);
    for (const Crop crop : {Crop{}, Crop{3, 5, 1190, 1001}}) {
        RenderOptions options;
        options.width = 1201, options.height = 1013, options.crop = crop;
        options.background = glm::vec3(0.25f);
        const int width = crop.width > 0 ? crop.width : options.width, height = crop.width > 0 ? crop.height : options.height;
        {
            Image before = Image::unwritten(width, height, 3);
            std::ranges::fill(before.values, std::numeric_limits<float>::quiet_NaN());
        }
        const RenderResult result = render(Scene{}, Lighting{}, options, *executor);
        ASSERT_EQ(result.radiance.values.size(), size_t(width) * size_t(height) * 3);
        EXPECT_TRUE(std::ranges::all_of(result.radiance.values, [](float value) { return value == 0.25f; }));
    }
}

}  // namespace
}  // namespace rawtexel::shading
