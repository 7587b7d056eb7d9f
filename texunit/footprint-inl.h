// The footprint of a pixel on a texture: how fine a level it asks for. Comes before the selection of taps and needs derivatives, never
// texels.
#include "texunit/lanes-inl.h"
#include "texunit/math-inl.h"

#include <hwy/highway.h>

#include <cfloat>

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

/// Which levels a wave reads. Every lane reads `finer`; where `fraction` is not 0 it mixes in that much of `coarser`, else coarser = finer.
struct LevelChoice {
    WaveInt finer, coarser;
    WaveFloat fraction;
    WaveFloat lod;         ///< lambda clamped to the levels there are
    WaveMask magnify = 0;  ///< lanes with lambda <= 0
    bool mixes = false;    ///< some lane's fraction is not 0
};

/// rho_max^2 in texels of level 0: the squared length of the longer derivative (D3D11.3 7.18.11, Vulkan "Scale Factor Operation"). Within
/// normal floats, so that its logarithm is finite; any derivative that is not finite gives the largest.
template <class V>
HWY_INLINE V rho_squared(V dudx, V dvdx, V dudy, V dvdy, V width, V height) {
    const hn::DFromV<V> d;
    const auto squared = [&](V du, V dv) HWY_ATTR {
        const V s = hn::Mul(du, width), t = hn::Mul(dv, height);
        return hn::Add(hn::Mul(s, s), hn::Mul(t, t));
    };
    const auto finite = hn::And(hn::And(hn::IsFinite(dudx), hn::IsFinite(dvdx)), hn::And(hn::IsFinite(dudy), hn::IsFinite(dvdy)));
    const V x = squared(dudx, dvdx), y = squared(dudy, dvdy);
    const V largest = hn::Set(d, FLT_MAX);
    const V longer = hn::IfThenElse(finite, hn::IfThenElse(x > y, x, y), largest);
    const V bounded = hn::IfThenElse(longer < largest, longer, largest);
    return hn::IfThenElse(bounded > hn::Set(d, FLT_MIN), bounded, hn::Set(d, FLT_MIN));
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

/// Chooses levels for all lanes of `at`.
HWY_INLINE void select_levels(const LevelTable& table, const SamplerState& sampler, const WaveCoordinates& at, LevelChoice& choice) {
    const FloatTag d;
    const IntTag di;
    const auto width = hn::Set(d, float(table.width[0])), height = hn::Set(d, float(table.height[0]));
    const auto zero = hn::Zero(d), one = hn::Set(d, 1.0f), half = hn::Set(d, 0.5f);
    const auto zero_level = hn::Zero(di), one_level = hn::Set(di, 1), last_level = hn::Set(di, table.levels - 1);
    choice.magnify = 0;
    choice.mixes = false;
    for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
        const auto rho2 = rho_squared(hn::Load(d, at.dudx.lane + i), hn::Load(d, at.dvdx.lane + i), hn::Load(d, at.dudy.lane + i),
                                      hn::Load(d, at.dvdy.lane + i), width, height);

        // lambda = log2(rho^2)/2 = level + fraction, kept apart: as one float the fraction would lose the bits of the level.
        hn::Vec<IntTag> exponent;
        hn::Vec<FloatTag> log_fraction;
        split_log2(rho2, exponent, log_fraction);
        auto level = hn::ShiftRight<1>(exponent);
        const auto odd = hn::ConvertTo(d, hn::And(exponent, one_level));
        auto fraction = hn::Mul(hn::Add(odd, log_fraction), half);
        const auto whole = fraction >= one;
        level = hn::IfThenElse(hn::RebindMask(di, whole), hn::Add(level, one_level), level);
        fraction = hn::IfThenElse(whole, zero, fraction);

        // lambda <= 0 magnifies (Vulkan "Texel Filtering"), however many levels there are; then clamp to the levels.
        const auto at_zero = hn::And(hn::Eq(level, zero_level), hn::RebindMask(di, hn::Eq(fraction, zero)));
        choice.magnify |= wave_mask(di, hn::Or(level < zero_level, at_zero), i);
        const auto outside = hn::Or(level < zero_level, hn::Not(level < last_level));
        level = hn::Min(hn::Max(level, zero_level), last_level);
        fraction = hn::IfThenElse(hn::RebindMask(d, outside), zero, fraction);
        hn::Store(hn::Add(hn::ConvertTo(d, level), fraction), d, choice.lod.lane + i);

        if (sampler.mip == MipMode::None) {
            level = zero_level;
            fraction = zero;
        } else if (sampler.mip == MipMode::Nearest) {
            // ceil(lambda + 1/2) - 1 (Vulkan "Image Level(s) Selection", the preferred rule).
            level = hn::Add(level, hn::IfThenElseZero(hn::RebindMask(di, fraction > half), one_level));
            fraction = zero;
        }
        const auto mixes = hn::RebindMask(di, hn::Ne(fraction, zero));
        choice.mixes = choice.mixes || !hn::AllFalse(di, mixes);
        hn::Store(level, di, choice.finer.lane + i);
        hn::Store(hn::Add(level, hn::IfThenElseZero(mixes, one_level)), di, choice.coarser.lane + i);
        hn::Store(fraction, d, choice.fraction.lane + i);
    }
}

/// Lanes whose kernel is nearest.
HWY_INLINE WaveMask nearest_lanes(const SamplerState& sampler, const LevelChoice& choice) {
    return (sampler.magnify == Kernel::Nearest ? choice.magnify : 0) | (sampler.minify == Kernel::Nearest ? ~choice.magnify : 0);
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::texunit
HWY_AFTER_NAMESPACE();

#endif  // RAWTEXEL_TEXUNIT_FOOTPRINT_INL_H_
