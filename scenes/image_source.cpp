// Images as textures: decoded whole, once, when the first texel is asked for.
#include "scenes/image_codec.h"

#include "texunit/containers.h"
#include "texunit/memory_source.h"
#include "texunit/srgb.h"

#include <cassert>
#include <cstring>
#include <mutex>

namespace rawtexel::scenes {
namespace {

using texunit::Format;

/// 16-bit colour has no sRGB texel format: it is decoded to linear floats, which keep more than its 16 bits (linear half would not).
Format texel_format(SampleType type, bool srgb) {
    switch (type) {
        case SampleType::Unorm8: return srgb ? Format::RGBA8Srgb : Format::RGBA8Unorm;
        case SampleType::Unorm16: return srgb ? Format::RGBA32Float : Format::RGBA16Unorm;
        case SampleType::Half: return Format::RGBA16Half;
        default: return Format::RGBA32Float;
    }
}

/// Which of the image's leading channels make up the texel.
enum class Layout { Grey, GreyAlpha, RedGreen, Rgb, Rgba };

Layout layout_of(const ImageHeader& header) {
    if (header.channels == 1) return Layout::Grey;
    if (header.channels == 2) return header.alpha_channel == 1 ? Layout::GreyAlpha : Layout::RedGreen;
    return header.channels >= 4 && header.alpha_channel == 3 ? Layout::Rgba : Layout::Rgb;
}

int channels_read(Layout layout) {
    switch (layout) {
        case Layout::Grey: return 1;
        case Layout::GreyAlpha:
        case Layout::RedGreen: return 2;
        case Layout::Rgb: return 3;
        default: return 4;
    }
}

/// Spreads the leading channels of each four-sample pixel to red, green, blue, alpha.
template <class Sample>
void arrange(Layout layout, Sample one, std::span<std::byte> pixels) {
    for (size_t at = 0; at < pixels.size(); at += 4 * sizeof(Sample)) {
        Sample s[4];
        std::memcpy(s, pixels.data() + at, sizeof s);
        const Sample alpha = layout == Layout::GreyAlpha ? s[1] : layout == Layout::Rgba ? s[3] : one;
        const bool grey = layout == Layout::Grey || layout == Layout::GreyAlpha;
        const Sample rgba[4] = {s[0], grey ? s[0] : s[1], grey ? s[0] : layout == Layout::RedGreen ? Sample{} : s[2], alpha};
        std::memcpy(pixels.data() + at, rgba, sizeof rgba);
    }
}

void arrange(SampleType type, Layout layout, std::span<std::byte> pixels) {
    constexpr uint16_t kHalfOne = 0x3c00;
    switch (type) {
        case SampleType::Unorm8: return arrange<uint8_t>(layout, 0xff, pixels);
        case SampleType::Unorm16: return arrange<uint16_t>(layout, 0xffff, pixels);
        case SampleType::Half: return arrange<uint16_t>(layout, kHalfOne, pixels);
        case SampleType::Float: return arrange<float>(layout, 1.0f, pixels);
    }
}

/// sRGB-encoded 16-bit RGBA to linear floats; alpha is linear already.
std::vector<std::byte> linear_floats(std::span<const std::byte> pixels) {
    static const std::vector<float> linear = [] {
        std::vector<float> table(65536);
        for (size_t code = 0; code < table.size(); ++code) table[code] = float(texunit::srgb_to_linear(double(code) / 65535.0));
        return table;
    }();
    std::vector<std::byte> floats(pixels.size() * 2);
    for (size_t i = 0; i < pixels.size() / sizeof(uint16_t); ++i) {
        uint16_t code;
        std::memcpy(&code, pixels.data() + i * sizeof code, sizeof code);
        const float value = i % 4 == 3 ? float(code) / 65535.0f : linear[code];
        std::memcpy(floats.data() + i * sizeof value, &value, sizeof value);
    }
    return floats;
}

class ImageSource final : public texunit::TexelSource {
  public:
    ImageSource(EncodedBytes encoded, bool srgb)
        : encoded_(std::move(encoded)), header_(read_image_header(*encoded_)), format_(texel_format(header_.type, srgb)) {}

    Format format() const override { return format_; }
    texunit::Shape shape() const override { return {.width = header_.width, .height = header_.height}; }
    uint64_t stored_bytes() const override { return texunit::stored_bytes(format_, header_.width, header_.height); }

    void decode_block(int level, int slice, int block_x, int block_y, std::byte* texels) override {
        assert(level == 0 && slice == 0);
        (void)level, (void)slice;
        std::call_once(decoded_, [this] { decode(); });
        if (!damage_.empty()) throw texunit::TextureError(damage_);
        const size_t row_stride = size_t(header_.width) * size_t(texunit::info(format_).bytes_per_block);
        texunit::store_block(format_, rows_.data(), header_.width, header_.height, row_stride, block_x, block_y, texels);
    }

  private:
    /// Damage is remembered, so that every thread and every later block reports it.
    void decode() {
        try {
            const Layout layout = layout_of(header_);
            const size_t pixel_bytes = 4 * bytes_per_sample(header_.type);
            std::vector<std::byte> pixels(size_t(header_.width) * size_t(header_.height) * pixel_bytes);
            read_image_pixels(encoded_->name(), all_bytes(*encoded_), header_, channels_read(layout), pixels.data(), pixel_bytes);
            arrange(header_.type, layout, pixels);
            const bool decode_srgb = header_.type == SampleType::Unorm16 && format_ == Format::RGBA32Float;
            rows_ = decode_srgb ? linear_floats(pixels) : std::move(pixels);
        } catch (const std::exception& error) {
            damage_ = error.what();
        }
        encoded_.reset();
    }

    EncodedBytes encoded_;
    ImageHeader header_;
    Format format_;
    std::once_flag decoded_;
    std::vector<std::byte> rows_;
    std::string damage_;
};

}  // namespace

std::unique_ptr<texunit::TexelSource> open_image(EncodedBytes encoded, bool srgb, uint64_t max_bytes) {
    const std::string name = encoded->name();
    auto source = std::make_unique<ImageSource>(std::move(encoded), srgb);
    if (source->stored_bytes() > max_bytes) {
        throw InputError(name + ": " + std::to_string(source->stored_bytes()) + " bytes of texels (at most " + std::to_string(max_bytes) +
                         " are allowed)");
    }
    return source;
}

std::unique_ptr<texunit::TexelSource> open_image(const std::string& path, bool srgb, uint64_t max_bytes) try {
    return open_image(bytes_of_file(path, path), srgb, max_bytes);
} catch (const texunit::TextureError& error) {
    throw InputError(error.what());
}

}  // namespace rawtexel::scenes
