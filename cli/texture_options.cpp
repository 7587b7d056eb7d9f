#include "cli/texture_options.h"

#include "cli/option_values.h"

namespace rawtexel::cli {

void declare_texture_options(CommandLine& line, texunit::ContainerOptions& options) {
    line.option(
        "--bc-rounding", "exact|ideal8|nvidia|amd",
        "colours of BC1, BC2 and BC3 as exact fractions (the default), or rounded to 8 bits as D3D's text or those vendors' GPUs do",
        [&](const std::string& text) {
            using texunit::BcRounding;
            options.bc_rounding =
                parse_choice("--bc-rounding", text, {BcRounding::Exact, BcRounding::Ideal8, BcRounding::Nvidia, BcRounding::Amd});
        });
    line.option("--max-texture-bytes", "BYTES",
                "refuse a texture file that holds more, uncompressed; K, M and G are understood (default 4G)",
                [&](const std::string& text) { options.max_texture_bytes = parse_bytes("--max-texture-bytes", text); });
}

}  // namespace rawtexel::cli
