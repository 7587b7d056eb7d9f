#include "cli/lookup_options.h"

#include "cli/footprint_options.h"
#include "cli/option_values.h"
#include "cli/texture_options.h"

#include <algorithm>

namespace rawtexel::cli {
namespace {

using texunit::Kernel;
using texunit::KernelInfo;
using texunit::MipMode;
using texunit::Precision;

/// Stands for the absence of a choice.
constexpr std::string_view kScene = "scene";

/// Why `text`, which names `kernel`, is none.
UsageError bad_parameters(const KernelInfo& kernel, std::string_view text) {
    const std::string start = "--filter: '" + std::string(text) + "'", name(kernel.name);
    if (kernel.parameters.empty()) return UsageError(start + " has parameters (allowed: " + name + " alone)");
    const std::string form = name + "[:" + std::string(kernel.parameters) + "]";
    const bool is_sigma = kernel.parameters == "SIGMA";
    const NumberRange range =
        is_sigma ? NumberRange{texunit::kLeastSigma, texunit::kMostSigma} : NumberRange{-texunit::kMostMitchell, texunit::kMostMitchell};
    return UsageError(start + " is not " + form + " with " + (is_sigma ? "SIGMA" : "B and C") + " from " + print(range));
}

}  // namespace

std::optional<Kernel> parse_filter(std::string_view text) {
    if (text == kScene) return std::nullopt;
    if (const std::optional<Kernel> kernel = texunit::parse_kernel(text)) return kernel;
    const std::string_view name = text.substr(0, text.find(':'));
    std::vector<std::string> names{std::string(kScene)};
    for (const KernelInfo& kernel : texunit::all_kernels()) {
        if (kernel.name == name) throw bad_parameters(kernel, text);
        names.emplace_back(kernel.name);
    }
    throw unknown_value("--filter", name, names);
}

std::string print_filter(const std::optional<Kernel>& filter) { return filter ? to_string(*filter) : std::string(kScene); }

std::optional<MipMode> parse_mip(std::string_view text) {
    if (text == kScene) return std::nullopt;
    if (const std::optional<MipMode> mode = texunit::parse_mip_mode(text)) return mode;
    throw unknown_value("--mip", text, std::vector<std::string>{std::string(kScene), "linear", "nearest", "none"});
}

std::string print_mip(const std::optional<MipMode>& mip) { return std::string(mip ? to_string(*mip) : kScene); }

texunit::MipStorage parse_mip_storage(std::string_view text) {
    return parse_word("--mip-storage", text, {"source", "float"}) == 0 ? texunit::MipStorage::Source : texunit::MipStorage::Float;
}

std::string print(texunit::MipStorage storage) { return storage == texunit::MipStorage::Source ? "source" : "float"; }

void declare_lookup_options(CommandLine& line, LookupOptions& lookup) {
    line.option("--filter", "NAME[:PARAM]",
                "how texels become a colour: one of `rawtexel list filters`, such as bspline or gaussian:0.7 (default scene: what the "
                "file's samplers say, bilinear where there are none)",
                [&](const std::string& text) { lookup.filter = parse_filter(text); });
    line.option("--mip", "scene|linear|nearest|none",
                "between which levels a minified lookup reads (default scene: what the file's samplers say, linear where there are none)",
                [&](const std::string& text) { lookup.mip = parse_mip(text); });
    line.option("--precision", "exact|gpu",
                "fractions of texels and levels as they are (the default), or in steps of 1/256 as GPUs take them",
                [&](const std::string& text) {
                    lookup.precision = parse_choice("--precision", text, {Precision::Exact, Precision::Gpu});
                });
    line.option("--mip-storage", "source|float", "generated levels rounded to the image's own format (the default), or kept in float",
                [&](const std::string& text) { lookup.mip_storage = parse_mip_storage(text); });
    declare_texture_options(line, lookup.files);
}

void check_texture_jitter(const LookupOptions& lookup) {
    if (lookup.filtering.texture_jitter == shading::TextureJitter::None) return;
    const std::string option = "--texture-jitter " + std::string(to_string(lookup.filtering.texture_jitter));
    if (lookup.mip != MipMode::None) throw UsageError(option + " filters minified textures by itself (allowed: with --mip none)");
    if (!(lookup.footprint == shading::FootprintOptions{}) || lookup.names_lod_rule)
        throw UsageError(option +
                         " looks up points without footprints (not allowed with --aniso, --ewa, --lod-*, --hybrid-bias, "
                         "--derivatives and --footprint)");
    if (lookup.filtering.baseline != shading::Baseline::None)
        throw UsageError(option + ": --baseline " + std::string(to_string(lookup.filtering.baseline)) +
                         " says itself how maps are looked up");
}

void check_lookup(const LookupOptions& lookup) {
    const shading::FootprintOptions& footprint = lookup.footprint;
    check_hybrid_bias(footprint, lookup.filtering);
    if (footprint.probe_variance > 0 && lookup.names_lod_rule)
        throw UsageError("--lod-rule: --aniso N:S2 always takes the axes of the ellipse");
    if (footprint.ellipse <= 0 && footprint.hybrid_bias && lookup.mip == MipMode::None)
        throw UsageError("--hybrid-bias: --mip none reads level 0, and no level is finer");
    if (footprint.ellipse <= 0) return;
    const std::pair<bool, const char*> taken[] = {{lookup.filter.has_value(), "--filter"},
                                                  {lookup.mip.has_value(), "--mip"},
                                                  {lookup.names_lod_rule, "--lod-rule"},
                                                  {footprint.lod_bias != 0, "--lod-bias"},
                                                  {lookup.precision != texunit::Precision::Exact, "--precision gpu"}};
    for (const auto& [given, option] : taken)
        if (given) throw UsageError(std::string(option) + ": --ewa has kernel, level and axes of its own, and rounds no fractions");
}

std::vector<std::pair<std::string, std::string>> print_choices(const LookupOptions& lookup) {
    const shading::FootprintOptions& footprint = lookup.footprint;
    return {{"filter", print_filter(lookup.filter)},
            {"mip", print_mip(lookup.mip)},
            {"aniso", print_anisotropy(footprint)},
            {"ewa", print_ellipse(footprint.ellipse)},
            {"lod-rule", std::string(to_string(footprint.lod_rule))},
            {"lod-bias", print_number(footprint.lod_bias)},
            {"derivatives", std::string(to_string(footprint.derivatives))},
            {"footprint", std::string(to_string(footprint.area))},
            {"hybrid-bias", footprint.hybrid_bias ? print_number(*footprint.hybrid_bias) : "none"},
            {"estimator", std::string(to_string(lookup.filtering.estimator))},
            {"draws", std::to_string(lookup.filtering.taps)},
            {"order", std::string(to_string(lookup.filtering.effective_order()))},
            {"random", std::string(to_string(lookup.filtering.sharing))},
            {"blend", std::string(to_string(lookup.filtering.effective_blend()))},
            {"shadow-taps", std::string(to_string(lookup.filtering.shadow_taps))},
            {"texture-jitter", std::string(to_string(lookup.filtering.texture_jitter))},
            {"noise", std::string(to_string(lookup.filtering.noise))},
            {"signed-numbers", lookup.filtering.common_numbers ? "common" : "independent"},
            {"baseline", std::string(to_string(lookup.filtering.baseline))},
            {"precision", std::string(to_string(lookup.precision))},
            {"mip-storage", print(lookup.mip_storage)},
            {"bc-rounding", std::string(to_string(lookup.files.bc_rounding))}};
}

}  // namespace rawtexel::cli
