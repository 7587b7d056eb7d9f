// One texel a lookup: a probe, a level and a texel of the kernel, each drawn with a number of its own. Meaning: texunit/draw.h.
#include "texunit/draw.h"
#include "texunit/fetch_edges-inl.h"
#include "texunit/footprint-inl.h"
#include "texunit/probes-inl.h"
#include "texunit/wide_taps-inl.h"

#include <hwy/highway.h>

// Included once per instruction set (highway's guard for -inl.h files).
#if defined(RAWTEXEL_TEXUNIT_DRAW_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_TEXUNIT_DRAW_INL_H_
#undef RAWTEXEL_TEXUNIT_DRAW_INL_H_
#else
#define RAWTEXEL_TEXUNIT_DRAW_INL_H_
#endif

HWY_BEFORE_NAMESPACE();
namespace rawtexel::texunit {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// The probe that each lane draws: the last one before which the probabilities sum to no more than the lane's number.
HWY_INLINE void draw_probes(const ProbeTable& table, bool equal_weights, const ProbeChoice& probes, const WaveFloat& number,
                            WaveInt& probe) {
    const FloatTag d;
    const IntTag di;
    for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
        const auto count = hn::Load(di, probes.count.lane + i);
        const auto random = hn::Load(d, number.lane + i);
        const auto last = hn::Sub(count, hn::Set(di, 1));
        if (equal_weights) {
            // The product may round up to the count.
            hn::Store(hn::Min(hn::ConvertTo(di, hn::Mul(random, hn::ConvertTo(d, count))), last), di, probe.lane + i);
            continue;
        }
        auto drawn = hn::Zero(di);
        auto before = hn::Zero(d);
        const auto first = hn::Mul(count, hn::Set(di, kMostProbes));
        for (int n = 0; n < probes.most; ++n) {
            const auto index = hn::Set(di, n);
            const auto takes = hn::And(hn::RebindMask(di, random >= before), hn::Not(last < index));
            drawn = hn::IfThenElse(takes, index, drawn);
            before = hn::Add(before, hn::GatherIndex(d, table.weight.data(), hn::Add(first, hn::Min(index, last))));
        }
        hn::Store(drawn, di, probe.lane + i);
    }
}

/// The level that each lane draws.
HWY_INLINE void draw_levels(const LevelChoice& choice, const WaveFloat& number, WaveInt& level) {
    const FloatTag d;
    const IntTag di;
    for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
        const auto coarser = hn::RebindMask(di, hn::Load(d, number.lane + i) < hn::Load(d, choice.fraction.lane + i));
        hn::Store(hn::IfThenElse(coarser, hn::Load(di, choice.coarser.lane + i), hn::Load(di, choice.finer.lane + i)), di, level.lane + i);
    }
}

/// The second tap of a pair, where the number is below its weight. Returns the lanes whose texel is beyond an edge.
HWY_INLINE WaveMask draw_of_pair(const WaveInt (&texel)[2], const WaveFloat& fraction, const WaveMask (&outside)[2], bool leaves,
                                 const WaveFloat& number, WaveInt& drawn) {
    const FloatTag d;
    const IntTag di;
    WaveMask second = 0;
    for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
        const auto takes = hn::Load(d, number.lane + i) < hn::Load(d, fraction.lane + i);
        const auto texels = hn::IfThenElse(hn::RebindMask(di, takes), hn::Load(di, texel[1].lane + i), hn::Load(di, texel[0].lane + i));
        hn::Store(texels, di, drawn.lane + i);
        if (leaves) second |= wave_mask(d, takes, i);
    }
    return leaves ? (second & outside[1]) | (~second & outside[0]) : 0;
}

/// Of the taps that weigh anything the last one before which the weights sum to no more than the number. Returns as draw_of_pair.
HWY_INLINE WaveMask draw_of_axis(const AxisTaps& taps, const WaveFloat& number, WaveInt& drawn) {
    const FloatTag d;
    const IntTag di;
    WaveMask border = 0;
    for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
        const auto random = hn::Load(d, number.lane + i);
        auto before = hn::Zero(d);
        auto texel = hn::Load(di, taps.texel[0].lane + i);
        WaveMask outside = 0;
        for (int k = 0; k < taps.count; ++k) {
            const auto weight = hn::Load(d, taps.weight[k].lane + i);
            const auto takes = hn::And(weight > hn::Zero(d), random >= before);
            texel = hn::IfThenElse(hn::RebindMask(di, takes), hn::Load(di, taps.texel[k].lane + i), texel);
            const WaveMask lanes = wave_mask(d, takes, i);
            if (taps.leaves) outside = (outside & ~lanes) | (taps.outside[k] & lanes);
            before = hn::Add(before, weight);
        }
        hn::Store(texel, di, drawn.lane + i);
        border |= outside;
    }
    return border;
}

