#include "cli/footprint_options.h"

#include "cli/option_values.h"

#include "texunit/probe_table.h"

namespace rawtexel::cli {
namespace {

constexpr float kTentVariance = 1.0f / 6;  ///< pixels^2, of a tent two pixels wide
constexpr NumberRange kVariance{1e-3f, 4.0f};
constexpr NumberRange kHybridBias{0.0f, 16.0f};
constexpr NumberRange kBias{-16.0f, 16.0f};  ///< levels, as far as Vulkan implementations go

/// The ellipse takes no probes.
void check_one_filter(const shading::FootprintOptions& footprint) {
    if (footprint.probes && footprint.ellipse > 0) throw UsageError("--aniso and --ewa exclude each other: probes, or the exact ellipse");
}

}  // namespace

void parse_anisotropy(std::string_view text, shading::FootprintOptions& footprint) {
    const size_t colon = text.find(':');
    footprint.probes = int(parse_integer("--aniso", text.substr(0, colon), 1, texunit::kMostProbes));
    footprint.probe_variance = colon == std::string_view::npos ? 0.0f : parse_number("--aniso", text.substr(colon + 1), kVariance);
}

std::string print_anisotropy(const shading::FootprintOptions& footprint) {
    if (!footprint.probes) return "scene";
    const std::string count = std::to_string(*footprint.probes);
    return footprint.probe_variance > 0 ? count + ":" + print_number(footprint.probe_variance) : count;
}

float parse_ellipse(std::string_view text) { return text.empty() ? kTentVariance : parse_number("--ewa", text, kVariance); }

std::string print_ellipse(float ellipse) { return ellipse > 0 ? print_number(ellipse) : "none"; }

std::string_view to_string(shading::Derivatives derivatives) { return derivatives == shading::Derivatives::Quad ? "quad" : "analytic"; }
std::string_view to_string(shading::FootprintArea area) { return area == shading::FootprintArea::Sample ? "sample" : "pixel"; }

void declare_lod_options(CommandLine& line, shading::FootprintOptions& footprint, bool* names_rule) {
    line.option("--aniso", "N[:S2]",
                "anisotropic probes, 1 to 64 at most; with S2 probes and level together have the covariance of a pixel filter of that "
                "variance, " +
                    print(kVariance) + " (default: what the scene says)",
                [&](const std::string& text) {
                    parse_anisotropy(text, footprint);
                    check_one_filter(footprint);
                });
    line.flag_with_value("--ewa", "S2", "the exact elliptical Gaussian of covariance S2*J*J^T + I/6 over level 0 (S2 1/6) instead",
                         [&](const std::string& text) {
                             footprint.ellipse = parse_ellipse(text);
                             check_one_filter(footprint);
                         });
    line.option("--lod-rule", "d3d|exact", "ratio and axes from the two derivatives (the default), or by singular values",
                [&footprint, names_rule](const std::string& text) {
                    footprint.lod_rule = parse_choice("--lod-rule", text, {texunit::LodRule::D3d, texunit::LodRule::Exact});
                    if (names_rule != nullptr) *names_rule = true;
                });
    line.option("--lod-bias", "B", "added to every level of detail, " + print(kBias) + " (default 0)",
                [&](const std::string& text) { footprint.lod_bias = parse_number("--lod-bias", text, kBias); });
    line.option(
        "--hybrid-bias", "B",
        "reads levels finer by B, " + print(kHybridBias) +
            ", and leaves what they have not filtered to the jitter: of drawn ellipses their own, else the pixel's samples (default "
            "0; drawn ellipses: level 0)",
        [&](const std::string& text) { footprint.hybrid_bias = parse_number("--hybrid-bias", text, kHybridBias); });
}

void check_hybrid_bias(const shading::FootprintOptions& footprint, const shading::FilteringOptions& filtering) {
    if (footprint.hybrid_bias && footprint.ellipse > 0 && !filtering.draws())
        throw UsageError("--hybrid-bias: --ewa with --estimator all weighs every texel of level 0; an estimator that draws takes a bias");
}

void declare_footprint_options(CommandLine& line, shading::FootprintOptions& footprint, bool* names_rule) {
    declare_lod_options(line, footprint, names_rule);
    line.option("--derivatives", "analytic|quad", "per pixel (the default), or by differences within 2x2 pixels as GPUs do",
                [&](const std::string& text) {
                    const bool quad = parse_word("--derivatives", text, {"analytic", "quad"}) == 1;
                    footprint.derivatives = quad ? shading::Derivatives::Quad : shading::Derivatives::Analytic;
                });
    line.option("--footprint", "pixel|sample", "lookups filter the whole pixel (the default), or 1/sqrt(spp) of it",
                [&](const std::string& text) {
                    const bool sample = parse_word("--footprint", text, {"pixel", "sample"}) == 1;
                    footprint.area = sample ? shading::FootprintArea::Sample : shading::FootprintArea::Pixel;
                });
}

}  // namespace rawtexel::cli
