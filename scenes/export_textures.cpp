#include "scenes/export_textures.h"

#include "scenes/encoded_bytes.h"
#include "scenes/gltf_policy.h"
#include "scenes/image_io.h"

#include "texunit/srgb.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <string_view>

namespace rawtexel::scenes {
namespace {

using nlohmann::json;
using texunit::Format;
using texunit::Kernel;
using texunit::MipMode;
using texunit::Texture;
using texunit::Wrap;

// glTF 2.0, 5.26.
int wrap_code(Wrap wrap) { return wrap == Wrap::ClampToEdge ? 33071 : wrap == Wrap::MirroredRepeat ? 33648 : 10497; }
int magnification_code(Kernel kernel) { return kernel == Kernel::Nearest ? 9728 : 9729; }
int minification_code(Kernel kernel, MipMode mip) {
    const int linear = kernel == Kernel::Nearest ? 0 : 1;
    return mip == MipMode::None ? 9728 + linear : 9984 + linear + (mip == MipMode::Linear ? 2 : 0);
}

json sampler_json(const texunit::SamplerState& state) {
    return {{"wrapS", wrap_code(state.wrap_s)},
            {"wrapT", wrap_code(state.wrap_t)},
            {"magFilter", magnification_code(state.magnify)},
            {"minFilter", minification_code(state.minify, state.mip)}};
}

/// How the texels of a format become samples of a PNG without loss; nothing where they cannot.
enum class Samples { None, Srgb8, Unorm8, Unorm16 };

Samples samples_of(Format format) {
    switch (format) {
        case Format::R8Srgb:
        case Format::RG8Srgb:
        case Format::RGBA8Srgb: return Samples::Srgb8;
        case Format::R8Unorm:
        case Format::RG8Unorm:
        case Format::RGBA8Unorm: return Samples::Unorm8;
        case Format::R16Unorm:
        case Format::RG16Unorm:
        case Format::RGBA16Unorm: return Samples::Unorm16;
        default: return Samples::None;
    }
}

uint32_t sample_code(float value, Samples samples, int channel) {
    if (samples == Samples::Unorm16) return uint32_t(std::lround(value * 65535.0f));
    if (samples == Samples::Srgb8 && channel < 3) return texunit::encode_srgb8(value);
    return uint32_t(std::lround(value * 255.0f));
}

/// Level 0 as RGBA samples; `opaque` tells whether alpha is 1 throughout.
std::vector<uint32_t> level_0(Texture& texture, Samples samples, bool& opaque) {
    const uint32_t one = samples == Samples::Unorm16 ? 65535 : 255;
    const auto [width, height] = std::pair(texture.shape().width, texture.shape().height);
    std::vector<uint32_t> codes;
    codes.reserve(size_t(width) * size_t(height) * 4);
    opaque = true;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const std::array<float, 4> texel = texture.texel(0, 0, x, y);
            for (int c = 0; c < 4; ++c) codes.push_back(sample_code(texel[size_t(c)], samples, c));
            opaque = opaque && codes.back() == one;
        }
    return codes;
}

/// The texture as PNG, without its alpha channel where that is 1 throughout.
std::vector<std::byte> png_of(Texture& texture, Samples samples) {
    bool opaque;
    const std::vector<uint32_t> codes = level_0(texture, samples, opaque);
    const int channels = opaque ? 3 : 4, bytes = samples == Samples::Unorm16 ? 2 : 1;
    std::vector<std::byte> pixels;
    pixels.reserve(codes.size() * size_t(bytes));
    for (size_t i = 0; i < codes.size(); ++i) {
        if (int(i % 4) >= channels) continue;
        const auto wide = uint16_t(codes[i]);
        const auto narrow = uint8_t(codes[i]);
        const void* code = bytes == 2 ? static_cast<const void*>(&wide) : &narrow;
        pixels.resize(pixels.size() + size_t(bytes));
        std::memcpy(pixels.data() + pixels.size() - bytes, code, size_t(bytes));
    }
    return encode_png(texture.shape().width, texture.shape().height, channels, 8 * bytes, pixels);
}

/// The extension through which textures name images of this type; empty for those of glTF itself.
std::string_view extension_of_type(std::string_view mime_type) {
    if (mime_type == "image/ktx2") return "KHR_texture_basisu";
    if (mime_type == "image/vnd-ms.dds") return "MSFT_texture_dds";
    return {};
}

}  // namespace

int ExportTextures::DistinctElements::index_of(json element) {
    const auto [entry, is_new] = index.try_emplace(std::move(element), int(array.size()));
    if (is_new) array.push_back(entry->first);
    return entry->second;
}

int ExportTextures::image(int index, bool color) {
    const shading::SceneTexture& source = scene_.textures[size_t(index)];
    const std::string what = path_ + ": texture \"" + source.image_name + "\"";
    if (source.srgb != color)
        throw OutputError(what + (color ? " is linear but used as colour (glTF reads colour as sRGB)"
                                        : " is sRGB-encoded but used as data (glTF reads data as linear)"));
    const void* identity = source.encoded ? static_cast<const void*>(source.encoded.get()) : source.texture.get();
    const auto [entry, is_new] = image_of_.try_emplace(identity, int(images_.size()));
    if (!is_new) return entry->second;
    if (source.encoded) {
        images_.push_back(
            {{"name", source.image_name}, {"mimeType", source.mime_type}, {"bufferView", buffer_.add_view(all_bytes(*source.encoded))}});
        return entry->second;
    }

    const texunit::Shape& shape = source.texture->shape();
    const Format format = source.texture->format();
    const Samples samples = samples_of(format);
    // A reader takes 16-bit colour for sRGB, and 16-bit sRGB is no texel format.
    const bool lossless = samples != Samples::None && (samples == Samples::Srgb8) == color;
    if (!lossless || shape.depth > 1 || shape.layers > 1)
        throw OutputError(what + " cannot be stored in a PNG (it is " + std::string(texunit::info(format).name) +
                          "; allowed are flat images of 8-bit colour, or of 8- or 16-bit unsigned data)");
    const std::vector<std::byte> png = png_of(*source.texture, samples);
    images_.push_back({{"name", source.image_name}, {"mimeType", "image/png"}, {"bufferView", buffer_.add_view(png)}});
    return entry->second;
}

int ExportTextures::texture(int texture, const texunit::SamplerState& state, bool color) {
    const int source = image(texture, color);
    json exported = {{"sampler", samplers_.index_of(sampler_json(state))}};
    const std::string extension(extension_of_type(images_[size_t(source)]["mimeType"].get<std::string>()));
    if (extension.empty()) {
        exported["source"] = source;
    } else {
        exported["extensions"][extension]["source"] = source;
        extensions_.insert(extension);
    }
    const shading::LookupPolicy& policy = scene_.textures[size_t(texture)].policy;
    if (policy != shading::LookupPolicy()) exported["extras"]["rawtexel"]["policy"] = policy_json(policy);
    return textures_.index_of(std::move(exported));
}

}  // namespace rawtexel::scenes
