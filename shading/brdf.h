// Constants of the surface model, glTF 2.0 appendix B, metallic-roughness. The model itself is in brdf-inl.h.
#pragma once

namespace rawtexel::shading {

inline constexpr float kDielectricF0 = 0.04f;          ///< reflectance at normal incidence of every dielectric (glTF 2.0 B.2.1)
inline constexpr float kMinAlpha = 1e-3f;              ///< alpha = roughness^2 is not taken below: a perfect mirror has no finite density
inline constexpr float kMinRoughness = 0.0316227766f;  ///< sqrt(kMinAlpha)
inline constexpr float kMinNdotV = 1e-4f;              ///< interpolated normals may face away from the eye
inline constexpr float kInversePi = 0.318309886f;

}  // namespace rawtexel::shading
