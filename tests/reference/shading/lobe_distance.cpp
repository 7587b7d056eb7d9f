#include "tests/reference/shading/lobe_distance.h"

#include "tests/reference/shading/environment.h"

#include "shading/brdf.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rawtexel::reference {
namespace {

constexpr double kPi = std::numbers::pi;

void normalise(std::vector<WeightedDirection>& directions) {
    double sum = 0.0;
    for (const WeightedDirection& d : directions) sum += d.weight;
    for (WeightedDirection& d : directions) d.weight /= sum;
}

/// Directions about +z: polar cosines by even steps, a quarter as many azimuths.
template <class Polar>
std::vector<WeightedDirection> zonal_lobe(int steps, const Polar& polar) {
    std::vector<WeightedDirection> lobe;
    for (int i = 0; i < steps; ++i) {
        const auto [z, weight] = polar((i + 0.5) / steps);
        const double sine = std::sqrt(1.0 - z * z);
        for (int j = 0; j < steps / 4; ++j) {
            const double azimuth = kPi * (j + 0.5) / (steps / 4);
            lobe.push_back({sine * std::cos(azimuth), sine * std::sin(azimuth), z, weight});
        }
    }
    normalise(lobe);
    return lobe;
}

struct PolarPoint {
    double z, weight;
};

/// The lobe that has n = v = r: half vectors of density D n.h up to where light reaches the horizon.
std::vector<WeightedDirection> ggx_lobe(double alpha, int steps) {
    const double a2 = alpha * alpha;
    return zonal_lobe(steps, [&](double t) {
        const TailPoint tail = towards_tail(t);
        const double u = tail.u / (1.0 + a2), z = 2.0 * (1.0 - u) / (1.0 + (a2 - 1.0) * u) - 1.0;
        return PolarPoint{z, z * tail.weight};
    });
}

/// The lobe of kFlatRoughness.
std::vector<WeightedDirection> flat_lobe(int steps) {
    return zonal_lobe(steps, [](double t) { return PolarPoint{t, t / ((1.0 + t) * (1.0 + t))}; });
}

double cubic(double p0, double p1, double p2, double p3, double t) {
    return p1 + 0.5 * t * (p2 - p0 + t * (2.0 * p0 - 5.0 * p1 + 4.0 * p2 - p3 + t * (3.0 * (p1 - p2) + p3 - p0)));
}

}  // namespace

double chord(const WeightedDirection& a, double x, double y, double z) {
    return std::sqrt((a.x - x) * (a.x - x) + (a.y - y) * (a.y - y) + (a.z - z) * (a.z - z));
}

double distance_of_chord(double chord) { return std::sqrt(chord); }

TailPoint towards_tail(double t) {
    const double rest = 1.0 - t;
    return {1.0 - rest * rest * rest, 3.0 * rest * rest};
}

double alpha_of(double roughness) { return std::max(roughness * roughness, double(shading::kMinAlpha)); }

std::vector<WeightedDirection> lobe_of(double roughness, int steps) {
    if (roughness <= 1.0) return ggx_lobe(alpha_of(roughness), steps);
    std::vector<WeightedDirection> lobe = ggx_lobe(1.0, steps);
    for (WeightedDirection& d : lobe) d.weight *= 2.0 - roughness;
    for (WeightedDirection& d : flat_lobe(steps)) lobe.push_back({d.x, d.y, d.z, d.weight * (roughness - 1.0)});
    return lobe;
}

MeanDistance::MeanDistance(double alpha) : alpha_(alpha), steps_per_log_((kSteps - 1) / std::log1p(2.0 / alpha)) {}

MeanDistance::MeanDistance(const std::vector<WeightedDirection>& lobe, double alpha) : MeanDistance(alpha) {
    for (int i = 0; i < kSteps; ++i) {
        const double at = std::min(alpha_ * std::expm1(i / steps_per_log_), 2.0), z = 1.0 - 0.5 * at * at,
                     x = std::sqrt(std::max(0.0, 1.0 - z * z));
        double sum = 0.0;
        for (const WeightedDirection& d : lobe) sum += d.weight * distance_of_chord(chord(d, x, 0.0, z));
        values_[size_t(i)] = sum / distance_of_chord(at + 2.0 * alpha_);
    }
}

MeanDistance::MeanDistance(const MeanDistance* four, double alpha, double t) : MeanDistance(alpha) {
    for (size_t i = 0; i < size_t(kSteps); ++i)
        values_[i] = cubic(four[0].values_[i], four[1].values_[i], four[2].values_[i], four[3].values_[i], t);
}

MeanDistance::MeanDistance(const MeanDistance& a, const MeanDistance& b, double t) : MeanDistance(1.0) {
    for (size_t i = 0; i < size_t(kSteps); ++i) values_[i] = a.values_[i] * (1.0 - t) + b.values_[i] * t;
}

double MeanDistance::operator()(double chord) const {
    const double x = std::log1p(chord / alpha_) * steps_per_log_;
    const int i = std::clamp(int(x), 1, kSteps - 3);
    return cubic(values_[size_t(i - 1)], values_[size_t(i)], values_[size_t(i + 1)], values_[size_t(i + 2)], x - i) *
           distance_of_chord(chord + 2.0 * alpha_);
}

MeanDistance mean_distance(double roughness) {
    constexpr int kAlphas = 80, kSteps = 128;
    static const double log_least = std::log(0.7 * shading::kMinAlpha), log_step = -log_least / (kAlphas - 2);
    static const std::vector<MeanDistance> table = [] {
        std::vector<MeanDistance> made;
        for (int i = 0; i < kAlphas; ++i) {
            const double alpha = std::exp(log_least + i * log_step);
            made.emplace_back(ggx_lobe(alpha, kSteps), alpha);
        }
        return made;
    }();
    static const MeanDistance flat(flat_lobe(kSteps), 1.0);
    if (roughness > 1.0) return MeanDistance(table[kAlphas - 2], flat, roughness - 1.0);
    const double alpha = alpha_of(roughness), x = (std::log(alpha) - log_least) / log_step;
    const int i = std::clamp(int(x), 1, kAlphas - 3);
    return MeanDistance(&table[size_t(i - 1)], alpha, x - i);
}

}  // namespace rawtexel::reference