HWY_INLINE void draw_texels(const LevelTable& table, const SamplerState& sampler, const Kernel& kernel, WaveMask nearest,
                            const WavePosition& at, const DrawNumbers& numbers, TexelDraw& draw) {
    if (kernel.kind == KernelKind::Nearest || kernel.kind == KernelKind::Bilinear) {
        TapWave<2> taps;
        select_taps(table, sampler, at, draw.level, nearest, taps);
        draw.border = draw_of_pair(taps.x, taps.fraction_x, taps.outside_x, taps.leaves, numbers.x, draw.x);
        draw.border |= draw_of_pair(taps.y, taps.fraction_y, taps.outside_y, taps.leaves, numbers.y, draw.y);
        return;
    }
    AxisTaps taps;
    select_wide_axis(kernel, edge_rule(sampler.wrap_s), *at.u, table.width, draw.level, {sampler.precision, nullptr}, taps);
    draw.border = draw_of_axis(taps, numbers.x, draw.x);
    select_wide_axis(kernel, edge_rule(sampler.wrap_t), *at.v, table.height, draw.level, {sampler.precision, nullptr}, taps);
    draw.border |= draw_of_axis(taps, numbers.y, draw.y);
}

HWY_INLINE void take_lanes(const TexelDraw& from, WaveMask lanes, TexelDraw& to) {
    to.border = (to.border & ~lanes) | (from.border & lanes);
    for (; lanes != 0; lanes &= lanes - 1) {
        const auto lane = int(hwy::Num0BitsBelowLS1Bit_Nonzero32(lanes));
        to.x[lane] = from.x[lane], to.y[lane] = from.y[lane];
    }
}

/// Calls draw(kernel, result) with the kernel of the magnified lanes, that of the others, or both; take(other result, lanes) then mixes.
template <class Result, class Draw, class Take>
HWY_INLINE void draw_by_kernel(const SamplerState& sampler, const LevelChoice& choice, WaveMask mask, Result& result, const Draw& draw,
                               const Take& take) {
    const WaveMask magnified = choice.magnify & mask;
    if (sampler.magnify == sampler.minify || magnified == mask) return draw(sampler.magnify, result);
    draw(sampler.minify, result);
    if (magnified == 0) return;
    Result large = result;
    draw(sampler.magnify, large);
    take(large, magnified);
}

/// Moves the coordinates to the probe that each lane draws.
HWY_NOINLINE inline void move_to_probes(const SamplerState& sampler, const ProbeChoice& probes, const WaveCoordinates& at,
                                        const WaveFloat& number, WaveFloat& u, WaveFloat& v) {
    const bool equal_weights = sampler.probe_variance <= 0;
    const ProbeTable& table = equal_weights ? uniform_probes() : gaussian_probes();
    WaveInt probe;
    draw_probes(table, equal_weights, probes, number, probe);
    const FloatTag d;
    const IntTag di;
    for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
        const auto count = hn::Load(di, probes.count.lane + i);
        const auto index = hn::Add(hn::Mul(count, hn::Set(di, kMostProbes)), hn::Load(di, probe.lane + i));
        // A single probe lies at the centre.
        const auto place = hn::GatherIndex(d, table.place.data(), index);
        const auto moved = [&](Wrap wrap, const WaveFloat& from, const WaveFloat& axis) HWY_ATTR {
            return fused_multiply_add(place, hn::Load(d, axis.lane + i), in_period(wrap, hn::Load(d, from.lane + i)));
        };
        hn::Store(moved(sampler.wrap_s, at.u, probes.axis_u), d, u.lane + i);
        hn::Store(moved(sampler.wrap_t, at.v, probes.axis_v), d, v.lane + i);
    }
}

