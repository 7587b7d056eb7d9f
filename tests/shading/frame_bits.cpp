#include "tests/shading/frame_bits.h"

#include <gtest/gtest.h>

#include <cstring>

namespace rawtexel::shading::test {

bool same_bits(const Image& a, const Image& b) {
    return a.width == b.width && a.height == b.height && a.channels == b.channels &&
           std::memcmp(a.values.data(), b.values.data(), a.values.size() * sizeof(float)) == 0;
}

Image expect_bits_of_tiles_threads_and_crops(const Scene& scene, const Lighting& lighting, RenderOptions options, const std::string& what) {
    const std::unique_ptr<Executor> one = make_executor(ExecutorKind::Threads, 1), two = make_executor(ExecutorKind::Tbb, 2);
    const Image whole = render(scene, lighting, options, *one).radiance;
    options.tile_size = 32;
    options.fetches.count = true;
    EXPECT_EQ(render(scene, lighting, options, *two).radiance.values, whole.values) << what;
    options.tile_size = 128;
    options.crop = {51, 30, 40, 40};
    const Image crop = render(scene, lighting, options, *two).radiance;
    size_t differing = 0;
    for (int y = 0; y < options.crop.height; ++y)
        for (int x = 0; x < options.crop.width; ++x)
            for (int c = 0; c < 3; ++c) differing += crop.pixel(x, y)[c] != whole.pixel(options.crop.x + x, options.crop.y + y)[c];
    EXPECT_EQ(differing, 0u) << what << ": values of a crop";
    return whole;
}

}  // namespace rawtexel::shading::test
