// The footprint of a pixel on a texture: its ellipse, and how fine a level it asks for. Comes before the selection of taps and needs
// derivatives, never texels.
//
// J = [d(s,t)/dx d(s,t)/dy], s and t in texels of level 0, maps the pixel to an ellipse. Its axes are the longer and the shorter derivative
// (LodRule::D3d) or the singular values of J (LodRule::Exact). An isotropic lookup asks for lambda = log2(longer); for anisotropic ones see
// texunit/anisotropy-inl.h.
#include "texunit/lanes-inl.h"
#include "texunit/math-inl.h"

#include <hwy/highway.h>

#include <algorithm>
#include <cfloat>
#include <cmath>

// Included once per instruction set (highway's guard for -inl.h files).
#if defined(RAWTEXEL_TEXUNIT_FOOTPRINT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_TEXUNIT_FOOTPRINT_INL_H_
#undef RAWTEXEL_TEXUNIT_FOOTPRINT_INL_H_
#else
#define RAWTEXEL_TEXUNIT_FOOTPRINT_INL_H_
#endif

HWY_BEFORE_NAMESPACE();
namespace rawtexel::texunit {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using FloatMask = hn::Mask<FloatTag>;

/// Which levels a wave reads. Every lane reads `finer`; where `fraction` is not 0 it mixes in that much of `coarser`, else coarser = finer.
struct LevelChoice {
    WaveInt finer, coarser;
    WaveFloat fraction;
    WaveFloat lod;         ///< lambda clamped to the levels there are
    WaveMask magnify = 0;  ///< lanes with lambda <= 0
    bool mixes = false;    ///< some lane's fraction is not 0
};

/// J divided by 2^exponent, so that its largest element lies in [1, 4) and no square of it overflows or vanishes that matters.
struct ScaledJacobian {
    FloatVec sx, tx, sy, ty;
    IntVec exponent;
};

/// 2^n for -126 <= n <= 127.
HWY_INLINE FloatVec power_of_two(IntVec n) { return hn::BitCast(FloatTag(), hn::ShiftLeft<23>(hn::Add(n, hn::Set(IntTag(), 127)))); }

inline constexpr int kBeyondAllLevels = 4096;  ///< exponent of a footprint that has no size

/// The derivatives of lanes i.. in texels, not scaled.
HWY_INLINE ScaledJacobian texel_jacobian(const WaveCoordinates& at, size_t i, FloatVec width, FloatVec height) {
    const FloatTag d;
    return {hn::Mul(hn::Load(d, at.dudx.lane + i), width), hn::Mul(hn::Load(d, at.dvdx.lane + i), height),
            hn::Mul(hn::Load(d, at.dudy.lane + i), width), hn::Mul(hn::Load(d, at.dvdy.lane + i), height), hn::Zero(IntTag())};
}

/// The derivatives of lanes i.. in texels. A derivative that is not finite makes the footprint round and larger than every level.
HWY_INLINE ScaledJacobian scale_jacobian(const WaveCoordinates& at, size_t i, FloatVec width, FloatVec height) {
    const FloatTag d;
    const IntTag di;
    ScaledJacobian j = texel_jacobian(at, i, width, height);
    const auto finite = hn::And(hn::And(hn::IsFinite(j.sx), hn::IsFinite(j.tx)), hn::And(hn::IsFinite(j.sy), hn::IsFinite(j.ty)));
    const auto largest = hn::Max(hn::Max(hn::Abs(j.sx), hn::Abs(j.tx)), hn::Max(hn::Abs(j.sy), hn::Abs(j.ty)));
    const auto exponent = hn::Sub(hn::ShiftRight<23>(hn::BitCast(di, hn::IfThenElseZero(finite, largest))), hn::Set(di, 127));
    j.exponent = hn::Min(exponent, hn::Set(di, 126));
    // A footprint below 2^-126 texels counts as that large.
    const auto scale = power_of_two(hn::Min(hn::Neg(j.exponent), hn::Set(di, 126)));
    const auto one = hn::Set(d, 1.0f);
    j.sx = hn::IfThenElse(finite, hn::Mul(j.sx, scale), one), j.tx = hn::IfThenElseZero(finite, hn::Mul(j.tx, scale));
    j.sy = hn::IfThenElseZero(finite, hn::Mul(j.sy, scale)), j.ty = hn::IfThenElse(finite, hn::Mul(j.ty, scale), one);
    j.exponent = hn::IfThenElse(hn::RebindMask(di, finite), j.exponent, hn::Set(di, kBeyondAllLevels));
    return j;
}

HWY_INLINE FloatVec squared_length(FloatVec s, FloatVec t) { return hn::Add(hn::Mul(s, s), hn::Mul(t, t)); }

/// The ellipse: squared lengths of its axes and the direction of the longer, in the units of a ScaledJacobian.
struct Axes {
    FloatVec major2, minor2;
    FloatVec s, t;  ///< the major axis
};

/// The longer and the shorter derivative stand for the axes (Vulkan "Scale Factor Operation", D3D11.3 7.18.11).
HWY_INLINE Axes derivative_axes(const ScaledJacobian& j) {
    const auto x2 = squared_length(j.sx, j.tx), y2 = squared_length(j.sy, j.ty);
    const auto y_longer = x2 < y2;
    return {hn::Max(x2, y2), hn::Min(x2, y2), hn::IfThenElse(y_longer, j.sy, j.sx), hn::IfThenElse(y_longer, j.ty, j.tx)};
}

/// The largest squared singular value: half the trace of J*J^T = [p q; q r] plus `root`, half the difference of its eigenvalues.
struct LargestSingularValue {
    FloatVec half_difference;  ///< (p - r)/2
    FloatVec q, root, squared;
};
HWY_INLINE LargestSingularValue largest_singular_value(const ScaledJacobian& j) {
    const auto half = hn::Set(FloatTag(), 0.5f);
    const auto p = squared_length(j.sx, j.sy), r = squared_length(j.tx, j.ty);
    LargestSingularValue v;
    v.half_difference = hn::Mul(hn::Sub(p, r), half);
    v.q = hn::Add(hn::Mul(j.sx, j.tx), hn::Mul(j.sy, j.ty));
    v.root = hn::Sqrt(squared_length(v.half_difference, v.q));
    v.squared = hn::Add(hn::Mul(hn::Add(p, r), half), v.root);
    return v;
}

/// a*d - b*c to a few units in the last place, however much cancels (Kahan).
HWY_INLINE FloatVec determinant(FloatVec a, FloatVec b, FloatVec c, FloatVec d) {
    const auto product = hn::Mul(b, c);
    const auto lost = fused_multiply_add(hn::Neg(b), c, product);
    return hn::Add(fused_multiply_add(a, d, hn::Neg(product)), lost);
}

/// The axes of the ellipse itself: singular values and the major left singular vector of J.
HWY_INLINE Axes singular_axes(const ScaledJacobian& j) {
    const FloatTag d;
    const LargestSingularValue v = largest_singular_value(j);
    // The smaller one is |det|/larger; as a difference it would lose its bits where the ellipse is thin.
    const auto det = determinant(j.sx, j.sy, j.tx, j.ty);
    const auto some = v.squared > hn::Zero(d);
    Axes axes;
    axes.major2 = v.squared;
    axes.minor2 = hn::IfThenElseZero(some, hn::Div(hn::Mul(det, det), v.squared));
    axes.minor2 = hn::Min(axes.minor2, axes.major2);
    // Of the two columns of J*J^T - minor^2*I, which both lie along the major axis, the longer one. A circle has no major axis: take s.
    const auto along = hn::Add(hn::Abs(v.half_difference), v.root);
    const auto s_longer = hn::Not(v.half_difference < hn::Zero(d));
    const auto s = hn::IfThenElse(s_longer, along, v.q), t = hn::IfThenElse(s_longer, v.q, along);
    const auto length2 = squared_length(s, t);
    const auto round = hn::Not(length2 > hn::Set(d, 1e-30f));
    const auto scale = hn::IfThenElseZero(hn::Not(round), hn::Sqrt(hn::Div(v.squared, length2)));
    axes.s = hn::IfThenElse(round, hn::Sqrt(v.squared), hn::Mul(s, scale));
    axes.t = hn::Mul(t, scale);
    return axes;
}

/// A level of detail as level + fraction, 0 <= fraction < 1, kept apart: as one float the fraction would lose the bits of the level.
struct Lod {
    IntVec level;
    FloatVec fraction;
};
/// The same for all lanes.
struct LodValue {
    int level;
    float fraction;
};

/// Level and fraction of a finite or infinite number.
HWY_INLINE LodValue split_lod(float lod) {
    const float bounded = std::clamp(std::isnan(lod) ? 0.0f : lod, -1000.0f, 1000.0f);
    const float whole = std::floor(bounded);
    return {int(whole), bounded - whole};
}

HWY_INLINE Lod spread(LodValue v) { return {hn::Set(IntTag(), v.level), hn::Set(FloatTag(), v.fraction)}; }

/// Moves a whole from a fraction in [0, 2) to the level.
HWY_INLINE Lod carry(Lod lod) {
    const FloatTag d;
    const IntTag di;
    const auto one = hn::Set(d, 1.0f);
    const auto whole = lod.fraction >= one;
    const auto rest = hn::Min(hn::Sub(lod.fraction, one), hn::Set(d, 1.0f - 0x1p-24f));
    return {hn::IfThenElse(hn::RebindMask(di, whole), hn::Add(lod.level, hn::Set(di, 1)), lod.level),
            hn::IfThenElse(whole, rest, lod.fraction)};
}

/// log2(length) + exponent from the squared length.
HWY_INLINE Lod lod_of_squared(FloatVec squared, IntVec exponent) {
    const FloatTag d;
    const IntTag di;
    IntVec twice;
    FloatVec part;
    split_log2(hn::Max(squared, hn::Set(d, FLT_MIN)), twice, part);
    const auto odd = hn::ConvertTo(d, hn::And(twice, hn::Set(di, 1)));
    return carry({hn::Add(hn::ShiftRight<1>(twice), exponent), hn::Mul(hn::Add(odd, part), hn::Set(d, 0.5f))});
}

HWY_INLINE Lod add(Lod lod, LodValue bias) {
    return carry({hn::Add(lod.level, hn::Set(IntTag(), bias.level)), hn::Add(lod.fraction, hn::Set(FloatTag(), bias.fraction))});
}

HWY_INLINE hn::Mask<IntTag> less(Lod a, Lod b) {
    const IntTag di;
    return hn::Or(a.level < b.level, hn::And(hn::Eq(a.level, b.level), hn::RebindMask(di, a.fraction < b.fraction)));
}

HWY_INLINE Lod select(hn::Mask<IntTag> mask, Lod yes, Lod no) {
    return {hn::IfThenElse(mask, yes.level, no.level), hn::IfThenElse(hn::RebindMask(FloatTag(), mask), yes.fraction, no.fraction)};
}

/// To the nearest 1/256 (D3D11.3 7.18.8).
HWY_INLINE Lod quantise(Lod lod) {
    const FloatTag d;
    return carry({lod.level, hn::Mul(round_small(hn::Mul(lod.fraction, hn::Set(d, 256.0f))), hn::Set(d, 1.0f / 256))});
}

inline constexpr float kBoundBeyondAllLevels = 150.0f;  ///< levels; there are 16 at most

/// What turns lambda into levels, the same for all lanes. Bounds that store_levels() and magnifies() would not notice are none.
struct LodRules {
    LodValue bias, least, most;
    bool biased, has_bounds, quantised;
    MipMode mip;
    int32_t last_level;
};
HWY_INLINE LodRules lod_rules(const LevelTable& table, const SamplerState& sampler) {
    return {split_lod(sampler.lod_bias),
            split_lod(sampler.min_lod),
            split_lod(sampler.max_lod),
            sampler.lod_bias != 0.0f,
            sampler.min_lod > 0.0f || !(sampler.max_lod >= kBoundBeyondAllLevels),
            sampler.precision == Precision::Gpu,
            sampler.mip,
            table.levels - 1};
}

/// lambda + bias, clamped to [min_lod, max_lod] (Vulkan "Level-of-Detail Operation"; D3D11.3 7.18.11: the lower bound wins).
HWY_INLINE Lod bound_lod(const LodRules& rules, Lod lod) {
    if (rules.biased) lod = add(lod, rules.bias);
    if (rules.has_bounds) {
        const Lod least = spread(rules.least), most = spread(rules.most);
        lod = select(less(most, lod), most, lod);
        lod = select(less(lod, least), least, lod);
    }
    return rules.quantised ? quantise(lod) : lod;
}

/// Lanes that magnify: lambda <= 0 after its bounds, however many levels there are (Vulkan "Texel Filtering").
HWY_INLINE hn::Mask<IntTag> magnifies(Lod lod) {
    const auto zero = hn::Zero(IntTag());
    return hn::Or(lod.level < zero, hn::And(hn::Eq(lod.level, zero), hn::RebindMask(IntTag(), hn::Eq(lod.fraction, hn::Zero(FloatTag())))));
}

/// Clamps to the levels there are and stores the choice of lanes i.. .
HWY_INLINE void store_levels(const LodRules& rules, Lod lod, size_t i, LevelChoice& choice) {
    const FloatTag d;
    const IntTag di;
    const auto zero_level = hn::Zero(di), one_level = hn::Set(di, 1), last = hn::Set(di, rules.last_level);
    const auto outside = hn::Or(lod.level < zero_level, hn::Not(lod.level < last));
    auto level = hn::Min(hn::Max(lod.level, zero_level), last);
    auto fraction = hn::IfThenElse(hn::RebindMask(d, outside), hn::Zero(d), lod.fraction);
    hn::Store(hn::Add(hn::ConvertTo(d, level), fraction), d, choice.lod.lane + i);

    if (rules.mip == MipMode::None) {
        level = zero_level;
        fraction = hn::Zero(d);
    } else if (rules.mip == MipMode::Nearest) {
        // ceil(lambda + 1/2) - 1 (Vulkan "Image Level(s) Selection", the preferred rule); D3D adds 1/2 and truncates the quantised one.
        const auto half = hn::Set(d, 0.5f);
        const auto up = rules.quantised ? fraction >= half : fraction > half;
        level = hn::Add(level, hn::IfThenElseZero(hn::RebindMask(di, up), one_level));
        fraction = hn::Zero(d);
    }
    const auto mixes = hn::RebindMask(di, hn::Ne(fraction, hn::Zero(d)));
    choice.mixes = choice.mixes || !hn::AllFalse(di, mixes);
    hn::Store(level, di, choice.finer.lane + i);
    hn::Store(hn::Add(level, hn::IfThenElseZero(mixes, one_level)), di, choice.coarser.lane + i);
    hn::Store(fraction, d, choice.fraction.lane + i);
}

/// Level 0 throughout: what a sampler without levels reads.
HWY_INLINE void choose_base_level(LevelChoice& choice) {
    const FloatTag d;
    const IntTag di;
    for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
        hn::Store(hn::Zero(di), di, choice.finer.lane + i);
        hn::Store(hn::Zero(di), di, choice.coarser.lane + i);
        hn::Store(hn::Zero(d), d, choice.fraction.lane + i);
        hn::Store(hn::Zero(d), d, choice.lod.lane + i);
    }
    choice.magnify = kWaveFull;
    choice.mixes = false;
}

