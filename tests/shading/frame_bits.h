// What may not change a frame's bits.
#pragma once

#include "shading/render.h"

#include <string>

namespace rawtexel::shading::test {

/// Renders 165x101 pixels or more with one thread and expects the same bits of two threads and other tiles, and of a crop those of that
/// part. Returns the whole frame.
Image expect_bits_of_tiles_threads_and_crops(const Scene& scene, const Lighting& lighting, RenderOptions options, const std::string& what);

}  // namespace rawtexel::shading::test
