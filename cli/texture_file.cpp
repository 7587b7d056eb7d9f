#include "cli/texture_file.h"

#include "cli/option_values.h"
#include "scenes/image_io.h"

namespace rawtexel::cli {

void declare_color_space(CommandLine& line, std::optional<ColorSpace>& color_space) {
    line.option("--color-space", "linear|srgb",
                "what the codes of the texture mean (default: what a DDS or KTX2 file declares, linear for images); floats are linear",
                [&](const std::string& text) {
                    color_space = parse_word("--color-space", text, {"linear", "srgb"}) == 1 ? ColorSpace::Srgb : ColorSpace::Linear;
                });
}

TextureFile open_texture_file(const std::string& path, std::optional<ColorSpace> color_space, const texunit::ContainerOptions& options) {
    using texunit::ContainerKind;
    const std::shared_ptr<const texunit::ByteSource> bytes = texunit::open_file(path);
    const bool srgb = color_space == ColorSpace::Srgb;
    const ContainerKind kind = texunit::container_kind(*bytes);
    if (kind == ContainerKind::None) return {"image", scenes::open_image(path, srgb, options.max_texture_bytes)};
    TextureFile file = kind == ContainerKind::Dds ? TextureFile{"dds", texunit::open_dds(bytes, options)}
                                                  : TextureFile{"ktx2", texunit::open_ktx2(bytes, options)};
    if (color_space) file.source = texunit::reinterpret_srgb(std::move(file.source), srgb);
    return file;
}

}  // namespace rawtexel::cli
