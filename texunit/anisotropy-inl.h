// How many probes an anisotropic lookup takes, along which axis and at which level: by the D3D and Vulkan rule, or so that probes and level
// together have the covariance of the pixel's filter.
#include "texunit/footprint-inl.h"
#include "texunit/probe_table.h"

#include <hwy/highway.h>

// Included once per instruction set (highway's guard for -inl.h files).
#if defined(RAWTEXEL_TEXUNIT_ANISOTROPY_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_TEXUNIT_ANISOTROPY_INL_H_
#undef RAWTEXEL_TEXUNIT_ANISOTROPY_INL_H_
#else
#define RAWTEXEL_TEXUNIT_ANISOTROPY_INL_H_
#endif

HWY_BEFORE_NAMESPACE();
namespace rawtexel::texunit {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// The probes of an anisotropic lookup. Probe i of n lies at (u, v) + place(i, n)*(axis_u, axis_v) (texunit/probe_table.h).
struct ProbeChoice {
    WaveInt count;             ///< 1..64
    WaveFloat axis_u, axis_v;  ///< what places are measured in
    WaveFloat anisotropy;      ///< eta, 1..64
    int most = 1;              ///< largest count of the wave
};

/// A level of detail, the number of probes and the axis of some lanes.
struct Line {
    Lod lod;
    FloatVec probes;  ///< before rounding up
    FloatVec s, t;    ///< axis in texels / 2^exponent
    FloatVec eta;
};

/// 2^n, n limited to normal floats with room for an axis in [1, 4).
HWY_INLINE FloatVec bounded_power_of_two(IntVec n) {
    const IntTag di;
    return power_of_two(hn::Min(hn::Max(n, hn::Set(di, -126)), hn::Set(di, 125)));
}

/// The whole number of probes from a real one >= 1: ceil, but what exceeds a whole number by less than 2^-20 of itself is rounding noise.
HWY_INLINE IntVec round_up(FloatVec probes) {
    const FloatTag d;
    const IntTag di;
    const auto below = hn::Mul(probes, hn::Set(d, 1.0f - 0x1p-20f));
    const auto whole = hn::ConvertTo(di, below);
    return hn::Add(whole, hn::IfThenElseZero(hn::RebindMask(di, hn::ConvertTo(d, whole) < below), hn::Set(di, 1)));
}

/// The level whose every read is the same texel, or -1.
HWY_INLINE int32_t one_texel_level(const LevelTable& table, const SamplerState& sampler) {
    const auto last = size_t(table.levels - 1);
    const bool one_texel = table.width[last] == 1 && table.height[last] == 1;
    const bool border = sampler.wrap_s == Wrap::ClampToBorder || sampler.wrap_t == Wrap::ClampToBorder;
    return one_texel && !border ? int32_t(last) : -1;
}

HWY_INLINE int largest_lane(IntVec v) {
    const IntTag di;
    alignas(64) int32_t lanes[hn::MaxLanes(di)];
    hn::Store(v, di, lanes);
    return *std::max_element(lanes, lanes + hn::Lanes(di));
}

/// Vulkan "Scale Factor Operation": eta = longer/shorter, at most the sampler's probes, and lambda = log2(longer/eta). Where an axis that
/// was never as long as a texel would be cut into probes, D3D11.3 7.18.11 takes fewer, and so do we.
HWY_INLINE Line ratio_line(const Axes& axes, IntVec exponent, const LodRules& rules, FloatVec most) {
    const FloatTag d;
    const auto one = hn::Set(d, 1.0f);
    const auto most2 = hn::Mul(most, most);
    const auto some = axes.major2 > hn::Zero(d);
    const auto capped = hn::Mul(axes.minor2, most2) < axes.major2;
    const auto eta2 = hn::IfThenElse(capped, most2, hn::Div(axes.major2, axes.minor2));
    const auto minor2 = hn::IfThenElse(capped, hn::Div(axes.major2, most2), axes.minor2);
    Line line;
    line.eta = hn::IfThenElse(some, hn::Sqrt(eta2), one);
    line.lod = bound_lod(rules, lod_of_squared(minor2, exponent));
    const auto minor = hn::Mul(hn::Sqrt(minor2), bounded_power_of_two(exponent));
    line.probes = hn::Max(hn::Mul(line.eta, hn::Min(minor, one)), one);
    line.s = axes.s, line.t = axes.t;
    return line;
}

/// Gap of the probes, in standard deviations of what the level filters by itself, beyond which the level is made coarser instead; and the
/// number of probes per ratio of standard deviations, which keeps the gap at 2.22 as long as so many are allowed: where they are scarce,
/// holes are the smaller evil up to there. Both from the measurements of docs/anisotropy.md.
inline constexpr float kWidestGap = 2.5f;
inline constexpr float kProbesPerRatio = 2.05f;

/// The level whose own filter has `variance` texels^2 along each axis, on average over its phase: box-filtered level l read bilinearly has
/// 4^l/12 - 1/12 + 4^l/6, and linear in between, so that 4^l*(1 + 3*fraction) = 4*variance + 1/3.
HWY_INLINE Lod lod_of_variance(FloatVec variance) {
    const FloatTag d;
    const IntTag di;
    const auto one = hn::Set(d, 1.0f), third = hn::Set(d, 1.0f / 3);
    const auto quarters = hn::Max(hn::Add(hn::Mul(hn::Set(d, 4.0f), variance), third), one);
    const auto level = hn::ShiftRight<1>(hn::Sub(hn::ShiftRight<23>(hn::BitCast(di, quarters)), hn::Set(di, 127)));
    const auto in_level = hn::Mul(quarters, power_of_two(hn::Neg(hn::Add(level, level))));
    return {level, hn::Min(hn::Mul(hn::Sub(in_level, one), third), hn::Set(d, 1.0f - 0x1p-24f))};
}

/// Probes whose variance along the major axis and whose level's variance together give S2*J*J^T + I/6, I/6 being bilinear reconstruction.
/// Where the probes allowed lie too far apart the level takes over part of it, which blurs the minor axis.
HWY_INLINE Line variance_line(const Axes& axes, IntVec exponent, const SamplerState& sampler, const LodRules& rules) {
    const FloatTag d;
    const IntTag di;
    const auto zero = hn::Zero(d), one = hn::Set(d, 1.0f);
    constexpr int kReach = 40;  // 2^40 texels are beyond all levels
    const auto bounded = hn::Min(hn::Max(exponent, hn::Set(di, -kReach)), hn::Set(di, kReach));
    const auto scale = power_of_two(hn::Add(bounded, bounded));
    const auto s2 = hn::Mul(hn::Set(d, sampler.probe_variance), scale);
    const auto wanted_minor = hn::Add(hn::Mul(s2, axes.minor2), hn::Set(d, 1.0f / 6));
    const auto wanted_extra = hn::Mul(s2, hn::Sub(axes.major2, axes.minor2));

    Line line;
    line.eta = hn::Sqrt(hn::Max(hn::Min(hn::Div(axes.major2, axes.minor2), hn::Set(d, float(kMostProbes * kMostProbes))), one));
    line.probes = hn::Mul(hn::Set(d, kProbesPerRatio), hn::Sqrt(hn::Div(wanted_extra, wanted_minor)));
    line.probes = hn::Max(hn::Min(line.probes, hn::Set(d, float(sampler.probes))), one);

    // The variance that the level must have so that probes this far apart leave no holes; a single probe shares the excess evenly.
    const auto count = round_up(line.probes);
    const auto gap = hn::Mul(hn::GatherIndex(d, gaussian_probes().gap.data(), count), hn::Set(d, 1 / kWidestGap));
    const auto single = hn::RebindMask(d, hn::Eq(count, hn::Set(di, 1)));
    const auto filled =
        hn::IfThenElse(single, hn::Add(wanted_minor, hn::Mul(wanted_extra, hn::Set(d, 0.5f))), hn::Mul(hn::Mul(gap, gap), wanted_extra));
    const auto level_variance = hn::Max(filled, wanted_minor);
    const auto extra = hn::Max(hn::Sub(wanted_extra, hn::Sub(level_variance, wanted_minor)), zero);

    line.lod = lod_of_variance(level_variance);
    const auto beyond = hn::Set(di, kReach) < exponent;
    line.lod.level = hn::IfThenElse(beyond, hn::Set(di, kBeyondAllLevels), line.lod.level);
    line.lod = bound_lod(rules, line.lod);
    // From the length of the major axis to the standard deviation of the probes.
    const auto some = axes.major2 > zero;
    const auto length2 = hn::Mul(axes.major2, scale);
    const auto sigma = hn::IfThenElseZero(hn::And(some, length2 > zero), hn::Sqrt(hn::Div(extra, length2)));
    line.s = hn::Mul(axes.s, sigma), line.t = hn::Mul(axes.t, sigma);
    return line;
}

/// Chooses levels and probes for all lanes of `at`; sampler.probes > 1.
HWY_NOINLINE inline void select_footprint(const LevelTable& table, const SamplerState& sampler, const WaveCoordinates& at,
                                          LevelChoice& choice, ProbeChoice& probes) {
    const FloatTag d;
    const IntTag di;
    const auto width = hn::Set(d, float(table.width[0])), height = hn::Set(d, float(table.height[0]));
    const auto one = hn::Set(di, 1), most = hn::Set(di, std::clamp(sampler.probes, 1, kMostProbes));
    const LodRules rules = lod_rules(table, sampler);
    const bool by_variance = sampler.probe_variance > 0;
    const bool one_kernel = sampler.magnify == sampler.minify;
    const auto one_texel = hn::Set(di, one_texel_level(table, sampler));
    auto largest = one;
    choice.magnify = 0;
    choice.mixes = false;
    for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
        const ScaledJacobian j = scale_jacobian(at, i, width, height);
        const Axes axes = by_variance || sampler.lod_rule == LodRule::Exact ? singular_axes(j) : derivative_axes(j);
        Line line =
            by_variance ? variance_line(axes, j.exponent, sampler, rules) : ratio_line(axes, j.exponent, rules, hn::ConvertTo(d, most));
        const auto magnified = magnifies(by_variance ? bound_lod(rules, lod_of_squared(axes.minor2, j.exponent)) : line.lod);
        // By variance even a magnified footprint reads a little of level 1; a kernel of its own reads the finest level alone.
        if (by_variance && !one_kernel) line.lod = select(magnified, spread(LodValue{0, 0.0f}), line.lod);
        choice.magnify |= wave_mask(di, magnified, i);
        store_levels(rules, line.lod, i, choice);

        auto count = hn::Min(round_up(line.probes), most);
        count = hn::IfThenElse(hn::Eq(hn::Load(di, choice.finer.lane + i), one_texel), one, count);
        largest = hn::Max(largest, count);
        hn::Store(count, di, probes.count.lane + i);
        const auto scale = bounded_power_of_two(j.exponent);
        hn::Store(hn::Div(hn::Mul(line.s, scale), width), d, probes.axis_u.lane + i);
        hn::Store(hn::Div(hn::Mul(line.t, scale), height), d, probes.axis_v.lane + i);
        hn::Store(line.eta, d, probes.anisotropy.lane + i);
    }
    probes.most = largest_lane(largest);
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::texunit
HWY_AFTER_NAMESPACE();

#endif  // RAWTEXEL_TEXUNIT_ANISOTROPY_INL_H_
