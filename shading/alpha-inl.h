// Alpha of MASK and BLEND surfaces: factor times texture times vertex colour (glTF 2.0 3.9.4), and the share of a sample that it covers.
#if defined(RAWTEXEL_SHADING_ALPHA_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_SHADING_ALPHA_INL_H_
#undef RAWTEXEL_SHADING_ALPHA_INL_H_
#else
#define RAWTEXEL_SHADING_ALPHA_INL_H_
#endif

#include "shading/draw_state.h"
#include "shading/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rawtexel::shading {
namespace HWY_NAMESPACE {

/// `texel` and `vertex` are null where the material has no base colour texture, the mesh no colours.
HWY_INLINE void find_alpha(const Material& material, const WaveFloat* texel, const WaveFloat* vertex, WaveFloat& alpha) {
    const FloatLanes d;
    for (size_t i = 0; i < texunit::kWaveLanes; i += hn::Lanes(d)) {
        auto value = hn::Set(d, material.base_color.a);
        if (texel) value = hn::Mul(value, hn::Load(d, texel->lane + i));
        if (vertex) value = hn::Mul(value, hn::Load(d, vertex->lane + i));
        hn::Store(value, d, alpha.lane + i);
    }
}

/// The share of a sample that a raw texel of this alpha covers: of MASK all or nothing, of BLEND the alpha.
HWY_INLINE FloatVector covered_share(const Material& material, FloatVector alpha) {
    const FloatLanes d;
    const auto one = hn::Set(d, 1.0f);
    if (material.alpha_mode == AlphaMode::Mask) return hn::IfThenElseZero(hn::Ge(alpha, hn::Set(d, material.alpha_cutoff)), one);
    return hn::Min(hn::Max(alpha, hn::Zero(d)), one);
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::shading
HWY_AFTER_NAMESPACE();
#endif
