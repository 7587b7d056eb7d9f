// Images as they are compared.
#pragma once

#include "shading/image.h"

#include <string>

namespace rawtexel::cli {

/// The colour channels of an image file as they show over black, 3 or 1 of them; further layers are left out. Integers are display values
/// from 0 to 1, floats linear light. Throws scenes::InputError.
shading::Image read_comparable(const std::string& path);

/// Grey as r = g = b where `channels` is 3.
shading::Image with_channels(shading::Image image, int channels);

/// Both of the same extents and channels.
shading::Image absolute_difference(const shading::Image& a, const shading::Image& b);

/// True when one format holds nothing but linear light and the other nothing but display values; a TIFF may hold either.
bool mixes_linear_and_display(const std::string& path_a, const std::string& path_b);

}  // namespace rawtexel::cli