/// Where and in which level each lane draws its texel.
struct DrawnPlace {
    LevelChoice choice;
    WaveFloat u, v;
    WavePosition position;
    WaveInt level;
};

/// All lanes of `at` are active or repeat one that is.
HWY_NOINLINE inline void draw_place(const LevelTable& table, const SamplerState& sampler, const WaveCoordinates& at,
                                    const DrawNumbers& numbers, DrawnPlace& place) {
    place.position = {&at.u, &at.v};
    if (!sampler.is_isotropic()) {
        ProbeChoice probes;
        select_footprint(table, sampler, at, place.choice, probes);
        if (probes.most > 1) {
            move_to_probes(sampler, probes, at, numbers.probe, place.u, place.v);
            place.position = {&place.u, &place.v};
        }
    } else {
        choose_levels(table, sampler, at, place.choice, nullptr);
    }
    draw_levels(place.choice, numbers.level, place.level);
}

HWY_NOINLINE inline void draw_lanes(const LevelTable& table, const SamplerState& sampler, const WaveCoordinates& at, WaveMask mask,
                                    const DrawNumbers& numbers, TexelDraw& drawn) {
    DrawnPlace place;
    draw_place(table, sampler, at, numbers, place);
    drawn.level = place.level;
    const auto draw = [&](const Kernel& kernel, TexelDraw& texels) HWY_ATTR {
        const WaveMask nearest = kernel.kind == KernelKind::Nearest ? kWaveFull : 0;
        draw_texels(table, sampler, kernel, nearest, place.position, numbers, texels);
    };
    draw_by_kernel(sampler, place.choice, mask, drawn, draw,
                   [&](const TexelDraw& large, WaveMask lanes) HWY_ATTR { take_lanes(large, lanes, drawn); });
}

/// Sums of an axis's positive weights and of its negative ones' magnitudes.
struct SignedSums {
    WaveFloat positive, negative;
};

HWY_INLINE void sum_signs(const AxisTaps& taps, SignedSums& sums) {
    const FloatTag d;
    const auto zero = hn::Zero(d);
    for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
        auto positive = zero, negative = zero;
        for (int k = 0; k < taps.count; ++k) {
            const auto weight = hn::Load(d, taps.weight[k].lane + i);
            positive = hn::Add(positive, hn::Max(weight, zero));
            negative = hn::Add(negative, hn::Max(hn::Neg(weight), zero));
        }
        hn::Store(positive, d, sums.positive.lane + i);
        hn::Store(negative, d, sums.negative.lane + i);
    }
}

/// The taps of one sign a lane, as weights that are not negative and sum to 1: what draw_of_axis takes.
HWY_INLINE void keep_sign(const AxisTaps& taps, const SignedSums& sums, WaveMask negative, AxisTaps& kept) {
    const FloatTag d;
    kept.count = taps.count;
    kept.leaves = taps.leaves;
    for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
        const auto flips = lanes_of(d, negative, i);
        const auto sum = hn::IfThenElse(flips, hn::Load(d, sums.negative.lane + i), hn::Load(d, sums.positive.lane + i));
        for (int k = 0; k < taps.count; ++k) {
            const auto weight = hn::Load(d, taps.weight[k].lane + i);
            const auto magnitude = hn::Max(hn::IfThenElse(flips, hn::Neg(weight), weight), hn::Zero(d));
            hn::Store(hn::IfThenElseZero(sum > hn::Zero(d), hn::Div(magnitude, sum)), d, kept.weight[k].lane + i);
            hn::Store(hn::Load(IntTag(), taps.texel[k].lane + i), IntTag(), kept.texel[k].lane + i);
        }
    }
    std::copy_n(taps.outside, taps.count, kept.outside);
}

