#include "shading/baseline.h"

#include <algorithm>

namespace rawtexel::shading {
namespace {

constexpr BaselineInfo kBaselines[] = {
    {Baseline::None, "none", "filtering as the other options say"},
    {Baseline::Toksvig, "toksvig", "before shading; gloss from the length of the filtered normal"},
    {Baseline::Lean, "lean", "before shading; an anisotropic lobe from the filtered covariance of the normal map's slopes"},
    {Baseline::Clean, "clean", "before shading; gloss from the filtered variance of the normal map's slopes"},
    {Baseline::UeDither, "ue-dither", "the Unreal software renderer's ordered 2x2 dither: one raw texel, shaded"},
    {Baseline::StartrekDither, "startrek-dither", "Star Trek 25th Anniversary's eight-threshold dither: one raw texel, shaded"},
    {Baseline::OiioStochastic, "oiio-stochastic", "before shading; one of the two levels is drawn, and filtered as usual"},
    {Baseline::Moonray, "moonray", "closest texel of the closest level where minified, bilinear where magnified; shaded afterwards"},
};

}  // namespace

std::span<const BaselineInfo> all_baselines() { return kBaselines; }

std::string_view to_string(Baseline baseline) { return kBaselines[size_t(baseline)].name; }

std::optional<Baseline> parse_baseline(std::string_view text) {
    const auto found = std::ranges::find(kBaselines, text, &BaselineInfo::name);
    if (found == std::end(kBaselines)) return std::nullopt;
    return found->baseline;
}

texunit::Dither dither_of(Baseline baseline) {
    switch (baseline) {
        case Baseline::UeDither: return texunit::Dither::Unreal;
        case Baseline::StartrekDither: return texunit::Dither::StarTrek;
        default: return texunit::Dither::None;
    }
}

void override_baseline(Baseline baseline, texunit::SamplerState& sampler) {
    using texunit::Kernel;
    const bool dithers = is_dither(baseline), moonray = baseline == Baseline::Moonray;
    if (!dithers && !moonray && !draws_level(baseline)) return;
    // The level drawn by oiio-stochastic is the nearest one of a footprint scaled at random.
    if (sampler.mip != texunit::MipMode::None) sampler.mip = texunit::MipMode::Nearest;
    sampler.probes = 1;
    if (dithers) sampler.estimator = texunit::Estimator::Reservoir;
    if (dithers || moonray) sampler.magnify = sampler.minify = Kernel::Bilinear;
    if (moonray) sampler.minify = Kernel::Nearest;
}

}  // namespace rawtexel::shading
