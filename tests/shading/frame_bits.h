// What may not change a frame's bits.
#pragma once

#include "shading/render.h"

#include <string>

namespace rawtexel::shading::test {

/// The same size and the bits of all pixels, so that equal NaNs are equal and 0 differs from -0.
bool same_bits(const Image& a, const Image& b);

/// Renders 165x101 pixels or more with one thread and expects the same bits of two threads and other tiles, and of a crop those of that
/// part. Returns the whole frame.
Image expect_bits_of_tiles_threads_and_crops(const Scene& scene, const Lighting& lighting, RenderOptions options, const std::string& what);

}  // namespace rawtexel::shading::test
