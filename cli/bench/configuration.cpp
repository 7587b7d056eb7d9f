#include "cli/bench/configuration.h"

#include "cli/footprint_options.h"
#include "cli/option_values.h"

#include <algorithm>

namespace rawtexel::cli {
namespace {

using shading::FilterOrder;
using texunit::Estimator;
using texunit::MipMode;

bool has_lobes(const Configuration& configuration) {
    return configuration.filter && !texunit::weighs_as_probability(*configuration.filter);
}

shading::FootprintOptions footprint_of(const Minification& minification, shading::FootprintOptions footprint) {
    footprint.probes = minification.probes;
    footprint.probe_variance = minification.probe_variance;
    footprint.ellipse = minification.ellipse;
    footprint.hybrid_bias = minification.hybrid_bias;
    return footprint;
}

}  // namespace

std::string print(const Minification& minification) {
    const shading::FootprintOptions footprint = footprint_of(minification, {});
    std::string text = minification.ellipse > 0 ? "ewa " + print_ellipse(minification.ellipse) : "mip " + print_mip(minification.mip);
    if (minification.probes) text += ", aniso " + print_anisotropy(footprint);
    if (minification.hybrid_bias) text += ", hybrid " + print_number(*minification.hybrid_bias);
    return text;
}

std::vector<std::string> options_of(const Configuration& configuration) {
    const Minification& minification = configuration.minification;
    std::vector<std::string> words;
    const auto add = [&](const char* option, const std::string& value) { words.insert(words.end(), {option, value}); };
    if (minification.ellipse > 0) {
        words.push_back("--ewa:" + print_ellipse(minification.ellipse));
    } else {
        add("--filter", print_filter(configuration.filter));
        add("--mip", print_mip(minification.mip));
    }
    if (minification.probes) add("--aniso", print_anisotropy(footprint_of(minification, {})));
    if (minification.hybrid_bias) add("--hybrid-bias", print_number(*minification.hybrid_bias));
    add("--estimator", std::string(to_string(configuration.estimator)));
    add("--order", std::string(to_string(configuration.order)));
    if (configuration.spp > 0) add("--spp", std::to_string(configuration.spp));
    return words;
}

RenderRequest with_configuration(RenderRequest base, const Configuration& configuration) {
    LookupOptions& lookup = base.lookup;
    lookup.filter = configuration.filter;
    lookup.mip = configuration.minification.mip;
    lookup.footprint = footprint_of(configuration.minification, lookup.footprint);
    shading::FilteringOptions& filtering = lookup.filtering;
    filtering.estimator = configuration.estimator;
    filtering.order = configuration.order;
    base.samples.spp = configuration.spp;
    const shading::FilteringOptions plain;
    if (configuration.estimator == Estimator::All) {
        filtering.taps = plain.taps;
        filtering.sharing = plain.sharing;
        const bool draws_otherwise = filtering.texture_jitter != shading::TextureJitter::None || filtering.blend == shading::Blend::Draw ||
                                     filtering.shadow_taps == shading::ShadowTaps::One || draws_level(filtering.baseline);
        if (!draws_otherwise) filtering.noise = plain.noise;
    }
    if (configuration.estimator != Estimator::Reservoir || !has_lobes(configuration)) filtering.common_numbers = plain.common_numbers;
    return base;
}

bool is_one_tap(const Configuration& configuration, const RenderRequest& base) {
    const bool draws = configuration.estimator == Estimator::Reservoir || configuration.estimator == Estimator::Jitter;
    return draws && !has_lobes(configuration) && base.lookup.filtering.taps == 1;
}

double weighed_texels(const Configuration& configuration) {
    const Minification& minification = configuration.minification;
    if (minification.ellipse > 0) return 64;
    const double axis = configuration.filter ? texunit::axis_taps(*configuration.filter) : 2;
    const double levels = minification.mip && *minification.mip != MipMode::Linear ? 1 : 2;
    // Few pixels take all the probes that they may.
    return axis * axis * levels * std::min(minification.probes.value_or(1), 4);
}

double shaded_texels(const Configuration& configuration) {
    if (configuration.estimator != Estimator::All) return has_lobes(configuration) ? 2 : 1;
    return configuration.order == FilterOrder::After ? weighed_texels(configuration) : 1;
}

double effort(const Configuration& configuration) {
    const double weighed = configuration.estimator == Estimator::All ? weighed_texels(configuration) : 4;
    return shaded_texels(configuration) + 0.03 * weighed;
}

}  // namespace rawtexel::cli
