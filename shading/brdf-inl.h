// The surface model in vectors: glTF 2.0 appendix B, metallic-roughness.
#if defined(RAWTEXEL_SHADING_BRDF_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_SHADING_BRDF_INL_H_
#undef RAWTEXEL_SHADING_BRDF_INL_H_
#else
#define RAWTEXEL_SHADING_BRDF_INL_H_
#endif

#include "shading/brdf.h"
#include "shading/vector3-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rawtexel::shading {
namespace HWY_NAMESPACE {

/// What every light shares at a shading point.
template <class V>
struct ShadingPoint {
    Vector3<V> position, normal, geometric_normal, view;
    V n_dot_v;           ///< at least kMinNdotV
    V roughness;         ///< perceptual, at least sqrt(kMinAlpha)
    V alpha2;            ///< alpha^2
    V smith_view;        ///< sqrt(n.v^2 (1 - alpha^2) + alpha^2)
    Vector3<V> f0;       ///< reflectance at normal incidence
    Vector3<V> diffuse;  ///< (1 - metallic) base / pi
    V occlusion;
};

template <class D, class V = hn::Vec<D>>
HWY_INLINE V smith_term(D d, V n_dot, V alpha2) {
    return hn::Sqrt(hn::Add(hn::Mul(hn::Mul(n_dot, n_dot), hn::Sub(hn::Set(d, 1.0f), alpha2)), alpha2));
}

template <class D, class V = hn::Vec<D>>
HWY_INLINE ShadingPoint<V> load_point(D d, const SurfaceWave& surface, size_t lane) {
    ShadingPoint<V> p;
    p.position = load3(d, surface.position, lane);
    p.normal = load3(d, surface.normal, lane);
    p.geometric_normal = load3(d, surface.geometric_normal, lane);
    p.view = load3(d, surface.view, lane);
    p.occlusion = hn::Load(d, surface.occlusion.lane + lane);
    p.n_dot_v = hn::Max(dot(p.normal, p.view), hn::Set(d, kMinNdotV));

    const V roughness = hn::Load(d, surface.roughness.lane + lane);
    const V alpha = hn::Max(hn::Mul(roughness, roughness), hn::Set(d, kMinAlpha));
    p.roughness = hn::Max(roughness, hn::Set(d, kMinRoughness));
    p.alpha2 = hn::Mul(alpha, alpha);
    p.smith_view = smith_term(d, p.n_dot_v, p.alpha2);

    // F0 = lerp(0.04, base, metallic): dielectrics keep their colour in the diffuse term, metals in the reflection.
    const Vector3<V> base = load3(d, surface.base_color, lane);
    const V metallic = hn::Load(d, surface.metallic.lane + lane);
    const V dielectric = hn::Sub(hn::Set(d, 1.0f), metallic);
    const V dielectric_f0 = hn::Mul(dielectric, hn::Set(d, kDielectricF0));
    p.f0 = {hn::Add(dielectric_f0, hn::Mul(base.x, metallic)), hn::Add(dielectric_f0, hn::Mul(base.y, metallic)),
            hn::Add(dielectric_f0, hn::Mul(base.z, metallic))};
    p.diffuse = scale(base, hn::Mul(dielectric, hn::Set(d, kInversePi)));
    return p;
}

/// (1 - x)^5 of Schlick's approximation.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V schlick_weight(D d, V v_dot_h) {
    const V k = hn::Sub(hn::Set(d, 1.0f), v_dot_h);
    const V k2 = hn::Mul(k, k);
    return hn::Mul(hn::Mul(k2, k2), k);
}

/// f(l, v) * n.l towards unit `light`, where n_dot_l > 0.
template <class D, class V = hn::Vec<D>>
HWY_INLINE Vector3<V> brdf_cosine(D d, const ShadingPoint<V>& p, const Vector3<V>& light, V n_dot_l) {
    const V zero = hn::Zero(d), one = hn::Set(d, 1.0f);
    // Half vector; the floor keeps a light exactly behind the eye's ray finite.
    const Vector3<V> sum = add(p.view, light);
    const V length = hn::Sqrt(hn::Max(dot(sum, sum), hn::Set(d, 1e-12f)));
    const Vector3<V> half = scale(sum, hn::Div(one, length));
    const V n_dot_h = dot(p.normal, half);
    const V v_dot_h = hn::Max(dot(p.view, half), zero);

    // D = a^2 / (pi ((n.h)^2 (a^2 - 1) + 1)^2), written with |n x h|^2 = 1 - (n.h)^2, which does not cancel at the highlight's peak.
    const Vector3<V> tilt = cross(p.normal, half);
    const V lobe = hn::Add(dot(tilt, tilt), hn::Mul(hn::Mul(n_dot_h, n_dot_h), p.alpha2));
    const V spread = hn::IfThenElse(hn::Gt(n_dot_h, zero), lobe, one);
    const V distribution = hn::Div(hn::Mul(p.alpha2, hn::Set(d, kInversePi)), hn::Mul(spread, spread));

    // V = 0.5 / (n.l sqrt((n.v)^2 (1 - a^2) + a^2) + n.v sqrt((n.l)^2 (1 - a^2) + a^2)), Heitz 2014 eq. 99.
    const V smith_light = smith_term(d, n_dot_l, p.alpha2);
    const V smith = hn::Add(hn::Add(hn::Mul(n_dot_l, p.smith_view), hn::Mul(p.n_dot_v, smith_light)), hn::Set(d, 1e-7f));
    const V specular = hn::Div(hn::Mul(distribution, hn::Set(d, 0.5f)), smith);

    // (1 - F) diffuse + F specular, F = F0 + (1 - F0) k.
    const V k = schlick_weight(d, v_dot_h);
    const auto channel = [&](V f0, V diffuse) HWY_ATTR {
        const V fresnel = hn::Add(f0, hn::Mul(hn::Sub(one, f0), k));
        const V reflected = hn::Add(hn::Mul(hn::Sub(one, fresnel), diffuse), hn::Mul(fresnel, specular));
        return hn::Mul(reflected, n_dot_l);
    };
    return {channel(p.f0.x, p.diffuse.x), channel(p.f0.y, p.diffuse.y), channel(p.f0.z, p.diffuse.z)};
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::shading
HWY_AFTER_NAMESPACE();

#endif  // RAWTEXEL_SHADING_BRDF_INL_H_
