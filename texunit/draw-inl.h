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
    for (; lanes != 0; lanes &= lanes - 1) {
        const auto lane = int(hwy::Num0BitsBelowLS1Bit_Nonzero32(lanes));
        to.x[lane] = from.x[lane], to.y[lane] = from.y[lane];
        to.border = (to.border & ~(1u << lane)) | (from.border & 1u << lane);
    }
}

/// The kernel of magnified lanes, that of the others, or both.
HWY_INLINE void draw_by_kernel(const LevelTable& table, const SamplerState& sampler, const LevelChoice& choice, WaveMask mask,
                               const WavePosition& at, const DrawNumbers& numbers, TexelDraw& draw) {
    const WaveMask magnified = choice.magnify & mask;
    const auto nearest_of = [](const Kernel& kernel) { return kernel.kind == KernelKind::Nearest ? kWaveFull : WaveMask{0}; };
    const Kernel& first = sampler.magnify == sampler.minify || magnified == mask ? sampler.magnify : sampler.minify;
    draw_texels(table, sampler, first, nearest_of(first), at, numbers, draw);
    if (first == sampler.magnify || magnified == 0) return;
    TexelDraw large;
    large.level = draw.level;
    draw_texels(table, sampler, sampler.magnify, nearest_of(sampler.magnify), at, numbers, large);
    take_lanes(large, magnified, draw);
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

/// All lanes of `at` are active or repeat one that is.
HWY_NOINLINE inline void draw_lanes(const LevelTable& table, const SamplerState& sampler, const WaveCoordinates& at, WaveMask mask,
                                    const DrawNumbers& numbers, TexelDraw& draw) {
    LevelChoice choice;
    WaveFloat u, v;
    WavePosition position{&at.u, &at.v};
    if (sampler.probes != 1) {
        ProbeChoice probes;
        select_footprint(table, sampler, at, choice, probes);
        if (probes.most > 1) {
            move_to_probes(sampler, probes, at, numbers.probe, u, v);
            position = {&u, &v};
        }
    } else {
        choose_levels(table, sampler, at, choice, nullptr);
    }
    draw_levels(choice, numbers.level, draw.level);
    draw_by_kernel(table, sampler, choice, mask, position, numbers, draw);
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
