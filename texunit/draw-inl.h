// One texel a lookup: a probe, a level and a texel of the kernel, each drawn with a number of its own. Meaning: texunit/draw.h.
#include "texunit/draw.h"
#include "texunit/draw_axis-inl.h"
#include "texunit/ellipse_reservoir-inl.h"
#include "texunit/fetch_edges-inl.h"
#include "texunit/footprint-inl.h"
#include "texunit/probes-inl.h"

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

HWY_INLINE void take_lanes(const TexelDraw& from, WaveMask lanes, TexelDraw& to) {
    to.border = (to.border & ~lanes) | (from.border & lanes);
    for (; lanes != 0; lanes &= lanes - 1) {
        const auto lane = int(hwy::Num0BitsBelowLS1Bit_Nonzero32(lanes));
        to.x[lane] = from.x[lane], to.y[lane] = from.y[lane];
    }
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

/// Which weights of a kernel a texel is drawn from.
enum class Lobes {
    Positive,   ///< the positive ones
    Negative,   ///< the negative ones; where they sum to less than is asked for, the positive ones make up the rest
    Magnitude,  ///< all, by their magnitudes
};

/// What lookups that share numbers tell each other of their negative weights.
struct LobeMass {
    const WaveFloat* wanted = nullptr;  ///< Lobes::Negative: the mass that is to be drawn, at least the lookup's own
    /// Positive and Negative: gets the magnitudes' sum of the lookup's negative weights. Magnitude: that of all, with the sign of the drawn
    /// one. Null where nobody asks.
    WaveFloat* found = nullptr;
};

/// The taps of a kernel with negative lobes along both axes.
struct SignedTaps {
    AxisTaps x, y;
    SignedSums sums_x, sums_y;
};

HWY_INLINE void select_axes(const LevelTable& table, const SamplerState& sampler, const Kernel& kernel, const DrawnPlace& place,
                            AxisTaps& x, AxisTaps& y) {
    const CoordinateReading reading{sampler.precision, nullptr};
    select_wide_axis(kernel, edge_rule(sampler.wrap_s), *place.position.u, table.width, place.level, reading, x);
    select_wide_axis(kernel, edge_rule(sampler.wrap_t), *place.position.v, table.height, place.level, reading, y);
}

HWY_INLINE void select_signed_axes(const LevelTable& table, const SamplerState& sampler, const Kernel& kernel, const DrawnPlace& place,
                                   SignedTaps& taps) {
    select_axes(table, sampler, kernel, place, taps.x, taps.y);
    sum_signs(taps.x, taps.sums_x);
    sum_signs(taps.y, taps.sums_y);
}

/// The four pairs of signs that the axes' weights can have, in the order in which they are drawn.
inline constexpr int kSignPairs = 4;  // ++ -- +- -+
inline constexpr bool kNegativeX[kSignPairs] = {false, true, false, true};
inline constexpr bool kNegativeY[kSignPairs] = {false, true, true, false};

/// Probabilities of the pairs for the lanes i .. , and the magnitudes' sum of the lookup's own negative weights. Lobes of no mass at all
/// give 0 everywhere.
struct SignShares {
    FloatVec share[kSignPairs];
    FloatVec negative_mass;
};
HWY_INLINE SignShares sign_shares(const SignedTaps& taps, Lobes lobes, const WaveFloat* wanted, size_t i) {
    const FloatTag d;
    const auto zero = hn::Zero(d);
    const auto px = hn::Load(d, taps.sums_x.positive.lane + i), nx = hn::Load(d, taps.sums_x.negative.lane + i);
    const auto py = hn::Load(d, taps.sums_y.positive.lane + i), ny = hn::Load(d, taps.sums_y.negative.lane + i);
    SignShares shares;
    FloatVec(&share)[kSignPairs] = shares.share;
    share[0] = hn::Mul(px, py), share[1] = hn::Mul(nx, ny);
    share[2] = hn::Mul(px, ny), share[3] = hn::Mul(nx, py);
    shares.negative_mass = hn::Add(share[2], share[3]);
    if (lobes == Lobes::Positive) {
        share[2] = share[3] = zero;
    } else if (lobes == Lobes::Negative) {
        const auto missing = hn::Max(hn::Sub(hn::Load(d, wanted->lane + i), shares.negative_mass), zero);
        const auto scale = hn::Div(missing, hn::Add(share[0], share[1]));
        share[0] = hn::Mul(share[0], scale), share[1] = hn::Mul(share[1], scale);
    }
    const auto sum = hn::Add(hn::Add(share[0], share[1]), hn::Add(share[2], share[3]));
    for (FloatVec& s : share) s = hn::IfThenElseZero(sum > zero, hn::Div(s, sum));
    return shares;
}

/// Signs of the two axes' weights, one bit a lane.
struct DrawnSigns {
    WaveMask negative_x = 0, negative_y = 0;
};
HWY_INLINE DrawnSigns draw_signs(const SignedTaps& taps, Lobes lobes, const LobeMass& mass, const WaveFloat& number) {
    const FloatTag d;
    DrawnSigns signs;
    for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
        const SignShares shares = sign_shares(taps, lobes, mass.wanted, i);
        if (mass.found != nullptr) hn::Store(shares.negative_mass, d, mass.found->lane + i);
        const auto random = hn::Load(d, number.lane + i);
        auto before = hn::Zero(d);
        for (int pair = 0; pair < kSignPairs; ++pair) {
            const auto takes = hn::And(shares.share[pair] > hn::Zero(d), random >= before);
            const WaveMask lanes = wave_mask(d, takes, i);
            signs.negative_x = kNegativeX[pair] ? signs.negative_x | lanes : signs.negative_x & ~lanes;
            signs.negative_y = kNegativeY[pair] ? signs.negative_y | lanes : signs.negative_y & ~lanes;
            before = hn::Add(before, shares.share[pair]);
        }
    }
    return signs;
}

