// Punctual lights in vectors: KHR_lights_punctual.
#if defined(RAWTEXEL_SHADING_PUNCTUAL_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_SHADING_PUNCTUAL_INL_H_
#undef RAWTEXEL_SHADING_PUNCTUAL_INL_H_
#else
#define RAWTEXEL_SHADING_PUNCTUAL_INL_H_
#endif

#include "shading/scene.h"
#include "shading/vector3-inl.h"

#include <algorithm>
#include <cmath>

HWY_BEFORE_NAMESPACE();
namespace rawtexel::shading {
namespace HWY_NAMESPACE {

/// What one light sends to a point: unit direction towards the light, and the share of color * intensity that arrives on a
/// surface facing it (1 for directional lights, per square metre for the others).
template <class V>
struct Incidence {
    Vector3<V> to_light;
    V attenuation;
};

/// max(min(1 - (d / range)^4, 1), 0), the window that KHR_lights_punctual recommends; 1 where the range is unlimited.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V range_window(D d, const Light& light, V distance2) {
    const V one = hn::Set(d, 1.0f);
    if (!(light.range > 0.0f)) return one;
    const V ratio2 = hn::Div(distance2, hn::Set(d, light.range * light.range));
    return hn::Max(hn::Sub(one, hn::Mul(ratio2, ratio2)), hn::Zero(d));
}

/// Angular attenuation of a spot: a squared linear ramp of the cosine between the outer and the inner cone.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V spot_cone(D d, const Light& light, const Vector3<V>& to_light) {
    const float cos_outer = std::cos(light.outer_cone);
    const float slope = 1.0f / std::max(0.001f, std::cos(light.inner_cone) - cos_outer);
    const V cosine = dot(to_light, set3(d, -light.direction));
    const V ramp = hn::Mul(hn::Sub(cosine, hn::Set(d, cos_outer)), hn::Set(d, slope));
    const V clamped = hn::Min(hn::Max(ramp, hn::Zero(d)), hn::Set(d, 1.0f));
    return hn::Mul(clamped, clamped);
}

template <class D, class V = hn::Vec<D>>
HWY_INLINE Incidence<V> incidence(D d, const Light& light, const Vector3<V>& position) {
    const V one = hn::Set(d, 1.0f);
    if (light.type == Light::Type::Directional) return {set3(d, -light.direction), one};
    const Vector3<V> offset = sub(set3(d, light.position), position);
    // A tenth of a millimetre at least: a point on the light itself stays finite.
    const V distance2 = hn::Max(dot(offset, offset), hn::Set(d, 1e-8f));
    const Vector3<V> to_light = scale(offset, hn::Div(one, hn::Sqrt(distance2)));
    V attenuation = hn::Div(range_window(d, light, distance2), distance2);
    if (light.type == Light::Type::Spot) attenuation = hn::Mul(attenuation, spot_cone(d, light, to_light));
    return {to_light, attenuation};
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::shading
HWY_AFTER_NAMESPACE();

#endif  // RAWTEXEL_SHADING_PUNCTUAL_INL_H_
