#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shading/lighting.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "shading/light-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rawtexel::shading {
namespace HWY_NAMESPACE {

void shade(const Lighting& lighting, const SurfaceWave& surface, WaveMask mask, WaveVector& radiance, const ShadowNumbers* shadow_numbers) {
    shade_lanes(lighting, surface, mask, radiance, shadow_numbers);
}

void look_around(const Environment& environment, const WaveVector& direction, WaveMask mask, WaveVector& out) {
    environment_radiance_lanes(environment, direction, mask, out);
}

/// Specular light of 32 directions and roughnesses.
void look_specular(const Environment& environment, const WaveVector& direction, const WaveFloat& roughness, WaveMask mask,
                   WaveVector& out) {
    const hn::ScalableTag<float> d;
    for (size_t i = 0; i < size_t(texunit::kWaveLanes); i += hn::Lanes(d)) {
        if (!any_active(mask, i, hn::Lanes(d))) continue;
        store3(d, specular_radiance(d, environment.tables(), load3(d, direction, i), hn::Load(d, roughness.lane + i)), out, i);
    }
}

/// Scale and bias of 32 pairs of n.v (`n_dot_v`) and roughness.
void look_albedo(const WaveFloat& n_dot_v, const WaveFloat& roughness, WaveFloat& scale_out, WaveFloat& bias_out) {
    const hn::ScalableTag<float> d;
    const auto albedo = ggx_lobe(d, ggx_reflection_table(), hn::Load(d, n_dot_v.lane), hn::Load(d, roughness.lane));
    hn::Store(albedo.scale, d, scale_out.lane);
    hn::Store(albedo.bias, d, bias_out.lane);
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::shading
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rawtexel::shading {
HWY_EXPORT(shade);
HWY_EXPORT(look_around);
HWY_EXPORT(look_specular);
HWY_EXPORT(look_albedo);
namespace {

/// A wave whose first lane is `v` and whose others look along it too.
WaveVector all_lanes(const glm::vec3& v) {
    WaveVector wave;
    for (int i = 0; i < texunit::kWaveLanes; ++i) {
        wave.x[i] = v.x;
        wave.y[i] = v.y;
        wave.z[i] = v.z;
    }
    return wave;
}

WaveFloat all_lanes(float v) {
    WaveFloat wave;
    for (float& lane : wave.lane) lane = v;
    return wave;
}

glm::vec3 first_lane(const WaveVector& wave) { return {wave.x[0], wave.y[0], wave.z[0]}; }

}  // namespace

void shade_surface(const Lighting& lighting, const SurfaceWave& surface, WaveMask mask, WaveVector& radiance,
                   const ShadowNumbers* shadow_numbers) {
    HWY_DYNAMIC_DISPATCH(shade)(lighting, surface, mask, radiance, shadow_numbers);
}

glm::vec3 Environment::radiance(const glm::vec3& direction) const {
    WaveVector out;
    HWY_DYNAMIC_DISPATCH(look_around)(*this, all_lanes(direction), 1u, out);
    return first_lane(out);
}

glm::vec3 Environment::diffuse(const glm::vec3& normal) const { return specular(normal, 1.0f); }

glm::vec3 Environment::specular(const glm::vec3& direction, float roughness) const {
    WaveVector out;
    HWY_DYNAMIC_DISPATCH(look_specular)(*this, all_lanes(direction), all_lanes(roughness), 1u, out);
    return first_lane(out);
}

glm::vec2 ggx_albedo(float n_dot_v, float roughness) {
    WaveFloat scale, bias;
    HWY_DYNAMIC_DISPATCH(look_albedo)(all_lanes(n_dot_v), all_lanes(roughness), scale, bias);
    return {scale[0], bias[0]};
}

}  // namespace rawtexel::shading
#endif  // HWY_ONCE
