#include "scenes/image_codec.h"

#include "scenes/encoded_bytes.h"
#include "scenes/image_png.h"
#include "scenes/message_text.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstring>

namespace rawtexel::scenes {
namespace {

using texunit::TextureError;

/// No encoder of these formats shrinks an image by more than this; a header that promises more is not backed by data.
constexpr uint64_t kMaxCompression = 65536;

struct Signature {
    std::string_view format, bytes;
};
using namespace std::string_view_literals;
constexpr std::array kSignatures = {
    Signature{"png", "\x89PNG\r\n\x1a\n"sv},
    Signature{"jpeg", "\xff\xd8\xff"sv},
    Signature{"openexr", "\x76\x2f\x31\x01"sv},
    Signature{"hdr", "#?RADIANCE"sv},
    Signature{"hdr", "#?RGBE"sv},
    Signature{"tiff", "II*\0"sv},
    Signature{"tiff", "MM\0*"sv},
    Signature{"tiff", "II+\0"sv},
    Signature{"tiff", "MM\0+"sv},
    Signature{"gif", "GIF8"sv},
    Signature{"dpx", "SDPX"sv},
    Signature{"dpx", "XPDS"sv},
    Signature{"psd", "8BPS"sv},
    Signature{"bmp", "BM"sv},
    Signature{"pnm", "P1"sv},
    Signature{"pnm", "P2"sv},
    Signature{"pnm", "P3"sv},
    Signature{"pnm", "P4"sv},
    Signature{"pnm", "P5"sv},
    Signature{"pnm", "P6"sv},
    Signature{"pnm", "PF"sv},
    Signature{"pnm", "Pf"sv},
};

/// The bytes to decode: those of the file, or of its checked copy when it is a PNG.
class CheckedPng {
  public:
    CheckedPng(const std::string& name, std::string_view format, Bytes encoded, PngExtent extent) : bytes_(encoded) {
        if (format != "png") return;
        copy_ = png_without_ancillary_chunks(name, encoded, extent);
        bytes_ = copy_;
    }
    Bytes bytes() const { return bytes_; }

  private:
    std::vector<std::byte> copy_;
    Bytes bytes_;
};

/// The library decodes in the thread that calls it: how many threads run is the program's to say.
void keep_single_threaded() {
    static const bool once = OIIO::attribute("threads", 1) && OIIO::attribute("exr_threads", -1);
    (void)once;
}

/// A reader over bytes in memory. The proxy must outlive the input, so it comes first.
struct Reader {
    OIIO::Filesystem::IOMemReader proxy;
    OIIO::ImageInput::unique_ptr input;
    OIIO::ImageSpec spec;

