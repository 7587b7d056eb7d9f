#include "shading/footprint_options.h"

#include <cassert>
#include <cmath>

namespace rawtexel::shading {

DerivativeRule derivative_rule(const FootprintOptions& options, int spp) {
    assert(spp > 0);
    const float scale = options.area == FootprintArea::Sample ? float(1 / std::sqrt(double(spp))) : 1.0f;
    return {options.derivatives == Derivatives::Quad, scale};
}

void override_footprint(const FootprintOptions& options, texunit::SamplerState& sampler) {
    if (options.probes) sampler.probes = *options.probes;
    sampler.probe_variance = options.probe_variance;
    sampler.ellipse = options.ellipse;
    sampler.lod_rule = options.lod_rule;
    sampler.lod_bias += options.lod_bias;
    if (!options.hybrid_bias) return;
    if (options.ellipse > 0) {
        sampler.hybrid_bias = *options.hybrid_bias;
    } else {
        sampler.lod_bias -= *options.hybrid_bias;
    }
}

}  // namespace rawtexel::shading
