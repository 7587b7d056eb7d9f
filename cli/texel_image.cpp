#include "cli/texel_image.h"

#include "cli/usage_error.h"
#include "scenes/output_file.h"
#include "texunit/srgb.h"

#include <cmath>
#include <cstring>
#include <span>
#include <vector>

namespace rawtexel::cli {
namespace {

using texunit::Format;
using texunit::Texture;

/// Whether every texel lies in [0, 1].
bool is_unsigned_fraction(Format format) {
    const texunit::TexelLayout& layout = texunit::layout(format);
    return layout.storage != texunit::StorageClass::Half4 && layout.storage != texunit::StorageClass::Float4 && !layout.is_signed;
}

/// Radiance HDR shares one exponent among three channels without a sign.
bool holds_negative_values(const std::string& path) {
    const std::string extension = scenes::extension_of(path);
    return scenes::is_float_format(path) && extension != "hdr" && extension != "rgbe";
}

bool has_16_bit_codes(Format format) { return format == Format::R16Unorm || format == Format::RG16Unorm || format == Format::RGBA16Unorm; }

/// Images of two channels are grey and alpha, so red and green take three.
int image_channels(Format format) {
    const int channels = texunit::info(format).channels;
    return channels == 2 ? 3 : channels;
}

/// Calls `put(value)` for the channels of every texel, row by row.
template <class Put>
void for_each_value(Texture& texture, int level, int slice, const Put& put) {
    const texunit::Shape& shape = texture.shape();
    const int width = texunit::level_extent(shape.width, level), height = texunit::level_extent(shape.height, level);
    const auto channels = size_t(image_channels(texture.format()));
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const std::array<float, 4> texel = texture.texel(level, slice, x, y);
            for (size_t c = 0; c < channels; ++c) put(texel[c], c);
        }
    }
}

std::vector<uint8_t> codes_8bit(Texture& texture, int level, int slice) {
    const bool srgb = texunit::info(texture.format()).srgb;
    std::vector<uint8_t> codes;
    for_each_value(texture, level, slice, [&](float value, size_t channel) {
        codes.push_back(srgb && channel < 3 ? texunit::encode_srgb8(value) : uint8_t(std::lround(value * 255.0f)));
    });
    return codes;
}

std::vector<std::byte> codes_16bit(Texture& texture, int level, int slice) {
    std::vector<std::byte> codes;
    for_each_value(texture, level, slice, [&](float value, size_t) {
        const auto code = uint16_t(std::lround(value * 65535.0f));
        std::array<std::byte, sizeof code> bytes;
        std::memcpy(bytes.data(), &code, sizeof code);
        codes.insert(codes.end(), bytes.begin(), bytes.end());
    });
    return codes;
}

shading::Image linear_image(Texture& texture, int level, int slice) {
    const texunit::Shape& shape = texture.shape();
    shading::Image image(texunit::level_extent(shape.width, level), texunit::level_extent(shape.height, level),
                         image_channels(texture.format()));
    size_t next = 0;
    for_each_value(texture, level, slice, [&](float value, size_t) { image.values[next++] = value; });
    return image;
}

}  // namespace

void check_holds_texels(std::string_view option, const std::string& path, Format format) {
    if (holds_negative_values(path) || is_unsigned_fraction(format)) return;
    throw UsageError(std::string(option) + ": '" + path + "' cannot hold the texels, which are " + std::string(texunit::info(format).name) +
                     "; a format that can is '.exr'");
}

bool loses_alpha(const std::string& path, Texture& texture, int level, int slice) {
    if (image_channels(texture.format()) < 4 || scenes::stores_alpha(path)) return false;
    bool opaque = true;
    for_each_value(texture, level, slice, [&](float value, size_t channel) { opaque &= channel < 3 || value == 1.0f; });
    return !opaque;
}

void write_slice(const std::string& path, Texture& texture, int level, int slice, const scenes::Metadata& metadata) {
    if (scenes::is_float_format(path)) return scenes::write_float(path, linear_image(texture, level, slice), {}, metadata);
    const texunit::Shape& shape = texture.shape();
    const int width = texunit::level_extent(shape.width, level), height = texunit::level_extent(shape.height, level);
    const int channels = image_channels(texture.format());
    if (has_16_bit_codes(texture.format()) && scenes::extension_of(path) == "png")
        return scenes::write_file(path, scenes::encode_png(width, height, channels, 16, codes_16bit(texture, level, slice)));
    scenes::write_8bit(path, width, height, channels, codes_8bit(texture, level, slice), metadata);
}

}  // namespace rawtexel::cli
