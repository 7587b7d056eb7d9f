#include "scenes/image_claim.h"

#include "scenes/message_text.h"

#include <algorithm>
#include <cctype>

namespace rawtexel::scenes {
namespace {

using namespace std::string_view_literals;

/// A format as image_format names it, or a GPU container, and as people do.
struct FormatTitle {
    std::string_view format, title;
};
constexpr FormatTitle kTitles[] = {
    {"png", "PNG"}, {"jpeg", "JPEG"}, {"openexr", "OpenEXR"}, {"hdr", "Radiance HDR"}, {"tiff", "TIFF"}, {"gif", "GIF"}, {"dpx", "DPX"},
    {"psd", "PSD"}, {"bmp", "BMP"},   {"pnm", "PNM"},         {"webp", "WebP"},        {"ktx2", "KTX2"}, {"dds", "DDS"},
};

/// What claims to be of a format: a MIME type (IANA's and those in use) or an extension.
struct Claim {
    std::string_view word, format;
};
constexpr Claim kMimeTypes[] = {
    {"image/png", "png"},          {"image/jpeg", "jpeg"},     {"image/jpg", "jpeg"},  {"image/webp", "webp"},
    {"image/ktx2", "ktx2"},        {"image/gif", "gif"},       {"image/bmp", "bmp"},   {"image/vnd-ms.dds", "dds"},
    {"image/vnd.ms-dds", "dds"},   {"image/x-exr", "openexr"}, {"image/tiff", "tiff"}, {"image/aces", "openexr"},
    {"image/vnd.radiance", "hdr"},
};
constexpr Claim kExtensions[] = {
    {"png", "png"},   {"jpg", "jpeg"}, {"jpeg", "jpeg"}, {"exr", "openexr"}, {"hdr", "hdr"},   {"rgbe", "hdr"}, {"tif", "tiff"},
    {"tiff", "tiff"}, {"gif", "gif"},  {"dpx", "dpx"},   {"psd", "psd"},     {"bmp", "bmp"},   {"ppm", "pnm"},  {"pgm", "pnm"},
    {"pbm", "pnm"},   {"pnm", "pnm"},  {"pfm", "pnm"},   {"webp", "webp"},   {"ktx2", "ktx2"}, {"dds", "dds"},
};

std::string_view claimed_format(std::span<const Claim> claims, std::string_view word) {
    std::string lower(word);
    std::ranges::transform(lower, lower.begin(), [](unsigned char c) { return char(std::tolower(c)); });
    const auto found = std::ranges::find(claims, std::string_view(lower), &Claim::word);
    return found == claims.end() ? std::string_view{} : found->format;
}

/// By the first bytes alone.
std::string_view found_format(Bytes encoded) {
    const std::string_view text(reinterpret_cast<const char*>(encoded.data()), encoded.size());
    if (text.starts_with("\xABKTX 20\xBB\r\n\x1A\n"sv)) return "ktx2";
    if (text.starts_with("DDS "sv)) return "dds";
    return image_format({}, encoded);
}

std::string title_of(std::string_view format) {
    const auto found = std::ranges::find(kTitles, format, &FormatTitle::format);
    return std::string(found == std::end(kTitles) ? format : found->title);
}

}  // namespace

void check_image_claim(const std::string& name, std::string_view mime_type, std::string_view file_name, Bytes encoded) {
    const std::string_view found = found_format(encoded);
    if (found.empty()) return;
    const std::string extension = extension_of(file_name);
    const std::string_view claimed = mime_type.empty() ? claimed_format(kExtensions, extension) : claimed_format(kMimeTypes, mime_type);
    if (claimed.empty() || claimed == found) return;
    const std::string declared = mime_type.empty() ? "." + extension + ", which is " + title_of(claimed) : shortened(mime_type);
    throw InputError(name + ": is " + title_of(found) + " (declared: " + declared + ")");
}

}  // namespace rawtexel::scenes
