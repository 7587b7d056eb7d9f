#include "cli/filtering_options.h"

#include "cli/option_values.h"

namespace rawtexel::cli {

using shading::Blend;
using shading::FilteringOptions;
using shading::FilterOrder;
using shading::NumberSharing;
using shading::ShadowTaps;
using shading::TextureJitter;
using texunit::Estimator;

texunit::Estimator read_estimator(const std::string& text) {
    return parse_choice("--estimator", text, {Estimator::All, Estimator::Reservoir, Estimator::Jitter, Estimator::AbsWeight});
}
texunit::Noise read_noise(const std::string& text) {
    using texunit::Noise;
    return parse_choice("--noise", text, {Noise::White, Noise::Sobol, Noise::R2, Noise::Blue, Noise::Stbn});
}
int read_taps(const std::string& text) { return int(parse_integer("--taps", text, 1, shading::kMostTaps)); }
bool read_common_numbers(const std::string& text) { return parse_word("--signed-numbers", text, {"independent", "common"}) == 1; }

void declare_filtering_options(CommandLine& line, FilteringOptions& filtering) {
    line.option("--estimator", "all|reservoir|jitter|abs-weight",
                "every tap weighed (the default); one drawn from the weights, two where a kernel has negative lobes; the coordinate "
                "jittered, then the nearest texel; one drawn by magnitude, for comparison",
                [&](const std::string& text) { filtering.estimator = read_estimator(text); });
    line.option("--taps", "K", "draws a lookup, 1 to " + std::to_string(shading::kMostTaps) + " (default 1)",
                [&](const std::string& text) { filtering.taps = read_taps(text); });
    line.option("--order", "before|after",
                "maps are filtered, then shaded; or raw texels are shaded, then filtered (default before with all, after with an estimator "
                "that draws)",
                [&](const std::string& text) {
                    filtering.order = parse_choice("--order", text, {FilterOrder::Before, FilterOrder::After});
                });
    line.option("--random", "shared|per-map",
                "the maps of a material draw with the same numbers (the default), or each with its own: the named wrong way",
                [&](const std::string& text) {
                    filtering.sharing = parse_choice("--random", text, {NumberSharing::Shared, NumberSharing::PerMap});
                });
    line.option("--noise", "white|sobol|r2|blue|stbn", "numbers of the draws: one of `rawtexel list noises` (default white)",
                [&](const std::string& text) { filtering.noise = read_noise(text); });
    line.option("--blend", "all|draw",
                "planes of triplanar materials and layers of layered ones: every one looked up and weighed, or one drawn at each point "
                "(default draw with an estimator that draws, else all)",
                [&](const std::string& text) {
                    filtering.blend = parse_choice("--blend", text, {Blend::All, Blend::Draw});
                });
    line.option("--shadow-taps", "all|one", "depth tests of the sun's shadow: a tent of 16 (the default), or one drawn from it",
                [&](const std::string& text) {
                    filtering.shadow_taps = parse_choice("--shadow-taps", text, {ShadowTaps::All, ShadowTaps::One});
                });
    line.option(
        "--texture-jitter", "none|perspective|affine",
        "textures are looked up where the sample lies (the default), or at a point of the pixel filter of their own, in perspective or "
        "by a step along the derivatives: filters minified textures with --mip none",
        [&](const std::string& text) {
            filtering.texture_jitter =
                parse_choice("--texture-jitter", text, {TextureJitter::None, TextureJitter::Perspective, TextureJitter::Affine});
        });
    line.option("--signed-numbers", "independent|common",
                "numbers of the draws from positive and from negative weights: their own (the default), or the same",
                [&](const std::string& text) { filtering.common_numbers = read_common_numbers(text); });
}

void check_filtering(const FilteringOptions& filtering, const std::optional<texunit::Kernel>& filter) {
    if (!filtering.draws()) {
        if (filtering.taps != 1) throw UsageError("--taps: --estimator all weighs every tap and draws none");
        if (filtering.sharing == NumberSharing::PerMap) throw UsageError("--random per-map: --estimator all draws no numbers");
        if (filtering.common_numbers) throw UsageError("--signed-numbers common: --estimator all draws no numbers");
        return;
    }
    const bool one_texel = !filter || texunit::weighs_as_probability(*filter);
    if (filtering.order == FilterOrder::Before && filtering.taps == 1 && one_texel)
        throw UsageError(
            "--order before: one draw is a raw texel, which is shaded as it is: that is --order after (--taps 2 and more "
            "are averaged before shading)");
}

}  // namespace rawtexel::cli
