// The options that say how a pixel's footprint on a texture is found and filtered.
#pragma once

#include "cli/command_line.h"
#include "shading/footprint_options.h"

#include <string>
#include <string_view>

namespace rawtexel::cli {

void declare_footprint_options(CommandLine& line, shading::FootprintOptions& footprint);

/// N or N:S2, 1 <= N <= 64, 0 < S2 <= 4.
void parse_anisotropy(std::string_view text, shading::FootprintOptions& footprint);
std::string print_anisotropy(const shading::FootprintOptions& footprint);
/// S2, or 1/6 for no text.
float parse_ellipse(std::string_view text);

}  // namespace rawtexel::cli
