// One texel a lookup: a probe, a level and a texel of the kernel, each drawn with a number of its own. Meaning: texunit/draw.h.
#include "texunit/draw.h"
#include "texunit/draw_signs-inl.h"
#include "texunit/ellipse_reservoir-inl.h"
#include "texunit/fetch_edges-inl.h"

#include <hwy/highway.h>

// Included once per instruction set (highway's guard for -inl.h files).
#if defined(RAWTEXEL_TEXUNIT_DRAW_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_TEXUNIT_DRAW_LANES_INL_H_
#undef RAWTEXEL_TEXUNIT_DRAW_LANES_INL_H_
#else
#define RAWTEXEL_TEXUNIT_DRAW_LANES_INL_H_
#endif

HWY_BEFORE_NAMESPACE();
namespace rawtexel::texunit {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

HWY_INLINE void take_lanes(const TexelDraw& from, WaveMask lanes, TexelDraw& to) {
    to.border = (to.border & ~lanes) | (from.border & lanes);
    for (; lanes != 0; lanes &= lanes - 1) {
        const auto lane = int(hwy::Num0BitsBelowLS1Bit_Nonzero32(lanes));
        to.x[lane] = from.x[lane], to.y[lane] = from.y[lane], to.slice[lane] = from.slice[lane];
    }
}

/// factor = the magnitudes' sum over all axes, with the sign of the drawn texel's weight.
HWY_INLINE void find_factor(const SignedTaps& taps, const DrawNumbers& numbers, WaveFloat& factor) {
    const FloatTag d;
    WaveMask negative = negative_lanes(taps.x, taps.sums_x, numbers.x) ^ negative_lanes(taps.y, taps.sums_y, numbers.y);
    if (taps.volume) negative ^= negative_lanes(taps.z, taps.sums_z, numbers.z);
    const auto magnitude = [&](const SignedSums& sums, size_t i)
                               HWY_ATTR { return hn::Add(hn::Load(d, sums.positive.lane + i), hn::Load(d, sums.negative.lane + i)); };
    for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
        auto sum = hn::Mul(magnitude(taps.sums_x, i), magnitude(taps.sums_y, i));
        if (taps.volume) sum = hn::Mul(sum, magnitude(taps.sums_z, i));
        hn::Store(hn::IfThenElse(lanes_of(d, negative, i), hn::Neg(sum), sum), d, factor.lane + i);
    }
}

/// By magnitude, axis by axis.
HWY_INLINE void draw_magnitude(const SignedTaps& taps, const DrawNumbers& numbers, WaveFloat* factor, TexelDraw& draw) {
    draw.border = draw_of_axis(taps.x, OfMagnitude(taps.sums_x), numbers.x, draw.x);
    draw.border |= draw_of_axis(taps.y, OfMagnitude(taps.sums_y), numbers.y, draw.y);
    if (taps.volume) draw.border |= draw_of_axis(taps.z, OfMagnitude(taps.sums_z), numbers.z, draw.slice);
    if (factor != nullptr) find_factor(taps, numbers, *factor);
}

HWY_NOINLINE inline void draw_signed_texels(const DrawnLookup& lookup, const Kernel& kernel, const DrawnPlace& place,
                                            const DrawNumbers& numbers, Lobes lobes, const LobeMass& mass, TexelDraw& draw) {
    SignedTaps taps;
    select_signed_axes(lookup, kernel, place, taps);
    if (lobes == Lobes::Magnitude) return draw_magnitude(taps, numbers, mass.found, draw);
    const DrawnSigns signs = draw_signs(taps, lobes, mass, numbers.sign);
    draw.border = draw_of_axis(taps.x, OfOneSign(taps.sums_x, signs.negative_x), numbers.x, draw.x);
    draw.border |= draw_of_axis(taps.y, OfOneSign(taps.sums_y, signs.negative_y), numbers.y, draw.y);
    if (taps.volume) draw.border |= draw_of_axis(taps.z, OfOneSign(taps.sums_z, signs.negative_z), numbers.z, draw.slice);
}

