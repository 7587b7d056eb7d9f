#include "texunit/draw.h"

#include <algorithm>
#include <cassert>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "texunit/draw.cpp"
#include <hwy/foreach_target.h>

#include "texunit/draw-inl.h"
#include "texunit/draw_lanes-inl.h"
#include "texunit/random-inl.h"
#include "texunit/shared_draw-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rawtexel::texunit {
namespace HWY_NAMESPACE {

/// Numbers of a texel along either axis and of its sign.
struct TexelDimensions {
    Dimension x, y, sign;
};
constexpr TexelDimensions kPositive{Dimension::TapX, Dimension::TapY, Dimension::Sign};
constexpr TexelDimensions kNegative{Dimension::NegativeX, Dimension::NegativeY, Dimension::NegativeSign};

HWY_INLINE void hash_numbers(const RandomAddress& first, const TexelDimensions& texel, const NumberRoles& roles, RandomStates& states,
                             DrawNumbers& numbers) {
    const auto hash = [&](Dimension dimension, WaveFloat& to) HWY_ATTR { random_wave(states.of(first, dimension), first.x, first.y, to); };
    hash(texel.x, numbers.x);
    hash(texel.y, numbers.y);
    if (roles.sign) hash(texel.sign, numbers.sign);
    if (roles.level) hash(Dimension::Level, numbers.level);
    if (roles.probe) hash(Dimension::Probe, numbers.probe);
}

void find_noise(Noise noise, const RandomAddress& first, const TexelDimensions& texel, const NumberRoles& roles, DrawNumbers& numbers) {
    const auto of = [&](Dimension dimension) {
        RandomAddress address = first;
        address.dimension = dimension;
        return address;
    };
    noise_pair_wave(noise, of(texel.x), texel.y, numbers.x, numbers.y);
    if (roles.sign) noise_wave(noise, of(texel.sign), numbers.sign);
    if (roles.level) noise_wave(noise, of(Dimension::Level), numbers.level);
    if (roles.probe) noise_wave(noise, of(Dimension::Probe), numbers.probe);
}

void number_lanes(const RandomAddress& first, bool negative, Noise noise, const NumberRoles& roles, RandomStates& states,
                  DrawNumbers& numbers) {
    const TexelDimensions& texel = negative ? kNegative : kPositive;
    if (noise == Noise::White) return hash_numbers(first, texel, roles, states, numbers);
    find_noise(noise, first, texel, roles, numbers);
}

/// Coordinates whose inactive lanes repeat an active one, and the layers.
HWY_INLINE const WaveCoordinates& prepare(const Texture& texture, const WaveCoordinates& at, WaveMask mask, const WaveFloat* layer,
                                          WaveCoordinates& filled, WaveInt& slice) {
    if (layer != nullptr) {
        select_layers(*layer, mask, texture.shape().layers, slice);
    } else {
        slice = {};
    }
    if (mask == kWaveFull) return at;
    fill_inactive(at, mask, filled);
    return filled;
}

HWY_INLINE void draw(Texture& texture, const SamplerState& sampler, const WaveCoordinates& at, WaveMask mask, const DrawNumbers& numbers,
                     TexelDraw& drawn, const WaveFloat* layer) {
    WaveCoordinates filled;
    const WaveCoordinates& coordinates = prepare(texture, at, mask, layer, filled, drawn.slice);
    draw_lanes(flat_lookup(texture.levels(), sampler, coordinates), mask, numbers, Lobes::Positive, {}, drawn);
}

void draw_signed(Texture& texture, const SamplerState& sampler, const WaveCoordinates& at, WaveMask mask, const DrawNumbers& positive,
                 const DrawNumbers& negative, SignedDraw& drawn, const WaveFloat* layer) {
    WaveCoordinates filled;
    const WaveCoordinates& coordinates = prepare(texture, at, mask, layer, filled, drawn.positive.slice);
    drawn.negative.slice = drawn.positive.slice;
    const DrawnLookup lookup = flat_lookup(texture.levels(), sampler, coordinates);
    WaveFloat& mass = drawn.negative_weight;
    draw_lanes(lookup, mask, positive, Lobes::Positive, {nullptr, &mass}, drawn.positive);
    draw_lanes(lookup, mask, negative, Lobes::Negative, {&mass, nullptr}, drawn.negative);
    for (int lane = 0; lane < kWaveLanes; ++lane) drawn.positive_weight[lane] = 1 + mass[lane];
}

void draw_absolute(Texture& texture, const SamplerState& sampler, const WaveCoordinates& at, WaveMask mask, const DrawNumbers& numbers,
                   TexelDraw& drawn, WaveFloat& factor, const WaveFloat* layer) {
    WaveCoordinates filled;
    const WaveCoordinates& coordinates = prepare(texture, at, mask, layer, filled, drawn.slice);
    draw_lanes(flat_lookup(texture.levels(), sampler, coordinates), mask, numbers, Lobes::Magnitude, {nullptr, &factor}, drawn);
}

void read_drawn_lanes(Texture& texture, const SamplerState& sampler, const TexelDraw& drawn, WaveColor& out) {
    read_drawn_texels(texture, sampler, drawn, out);
}

void draw_and_read(Texture& texture, const SamplerState& sampler, const WaveCoordinates& at, WaveMask mask, const DrawNumbers& numbers,
                   WaveColor& out, const WaveFloat* layer) {
    TexelDraw drawn;
    draw(texture, sampler, at, mask, numbers, drawn, layer);
    read_drawn_texels(texture, sampler, drawn, out);
}

void count(const Texture& texture, const TexelDraw& drawn, WaveMask mask, bool first, FetchCounter& counter) {
    if (first) begin_lookups(texture, mask, counter);
    counter.texture = &texture;
    hear_texel(drawn.level, drawn.x, drawn.y, mask, drawn.border, counter);
}
void record(const Texture& texture, const TexelDraw& drawn, WaveMask mask, bool, TapSink& sink) {
    FetchRecorder recorder{&sink};
    begin_lookups(texture, mask, recorder);
    hear_texel(drawn.level, drawn.x, drawn.y, mask, drawn.border, recorder);
}

void draw_shared_lanes(const LookupSet& set, const DrawNumbers& positive, const DrawNumbers& negative, const UseTap& use) {
    draw_set(set, positive, negative, use);
}
void enumerate_shared_lanes(const LookupSet& set, const UseTap& use) { enumerate_set(set, use); }

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::texunit
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rawtexel::texunit {

HWY_EXPORT(number_lanes);
HWY_EXPORT(draw);
HWY_EXPORT(draw_signed);
HWY_EXPORT(draw_absolute);
HWY_EXPORT(read_drawn_lanes);
HWY_EXPORT(draw_and_read);
HWY_EXPORT(draw_shared_lanes);
HWY_EXPORT(count);
HWY_EXPORT(record);
HWY_EXPORT(enumerate_shared_lanes);

NumberRoles roles_of(const SamplerState& sampler) {
    const bool ellipse = sampler.ellipse > 0;
    const bool one_sign = weighs_as_probability(sampler.magnify) && weighs_as_probability(sampler.minify);
    return {.level = ellipse || sampler.mip == MipMode::Linear, .probe = ellipse || !sampler.is_isotropic(), .sign = ellipse || !one_sign};
}

void draw_numbers(const RandomAddress& first, DrawNumbers& numbers, Noise noise, const NumberRoles& roles, RandomStates& states) {
    HWY_DYNAMIC_DISPATCH(number_lanes)(first, false, noise, roles, states, numbers);
}
void draw_numbers(const RandomAddress& first, DrawNumbers& numbers, Noise noise, const NumberRoles& roles) {
    RandomStates states;
    draw_numbers(first, numbers, noise, roles, states);
}
void negative_draw_numbers(const RandomAddress& first, DrawNumbers& numbers, Noise noise, const NumberRoles& roles) {
    RandomStates states;
    HWY_DYNAMIC_DISPATCH(number_lanes)(first, true, noise, roles, states, numbers);
}

namespace {

void find_depth(Noise noise, RandomAddress first, Dimension dimension, DrawNumbers& numbers) {
    first.dimension = dimension;
    noise_wave(noise, first, numbers.z);
}

}  // namespace

void draw_depth_numbers(const RandomAddress& first, DrawNumbers& numbers, Noise noise) {
    find_depth(noise, first, Dimension::TapZ, numbers);
}
void negative_draw_depth_numbers(const RandomAddress& first, DrawNumbers& numbers, Noise noise) {
    find_depth(noise, first, Dimension::NegativeZ, numbers);
}

void draw_wave(Texture& texture, const SamplerState& sampler, const WaveCoordinates& at, WaveMask mask, const DrawNumbers& numbers,
               TexelDraw& drawn, const WaveFloat* layer) {
    assert(mask != 0 && texture.shape().depth == 1);
    assert(weighs_as_probability(sampler.magnify) && weighs_as_probability(sampler.minify));
    HWY_DYNAMIC_DISPATCH(draw)(texture, sampler, at, mask, numbers, drawn, layer);
}

void draw_signed_wave(Texture& texture, const SamplerState& sampler, const WaveCoordinates& at, WaveMask mask, const DrawNumbers& positive,
                      const DrawNumbers& negative, SignedDraw& drawn, const WaveFloat* layer) {
    assert(mask != 0 && texture.shape().depth == 1);
    HWY_DYNAMIC_DISPATCH(draw_signed)(texture, sampler, at, mask, positive, negative, drawn, layer);
}

void draw_absolute_wave(Texture& texture, const SamplerState& sampler, const WaveCoordinates& at, WaveMask mask, const DrawNumbers& numbers,
                        TexelDraw& drawn, WaveFloat& factor, const WaveFloat* layer) {
    assert(mask != 0 && texture.shape().depth == 1);
    HWY_DYNAMIC_DISPATCH(draw_absolute)(texture, sampler, at, mask, numbers, drawn, factor, layer);
}

void count_drawn_wave(const Texture& texture, const TexelDraw& drawn, WaveMask mask, bool first, FetchCounter& counter) {
    HWY_DYNAMIC_DISPATCH(count)(texture, drawn, mask, first, counter);
}
void record_drawn_wave(const Texture& texture, const TexelDraw& drawn, WaveMask mask, bool first, TapSink& sink) {
    HWY_DYNAMIC_DISPATCH(record)(texture, drawn, mask, first, sink);
}

void read_drawn_wave(Texture& texture, const SamplerState& sampler, const TexelDraw& drawn, WaveColor& out) {
    HWY_DYNAMIC_DISPATCH(read_drawn_lanes)(texture, sampler, drawn, out);
}

void sample_drawn_wave(Texture& texture, const SamplerState& sampler, const WaveCoordinates& at, WaveMask mask, const DrawNumbers& numbers,
                       WaveColor& out, const WaveFloat* layer) {
    assert(mask != 0 && texture.shape().depth == 1);
    assert(weighs_as_probability(sampler.magnify) && weighs_as_probability(sampler.minify));
    HWY_DYNAMIC_DISPATCH(draw_and_read)(texture, sampler, at, mask, numbers, out, layer);
}

void draw_shared(const LookupSet& set, const DrawNumbers& positive, const DrawNumbers& negative, const UseTap& use) {
    HWY_DYNAMIC_DISPATCH(draw_shared_lanes)(set, positive, negative, use);
}
void enumerate_shared(const LookupSet& set, const UseTap& use) { HWY_DYNAMIC_DISPATCH(enumerate_shared_lanes)(set, use); }

bool can_enumerate(const LookupSet& set) {
    if (set.count == 1) return true;
    return std::none_of(set.lookup, set.lookup + set.count, [](const SharedLookup& lookup) { return lookup.sampler->ellipse > 0; });
}

}  // namespace rawtexel::texunit
#endif
