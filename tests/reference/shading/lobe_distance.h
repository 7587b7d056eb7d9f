// Distances between the directions of prefiltered lobes: what the probes of a reflection are fitted by (probe_fit.h).
#pragma once

#include <array>
#include <vector>

namespace rawtexel::reference {

/// One of a set of weighted directions of half the sphere, y >= 0: the set is its own mirror image across the plane y = 0.
struct WeightedDirection {
    double x, y, z, weight = 0.0;
};

double chord(const WeightedDirection& a, double x, double y, double z);
/// What chords count: their roots.
double distance_of_chord(double chord);

/// Even points t of [0, 1] gathered at 1, where a lobe's long tail begins: u = 1 - (1 - t)^3, weight du/dt.
struct TailPoint {
    double u, weight;
};
TailPoint towards_tail(double t);

double alpha_of(double roughness);

/// The lobe of a roughness up to kFlatRoughness about +z, as the prefiltered levels mix it: `steps` polar angles, a quarter as many
/// azimuths. Weights sum to one.
std::vector<WeightedDirection> lobe_of(double roughness, int steps);

/// Mean distance of a lobe's directions from a direction at a given chord from its axis, by steps of log(1 + chord / alpha).
class MeanDistance {
  public:
    double operator()(double chord) const;

    MeanDistance(const std::vector<WeightedDirection>& lobe, double alpha);
    /// Between the second and the third of four at even steps of log alpha.
    MeanDistance(const MeanDistance* four, double alpha, double t);
    /// Between two of alpha 1.
    MeanDistance(const MeanDistance& a, const MeanDistance& b, double t);

  private:
    static constexpr int kSteps = 192;
    explicit MeanDistance(double alpha);

    double alpha_, steps_per_log_;
    std::array<double, kSteps> values_{};  ///< divided by that of chord + 2 alpha, which takes most of the bend out
};

/// The mean distances of a roughness up to kFlatRoughness, from a table made when first asked for.
MeanDistance mean_distance(double roughness);

}  // namespace rawtexel::reference
