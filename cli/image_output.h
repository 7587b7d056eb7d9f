// The image a render writes: which format means what, and the way from radiance to file.
#pragma once

#include "cli/render_options.h"
#include "scenes/image_io.h"
#include "shading/display.h"
#include "shading/render.h"

#include <array>
#include <string>
#include <string_view>

namespace rawtexel::cli {

/// The image formats that are suggested, by extension: some that can be written.
inline constexpr std::array<std::string_view, 8> kCommonImageFormats{"png", "jpg", "exr", "hdr", "tif", "bmp", "tga", "webp"};

/// Throws UsageError when the extension names no image format that can be written, with the nearest that can.
void check_image_format(std::string_view option, const std::string& path);

/// True where further layers can be stored beside the image.
bool stores_layers(const std::string& path);

/// What the options mean, defaults filled in.
shading::DisplayOptions display_options(const ToneOptions& tone);

/// Linear radiance and layers into float formats; exposure, tone map and transfer into 8-bit ones. With `tone.white_backdrop`, which needs
/// `frame.coverage` and a frame over black, white is what shows where nothing is: radiance 1 in float formats, laid under the encoded
/// colours of what is there in 8-bit ones. Throws scenes::OutputError.
void write_image(const std::string& path, const shading::RenderResult& frame, const ToneOptions& tone, const scenes::Placement& placement,
                 const scenes::Metadata& metadata);

}  // namespace rawtexel::cli