    Reader(std::string_view format, Bytes encoded) : proxy(encoded.data(), encoded.size()) {
        keep_single_threaded();
        input = OIIO::ImageInput::create(OIIO::string_view(format.data(), format.size()), false, nullptr, &proxy);
    }
    bool open(const std::string& name) {
        OIIO::ImageSpec request;
        request["oiio:UnassociatedAlpha"] = 1;
        input->set_ioproxy(&proxy);
        return input->open(name, spec, request);
    }
    /// The pending message, which also keeps the library from printing it.
    std::string message() { return input ? one_line(input->geterror()) : one_line(OIIO::geterror()); }
};

[[noreturn]] void not_readable(const std::string& name, std::string_view format, const std::string& message) {
    throw InputError(name + ": not a readable " + std::string(format) + " image" + (message.empty() ? "" : " (" + message + ")"));
}

SampleType sample_type(const OIIO::TypeDesc& type) {
    switch (type.basetype) {
        case OIIO::TypeDesc::UINT8: return SampleType::Unorm8;
        case OIIO::TypeDesc::UINT16: return SampleType::Unorm16;
        case OIIO::TypeDesc::HALF: return SampleType::Half;
        default: return SampleType::Float;
    }
}

OIIO::TypeDesc type_desc(SampleType type) {
    switch (type) {
        case SampleType::Unorm8: return OIIO::TypeDesc::UINT8;
        case SampleType::Unorm16: return OIIO::TypeDesc::UINT16;
        case SampleType::Half: return OIIO::TypeDesc::HALF;
        default: return OIIO::TypeDesc::FLOAT;
    }
}

void check_extents(const std::string& name, const OIIO::ImageSpec& spec) {
    const auto allowed = [](int extent) { return extent >= 1 && extent <= texunit::kMaxExtent; };
    if (!allowed(spec.width) || !allowed(spec.height))
        throw InputError(name + ": image of " + std::to_string(spec.width) + " x " + std::to_string(spec.height) +
                         " pixels (allowed are 1 to " + std::to_string(texunit::kMaxExtent) + " along each side)");
    if (spec.depth > 1) throw InputError(name + ": a volume image (allowed are flat images)");
    if (spec.deep) throw InputError(name + ": a deep image (allowed are flat images)");
    if (spec.nchannels < 1) throw InputError(name + ": an image without channels (at least 1 is needed)");
}

void check_compression(const std::string& name, const ImageHeader& header, uint64_t encoded_bytes) {
    if (header.bytes() / kMaxCompression > encoded_bytes)
        throw InputError(name + ": truncated image (" + std::to_string(encoded_bytes) + " bytes cannot hold " +
                         std::to_string(header.width) + " x " + std::to_string(header.height) + " pixels)");
}

/// A JPEG that ends with a few stray bytes is whole; every other complaint of the decoder means lost pixels.
bool is_harmless(const std::string& message) { return message.find("extraneous bytes before marker 0xd9") != message.npos; }

}  // namespace

std::string extension_of(std::string_view path) {
    const size_t slash = path.rfind('/'), dot = path.rfind('.');
    if (dot == path.npos || (slash != path.npos && dot < slash)) return {};
    std::string extension(path.substr(dot + 1));
    std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return char(std::tolower(c)); });
    return extension;
}

std::string_view image_format(std::string_view name, Bytes encoded) {
    const std::string_view text(reinterpret_cast<const char*>(encoded.data()), encoded.size());
    for (const Signature& signature : kSignatures)
        if (text.starts_with(signature.bytes)) return signature.format;
    if (text.size() >= 12 && text.starts_with("RIFF") && text.substr(8, 4) == "WEBP") return "webp";
    const std::string extension = extension_of(name);
    if (extension == "tga" || extension == "tpic") return "targa";
    return {};
}

namespace {

/// Header of an image of `file_bytes`, of which `encoded` are the first.
ImageHeader read_header(const std::string& name, Bytes encoded, uint64_t file_bytes) try {
    if (encoded.empty()) throw InputError(name + ": empty (0 bytes, an image was expected)");
    const std::string_view format = image_format(name, encoded);
    if (format.empty()) throw InputError(name + ": not an image of a known format (its first bytes match none)");
    const CheckedPng png(name, format, encoded, PngExtent::Header);
    Reader reader(format, png.bytes());
    if (!reader.input || !reader.open(name)) not_readable(name, format, reader.message());
    reader.message();  // warnings about the header
    check_extents(name, reader.spec);
    const ImageHeader header{reader.spec.width, reader.spec.height, reader.spec.nchannels, sample_type(reader.spec.format),
                             reader.spec.alpha_channel};
    check_compression(name, header, file_bytes);
    return header;
} catch (const TextureError& damage) {
    throw InputError(damage.what());
}

/// Whether a header read from the first bytes alone is the one that all of them give.
bool header_comes_first(std::string_view format) { return format == "png" || format == "jpeg"; }

}  // namespace

ImageHeader read_image_header(const std::string& name, Bytes encoded) { return read_header(name, encoded, encoded.size()); }

ImageHeader read_image_header(const texunit::ByteSource& encoded) try {
    // Metadata may push the pixels far back: a header that seems damaged is tried with more bytes.
    for (uint64_t count = uint64_t{64} << 10; count < encoded.size(); count *= 16) {
        const std::vector<std::byte> bytes = leading_bytes(encoded, count);
        if (!header_comes_first(image_format(encoded.name(), bytes))) break;
        try {
            return read_header(encoded.name(), bytes, encoded.size());
        } catch (const InputError&) {
        }
    }
    return read_image_header(encoded.name(), all_bytes(encoded));
} catch (const TextureError& damage) {
    throw InputError(damage.what());
}