/// Chooses levels for all lanes of `at`, isotropically: lambda = log2 of the longer axis.
HWY_INLINE void select_levels(const LevelTable& table, const SamplerState& sampler, const WaveCoordinates& at, LevelChoice& choice) {
    const FloatTag d;
    const IntTag di;
    const auto width = hn::Set(d, float(table.width[0])), height = hn::Set(d, float(table.height[0]));
    const LodRules rules = lod_rules(table, sampler);
    const bool exact = sampler.lod_rule == LodRule::Exact;
    choice.magnify = 0;
    choice.mixes = false;
    for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
        ScaledJacobian j = texel_jacobian(at, i, width, height);
        // Where squares of squares neither over- nor underflow, scaling by powers of two would change no bit. What is not a number is not
        // moderate.
        const auto both2 = hn::Add(squared_length(j.sx, j.tx), squared_length(j.sy, j.ty));
        const auto moderate = hn::And(both2 >= hn::Set(d, 0x1p-20f), both2 <= hn::Set(d, 0x1p40f));
        if (HWY_UNLIKELY(!hn::AllTrue(d, moderate))) j = scale_jacobian(at, i, width, height);
        const auto longer2 = exact ? largest_singular_value(j).squared : hn::Max(squared_length(j.sx, j.tx), squared_length(j.sy, j.ty));
        const Lod lod = bound_lod(rules, lod_of_squared(longer2, j.exponent));
        choice.magnify |= wave_mask(di, magnifies(lod), i);
        store_levels(rules, lod, i, choice);
    }
}

