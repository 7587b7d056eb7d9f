// Images as they are compared.
#pragma once

#include "shading/image.h"

#include <string>

namespace rawtexel::cli {

struct ComparableImage {
    shading::Image image;
    bool linear = false;  ///< linear light
};

/// The colour channels of an image file as they show over black, 3 or 1 of them; further layers are left out. Integers are display values
/// from 0 to 1, floats linear light. Throws scenes::InputError.
ComparableImage read_comparable(const std::string& path);

/// Grey as r = g = b where `channels` is 3.
shading::Image with_channels(shading::Image image, int channels);

/// Both of the same extents and channels.
shading::Image absolute_difference(const shading::Image& a, const shading::Image& b);

/// Linear light of display values by the sRGB curve, and display values of linear light, clamped to [0, 1]. Keep what is not a number.
shading::Image to_linear(shading::Image display);
shading::Image to_display(shading::Image linear);

}  // namespace rawtexel::cli
