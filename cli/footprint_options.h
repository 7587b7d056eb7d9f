// The options that say how a pixel's footprint on a texture is found and filtered.
#pragma once

#include "cli/command_line.h"
#include "shading/filtering_options.h"
#include "shading/footprint_options.h"

#include <string>
#include <string_view>

namespace rawtexel::cli {

/// --aniso, --ewa, --lod-rule, --lod-bias and --hybrid-bias: what becomes of derivatives. `names_rule` becomes true where a rule is given.
void declare_lod_options(CommandLine& line, shading::FootprintOptions& footprint, bool* names_rule = nullptr);
/// The same, with --derivatives and --footprint: where a frame's derivatives come from.
void declare_footprint_options(CommandLine& line, shading::FootprintOptions& footprint, bool* names_rule = nullptr);

/// Throws UsageError where a bias has nothing to act on.
void check_hybrid_bias(const shading::FootprintOptions& footprint, const shading::FilteringOptions& filtering);

/// N or N:S2, 1 <= N <= 64, 0.001 <= S2 <= 4.
void parse_anisotropy(std::string_view text, shading::FootprintOptions& footprint);
std::string print_anisotropy(const shading::FootprintOptions& footprint);
/// S2 in the same range, or 1/6 for no text.
float parse_ellipse(std::string_view text);
/// "none", or S2.
std::string print_ellipse(float ellipse);
std::string_view to_string(shading::Derivatives derivatives);  // analytic quad
std::string_view to_string(shading::FootprintArea area);       // pixel sample

}  // namespace rawtexel::cli