/// By magnitude, axis by axis.
HWY_INLINE void draw_magnitude(const SignedTaps& taps, const DrawNumbers& numbers, WaveFloat* factor, TexelDraw& draw) {
    const FloatTag d;
    draw.border = draw_of_axis(taps.x, OfMagnitude(taps.sums_x), numbers.x, draw.x);
    draw.border |= draw_of_axis(taps.y, OfMagnitude(taps.sums_y), numbers.y, draw.y);
    if (factor == nullptr) return;
    const WaveMask negative = negative_lanes(taps.x, taps.sums_x, numbers.x) ^ negative_lanes(taps.y, taps.sums_y, numbers.y);
    for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
        const auto sum_x = hn::Add(hn::Load(d, taps.sums_x.positive.lane + i), hn::Load(d, taps.sums_x.negative.lane + i));
        const auto sum_y = hn::Add(hn::Load(d, taps.sums_y.positive.lane + i), hn::Load(d, taps.sums_y.negative.lane + i));
        const auto sum = hn::Mul(sum_x, sum_y);
        hn::Store(hn::IfThenElse(lanes_of(d, negative, i), hn::Neg(sum), sum), d, factor->lane + i);
    }
}

HWY_NOINLINE inline void draw_signed_texels(const LevelTable& table, const SamplerState& sampler, const Kernel& kernel,
                                            const DrawnPlace& place, const DrawNumbers& numbers, Lobes lobes, const LobeMass& mass,
                                            TexelDraw& draw) {
    SignedTaps taps;
    select_signed_axes(table, sampler, kernel, place, taps);
    if (lobes == Lobes::Magnitude) return draw_magnitude(taps, numbers, mass.found, draw);
    const DrawnSigns signs = draw_signs(taps, lobes, mass, numbers.sign);
    draw.border = draw_of_axis(taps.x, OfOneSign(taps.sums_x, signs.negative_x), numbers.x, draw.x);
    draw.border |= draw_of_axis(taps.y, OfOneSign(taps.sums_y, signs.negative_y), numbers.y, draw.y);
}

