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
    bool stretched;  ///< the lobe has `axis` instead of alpha (SurfaceWave::axis)
    Vector3<V> axis[2];
    V axes_area;  ///< |axis[0] x axis[1]|: alpha^2 of a round lobe
};

template <class D, class V = hn::Vec<D>>
HWY_INLINE V smith_term(D d, V n_dot, V alpha2) {
    return hn::Sqrt(hn::Add(hn::Mul(hn::Mul(n_dot, n_dot), hn::Sub(hn::Set(d, 1.0f), alpha2)), alpha2));
}

/// The same of a stretched lobe, whose alpha is that towards `direction` (Heitz 2014 section 5.4).
template <class D, class V = hn::Vec<D>>
HWY_INLINE V smith_term(D d, const ShadingPoint<V>& p, const Vector3<V>& direction, V n_dot) {
    if (!p.stretched) return smith_term(d, n_dot, p.alpha2);
    const V a = dot(p.axis[0], direction), b = dot(p.axis[1], direction);
    return hn::Sqrt(hn::Add(hn::Mul(n_dot, n_dot), hn::Add(hn::Mul(a, a), hn::Mul(b, b))));
}

template <class D, class V = hn::Vec<D>>
HWY_INLINE void load_axes(D d, const SurfaceWave& surface, size_t lane, ShadingPoint<V>& p) {
    p.stretched = surface.stretched;
    const V zero = hn::Zero(d);
    p.axis[0] = p.axis[1] = {zero, zero, zero};
    p.axes_area = zero;
    if (!p.stretched) return;
    for (int k = 0; k < 2; ++k) p.axis[k] = load3(d, surface.axis[k], lane);
    p.axes_area = hn::Abs(dot(cross(p.axis[0], p.axis[1]), p.normal));
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
    load_axes(d, surface, lane, p);
    p.smith_view = smith_term(d, p, p.view, p.n_dot_v);

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
    // A stretched lobe's is q^3 / (pi ((axis[0].t)^2 + (axis[1].t)^2 + (q n.h)^2)^2), t = n x h, q the axes' area.
    const Vector3<V> tilt = cross(p.normal, half);
    const V peak = hn::Mul(n_dot_h, n_dot_h);
    V lobe, scaled;
    if (p.stretched) {
        const V a = dot(p.axis[0], tilt), b = dot(p.axis[1], tilt), area2 = hn::Mul(p.axes_area, p.axes_area);
        lobe = hn::Add(hn::Add(hn::Mul(a, a), hn::Mul(b, b)), hn::Mul(peak, area2));
        scaled = hn::Mul(area2, p.axes_area);
    } else {
        lobe = hn::Add(dot(tilt, tilt), hn::Mul(peak, p.alpha2));
        scaled = p.alpha2;
    }
    const V spread = hn::IfThenElse(hn::Gt(n_dot_h, zero), lobe, one);
    const V distribution = hn::Div(hn::Mul(scaled, hn::Set(d, kInversePi)), hn::Mul(spread, spread));

    // V = 0.5 / (n.l sqrt((n.v)^2 (1 - a^2) + a^2) + n.v sqrt((n.l)^2 (1 - a^2) + a^2)), Heitz 2014 eq. 99.
    const V smith_light = smith_term(d, p, light, n_dot_l);
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
