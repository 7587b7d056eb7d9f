#include "texunit/draw.h"

#include <cassert>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "texunit/draw.cpp"
#include <hwy/foreach_target.h>

#include "texunit/draw-inl.h"
#include "texunit/random-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rawtexel::texunit {
namespace HWY_NAMESPACE {

/// Numbers of a texel along either axis and of its sign.
struct TexelDimensions {
    Dimension x, y, sign;
};
constexpr TexelDimensions kPositive{Dimension::TapX, Dimension::TapY, Dimension::Sign};
constexpr TexelDimensions kNegative{Dimension::NegativeX, Dimension::NegativeY, Dimension::NegativeSign};

void hash_numbers(const RandomAddress& first, bool negative, DrawNumbers& numbers) {
    const hn::ScalableTag<uint32_t> du;
    const TexelDimensions& texel = negative ? kNegative : kPositive;
    for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(du)) {
        const auto lane = hn::Iota(du, uint32_t(i));
        const auto x = hn::Add(hn::Set(du, first.x), hn::And(lane, hn::Set(du, kWaveWidth - 1)));
        const auto y = hn::Add(hn::Set(du, first.y), hn::ShiftRight<3>(lane));
        static_assert(kWaveWidth == 1 << 3);
        const auto state = random_state_v(du, first.seed, first.sample, x, y, hn::Set(du, first.surface));
        const auto number = [&](Dimension dimension, WaveFloat& out)
                                HWY_ATTR { hn::Store(unit_float_v(du, random_bits_v(du, state, dimension)), FloatTag(), out.lane + i); };
        number(texel.x, numbers.x);
        number(texel.y, numbers.y);
        number(texel.sign, numbers.sign);
        number(Dimension::Level, numbers.level);
        number(Dimension::Probe, numbers.probe);
    }
}

/// Coordinates whose inactive lanes repeat an active one, and the layers.
const WaveCoordinates& prepare(const Texture& texture, const WaveCoordinates& at, WaveMask mask, const WaveFloat* layer,
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

void draw_signed(Texture& texture, const SamplerState& sampler, const WaveCoordinates& at, WaveMask mask, const DrawNumbers& positive,
                 const DrawNumbers& negative, SignedDraw& drawn, const WaveFloat* layer) {
    WaveCoordinates filled;
    const WaveCoordinates& coordinates = prepare(texture, at, mask, layer, filled, drawn.positive.slice);
    drawn.negative.slice = drawn.positive.slice;
    draw_signed_lanes(texture.levels(), sampler, coordinates, mask, positive, negative, drawn);
}

void draw(Texture& texture, const SamplerState& sampler, const WaveCoordinates& at, WaveMask mask, const DrawNumbers& numbers,
          TexelDraw& drawn, const WaveFloat* layer) {
    WaveCoordinates filled;
    const WaveCoordinates& coordinates = prepare(texture, at, mask, layer, filled, drawn.slice);
    draw_lanes(texture.levels(), sampler, coordinates, mask, numbers, drawn);
}

void read(Texture& texture, const SamplerState& sampler, const TexelDraw& drawn, WaveColor& out) {
    read_drawn_lanes(texture, sampler, drawn, out);
}

void draw_and_read(Texture& texture, const SamplerState& sampler, const WaveCoordinates& at, WaveMask mask, const DrawNumbers& numbers,
                   WaveColor& out, const WaveFloat* layer) {
    TexelDraw drawn;
    draw(texture, sampler, at, mask, numbers, drawn, layer);
    read_drawn_lanes(texture, sampler, drawn, out);
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::texunit
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rawtexel::texunit {

HWY_EXPORT(hash_numbers);
HWY_EXPORT(draw);
HWY_EXPORT(draw_signed);
HWY_EXPORT(read);
HWY_EXPORT(draw_and_read);

void draw_numbers(const RandomAddress& first, DrawNumbers& numbers) { HWY_DYNAMIC_DISPATCH(hash_numbers)(first, false, numbers); }
void negative_draw_numbers(const RandomAddress& first, DrawNumbers& numbers) { HWY_DYNAMIC_DISPATCH(hash_numbers)(first, true, numbers); }

bool weighs_as_probability(const Kernel& kernel) {
    switch (kernel.kind) {
        case KernelKind::Mitchell: return kernel.c == 0 && kernel.b >= 1 && kernel.b <= 1;
        case KernelKind::CatmullRom:
        case KernelKind::Lanczos2:
        case KernelKind::Lanczos3: return false;
        default: return true;
    }
}

void draw_wave(Texture& texture, const SamplerState& sampler, const WaveCoordinates& at, WaveMask mask, const DrawNumbers& numbers,
               TexelDraw& drawn, const WaveFloat* layer) {
    assert(mask != 0 && texture.shape().depth == 1 && sampler.ellipse <= 0);
    assert(weighs_as_probability(sampler.magnify) && weighs_as_probability(sampler.minify));
    HWY_DYNAMIC_DISPATCH(draw)(texture, sampler, at, mask, numbers, drawn, layer);
}

void draw_signed_wave(Texture& texture, const SamplerState& sampler, const WaveCoordinates& at, WaveMask mask, const DrawNumbers& positive,
                      const DrawNumbers& negative, SignedDraw& drawn, const WaveFloat* layer) {
    assert(mask != 0 && texture.shape().depth == 1 && sampler.ellipse <= 0);
    HWY_DYNAMIC_DISPATCH(draw_signed)(texture, sampler, at, mask, positive, negative, drawn, layer);
}

void read_drawn_wave(Texture& texture, const SamplerState& sampler, const TexelDraw& drawn, WaveColor& out) {
    HWY_DYNAMIC_DISPATCH(read)(texture, sampler, drawn, out);
}

void sample_drawn_wave(Texture& texture, const SamplerState& sampler, const WaveCoordinates& at, WaveMask mask, const DrawNumbers& numbers,
                       WaveColor& out, const WaveFloat* layer) {
    assert(mask != 0 && texture.shape().depth == 1 && sampler.ellipse <= 0);
    assert(weighs_as_probability(sampler.magnify) && weighs_as_probability(sampler.minify));
    HWY_DYNAMIC_DISPATCH(draw_and_read)(texture, sampler, at, mask, numbers, out, layer);
}

}  // namespace rawtexel::texunit
#endif
