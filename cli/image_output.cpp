#include "cli/image_output.h"

#include "scenes/spelling.h"

#include <vector>

namespace rawtexel::cli {
namespace {

// What is covered in part over white of radiance 1.
shading::Image over_white(const shading::Image& radiance, const shading::Image& coverage) {
    shading::Image result = radiance;
    for (size_t i = 0; i < result.values.size(); ++i) result.values[i] += 1.0f - coverage.values[i / size_t(radiance.channels)];
    return result;
}

std::vector<uint8_t> display_codes(const shading::RenderResult& frame, const ToneOptions& tone) {
    const shading::DisplayOptions display = display_options(tone);
    if (tone.white_backdrop) return shading::encode_8bit_over_white(frame.radiance, frame.coverage, display);
    return shading::encode_8bit(shading::tone_mapped(frame.radiance, display), display.transfer);
}

}  // namespace

void check_image_format(std::string_view option, const std::string& path) {
    if (scenes::is_writable_format(path)) return;
    const std::vector<std::string> common(kCommonImageFormats.begin(), kCommonImageFormats.end());
    const std::string extension = scenes::extension_of(path);
    const std::string found = extension.empty() ? "has no extension" : "has the unknown extension '." + extension + "'";
    const std::string nearest = extension.empty() ? "png" : scenes::nearest_spelling(extension, common);
    throw UsageError(std::string(option) + ": '" + path + "' " + found + ", the nearest image format is '." + nearest + "'");
}

bool stores_layers(const std::string& path) { return scenes::extension_of(path) == "exr"; }

shading::DisplayOptions display_options(const ToneOptions& tone) {
    return {tone.exposure.value_or(0.0f), tone.tone_map.value_or(shading::ToneMap::Aces), tone.transfer.value_or(shading::Transfer::Srgb)};
}

void write_image(const std::string& path, const shading::RenderResult& frame, const ToneOptions& tone, const scenes::Placement& placement,
                 const scenes::Metadata& metadata) {
    const shading::Image& radiance = frame.radiance;
    if (!scenes::is_float_format(path)) {
        scenes::write_8bit(path, radiance.width, radiance.height, radiance.channels, display_codes(frame, tone), metadata);
    } else if (tone.white_backdrop) {
        scenes::write_float(path, over_white(radiance, frame.coverage), frame.layers, metadata, placement);
    } else {
        scenes::write_float(path, radiance, frame.layers, metadata, placement);
    }
}

}  // namespace rawtexel::cli
