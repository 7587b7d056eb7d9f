// Images on disk, through OpenImageIO: the one door behind which that library lives.
#pragma once

#include "scenes/encoded_bytes.h"
#include "scenes/load.h"
#include "shading/image.h"
#include "texunit/texel_source.h"

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rawtexel::scenes {

/// The output cannot be written. what() is one line naming the path.
class OutputError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// The bytes of a regular file. Throws InputError.
std::vector<std::byte> read_file(const std::string& path);

/// An image as a texture: header checked now, of PNG and JPEG files no more being read, of others the whole file but not kept; pixels read
/// on first use by whichever thread comes first, kept as RGBA of 8 or 16 bits,
/// half or float. Grey becomes r = g = b; alpha is unassociated; profiles, gamma and orientation in the file play no part (glTF 2.0 3.9.2).
/// `srgb`: colour is encoded by the sRGB curve. 8-bit colour keeps its codes, 16-bit colour is decoded to float, float is linear already.
/// Damage found in the pixels is a texunit::TextureError of every texel.
/// Throws InputError: missing, not a regular file, not an image, zero or over-large extents (1..16384), more than `max_bytes` of texels,
/// unsupported.
inline constexpr uint64_t kMaxImageBytes = texunit::ContainerOptions{}.max_texture_bytes;
std::unique_ptr<texunit::TexelSource> open_image(const std::string& path, bool srgb, uint64_t max_bytes = kMaxImageBytes);
std::unique_ptr<texunit::TexelSource> open_image(EncodedBytes encoded, bool srgb, uint64_t max_bytes = kMaxImageBytes);

/// The whole image as linear floats with its own channels. 8-bit and 16-bit integer images are decoded by the sRGB curve when
/// `srgb_integers`.
shading::Image read_image(const std::string& path, bool srgb_integers);

using Metadata = std::vector<std::pair<std::string, std::string>>;

/// Writes 8-bit codes (1, 3 or 4 channels) under a temporary name and renames. Format by extension. Throws OutputError.
void write_8bit(const std::string& path, int width, int height, int channels, std::span<const uint8_t> codes, const Metadata& metadata);
/// Where an image lies in a larger one of which it is a part; zero extents: it is the whole.
struct Placement {
    int x = 0, y = 0;                       ///< of the upper left pixel
    int whole_width = 0, whole_height = 0;  ///< pixels
};

/// Writes linear floats; further layers become "layer.channel" in OpenEXR, and are refused with OutputError elsewhere.
/// OpenEXR takes `placement` as its data and display windows.
void write_float(const std::string& path, const shading::Image& image, std::span<const shading::Layer> layers, const Metadata& metadata,
                 const Placement& placement = {});
/// PNG in memory, 8 or 16 bits a channel, `channels` 1..4.
std::vector<std::byte> encode_png(int width, int height, int channels, int bits, std::span<const std::byte> pixels);

/// The lower-case extension without its dot; empty when there is none.
std::string extension_of(std::string_view path);
/// True when the extension names a format that stores floats: .exr .hdr .rgbe .tif .tiff, and .pfm, which can only be read.
bool is_float_format(const std::string& path);
/// True when OpenImageIO can write the extension.
bool is_writable_format(const std::string& path);
/// True when alpha is written into files of the extension; it is left out of others.
bool stores_alpha(const std::string& path);

}  // namespace rawtexel::scenes