void read_image_pixels(const std::string& name, Bytes encoded, const ImageHeader& header, int channels, std::byte* pixels,
                       size_t pixel_stride) {
    const std::string_view format = image_format(name, encoded);
    const CheckedPng png(name, format, encoded, PngExtent::Whole);
    Reader reader(format, png.bytes());
    if (!reader.input || !reader.open(name)) throw TextureError(name + ": damaged image (" + reader.message() + ")");
    // The file may have been replaced since its header was read.
    const bool same = reader.spec.width == header.width && reader.spec.height == header.height && reader.spec.nchannels == header.channels;
    if (!same || reader.spec.depth > 1 || reader.spec.deep) throw TextureError(name + ": has changed since its header was read");
    const bool read = reader.input->read_image(0, 0, 0, channels, type_desc(header.type), pixels, OIIO::stride_t(pixel_stride));
    const std::string message = reader.message();
    if (!read || (!message.empty() && !is_harmless(message)))
        throw TextureError(name + ": damaged image" + (message.empty() ? "" : " (" + message + ")"));
}

namespace {

/// Null when no format that writes to memory goes with the extension.
OIIO::ImageOutput::unique_ptr create_output(const std::string& path) {
    if (extension_of(path).empty()) return nullptr;
    keep_single_threaded();
    auto output = OIIO::ImageOutput::create(path);
    OIIO::geterror();  // asking is no error
    return output && output->supports("ioproxy") ? std::move(output) : nullptr;
}

std::string writer_message(const std::string& path, OIIO::ImageOutput& output) {
    const std::string message = one_line(output.geterror());
    return path + ": cannot be encoded" + (message.empty() ? "" : " (" + message + ")");
}

OIIO::ImageSpec output_spec(const PixelData& data, const Metadata& metadata) {
    OIIO::ImageSpec spec(data.width, data.height, int(data.channel_names.size()), type_desc(data.type));
    spec.channelnames = data.channel_names;
    spec.alpha_channel = -1;
    for (size_t c = 0; c < data.channel_names.size(); ++c)
        if (data.channel_names[c] == "A") spec.alpha_channel = int(c);
    spec["oiio:UnassociatedAlpha"] = 1;  // codes are written as they come
    if (data.placement.whole_width > 0) {
        spec.x = data.placement.x;
        spec.y = data.placement.y;
        spec.full_width = data.placement.whole_width;
        spec.full_height = data.placement.whole_height;
    }
    for (const auto& [key, value] : metadata) spec.attribute(key, value);
    return spec;
}

}  // namespace

std::vector<std::byte> encode_image(const std::string& path, const PixelData& data, const Metadata& metadata) {
    const auto output = create_output(path);
    if (!output) {
        throw OutputError(path + ": no image format goes with this name (such as .png, .jpg, .exr, .hdr or .tif)");
    }
    OIIO::ImageSpec spec = output_spec(data, metadata);
    if (OIIO::string_view(output->format_name()) == "jpeg") {
        spec["Compression"] = "jpeg:95";
        spec["jpeg:subsampling"] = "4:4:4";
    }
    std::vector<unsigned char> encoded;
    OIIO::Filesystem::IOVecOutput proxy(encoded);
    output->set_ioproxy(&proxy);
    const bool written = output->open(path, spec) && output->write_image(type_desc(data.type), data.pixels) && output->close();
    if (!written) throw OutputError(writer_message(path, *output));
    std::vector<std::byte> bytes(encoded.size());
    std::memcpy(bytes.data(), encoded.data(), encoded.size());
    return bytes;
}

bool can_encode(const std::string& path) {
    const auto output = create_output(path);
    return output != nullptr;
}

bool can_encode_alpha(const std::string& path) {
    const auto output = create_output(path);
    return output && output->supports("alpha");
}

}  // namespace rawtexel::scenes
