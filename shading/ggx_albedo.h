// How much of the light about it a glossy surface reflects, and from where: what the environment's split sum is weighted and aimed with.
#pragma once

#include <array>

namespace rawtexel::shading {

/// The reflection lobe of single-scattering GGX seen from one angle, F = 1: V D n.l (Heitz 2014, height-correlated Smith), integrated in
/// double.
struct GgxReflection {
    double scale, bias;    ///< reflected share of uniform light is F0 * scale + bias
    double mean_outwards;  ///< mean direction of the reflected light: along the surface, away from the viewer,
    double mean_up;        ///< and along the normal. Not normalised: the wider the lobe the shorter
};
GgxReflection integrate_ggx_reflection(double n_dot_v, double alpha);

/// Over sqrt(n.v) and perceptual roughness, both from 0 to 1.
struct GgxReflectionTable {
    static constexpr int kViews = 40, kRoughnesses = 40;
    enum Channel { kScale, kBias, kLean, kRoughness, kChannels };
    /// Scale and bias as above; the zonal lobe (n = v = r) that stands for the reflection: its axis is
    /// mirror direction + lean * (normal - mirror direction), its roughness is the last channel.
    std::array<float, kViews * kRoughnesses * kChannels> values;  ///< channel + kChannels * (view + kViews * roughness)
};

/// Integrated when first asked for, once.
const GgxReflectionTable& ggx_reflection_table();

/// Smooth surfaces reflect about the mirror direction. Rough ones reflect about the mean direction, from a lobe of the same mean length:
/// the first moment of the reflection is right. Between these roughnesses the one passes into the other.
inline constexpr double kMirrorRoughness = 0.2, kMeanRoughness = 0.6;

/// Mean of Schlick's (1 - v.h)^5 over cosine-weighted light, by n.v: what specular reflection takes from the diffuse term is
/// F0 + (1 - F0) * this. Polynomial in n.v, lowest power first; it deviates from the integral by at most 6e-6.
inline constexpr float kDiffuseFresnel[5] = {0.0281612603f, -0.0798002948f, 0.0862494602f, -0.0433759251f, 0.00884750588f};

}  // namespace rawtexel::shading