/// Without lists of taps: by jittered coordinates, or from the weights of few taps.
template <class Place>
HWY_INLINE void draw_places(const DrawnLookup& lookup, const Place& how, const DrawnPlace& place, const DrawNumbers& numbers,
                            TexelDraw& draw) {
    const LevelTable& table = *lookup.levels;
    const SamplerState& sampler = *lookup.sampler;
    const WavePosition& at = *place.position;
    const auto by_rule = [&](EdgeRule rule, const auto& axes)
                             HWY_ATTR { return draw_placed(how, rule, axes, place.level, sampler.precision); };
    const DrawnAxis x{at.u, at.u_rest, &table.width, &numbers.x, &draw.x}, y{at.v, at.v_rest, &table.height, &numbers.y, &draw.y};
    const EdgeRule rule_x = cheapest_rule(rule_of(at, sampler.wrap_s), table.width);
    const EdgeRule rule_y = cheapest_rule(rule_of(at, sampler.wrap_t), table.height);
    if (rule_x == rule_y) {
        const DrawnAxis both[] = {x, y};
        draw.border = by_rule(rule_x, both);
    } else {
        const DrawnAxis only_x[] = {x}, only_y[] = {y};
        draw.border = by_rule(rule_x, only_x) | by_rule(rule_y, only_y);
    }
    if (at.w == nullptr) return;
    const DrawnAxis z[] = {{at.w, nullptr, &table.depth, &numbers.z, &draw.slice}};
    draw.border |= by_rule(cheapest_rule(edge_rule(sampler.wrap_r), table.depth), z);
}

HWY_INLINE void draw_listless_texels(const DrawnLookup& lookup, const Kernel& kernel, const DrawnPlace& place, const DrawNumbers& numbers,
                                     TexelDraw& draw) {
    if (lookup.sampler->estimator == Estimator::Jitter) return draw_places(lookup, JitteredPlace{kernel}, place, numbers, draw);
    if (kernel.kind == KernelKind::BSpline) return draw_places(lookup, BSplinePlace{kernel}, place, numbers, draw);
    draw_places(lookup, WeighedPlace{kernel}, place, numbers, draw);
}

/// A texel of `kernel` for every lane; indices of cube maps may lie beyond the face.
HWY_INLINE void draw_indices(const DrawnLookup& lookup, const Kernel& kernel, const DrawnPlace& place, const DrawNumbers& numbers,
                             Lobes lobes, const LobeMass& mass, TexelDraw& draw) {
    if (!weighs_as_probability(kernel)) return draw_signed_texels(lookup, kernel, place, numbers, lobes, mass, draw);
    if (mass.found != nullptr) std::fill_n(mass.found->lane, kWaveLanes, lobes == Lobes::Magnitude ? 1.0f : 0.0f);
    if (lookup.sampler->estimator == Estimator::Jitter || has_fixed_weights(kernel))
        return draw_listless_texels(lookup, kernel, place, numbers, draw);
    TextureTaps taps;
    select_axes(lookup, kernel, place, taps);
    draw.border = draw_of_axis(taps.x, AsProbabilities(), numbers.x, draw.x);
    draw.border |= draw_of_axis(taps.y, AsProbabilities(), numbers.y, draw.y);
    if (taps.volume) draw.border |= draw_of_axis(taps.z, AsProbabilities(), numbers.z, draw.slice);
}

/// The texels of a cube map that drawn indices mean: of another face beyond an edge, and beyond a corner one of the three that meet there,
/// each with a third of the numbers.
HWY_NOINLINE inline void fold_drawn_cube(const DrawnLookup& lookup, const DrawnPlace& place, const WaveFloat& number, TexelDraw& draw) {
    const FloatTag d;
    const IntTag di;
    for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
        const auto extent = look_up_level(di, lookup.levels->width, hn::Load(di, place.level.lane + i));
        const auto tap = resolve_cube_tap(hn::Load(di, lookup.position.slice->lane + i), hn::Load(di, draw.x.lane + i),
                                          hn::Load(di, draw.y.lane + i), extent);
        const auto third = hn::Mul(hn::Load(d, number.lane + i), hn::Set(d, 3.0f));
        const auto second = hn::RebindMask(di, third >= hn::Set(d, 1.0f)), last = hn::RebindMask(di, third >= hn::Set(d, 2.0f));
        const auto choose = [&](hn::Vec<IntTag> a, hn::Vec<IntTag> b, hn::Vec<IntTag> c)
                                HWY_ATTR { return hn::IfThenElse(last, c, hn::IfThenElse(second, b, a)); };
        hn::Store(choose(tap.texel[0].slice(), tap.texel[1].slice(), tap.texel[2].slice()), di, draw.slice.lane + i);
        hn::Store(choose(tap.texel[0].x, tap.texel[1].x, tap.texel[2].x), di, draw.x.lane + i);
        hn::Store(choose(tap.texel[0].y, tap.texel[1].y, tap.texel[2].y), di, draw.y.lane + i);
    }
    draw.border = 0;
}

