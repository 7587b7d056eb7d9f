// Corrections of gloss: what the spread of a normal map's texels under the footprint adds to the roughness (shading/baseline.h).
#if defined(RAWTEXEL_SHADING_GLOSS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_SHADING_GLOSS_INL_H_
#undef RAWTEXEL_SHADING_GLOSS_INL_H_
#else
#define RAWTEXEL_SHADING_GLOSS_INL_H_
#endif

#include "shading/brdf.h"
#include "shading/draw_state.h"
#include "shading/fragment.h"
#include "shading/lanes-inl.h"
#include "shading/lookup-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rawtexel::shading {
namespace HWY_NAMESPACE {

/// alpha^2 of a lobe of perceptual roughness.
HWY_INLINE FloatVector alpha_squared(FloatVector roughness) {
    const FloatVector alpha = hn::Max(hn::Mul(roughness, roughness), hn::Set(FloatLanes(), kMinAlpha));
    return hn::Mul(alpha, alpha);
}
HWY_INLINE FloatVector roughness_of(FloatVector alpha2) { return hn::Min(hn::Sqrt(hn::Sqrt(alpha2)), hn::Set(FloatLanes(), 1.0f)); }

/// The power s = 2/alpha^2 - 2 of the lobe times ft = |N| / (|N| + s (1 - |N|)), N the filtered normal (Toksvig 2005). That is
/// 1/s' = 1/s + v with the variance v = (1 - |N|) / |N|, which grows with the square of the map's scale.
HWY_NOINLINE inline void shorten_gloss(const MaterialState& state, const texunit::WaveColor& texel, SurfaceWave& out) {
    const FloatLanes d;
    const auto zero = hn::Zero(d), one = hn::Set(d, 1.0f), two = hn::Set(d, 2.0f);
    const auto scale2 = hn::Set(d, state.material->normal_scale * state.material->normal_scale);
    for (size_t i = 0; i < texunit::kWaveLanes; i += hn::Lanes(d)) {
        const SpaceVector code = load_rgb(texel, i), normal = sub(scale(code, two), SpaceVector{one, one, one});
        const auto length = hn::Max(hn::Min(hn::Sqrt(dot(normal, normal)), one), hn::Set(d, 1e-3f));
        const auto variance = hn::Mul(hn::Div(hn::Sub(one, length), length), scale2);
        const auto roughness = hn::Load(d, out.roughness.lane + i);
        const auto power = hn::Sub(hn::Div(two, alpha_squared(roughness)), two);
        const auto corrected = hn::Div(power, hn::Add(one, hn::Mul(power, variance)));
        const auto rougher = roughness_of(hn::Div(two, hn::Add(corrected, two)));
        hn::Store(hn::IfThenElse(variance > zero, rougher, roughness), d, out.roughness.lane + i);
    }
}

/// Covariance of the slopes under a footprint, in the surface's frame, and their mean.
struct SlopeSpread {
    FloatVector mean_x, mean_y, xx, xy, yy;
};

/// Clean has the mean of both variances for either axis.
HWY_INLINE SlopeSpread slope_spread(const MaterialState& state, const MapColors& maps, size_t i) {
    const FloatLanes d;
    const auto zero = hn::Zero(d);
    const float factor = state.material->normal_scale;
    const auto moment = [&](const texunit::WaveColor& of, int c, float by)
                            HWY_ATTR { return hn::Mul(hn::Load(d, of.channel[c].lane + i), hn::Set(d, by)); };
    const texunit::WaveColor& powers = maps.moments[0];
    SlopeSpread s;
    s.mean_x = moment(powers, 0, factor), s.mean_y = moment(powers, 1, factor);
    // Rounding, and kernels with negative lobes, may leave less than nothing.
    s.xx = hn::Max(hn::Sub(moment(powers, 2, factor * factor), hn::Mul(s.mean_x, s.mean_x)), zero);
    s.yy = hn::Max(hn::Sub(moment(powers, 3, factor * factor), hn::Mul(s.mean_y, s.mean_y)), zero);
    s.xy = zero;
    if (state.gloss.way == Baseline::Lean) {
        const auto most = hn::Sqrt(hn::Mul(s.xx, s.yy));
        const auto product = hn::Sub(moment(maps.moments[1], 0, factor * factor), hn::Mul(s.mean_x, s.mean_y));
        s.xy = hn::Min(hn::Max(product, hn::Neg(most)), most);
    } else {
        s.xx = s.yy = hn::Mul(hn::Add(s.xx, s.yy), hn::Set(d, 0.5f));
    }
    return s;
}

/// Two vectors across `normal` whose outer products add up to the covariance of normals whose slopes spread so: to first order a slope's
/// change w in the surface's plane turns the normal by w's part across it, divided by the length of (slopes, 1).
struct NormalSpread {
    SpaceVector a, b;
};
HWY_INLINE NormalSpread normal_spread(const SlopeSpread& s, const SpaceVector& tangent, const SpaceVector& bitangent,
                                      const SpaceVector& normal) {
    const FloatLanes d;
    const auto zero = hn::Zero(d), one = hn::Set(d, 1.0f);
    const auto length2 = hn::Add(one, hn::Add(hn::Mul(s.mean_x, s.mean_x), hn::Mul(s.mean_y, s.mean_y)));
    const auto shrink = hn::Div(one, hn::Sqrt(length2));
    const auto across = [&](const SpaceVector& w) HWY_ATTR { return scale(sub(w, scale(normal, dot(normal, w))), shrink); };
    // Cholesky's factor of the covariance.
    const auto xx = hn::Sqrt(s.xx);
    const auto xy = hn::IfThenElseZero(xx > zero, hn::Div(s.xy, xx));
    const auto yy = hn::Sqrt(hn::Max(hn::Sub(s.yy, hn::Mul(xy, xy)), zero));
    return {across(add(scale(tangent, xx), scale(bitangent, xy))), across(scale(bitangent, yy))};
}

/// Two unit vectors across a unit normal (Duff et al. 2017, "Building an Orthonormal Basis, Revisited").
HWY_INLINE NormalSpread basis_across(const SpaceVector& n) {
    const FloatLanes d;
    const auto one = hn::Set(d, 1.0f);
    const auto sign = hn::CopySign(one, n.z);
    const auto a = hn::Div(hn::Set(d, -1.0f), hn::Add(sign, n.z));
    const auto b = hn::Mul(hn::Mul(n.x, n.y), a);
    return {{hn::Add(one, hn::Mul(sign, hn::Mul(hn::Mul(n.x, n.x), a))), hn::Mul(sign, b), hn::Neg(hn::Mul(sign, n.x))},
            {b, hn::Add(sign, hn::Mul(hn::Mul(n.y, n.y), a)), hn::Neg(n.y)}};
}

/// Axes whose outer products add up to alpha^2 I + 2 C across the normal: a Beckmann lobe of alpha has the variance alpha^2/2 per axis.
HWY_INLINE void stretch_lobe(const NormalSpread& spread, FloatVector alpha2, const SpaceVector& normal, SurfaceWave& out, size_t i) {
    const FloatLanes d;
    const auto two = hn::Set(d, 2.0f);
    const NormalSpread basis = basis_across(normal);
    const auto au = dot(spread.a, basis.a), av = dot(spread.a, basis.b), bu = dot(spread.b, basis.a), bv = dot(spread.b, basis.b);
    const auto entry = [&](FloatVector x1, FloatVector y1, FloatVector x2, FloatVector y2)
                           HWY_ATTR { return hn::Mul(two, hn::Add(hn::Mul(x1, y1), hn::Mul(x2, y2))); };
    const auto uu = hn::Add(alpha2, entry(au, au, bu, bu)), vv = hn::Add(alpha2, entry(av, av, bv, bv)), uv = entry(au, av, bu, bv);
    const auto u = hn::Sqrt(uu), across = hn::Div(uv, u);
    // alpha^2 is the least that either axis can have.
    const auto v = hn::Sqrt(hn::Max(hn::Sub(vv, hn::Mul(across, across)), alpha2));
    store3(d, add(scale(basis.a, u), scale(basis.b, across)), out.axis[0], i);
    store3(d, scale(basis.b, v), out.axis[1], i);
}

/// The normal from the mean slopes, and the lobe with their covariance added (Olano and Baker 2010).
HWY_NOINLINE inline void spread_lobe(const MaterialState& state, const FragmentWave& fragment, const MapColors& maps, SurfaceWave& out) {
    const FloatLanes d;
    out.stretched = state.gloss.way == Baseline::Lean;
    for (size_t i = 0; i < texunit::kWaveLanes; i += hn::Lanes(d)) {
        const SlopeSpread slopes = slope_spread(state, maps, i);
        const SpaceVector base = load3(d, fragment.normal, i), tangent = load3(d, fragment.tangent, i);
        const SpaceVector bitangent = scale(cross(base, tangent), hn::Load(d, fragment.bitangent_sign.lane + i));
        const SpaceVector normal = unit_or(add(add(scale(tangent, slopes.mean_x), scale(bitangent, slopes.mean_y)), base), base);
        const NormalSpread spread = normal_spread(slopes, tangent, bitangent, normal);
        const auto alpha2 = alpha_squared(hn::Load(d, out.roughness.lane + i));
        const auto both = hn::Add(dot(spread.a, spread.a), dot(spread.b, spread.b));
        hn::Store(roughness_of(hn::Add(alpha2, both)), d, out.roughness.lane + i);
        store3(d, scale(normal, hn::Load(d, fragment.facing.lane + i)), out.normal, i);
        if (out.stretched) stretch_lobe(spread, alpha2, normal, out, i);
    }
}

/// `out` has its normals and its roughness.
HWY_INLINE void correct_gloss(const MaterialState& state, const FragmentWave& fragment, const MapColors& maps, SurfaceWave& out) {
    if (state.gloss.way == Baseline::Toksvig) return shorten_gloss(state, maps.slot[kNormal], out);
    spread_lobe(state, fragment, maps, out);
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::shading
HWY_AFTER_NAMESPACE();
#endif
