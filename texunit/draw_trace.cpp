#include "texunit/draw_trace.h"

#include "texunit/shared_draw.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace rawtexel::texunit {
namespace {

void spread(float value, WaveFloat& wave) { std::fill_n(wave.lane, kWaveLanes, value); }

WaveCoordinates3 spread(const LaneCoordinates3& at) {
    WaveCoordinates3 wave;
    for (size_t axis = 0; axis < 3; ++axis) {
        spread(at.position[axis], wave.position[axis]);
        spread(at.dx[axis], wave.dx[axis]);
        spread(at.dy[axis], wave.dy[axis]);
    }
    return wave;
}

/// Those that the sampler looks at.
RoleNumbers numbers_of(const SharedLookup& lookup, const DrawNumbers& numbers) {
    const SamplerState& sampler = *lookup.sampler;
    const bool ellipse = sampler.ellipse > 0;
    const bool positive = weighs_as_probability(sampler.magnify) && weighs_as_probability(sampler.minify);
    RoleNumbers roles{.x = numbers.x[0], .y = numbers.y[0], .z = {}, .level = {}, .probe = {}, .sign = {}};
    if (lookup.solid != nullptr) roles.z = numbers.z[0];
    if (ellipse ? std::isfinite(sampler.hybrid_bias) : sampler.mip == MipMode::Linear) roles.level = numbers.level[0];
    if (ellipse) return roles;
    if (!sampler.is_isotropic()) roles.probe = numbers.probe[0];
    if (!positive && sampler.estimator != Estimator::AbsWeight) roles.sign = numbers.sign[0];
    return roles;
}

void find_numbers(const SharedLookup& lookup, const DrawSource& source, const RandomAddress& address, DrawNumbers& positive,
                  DrawNumbers& negative) {
    draw_numbers(address, positive, source.noise);
    negative_draw_numbers(address, negative, source.noise);
    positive.z = negative.z = {};
    if (lookup.solid != nullptr) {
        draw_depth_numbers(address, positive, source.noise);
        negative_draw_depth_numbers(address, negative, source.noise);
    }
    if (source.common_numbers) negative = positive;
}

DrawTrace trace(Texture& texture, const SharedLookup& lookup, const DrawSource& source) {
    assert(source.draws >= 1 && lookup.sampler->estimator != Estimator::All);
    LookupSet set;
    set.mask = 1;
    set.count = 1;
    set.lookup[0] = lookup;
    const float share = 1 / float(source.draws);
    DrawTrace trace;
    for (int n = 0; n < source.draws; ++n) {
        RandomAddress address = source.address;
        address.sample += uint32_t(n);
        DrawNumbers positive, negative;
        find_numbers(lookup, source, address, positive, negative);
        const DrawNumbers* numbers = &positive;
        draw_shared(set, positive, negative, [&](const SharedTap& tap) {
            const TexelDraw& draw = tap.draw[0];
            const bool border = (draw.border & 1) != 0;
            const float weight = tap.weight[0] * share;
            TracedTap traced{draw.level[0], draw.slice[0], draw.x[0], draw.y[0], double(weight), border, {}};
            traced.value = border ? lookup.sampler->border : texture.texel(traced.level, traced.slice, traced.x, traced.y);
            for (size_t c = 0; c < 4; ++c) trace.result[c] += weight * traced.value[c];
            trace.taps.push_back({n, traced, numbers_of(lookup, *numbers)});
            numbers = &negative;
        });
    }
    return trace;
}

}  // namespace

DrawTrace trace_draws(Texture& texture, const SamplerState& sampler, const LaneCoordinates& at, const DrawSource& source, float layer) {
    WaveCoordinates wave;
    spread(at.u, wave.u), spread(at.v, wave.v);
    spread(at.dudx, wave.dudx), spread(at.dvdx, wave.dvdx);
    spread(at.dudy, wave.dudy), spread(at.dvdy, wave.dvdy);
    WaveFloat layers;
    spread(layer, layers);
    SharedLookup lookup{.levels = &texture.levels(), .sampler = &sampler, .at = &wave};
    if (texture.shape().layers > 1) lookup.layer = &layers, lookup.layers = texture.shape().layers;
    return trace(texture, lookup, source);
}

DrawTrace trace_volume_draws(Texture& texture, const SamplerState& sampler, const LaneCoordinates3& at, const DrawSource& source) {
    const WaveCoordinates3 wave = spread(at);
    return trace(texture, {.levels = &texture.levels(), .sampler = &sampler, .solid = &wave}, source);
}

DrawTrace trace_cube_draws(Texture& texture, const SamplerState& sampler, const LaneCoordinates3& direction, const DrawSource& source,
                           float cube) {
    const WaveCoordinates3 wave = spread(direction);
    WaveFloat cubes;
    spread(cube, cubes);
    SharedLookup lookup{.levels = &texture.levels(), .sampler = &sampler, .solid = &wave, .cube = true};
    if (texture.shape().cubes() > 1) lookup.layer = &cubes, lookup.layers = texture.shape().cubes();
    return trace(texture, lookup, source);
}

}  // namespace rawtexel::texunit
