// Encoded images in memory to pixels and back: the one place that knows OpenImageIO. Inside scenes/ only; the door is scenes/image_io.h.
#pragma once

#include "scenes/image_io.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rawtexel::scenes {

enum class SampleType : uint8_t { Unorm8, Unorm16, Half, Float };
constexpr size_t bytes_per_sample(SampleType type) { return type == SampleType::Unorm8 ? 1 : type == SampleType::Float ? 4 : 2; }

struct ImageHeader {
    int width = 0, height = 0, channels = 0;
    SampleType type = SampleType::Unorm8;
    int alpha_channel = -1;  ///< -1: none
    uint64_t bytes() const { return uint64_t(width) * uint64_t(height) * uint64_t(channels) * bytes_per_sample(type); }
};

using Bytes = std::span<const std::byte>;

/// The format that the first bytes are in ("png", "jpeg", "openexr", …), by `name`'s extension for formats without a signature;
/// empty when neither says.
std::string_view image_format(std::string_view name, Bytes encoded);

/// Reads and checks what precedes the pixels. Throws InputError: not an image, extents outside 1..kMaxExtent, deep or volume data,
/// or far fewer bytes than any such image takes.
ImageHeader read_image_header(const std::string& name, Bytes encoded);
/// Reads no more of `encoded` than the header where it comes first, as in PNG and JPEG.
ImageHeader read_image_header(const texunit::ByteSource& encoded);

/// Reads channels [0, channels) as samples of `header.type` to `pixels`, `pixel_stride` bytes apart, rows from top to bottom without
/// padding. Alpha stays unassociated. Throws TextureError when the data is damaged or not what `header` says.
void read_image_pixels(const std::string& name, Bytes encoded, const ImageHeader& header, int channels, std::byte* pixels,
                       size_t pixel_stride);

/// Pixels to encode, rows from top to bottom, channels interleaved.
struct PixelData {
    int width, height;
    std::vector<std::string> channel_names;  ///< one per channel
    SampleType type;
    const std::byte* pixels;
    Placement placement = {};
};

/// The image in the format that goes with the extension of `path`. Throws OutputError naming `path`.
std::vector<std::byte> encode_image(const std::string& path, const PixelData& data, const Metadata& metadata);

bool can_encode(const std::string& path);
bool can_encode_alpha(const std::string& path);

}  // namespace rawtexel::scenes
