#include "scenes/image_io.h"

#include "scenes/image_claim.h"
#include "scenes/image_codec.h"
#include "scenes/output_file.h"

#include "texunit/containers.h"
#include "texunit/srgb.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstring>

namespace rawtexel::scenes {
namespace {

std::vector<std::string> default_channel_names(int channels) {
    switch (channels) {
        case 1: return {"Y"};
        case 2: return {"Y", "A"};
        case 3: return {"R", "G", "B"};
        case 4: return {"R", "G", "B", "A"};
        default: break;
    }
    std::vector<std::string> names;
    for (int c = 0; c < channels; ++c) names.push_back("channel" + std::to_string(c));
    return names;
}

/// The first `kept` channels of interleaved samples.
template <class Sample>
std::vector<Sample> leading_channels(std::span<const Sample> samples, int channels, int kept) {
    std::vector<Sample> result;
    result.reserve(samples.size() / size_t(channels) * size_t(kept));
    for (size_t at = 0; at < samples.size(); at += size_t(channels)) result.insert(result.end(), &samples[at], &samples[at] + kept);
    return result;
}

void decode_integers(const ImageHeader& header, std::span<const std::byte> bytes, bool srgb, std::span<float> values) {
    const double maximum = header.type == SampleType::Unorm8 ? 255.0 : 65535.0;
    std::vector<float> colour(size_t(maximum) + 1), linear(colour.size());
    for (size_t code = 0; code < linear.size(); ++code) {
        linear[code] = float(double(code) / maximum);
        colour[code] = srgb ? float(texunit::srgb_to_linear(double(code) / maximum)) : linear[code];
    }
    const size_t size = bytes_per_sample(header.type);
    for (size_t i = 0; i < values.size(); ++i) {
        uint16_t code = 0;
        std::memcpy(&code, bytes.data() + i * size, size);
        const bool alpha = int(i % size_t(header.channels)) == header.alpha_channel;
        values[i] = alpha ? linear[code] : colour[code];
    }
}

void write_encoded(const std::string& path, const PixelData& data, const Metadata& metadata) {
    const std::vector<std::byte> encoded = encode_image(path, data, metadata);
    write_file(path, encoded);
}

/// The main image and all layers side by side: per pixel the image's channels, then each layer's.
PixelData interleave(const shading::Image& image, std::span<const shading::Layer> layers, std::vector<float>& values) {
    std::vector<const shading::Image*> parts = {&image};
    PixelData data{image.width, image.height, default_channel_names(image.channels), SampleType::Float, nullptr};
    for (const shading::Layer& layer : layers) {
        assert(layer.image.width == image.width && layer.image.height == image.height);
        assert(int(layer.channel_names.size()) == layer.image.channels);
        parts.push_back(&layer.image);
        for (const std::string& channel : layer.channel_names) data.channel_names.push_back(layer.name + "." + channel);
    }
    values.reserve(size_t(image.width) * size_t(image.height) * data.channel_names.size());
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (const shading::Image* part : parts) values.insert(values.end(), part->pixel(x, y), part->pixel(x, y) + part->channels);
    data.pixels = reinterpret_cast<const std::byte*>(values.data());
    return data;
}

}  // namespace

std::vector<std::byte> read_file(const std::string& path) try {
    const auto file = texunit::open_file(path);
    std::vector<std::byte> bytes(file->size());
    file->read(0, bytes);
    return bytes;
} catch (const texunit::TextureError& error) {
    throw InputError(error.what());
}

shading::Image read_image(const std::string& path, bool srgb_integers) try {
    const std::vector<std::byte> encoded = read_file(path);
    check_image_claim(path, {}, path, encoded);
    const ImageHeader header = read_image_header(path, encoded);
    shading::Image image(header.width, header.height, header.channels);
    const bool integers = header.type == SampleType::Unorm8 || header.type == SampleType::Unorm16;
    if (integers) {
        std::vector<std::byte> pixels(header.bytes());
        read_image_pixels(path, encoded, header, header.channels, pixels.data(), size_t(header.channels) * bytes_per_sample(header.type));
        decode_integers(header, pixels, srgb_integers, image.values);
    } else {
        ImageHeader as_floats = header;
        as_floats.type = SampleType::Float;
        auto* pixels = reinterpret_cast<std::byte*>(image.values.data());
        read_image_pixels(path, encoded, as_floats, header.channels, pixels, size_t(header.channels) * sizeof(float));
    }
    return image;
} catch (const texunit::TextureError& damage) {
    throw InputError(damage.what());
}

void write_8bit(const std::string& path, int width, int height, int channels, std::span<const uint8_t> codes, const Metadata& metadata) {
    assert(width > 0 && height > 0 && channels >= 1 && channels <= 4);
    assert(codes.size() == size_t(width) * size_t(height) * size_t(channels));
    std::vector<uint8_t> opaque;
    const bool has_alpha = channels == 2 || channels == 4;
    if (has_alpha && is_writable_format(path) && !can_encode_alpha(path)) {
        opaque = leading_channels(codes, channels, channels - 1);
        codes = opaque;
        --channels;
    }
    const auto* pixels = reinterpret_cast<const std::byte*>(codes.data());
    write_encoded(path, {width, height, default_channel_names(channels), SampleType::Unorm8, pixels}, metadata);
}

void write_float(const std::string& path, const shading::Image& image, std::span<const shading::Layer> layers, const Metadata& metadata,
                 const Placement& placement) {
    assert(image.width > 0 && image.height > 0 && image.channels > 0);
    const bool open_exr = extension_of(path) == "exr";
    if (!layers.empty() && !open_exr) throw OutputError(path + ": further layers need an OpenEXR file (.exr)");
    if (!open_exr && is_writable_format(path) && !can_encode_alpha(path) && image.channels == 4) {
        shading::Image opaque(image.width, image.height, 3);
        opaque.values = shading::PixelValues(leading_channels(std::span<const float>(image.values), 4, 3));
        return write_float(path, opaque, layers, metadata, placement);
    }
    std::vector<float> values;
    PixelData data = interleave(image, layers, values);
    if (open_exr) data.placement = placement;
    write_encoded(path, data, metadata);
}

std::vector<std::byte> encode_png(int width, int height, int channels, int bits, std::span<const std::byte> pixels) {
    assert(channels >= 1 && channels <= 4 && (bits == 8 || bits == 16));
    assert(pixels.size() == size_t(width) * size_t(height) * size_t(channels) * size_t(bits / 8));
    const SampleType type = bits == 8 ? SampleType::Unorm8 : SampleType::Unorm16;
    return encode_image("image.png", {width, height, default_channel_names(channels), type, pixels.data()}, {});
}

bool is_float_format(const std::string& path) {
    static constexpr std::array<std::string_view, 6> kFloatExtensions = {"exr", "hdr", "rgbe", "pfm", "tif", "tiff"};
    return std::ranges::find(kFloatExtensions, extension_of(path)) != kFloatExtensions.end();
}

bool is_writable_format(const std::string& path) { return can_encode(path); }

bool stores_alpha(const std::string& path) { return can_encode_alpha(path); }

}  // namespace rawtexel::scenes
