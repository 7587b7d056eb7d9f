// The image a render writes: which format means what, and the way from radiance to file.
#pragma once

#include "cli/render_options.h"
#include "scenes/image_io.h"
#include "shading/image.h"

#include <span>
#include <string>
#include <string_view>

namespace rawtexel::cli {

/// Throws UsageError when the extension names no image format that can be written, with the nearest that can.
void check_image_format(std::string_view option, const std::string& path);

/// True where further layers can be stored beside the image.
bool stores_layers(const std::string& path);

/// Linear radiance and layers into float formats; exposure, tone map and transfer into 8-bit ones. Throws scenes::OutputError.
void write_image(const std::string& path, const shading::Image& radiance, std::span<const shading::Layer> layers, const ToneOptions& tone,
                 const scenes::Metadata& metadata);

}  // namespace rawtexel::cli
