// Material inputs: from interpolated geometry and looked-up maps to the surface that is shaded.
#if defined(RAWTEXEL_SHADING_MATERIAL_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_SHADING_MATERIAL_INL_H_
#undef RAWTEXEL_SHADING_MATERIAL_INL_H_
#else
#define RAWTEXEL_SHADING_MATERIAL_INL_H_
#endif

#include "shading/draw_state.h"
#include "shading/fragment.h"
#include "shading/gloss-inl.h"
#include "shading/lanes-inl.h"
#include "shading/lookup-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rawtexel::shading {
namespace HWY_NAMESPACE {

/// Factor times texture times vertex colour, not negative.
HWY_INLINE void find_base_color(const DrawState& draw, const FragmentWave& fragment, const texunit::WaveColor& texel, SurfaceWave& out) {
    const FloatLanes d;
    const bool textured = draw.material->maps[kBaseColor].texture != nullptr;
    const bool colored = !draw.mesh->colors.empty() && !draw.colors_weigh;
    const SpaceVector factor = set3(d, glm::vec3(draw.material->material->base_color));
    const auto zero = hn::Zero(d);
    for (size_t i = 0; i < texunit::kWaveLanes; i += hn::Lanes(d)) {
        SpaceVector base = factor;
        if (textured) base = mul(base, load_rgb(texel, i));
        if (colored) base = mul(base, load_rgb(fragment.color, i));
        store3(d, {hn::Max(base.x, zero), hn::Max(base.y, zero), hn::Max(base.z, zero)}, out.base_color, i);
    }
}

/// Roughness in green, metallic in blue (glTF 2.0 3.9.2).
HWY_INLINE void find_metallic_roughness(const MaterialState& state, const texunit::WaveColor& texel, SurfaceWave& out) {
    const FloatLanes d;
    const bool textured = state.maps[kMetallicRoughness].texture != nullptr;
    const auto zero = hn::Zero(d), one = hn::Set(d, 1.0f);
    for (size_t i = 0; i < texunit::kWaveLanes; i += hn::Lanes(d)) {
        auto roughness = hn::Set(d, state.material->roughness), metallic = hn::Set(d, state.material->metallic);
        if (textured) {
            roughness = hn::Mul(roughness, hn::Load(d, texel.channel[1].lane + i));
            metallic = hn::Mul(metallic, hn::Load(d, texel.channel[2].lane + i));
        }
        hn::Store(hn::Min(hn::Max(roughness, zero), one), d, out.roughness.lane + i);
        hn::Store(hn::Min(hn::Max(metallic, zero), one), d, out.metallic.lane + i);
    }
}

/// 1 + strength*(red - 1) (glTF 2.0 3.9.3).
HWY_INLINE void find_occlusion(const MaterialState& state, const texunit::WaveColor& texel, SurfaceWave& out) {
    const FloatLanes d;
    const bool textured = state.maps[kOcclusion].texture != nullptr;
    const auto one = hn::Set(d, 1.0f), strength = hn::Set(d, state.material->occlusion_strength);
    for (size_t i = 0; i < texunit::kWaveLanes; i += hn::Lanes(d)) {
        auto occlusion = one;
        if (textured) occlusion = hn::Add(one, hn::Mul(strength, hn::Sub(hn::Load(d, texel.channel[0].lane + i), one)));
        hn::Store(occlusion, d, out.occlusion.lane + i);
    }
}

HWY_INLINE void find_emission(const MaterialState& state, const texunit::WaveColor& texel, SurfaceWave& out) {
    const FloatLanes d;
    const bool textured = state.maps[kEmissive].texture != nullptr;
    const SpaceVector factor = set3(d, state.material->emission);
    for (size_t i = 0; i < texunit::kWaveLanes; i += hn::Lanes(d))
        store3(d, textured ? mul(factor, load_rgb(texel, i)) : factor, out.emission, i);
}

/// The map's direction in the frame (tangent, bitangent, normal), its x and y scaled (glTF 2.0 3.9.3).
HWY_INLINE SpaceVector mapped_normal(const FragmentWave& fragment, const texunit::WaveColor& texel, float normal_scale,
                                     const SpaceVector& normal, size_t i) {
    const FloatLanes d;
    const auto two = hn::Set(d, 2.0f), one = hn::Set(d, 1.0f), strength = hn::Set(d, normal_scale);
    const SpaceVector code = load_rgb(texel, i);
    const auto x = hn::Mul(hn::Sub(hn::Mul(code.x, two), one), strength), y = hn::Mul(hn::Sub(hn::Mul(code.y, two), one), strength);
    const auto z = hn::Sub(hn::Mul(code.z, two), one);
    const SpaceVector tangent = load3(d, fragment.tangent, i);
    const SpaceVector bitangent = scale(cross(normal, tangent), hn::Load(d, fragment.bitangent_sign.lane + i));
    return unit_or(add(add(scale(tangent, x), scale(bitangent, y)), scale(normal, z)), normal);
}

/// Normals on the side that is seen: the back of a double-sided surface turns the whole frame about (glTF 2.0 3.9.6).
HWY_INLINE void find_normals(const MaterialState& state, const FragmentWave& fragment, const texunit::WaveColor& texel, SurfaceWave& out) {
    const FloatLanes d;
    const bool mapped = state.maps[kNormal].texture != nullptr;
    for (size_t i = 0; i < texunit::kWaveLanes; i += hn::Lanes(d)) {
        const auto facing = hn::Load(d, fragment.facing.lane + i);
        SpaceVector normal = load3(d, fragment.normal, i);
        if (mapped) normal = mapped_normal(fragment, texel, state.material->normal_scale, normal, i);
        store3(d, scale(normal, facing), out.normal, i);
        store3(d, scale(load3(d, fragment.geometric_normal, i), facing), out.geometric_normal, i);
    }
}

/// All of `out` but `view`, which is the caller's. An unlit material has a base colour and nothing else to shade; `shapes`: its normals
/// are asked for all the same.
HWY_INLINE void find_surface(const DrawState& draw, const FragmentWave& fragment, const MapColors& maps, bool shapes, SurfaceWave& out) {
    const MaterialState& state = *draw.material;
    find_base_color(draw, fragment, maps.slot[kBaseColor], out);
    if (shapes) find_normals(state, fragment, maps.slot[kNormal], out);
    if (state.material->unlit) return;
    find_metallic_roughness(state, maps.slot[kMetallicRoughness], out);
    out.stretched = false;
    if (state.gloss.way != Baseline::None) correct_gloss(state, fragment, maps, out);
    find_occlusion(state, maps.slot[kOcclusion], out);
    find_emission(state, maps.slot[kEmissive], out);
    out.position = fragment.position;
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::shading
HWY_AFTER_NAMESPACE();
#endif