HWY_INLINE void draw_jittered_texels(const LevelTable& table, const SamplerState& sampler, const Kernel& kernel, const DrawnPlace& place,
                                     const DrawNumbers& numbers, TexelDraw& draw) {
    const auto axis =
        [&](Wrap wrap, const WaveFloat& coordinate, const std::array<int32_t, 16>& extents, const WaveFloat& number, WaveInt& texel)
            HWY_ATTR { return jitter_axis(kernel, wrap, coordinate, extents, place.level, sampler.precision, number, texel); };
    draw.border = axis(sampler.wrap_s, *place.position.u, table.width, numbers.x, draw.x);
    draw.border |= axis(sampler.wrap_t, *place.position.v, table.height, numbers.y, draw.y);
}

/// A texel of `kernel` for every lane.
HWY_INLINE void draw_texels(const LevelTable& table, const SamplerState& sampler, const Kernel& kernel, const DrawnPlace& place,
                            const DrawNumbers& numbers, Lobes lobes, const LobeMass& mass, TexelDraw& draw) {
    if (!weighs_as_probability(kernel)) return draw_signed_texels(table, sampler, kernel, place, numbers, lobes, mass, draw);
    if (mass.found != nullptr) std::fill_n(mass.found->lane, kWaveLanes, lobes == Lobes::Magnitude ? 1.0f : 0.0f);
    if (sampler.estimator == Estimator::Jitter) return draw_jittered_texels(table, sampler, kernel, place, numbers, draw);
    if (kernel.kind == KernelKind::Nearest || kernel.kind == KernelKind::Bilinear) {
        TapWave<2> taps;
        select_taps(table, sampler, place.position, place.level, kernel.kind == KernelKind::Nearest ? kWaveFull : 0, taps);
        draw.border = draw_of_pair(taps.x, taps.fraction_x, taps.outside_x, taps.leaves, numbers.x, draw.x);
        draw.border |= draw_of_pair(taps.y, taps.fraction_y, taps.outside_y, taps.leaves, numbers.y, draw.y);
        return;
    }
    AxisTaps x, y;
    select_axes(table, sampler, kernel, place, x, y);
    draw.border = draw_of_axis(x, AsProbabilities(), numbers.x, draw.x);
    draw.border |= draw_of_axis(y, AsProbabilities(), numbers.y, draw.y);
}

/// Draws for all lanes, of which those outside `mask` repeat an active one; `draw.slice` is the caller's.
HWY_NOINLINE inline void draw_lanes(const LevelTable& table, const SamplerState& sampler, const WaveCoordinates& at, WaveMask mask,
                                    const DrawNumbers& numbers, Lobes lobes, const LobeMass& mass, TexelDraw& draw) {
    if (sampler.ellipse > 0) {
        if (mass.found != nullptr) std::fill_n(mass.found->lane, kWaveLanes, lobes == Lobes::Magnitude ? 1.0f : 0.0f);
        // Streaming weighs every texel; offsets need none.
        if (sampler.estimator == Estimator::Reservoir) {
            stream_ellipses(table, sampler, at, mask, numbers, draw);
        } else {
            jitter_ellipses(table, sampler, at, mask, numbers, draw);
        }
        return repeat_first_draw(mask, draw);
    }
    DrawnPlace place;
    draw_place(table, sampler, at, numbers, place);
    draw.level = place.level;
    const WaveMask magnified = place.choice.magnify & mask;
    const bool one_kernel = sampler.magnify == sampler.minify || magnified == 0 || magnified == mask;
    const Kernel& most = magnified == mask ? sampler.magnify : sampler.minify;
    draw_texels(table, sampler, most, place, numbers, lobes, mass, draw);
    if (one_kernel) return;
    TexelDraw large;
    WaveFloat found;
    draw_texels(table, sampler, sampler.magnify, place, numbers, lobes, {mass.wanted, mass.found != nullptr ? &found : nullptr}, large);
    take_lanes(large, magnified, draw);
    for (WaveMask lanes = magnified; mass.found != nullptr && lanes != 0; lanes &= lanes - 1) {
        const auto lane = int(hwy::Num0BitsBelowLS1Bit_Nonzero32(lanes));
        (*mass.found)[lane] = found[lane];
    }
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
