// One way to look textures up, as a sweep measures it.
#pragma once

#include "cli/render_options.h"

#include <optional>
#include <string>
#include <vector>

namespace rawtexel::cli {

/// How minified lookups are filtered.
struct Minification {
    std::optional<texunit::MipMode> mip = std::nullopt;  ///< unset: what the scene says, and of ellipses
    std::optional<int> probes = std::nullopt;            ///< unset: what the scene says
    float probe_variance = 0;
    float ellipse = 0;  ///< above 0: --ewa:ELLIPSE
    std::optional<float> hybrid_bias = std::nullopt;

    bool operator==(const Minification&) const = default;
};
/// Such as "mip none", "mip linear", "mip linear, aniso 16", "mip linear, hybrid 2" or "ewa 0.16666667".
std::string print(const Minification& minification);

struct Configuration {
    std::optional<texunit::Kernel> filter;  ///< unset: what the scene says
    Minification minification;
    texunit::Estimator estimator = texunit::Estimator::All;
    shading::FilterOrder order = shading::FilterOrder::Before;
    int spp = 1;

    bool operator==(const Configuration&) const = default;
};

/// The options of `render` that choose it, spelled as the command line takes them; `spp` of 0 leaves the samples out.
std::vector<std::string> options_of(const Configuration& configuration);

/// `base` looked up so. Options of draws alone (--taps, --random, --noise, --signed-numbers) are kept by configurations that draw.
RenderRequest with_configuration(RenderRequest base, const Configuration& configuration);

/// Whether one lookup is one drawn texel, of a kernel that weighs as a probability.
bool is_one_tap(const Configuration& configuration, const RenderRequest& base);

/// Texels that a lookup weighs, about: of the kernel, levels and probes; those of an ellipse count as 64.
double weighed_texels(const Configuration& configuration);
/// Shaded texels a sample, about: all that are weighed where each is shaded, one or two that are drawn, one where texels are filtered
/// first.
double shaded_texels(const Configuration& configuration);
/// Both, in shaded texels: what progress goes by.
double effort(const Configuration& configuration);

}  // namespace rawtexel::cli
