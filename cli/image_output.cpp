#include "cli/image_output.h"

#include "cli/spelling.h"

#include <algorithm>
#include <array>
#include <cctype>

namespace rawtexel::cli {
namespace {

// Extension with its dot, in lower case; empty when there is none.
std::string extension_of(const std::string& path) {
    const size_t name = path.find_last_of('/') + 1;  // npos + 1 is 0
    const size_t dot = path.find_last_of('.');
    if (dot == std::string::npos || dot <= name) return "";
    std::string extension = path.substr(dot);
    std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return char(std::tolower(c)); });
    return extension;
}

}  // namespace

void check_image_format(std::string_view option, const std::string& path) {
    if (scenes::is_writable_format(path)) return;
    const std::array<std::string, 9> common{".png", ".jpg", ".exr", ".hdr", ".tif", ".bmp", ".tga", ".pfm", ".webp"};
    const std::string extension = extension_of(path);
    const std::string found = extension.empty() ? "has no extension" : "has the unknown extension '" + extension + "'";
    const std::string nearest = extension.empty() ? ".png" : nearest_spelling(extension, common);
    throw UsageError(std::string(option) + ": '" + path + "' " + found + ", the nearest image format is '" + nearest + "'");
}

bool stores_layers(const std::string& path) { return extension_of(path) == ".exr"; }

void write_image(const std::string& path, const shading::Image& radiance, std::span<const shading::Layer> layers, const ToneOptions& tone,
                 const scenes::Metadata& metadata) {
    if (scenes::is_float_format(path)) return scenes::write_float(path, radiance, layers, metadata);
    const shading::DisplayOptions display{tone.exposure.value_or(0.0f), tone.tone_map.value_or(shading::ToneMap::Aces),
                                          tone.transfer.value_or(shading::Transfer::Srgb)};
    const std::vector<uint8_t> codes = shading::encode_8bit(shading::tone_mapped(radiance, display), display.transfer);
    scenes::write_8bit(path, radiance.width, radiance.height, radiance.channels, codes, metadata);
}

}  // namespace rawtexel::cli
