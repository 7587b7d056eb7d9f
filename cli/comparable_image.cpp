#include "cli/comparable_image.h"

#include "scenes/image_codec.h"
#include "scenes/image_io.h"
#include "shading/transfer.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace rawtexel::cli {

using shading::Image;

namespace {

// Of TIFF files only the header tells.
bool holds_linear_light(const std::string& path) {
    if (!scenes::is_float_format(path)) return false;
    const std::string extension = scenes::extension_of(path);
    if (extension != "tif" && extension != "tiff") return true;
    const scenes::SampleType type = scenes::read_image_header(path, scenes::read_file(path)).type;
    return type == scenes::SampleType::Half || type == scenes::SampleType::Float;
}

}  // namespace

ComparableImage read_comparable(const std::string& path) {
    const Image whole = scenes::read_image(path, /*srgb_integers=*/false);
    const int channels = whole.channels >= 3 ? 3 : 1;
    // Float formats hold colour times alpha already, the others do not.
    const bool has_alpha = whole.channels == channels + 1 && !scenes::is_float_format(path);
    Image colour(whole.width, whole.height, channels);
    for (int y = 0; y < whole.height; ++y)
        for (int x = 0; x < whole.width; ++x) {
            const float* from = whole.pixel(x, y);
            const float alpha = has_alpha ? from[channels] : 1.0f;
            std::transform(from, from + channels, colour.pixel(x, y), [&](float value) { return value * alpha; });
        }
    return {std::move(colour), holds_linear_light(path)};
}

Image with_channels(Image image, int channels) {
    if (image.channels == channels) return image;
    Image wide(image.width, image.height, channels);
    for (size_t i = 0; i < wide.values.size(); ++i) wide.values[i] = image.values[i / size_t(channels)];
    return wide;
}

Image absolute_difference(const Image& a, const Image& b) {
    assert(a.values.size() == b.values.size());
    Image difference(a.width, a.height, a.channels);
    for (size_t i = 0; i < a.values.size(); ++i) difference.values[i] = std::abs(a.values[i] - b.values[i]);
    return difference;
}

Image to_linear(Image display) {
    for (float& value : display.values) value = float(shading::decoded(double(value), shading::Transfer::Srgb));
    return display;
}

Image to_display(Image linear) {
    for (float& value : linear.values) value = float(shading::encoded(std::clamp(double(value), 0.0, 1.0), shading::Transfer::Srgb));
    return linear;
}

}  // namespace rawtexel::cli