HWY_INLINE void draw_texels(const DrawnLookup& lookup, const Kernel& kernel, const DrawnPlace& place, const DrawNumbers& numbers,
                            Lobes lobes, const LobeMass& mass, TexelDraw& draw) {
    draw_indices(lookup, kernel, place, numbers, lobes, mass, draw);
    if (lookup.position.cube()) fold_drawn_cube(lookup, place, numbers.z, draw);
}

/// Draws for all lanes, of which those outside `mask` repeat an active one. Of flat lookups `draw.slice` is the caller's.
HWY_NOINLINE inline void draw_lanes(const DrawnLookup& lookup, WaveMask mask, const DrawNumbers& numbers, Lobes lobes, const LobeMass& mass,
                                    TexelDraw& draw) {
    const SamplerState& sampler = *lookup.sampler;
    if (sampler.ellipse > 0) {
        if (mass.found != nullptr) std::fill_n(mass.found->lane, kWaveLanes, lobes == Lobes::Magnitude ? 1.0f : 0.0f);
        // Streaming weighs every texel; offsets need none.
        if (sampler.estimator == Estimator::Reservoir) {
            stream_ellipses(*lookup.levels, sampler, *lookup.at, mask, numbers, draw);
        } else {
            jitter_ellipses(*lookup.levels, sampler, *lookup.at, mask, numbers, draw);
        }
        return repeat_first_draw(mask, draw);
    }
    DrawnPlace place(lookup, draw.level);
    draw_place(lookup, numbers, place);
    const WaveMask magnified = place.choice.magnify & mask;
    const bool one_kernel = sampler.magnify == sampler.minify || magnified == 0 || magnified == mask;
    const Kernel& most = magnified == mask ? sampler.magnify : sampler.minify;
    draw_texels(lookup, most, place, numbers, lobes, mass, draw);
    if (one_kernel) return;
    TexelDraw large;
    large.slice = draw.slice;
    WaveFloat found;
    draw_texels(lookup, sampler.magnify, place, numbers, lobes, {mass.wanted, mass.found != nullptr ? &found : nullptr}, large);
    take_lanes(large, magnified, draw);
    for (WaveMask lanes = magnified; mass.found != nullptr && lanes != 0; lanes &= lanes - 1) {
        const auto lane = int(hwy::Num0BitsBelowLS1Bit_Nonzero32(lanes));
        (*mass.found)[lane] = found[lane];
    }
}

/// Texels of other slices than the first, and those of a border.
template <StorageClass storage>
HWY_NOINLINE void read_drawn_edges(Texture& texture, const SamplerState& sampler, const TexelDraw& draw, const WaveInt* slice,
                                   WaveColor& out) {
    TapWave<1> tap;
    tap.level = &draw.level;
    tap.slice = slice;
    tap.x[0] = draw.x, tap.y[0] = draw.y;
    tap.leaves = draw.border != 0;
    tap.outside_x[0] = tap.outside_y[0] = draw.border;
    TexelWave<1> texels;
    fetch<storage>(texture, sampler.border, false, tap, texels);
    for (int c = 0; c < 4; ++c) out.channel[c] = texels.channel[c][0];
}

template <StorageClass storage>
HWY_INLINE void read_drawn(Texture& texture, const SamplerState& sampler, const TexelDraw& draw, WaveColor& out) {
    const bool is_flat = texture.shape().layers == 1 && texture.shape().depth == 1;
    if (!is_flat || draw.border != 0) return read_drawn_edges<storage>(texture, sampler, draw, is_flat ? nullptr : &draw.slice, out);
    WaveInt index[1];
    texel_indices<storage>(texture.levels(), draw.level, nullptr, draw.x, draw.y, index[0]);
    ensure(texture, draw.level, index);
    gather<storage>(texture, index, channels_of(out));
}

HWY_INLINE void read_drawn_texels(Texture& texture, const SamplerState& sampler, const TexelDraw& draw, WaveColor& out) {
    switch (texture.texel_layout().storage) {
        case StorageClass::Packed32: return read_drawn<StorageClass::Packed32>(texture, sampler, draw, out);
        case StorageClass::Packed64: return read_drawn<StorageClass::Packed64>(texture, sampler, draw, out);
        case StorageClass::Half4: return read_drawn<StorageClass::Half4>(texture, sampler, draw, out);
        case StorageClass::Float4: return read_drawn<StorageClass::Float4>(texture, sampler, draw, out);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::texunit
HWY_AFTER_NAMESPACE();

#endif  // RAWTEXEL_TEXUNIT_DRAW_LANES_INL_H_
