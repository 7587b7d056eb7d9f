// Float images in memory.
#pragma once

#include "shading/pixel_memory.h"

#include <cstddef>
#include <string>
#include <vector>

namespace rawtexel::shading {

/// Rows from top to bottom, channels interleaved. Linear values.
struct Image {
    int width = 0, height = 0, channels = 0;
    PixelValues values;

    Image() = default;
    Image(int w, int h, int c) : width(w), height(h), channels(c), values(size_t(w) * size_t(h) * size_t(c), 0.0f) {}
    /// For whoever writes every pixel.
    static Image unwritten(int w, int h, int c) {
        Image image;
        image.width = w, image.height = h, image.channels = c;
        image.values = PixelValues(size_t(w) * size_t(h) * size_t(c));
        return image;
    }
    float* pixel(int x, int y) { return values.data() + (size_t(y) * size_t(width) + size_t(x)) * size_t(channels); }
    const float* pixel(int x, int y) const { return values.data() + (size_t(y) * size_t(width) + size_t(x)) * size_t(channels); }
};

/// A named image of a render: a layer of an OpenEXR file. `channel_names` has one entry per channel, such as "R" "G" "B" or "Z".
struct Layer {
    std::string name;
    std::vector<std::string> channel_names;
    Image image;
};

}  // namespace rawtexel::shading
