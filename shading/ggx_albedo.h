// How much of uniform light a surface reflects: tables that the environment's split sum is weighted with.
#pragma once

#include <array>

namespace rawtexel::shading {

/// Directional albedo of single-scattering GGX as scale and bias of F0, over sqrt(n.v) and perceptual roughness. See ggx_albedo().
struct GgxAlbedoTable {
    static constexpr int kViews = 40, kRoughnesses = 40;
    std::array<float, kViews * kRoughnesses * 2> values;  ///< (scale, bias) by view + kViews*roughness; both axes run from 0 to 1
};

/// Integrated in double when first asked for, once.
const GgxAlbedoTable& ggx_albedo_table();

/// Scale and bias at one point, integrated in double (what the table is made of); n_dot_v in (0, 1].
std::array<double, 2> integrate_ggx_albedo(double n_dot_v, double alpha);

/// Mean of Schlick's (1 - v.h)^5 over cosine-weighted light, by n.v: what specular reflection takes from the diffuse term is
/// F0 + (1 - F0) * this. Polynomial in n.v, lowest power first; it deviates from the integral by at most 6e-6.
inline constexpr float kDiffuseFresnel[5] = {0.0281612603f, -0.0798002948f, 0.0862494602f, -0.0433759251f, 0.00884750588f};

}  // namespace rawtexel::shading