/// Lanes whose kernel is nearest.
HWY_INLINE WaveMask nearest_lanes(const SamplerState& sampler, const LevelChoice& choice) {
    return (sampler.magnify == Kernel::Nearest ? choice.magnify : 0) | (sampler.minify == Kernel::Nearest ? ~choice.magnify : 0);
}

/// One kernel and no levels: lambda decides nothing.
HWY_INLINE bool needs_no_level(const SamplerState& sampler, const WaveFloat* lod) {
    return sampler.mip == MipMode::None && sampler.magnify == sampler.minify && lod == nullptr;
}

/// Whether no lane is minified: its longer derivative is at most a texel long, before a bias that is none.
HWY_INLINE bool magnifies_throughout(const LevelTable& table, const SamplerState& sampler, const WaveCoordinates& at) {
    if (sampler.lod_bias > 0.0f || sampler.min_lod > 0.0f || sampler.lod_rule == LodRule::Exact) return false;
    const FloatTag d;
    const auto width = hn::Set(d, float(table.width[0])), height = hn::Set(d, float(table.height[0])), one = hn::Set(d, 1.0f);
    auto all = hn::FirstN(d, hn::Lanes(d));
    for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
        const auto length2 = [&](const WaveFloat& du, const WaveFloat& dv) HWY_ATTR {
            return squared_length(hn::Mul(hn::Load(d, du.lane + i), width), hn::Mul(hn::Load(d, dv.lane + i), height));
        };
        // What is not a number is not short.
        all = hn::And(all, hn::And(length2(at.dudx, at.dvdx) <= one, length2(at.dudy, at.dvdy) <= one));
    }
    return hn::AllTrue(d, all);
}

/// Levels of an isotropic lookup.
HWY_INLINE void choose_levels(const LevelTable& table, const SamplerState& sampler, const WaveCoordinates& at, LevelChoice& choice,
                              WaveFloat* lod) {
    if (needs_no_level(sampler, lod)) return choose_base_level(choice);
    if (lod == nullptr && magnifies_throughout(table, sampler, at)) return choose_base_level(choice);
    select_levels(table, sampler, at, choice);
    if (lod != nullptr) *lod = choice.lod;
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::texunit
HWY_AFTER_NAMESPACE();

#endif  // RAWTEXEL_TEXUNIT_FOOTPRINT_INL_H_
