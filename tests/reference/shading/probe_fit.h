// Fitting the probes of shading/reflection_probes.h: a reflection of GGX as a sum of prefiltered lobes in the plane of incidence.
#pragma once

#include "shading/reflection_probes.h"

#include <array>
#include <vector>

namespace rawtexel::reference {

/// One probe: its axis is mirror direction + lean * (normal - mirror direction), its lobe that of `roughness`, 0..kFlatRoughness. Weights
/// are shares of the reflected light, of F0's scale and of the bias.
struct FittedProbe {
    double lean = 0.0, roughness = 0.0, scale_share = 0.0, bias_share = 0.0;
};
using FittedProbes = std::array<FittedProbe, shading::ReflectionProbeTable::kProbes>;

/// The distance between a reflection and a sum of lobes is the energy distance, 2 E d(x, y) - E d(x, x') - E d(y, y') over directions x of
/// the one and y of the other (Székely and Rizzo 2013). With d = |x - y| it would be the mean square error in light that changes its
/// brightness across the edge of a random cap of the sphere (Stolarsky 1973); d = |x - y|^(1/2) weighs small lights more. It is relative
/// to alpha, the size of the reflection.
class ProbeFit {
  public:
    ProbeFit(double n_dot_v, double roughness);

    /// Best shares for the given axes and lobes, and the distance that is left: of F0 = 1 and, a quarter of it, F0 = 0.04.
    double weigh(FittedProbes& probes, const FittedProbes& expected) const;
    /// Moves axes and lobes to where the distance is least. Where that leaves a choice, probes stay near `expected`. Puts them in order,
    /// from the normal outwards, so that neighbouring nodes agree which is which.
    void improve(FittedProbes& probes, const FittedProbes& expected, int steps) const;

  private:
    struct Sample {
        double x, y, z, scale, bias;
    };
    struct Distances;
    Distances distances_to(const FittedProbes& probes) const;
    double axis_angle(double lean) const;
    double roaming(const FittedProbe& probe, const FittedProbe& expected) const;

    double n_dot_v_, alpha_;
    std::vector<Sample> samples_;
    double scale_ = 0.0, bias_ = 0.0;                                     ///< albedo terms: sums over the samples
    double scale_spread_ = 0.0, bias_spread_ = 0.0, cross_spread_ = 0.0;  ///< E|x - x'| among the samples
};

}  // namespace rawtexel::reference
