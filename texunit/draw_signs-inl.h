// The taps that a draw chooses among, and where kernels have negative lobes the signs of the axes' weights, drawn before the texel.
#include "texunit/draw_axis-inl.h"
#include "texunit/draw_place-inl.h"

#include <hwy/highway.h>

// Included once per instruction set (highway's guard for -inl.h files).
#if defined(RAWTEXEL_TEXUNIT_DRAW_SIGNS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_TEXUNIT_DRAW_SIGNS_INL_H_
#undef RAWTEXEL_TEXUNIT_DRAW_SIGNS_INL_H_
#else
#define RAWTEXEL_TEXUNIT_DRAW_SIGNS_INL_H_
#endif

HWY_BEFORE_NAMESPACE();
namespace rawtexel::texunit {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

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

/// The taps of a kernel along the axes of a texture.
struct TextureTaps {
    bool volume;
    AxisTaps x, y, z;  ///< z of volumes alone
};

HWY_INLINE void select_axes(const DrawnLookup& lookup, const Kernel& kernel, const DrawnPlace& place, TextureTaps& taps) {
    const LevelTable& table = *lookup.levels;
    const SamplerState& sampler = *lookup.sampler;
    const WavePosition& at = *place.position;
    taps.volume = at.w != nullptr;
    const auto axis = [&](EdgeRule rule, const WaveFloat& coordinate, const std::array<int32_t, 16>& extents, const WaveFloat* rest,
                          AxisTaps& to) HWY_ATTR {
        select_wide_axis(kernel, rule, coordinate, extents, place.level, {sampler.precision, rest}, to);
    };
    axis(rule_of(at, sampler.wrap_s), *at.u, table.width, at.u_rest, taps.x);
    axis(rule_of(at, sampler.wrap_t), *at.v, table.height, at.v_rest, taps.y);
    if (taps.volume) axis(edge_rule(sampler.wrap_r), *at.w, table.depth, nullptr, taps.z);
}

/// The same of a kernel with negative lobes.
struct SignedTaps : TextureTaps {
    SignedSums sums_x, sums_y, sums_z;
};

HWY_INLINE void select_signed_axes(const DrawnLookup& lookup, const Kernel& kernel, const DrawnPlace& place, SignedTaps& taps) {
    select_axes(lookup, kernel, place, taps);
    sum_signs(taps.x, taps.sums_x);
    sum_signs(taps.y, taps.sums_y);
    if (taps.volume) sum_signs(taps.z, taps.sums_z);
}

/// Signs that the axes' weights can have, in the order in which they are drawn: first the half whose product is positive.
struct SignPattern {
    bool negative_x, negative_y, negative_z;
};
inline constexpr int kFlatPatterns = 4, kVolumePatterns = 8;
inline constexpr SignPattern kFlatSigns[kFlatPatterns] = {
    {false, false, false}, {true, true, false}, {false, true, false}, {true, false, false}};
inline constexpr SignPattern kVolumeSigns[kVolumePatterns] = {{false, false, false}, {true, true, false},  {false, true, true},
                                                              {true, false, true},   {false, true, false}, {true, false, false},
                                                              {false, false, true},  {true, true, true}};
HWY_INLINE int sign_patterns(const SignedTaps& taps) { return taps.volume ? kVolumePatterns : kFlatPatterns; }
HWY_INLINE const SignPattern* signs_of(const SignedTaps& taps) { return taps.volume ? kVolumeSigns : kFlatSigns; }

/// Probabilities of the patterns for the lanes i .. , and the magnitudes' sum of the lookup's own negative weights. Lobes of no mass at all
/// give 0 everywhere.
struct SignShares {
    FloatVec share[kVolumePatterns];
    FloatVec negative_mass;
};
HWY_INLINE SignShares sign_shares(const SignedTaps& taps, Lobes lobes, const WaveFloat* wanted, size_t i) {
    const FloatTag d;
    const auto zero = hn::Zero(d);
    const int count = sign_patterns(taps);
    const SignPattern* const signs = signs_of(taps);
    const auto sum_of = [&](const SignedSums& sums, bool negative)
                            HWY_ATTR { return hn::Load(d, (negative ? sums.negative : sums.positive).lane + i); };
    SignShares shares;
    FloatVec(&share)[kVolumePatterns] = shares.share;
    for (int n = 0; n < count; ++n) {
        share[n] = hn::Mul(sum_of(taps.sums_x, signs[n].negative_x), sum_of(taps.sums_y, signs[n].negative_y));
        if (taps.volume) share[n] = hn::Mul(share[n], sum_of(taps.sums_z, signs[n].negative_z));
    }
    const auto sum_half = [&](int first) HWY_ATTR {
        auto sum = hn::Add(share[first], share[first + 1]);
        for (int n = first + 2; n < first + count / 2; ++n) sum = hn::Add(sum, share[n]);
        return sum;
    };
    shares.negative_mass = sum_half(count / 2);
    if (lobes == Lobes::Positive) {
        for (int n = count / 2; n < count; ++n) share[n] = zero;
    } else if (lobes == Lobes::Negative) {
        const auto missing = hn::Max(hn::Sub(hn::Load(d, wanted->lane + i), shares.negative_mass), zero);
        const auto scale = hn::Div(missing, sum_half(0));
        for (int n = 0; n < count / 2; ++n) share[n] = hn::Mul(share[n], scale);
    }
    const auto sum = hn::Add(sum_half(0), sum_half(count / 2));
    for (int n = 0; n < count; ++n) share[n] = hn::IfThenElseZero(sum > zero, hn::Div(share[n], sum));
    return shares;
}

/// Signs of the axes' weights, one bit a lane.
struct DrawnSigns {
    WaveMask negative_x = 0, negative_y = 0, negative_z = 0;
};
HWY_INLINE DrawnSigns draw_signs(const SignedTaps& taps, Lobes lobes, const LobeMass& mass, const WaveFloat& number) {
    const FloatTag d;
    const int count = sign_patterns(taps);
    const SignPattern* const signs = signs_of(taps);
    const auto take = [](bool negative, WaveMask lanes, WaveMask& mask) { mask = negative ? mask | lanes : mask & ~lanes; };
    DrawnSigns drawn;
    for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
        const SignShares shares = sign_shares(taps, lobes, mass.wanted, i);
        if (mass.found != nullptr) hn::Store(shares.negative_mass, d, mass.found->lane + i);
        const auto random = hn::Load(d, number.lane + i);
        auto before = hn::Zero(d);
        for (int n = 0; n < count; ++n) {
            const WaveMask lanes = wave_mask(d, hn::And(shares.share[n] > hn::Zero(d), random >= before), i);
            take(signs[n].negative_x, lanes, drawn.negative_x);
            take(signs[n].negative_y, lanes, drawn.negative_y);
            take(signs[n].negative_z, lanes, drawn.negative_z);
            before = hn::Add(before, shares.share[n]);
        }
    }
    return drawn;
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::texunit
HWY_AFTER_NAMESPACE();

#endif  // RAWTEXEL_TEXUNIT_DRAW_SIGNS_INL_H_