/// Draws from weights whose signs are equal on both axes (`mixed` false: ++ or --) or not (+- or -+), and tells their sum.
HWY_INLINE void draw_signs(const AxisTaps& x, const AxisTaps& y, const SignedSums& sums_x, const SignedSums& sums_y, bool mixed,
                           const DrawNumbers& numbers, TexelDraw& draw, WaveFloat& total) {
    const FloatTag d;
    WaveMask negative_x = 0, negative_y = 0;
    for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
        const auto px = hn::Load(d, sums_x.positive.lane + i), nx = hn::Load(d, sums_x.negative.lane + i);
        const auto py = hn::Load(d, sums_y.positive.lane + i), ny = hn::Load(d, sums_y.negative.lane + i);
        const auto first = hn::Mul(px, mixed ? ny : py), second = hn::Mul(nx, mixed ? py : ny);
        const auto sum = hn::Add(first, second);
        hn::Store(sum, d, total.lane + i);
        // Rounding may take the product up to the sum, and must not take a pair that weighs nothing.
        const auto takes_second = hn::And(hn::Mul(hn::Load(d, numbers.sign.lane + i), sum) >= first, second > hn::Zero(d));
        const WaveMask lanes = wave_mask(d, takes_second, i);
        const WaveMask all = wave_mask(d, hn::Eq(sum, sum), i);
        negative_x |= lanes;
        negative_y |= mixed ? all & ~lanes : lanes;
    }
    AxisTaps kept;
    keep_sign(x, sums_x, negative_x, kept);
    draw.border = draw_of_axis(kept, numbers.x, draw.x);
    keep_sign(y, sums_y, negative_y, kept);
    draw.border |= draw_of_axis(kept, numbers.y, draw.y);
}

HWY_NOINLINE inline void draw_signed_texels(const LevelTable& table, const SamplerState& sampler, const Kernel& kernel,
                                            const WavePosition& at, const DrawNumbers& positive, const DrawNumbers& negative,
                                            SignedDraw& draw) {
    AxisTaps x, y;
    select_wide_axis(kernel, edge_rule(sampler.wrap_s), *at.u, table.width, draw.positive.level, {sampler.precision, nullptr}, x);
    select_wide_axis(kernel, edge_rule(sampler.wrap_t), *at.v, table.height, draw.positive.level, {sampler.precision, nullptr}, y);
    SignedSums sums_x, sums_y;
    sum_signs(x, sums_x);
    sum_signs(y, sums_y);
    draw_signs(x, y, sums_x, sums_y, false, positive, draw.positive, draw.positive_weight);
    draw_signs(x, y, sums_x, sums_y, true, negative, draw.negative, draw.negative_weight);
}

HWY_NOINLINE inline void draw_signed_lanes(const LevelTable& table, const SamplerState& sampler, const WaveCoordinates& at, WaveMask mask,
                                           const DrawNumbers& positive, const DrawNumbers& negative, SignedDraw& drawn) {
    DrawnPlace place;
    draw_place(table, sampler, at, positive, place);
    drawn.positive.level = drawn.negative.level = place.level;
    const auto draw = [&](const Kernel& kernel, SignedDraw& texels)
                          HWY_ATTR { draw_signed_texels(table, sampler, kernel, place.position, positive, negative, texels); };
    draw_by_kernel(sampler, place.choice, mask, drawn, draw, [&](const SignedDraw& large, WaveMask lanes) HWY_ATTR {
        take_lanes(large.positive, lanes, drawn.positive);
        take_lanes(large.negative, lanes, drawn.negative);
        for (; lanes != 0; lanes &= lanes - 1) {
            const auto lane = int(hwy::Num0BitsBelowLS1Bit_Nonzero32(lanes));
            drawn.positive_weight[lane] = large.positive_weight[lane];
            drawn.negative_weight[lane] = large.negative_weight[lane];
        }
    });
}

template <StorageClass storage>
HWY_INLINE void read_drawn(Texture& texture, const SamplerState& sampler, const TexelDraw& draw, WaveColor& out) {
    TapWave<1> tap;
    tap.level = &draw.level;
    tap.slice = texture.shape().layers > 1 ? &draw.slice : nullptr;
    tap.x[0] = draw.x, tap.y[0] = draw.y;
    tap.leaves = draw.border != 0;
    tap.outside_x[0] = tap.outside_y[0] = draw.border;
    TexelWave<1> texels;
    fetch<storage>(texture, sampler.border, false, tap, texels);
    for (int c = 0; c < 4; ++c) out.channel[c] = texels.channel[c][0];
}

HWY_INLINE void read_drawn_lanes(Texture& texture, const SamplerState& sampler, const TexelDraw& draw, WaveColor& out) {
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

#endif  // RAWTEXEL_TEXUNIT_DRAW_INL_H_
