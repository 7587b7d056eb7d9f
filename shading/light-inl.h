// Shading a wave: emission, ambient, punctual lights with the sun's shadow, environment. Work whose weight is zero is skipped.
#if defined(RAWTEXEL_SHADING_LIGHT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_SHADING_LIGHT_INL_H_
#undef RAWTEXEL_SHADING_LIGHT_INL_H_
#else
#define RAWTEXEL_SHADING_LIGHT_INL_H_
#endif

#include "shading/brdf-inl.h"
#include "shading/environment-inl.h"
#include "shading/ggx_albedo-inl.h"
#include "shading/lighting.h"
#include "shading/punctual-inl.h"
#include "shading/reflection_probes-inl.h"
#include "shading/shadow-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rawtexel::shading {
namespace HWY_NAMESPACE {

/// What stands between a light and a point.
template <class V>
struct ShadowTest {
    const ShadowMap* map;  ///< null: nothing
    bool draws;            ///< one depth test by the numbers
    bool skips;            ///< tests that weigh nothing
    V x, y;

    template <class D>
    HWY_INLINE V visibility(D d, const ShadingPoint<V>& p) const {
        if (draws) return drawn_shadow_visibility_lanes(d, *map, p.position, p.geometric_normal, x, y, skips);
        return shadow_visibility_lanes(d, *map, p.position, p.geometric_normal, skips);
    }
};

/// Radiance that one punctual light adds.
template <class D, class V = hn::Vec<D>>
HWY_INLINE Vector3<V> punctual_radiance(D d, const Light& light, const ShadowTest<V>& shadow, const ShadingPoint<V>& p) {
    const V zero = hn::Zero(d);
    const Incidence<V> arriving = incidence(d, light, p.position);
    const V n_dot_l = dot(p.normal, arriving.to_light);
    const auto lit = hn::And(hn::Gt(n_dot_l, zero), hn::Gt(arriving.attenuation, zero));
    if (shadow.skips && hn::AllFalse(d, lit)) return {zero, zero, zero};

    V share = arriving.attenuation;
    if (shadow.map) share = hn::Mul(share, shadow.visibility(d, p));
    const auto arrives = hn::And(lit, hn::Gt(share, zero));
    if (shadow.skips && hn::AllFalse(d, arrives)) return {zero, zero, zero};
    const Vector3<V> reflected = brdf_cosine(d, p, arriving.to_light, hn::Max(n_dot_l, zero));
    const Vector3<V> radiance = mul(scale(reflected, share), set3(d, light.color * light.intensity));
    return {hn::IfThenElseZero(arrives, radiance.x), hn::IfThenElseZero(arrives, radiance.y), hn::IfThenElseZero(arrives, radiance.z)};
}

/// Environment light that the surface reflects, F0 = 0..1. SplitSum: its weight times the mean light of the prefiltered lobe that resembles
/// it most (Karis 2013). Prefiltered: a sum over the probes of reflection_probes.h.
template <class D, class V = hn::Vec<D>>
HWY_INLINE Vector3<V> environment_reflection(D d, const Environment::Tables& tables, EnvironmentReflections way, const ShadingPoint<V>& p,
                                             V n_dot_v) {
    const GgxLobe<V> lobe = ggx_lobe(d, *tables.reflection, n_dot_v, p.roughness);
    const Vector3<V> mirrored = sub(scale(p.normal, hn::Mul(hn::Set(d, 2.0f), dot(p.normal, p.view))), p.view);
    const Vector3<V> to_normal = sub(p.normal, mirrored);
    const auto weighted = [&](V lean, V roughness, V scale_share, V bias_share) HWY_ATTR {
        const Vector3<V> light = specular_radiance(d, tables, add(mirrored, scale(to_normal, lean)), roughness);
        const auto channel = [&](V f0, V arriving) HWY_ATTR { return hn::Mul(hn::Add(hn::Mul(f0, scale_share), bias_share), arriving); };
        return Vector3<V>{channel(p.f0.x, light.x), channel(p.f0.y, light.y), channel(p.f0.z, light.z)};
    };
    if (way == EnvironmentReflections::SplitSum) return weighted(lobe.lean, lobe.roughness, lobe.scale, lobe.bias);

    const V zero = hn::Zero(d);
    Vector3<V> sum{zero, zero, zero};
    const auto nodes = probe_nodes(d, n_dot_v, p.roughness);
    for (int k = 0; k < ReflectionProbeTable::kProbes; ++k) {
        const ReflectionProbe<V> probe = reflection_probe(d, kReflectionProbes, nodes, k);
        if (hn::AllFalse(d, hn::Gt(hn::Add(probe.scale, probe.bias), zero))) continue;
        sum = add(sum, weighted(probe.lean, probe.roughness, hn::Mul(lobe.scale, probe.scale), hn::Mul(lobe.bias, probe.bias)));
    }
    return sum;
}

/// Radiance that the environment adds.
template <class D, class V = hn::Vec<D>>
HWY_INLINE Vector3<V> environment_radiance(D d, const Environment::Tables& tables, EnvironmentReflections way, const ShadingPoint<V>& p) {
    const V one = hn::Set(d, 1.0f);
    const V n_dot_v = hn::Min(p.n_dot_v, one);
    Vector3<V> radiance = environment_reflection(d, tables, way, p, n_dot_v);

    // Metals and black have no diffuse term. Of the others' light, F0 + (1 - F0) * mean Schlick weight is reflected before it enters.
    const V most = hn::Max(hn::Max(p.diffuse.x, p.diffuse.y), p.diffuse.z);
    if (!hn::AllFalse(d, hn::Gt(most, hn::Zero(d)))) {
        const Vector3<V> light = diffuse_radiance(d, tables, p.normal);
        const V entering = hn::Mul(hn::Sub(one, diffuse_fresnel(d, n_dot_v)), hn::Set(d, 3.14159265f));
        const Vector3<V> reflected = mul(p.diffuse, light);
        const auto diffuse = [&](V f0, V reflected_light)
                                 HWY_ATTR { return hn::Mul(hn::Mul(hn::Sub(one, f0), entering), reflected_light); };
        radiance = add(radiance, {diffuse(p.f0.x, reflected.x), diffuse(p.f0.y, reflected.y), diffuse(p.f0.z, reflected.z)});
    }
    return scale(radiance, p.occlusion);
}

/// Radiance towards the viewer at the lanes of `mask`: shade_surface of lighting.h. `skips`: what weighs nothing is left out.
inline void shade_lanes(const Lighting& lighting, const SurfaceWave& surface, WaveMask mask, WaveVector& radiance,
                        const ShadowNumbers* shadow_numbers = nullptr, bool skips = true) {
    const hn::ScalableTag<float> d;
    for (size_t i = 0; i < size_t(texunit::kWaveLanes); i += hn::Lanes(d)) {
        if (!any_active(mask, i, hn::Lanes(d))) {
            store3(d, set3(d, glm::vec3(0.0f)), radiance, i);
            continue;
        }
        const auto point = load_point(d, surface, i);
        const auto ambient = hn::Mul(hn::Set(d, lighting.ambient), point.occlusion);
        auto sum = add(scale(load3(d, surface.base_color, i), ambient), load3(d, surface.emission, i));

        // The shadow map is the first directional light's.
        const auto zero = hn::Zero(d);
        ShadowTest<hn::Vec<decltype(d)>> shadow{lighting.shadow.get(), shadow_numbers != nullptr, skips, zero, zero};
        if (shadow.draws) shadow.x = hn::Load(d, shadow_numbers->x.lane + i), shadow.y = hn::Load(d, shadow_numbers->y.lane + i);
        const ShadowTest<hn::Vec<decltype(d)>> nothing{nullptr, false, skips, zero, zero};
        for (const Light& light : lighting.lights) {
            const bool directional = light.type == Light::Type::Directional;
            sum = add(sum, punctual_radiance(d, light, directional ? shadow : nothing, point));
            if (directional) shadow.map = nullptr;
        }
        if (lighting.environment) sum = add(sum, environment_radiance(d, lighting.environment->tables(), lighting.reflections, point));
        store3(d, sum, radiance, i);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::shading
HWY_AFTER_NAMESPACE();

#endif  // RAWTEXEL_SHADING_LIGHT_INL_H_
