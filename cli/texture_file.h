// Texture files of every kind, opened: DDS, KTX2, and whatever is an image.
#pragma once

#include "cli/command_line.h"
#include "texunit/containers.h"

#include <memory>
#include <optional>
#include <string>

namespace rawtexel::cli {

enum class ColorSpace { Linear, Srgb };

/// Declares --color-space.
void declare_color_space(CommandLine& line, std::optional<ColorSpace>& color_space);

struct TextureFile {
    std::string container;  ///< "dds", "ktx2" or "image"
    std::unique_ptr<texunit::TexelSource> source;
};

/// Header checked, texels read when asked for. Without `color_space` DDS and KTX2 files are read as they declare and images as linear data;
/// formats that have no sRGB form are linear whatever it says. Throws texunit::TextureError or scenes::InputError.
TextureFile open_texture_file(const std::string& path, std::optional<ColorSpace> color_space, const texunit::ContainerOptions& options);

}  // namespace rawtexel::cli
