#include "tests/reference/shading/probe_fit.h"

#include "tests/reference/shading/environment.h"
#include "tests/reference/shading/lobe_distance.h"
#include "tests/reference/shading/simplex_descent.h"

#include "shading/brdf.h"
#include "shading/environment_tables.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace rawtexel::reference {
namespace {

using Table = shading::ReflectionProbeTable;
constexpr double kPi = std::numbers::pi;
constexpr int kProbes = Table::kProbes;
/// How much a probe is drawn towards those of its neighbours in the table: far less than a misfit, enough where there is nothing to choose.
constexpr double kPull = 1e-3;

constexpr int kReflectionSamples = 512, kLobeSteps = 32;

using Vector = std::array<double, kProbes>;
using Matrix = std::array<Vector, kProbes>;

/// Solves the linear equations of the rows, coefficients before the right side, by elimination with pivots.
std::vector<double> solved(std::vector<std::vector<double>> rows) {
    const size_t size = rows.size();
    for (size_t column = 0; column < size; ++column) {
        const auto larger = [column](const auto& a, const auto& b) { return std::fabs(a[column]) < std::fabs(b[column]); };
        std::iter_swap(rows.begin() + long(column), std::max_element(rows.begin() + long(column), rows.end(), larger));
        for (size_t row = 0; row < size; ++row) {
            if (row == column) continue;
            const double factor = rows[row][column] / rows[column][column];
            for (size_t k = column; k <= size; ++k) rows[row][k] -= factor * rows[column][k];
        }
    }
    std::vector<double> values;
    for (size_t i = 0; i < size; ++i) values.push_back(rows[i][size] / rows[i][i]);
    return values;
}

/// Shares w >= 0 that sum to one and make 2 w.outside - w.among.w + pull |w - expected|^2 least: the conditions of the minimum are linear;
/// the most negative share is struck out until none is left.
Vector best_shares(const Matrix& among, const Vector& outside, const Vector& expected, double pull) {
    std::vector<size_t> kept(kProbes);
    std::iota(kept.begin(), kept.end(), size_t(0));
    for (;;) {
        // One row a share, the last for their sum; the last column but one is the sum's multiplier.
        const size_t n = kept.size();
        std::vector<std::vector<double>> rows(n + 1, std::vector<double>(n + 2, 1.0));
        for (size_t i = 0; i < n; ++i) {
            for (size_t j = 0; j < n; ++j) rows[i][j] = -among[kept[i]][kept[j]] + (i == j ? pull : 0.0);
            rows[i][n + 1] = pull * expected[kept[i]] - outside[kept[i]];
        }
        rows[n][n] = 0.0;
        const std::vector<double> values = solved(std::move(rows));

        const auto least = std::min_element(values.begin(), values.begin() + long(n));
        if (*least < 0.0) {
            kept.erase(kept.begin() + (least - values.begin()));
            continue;
        }
        Vector shares{};
        for (size_t i = 0; i < n; ++i) shares[kept[i]] = values[i];
        return shares;
    }
}

}  // namespace

struct ProbeFit::Distances {
    Matrix among;        ///< E|y - y'| of two probes
    Vector scale, bias;  ///< E|x - y| of the reflection and a probe
};

ProbeFit::ProbeFit(double n_dot_v, double roughness) : n_dot_v_(n_dot_v), alpha_(alpha_of(roughness)) {
    const double a2 = alpha_ * alpha_, nv = n_dot_v_, vx = std::sqrt(1.0 - nv * nv), smith_view = std::sqrt(nv * nv * (1.0 - a2) + a2);
    const glm::dvec3 v(vx, 0.0, nv), stretched = glm::normalize(glm::dvec3(alpha_ * vx, 0.0, nv)), t1(0, 1, 0),
                                     t2 = glm::cross(stretched, t1);
    for (int i = 0; i < kReflectionSamples; ++i) {
        // Visible normals (Heitz 2018) of one half of the plane of incidence; the weight is G2 / G1.
        const glm::dvec2 point = hammersley(uint32_t(i), uint32_t(kReflectionSamples));
        const TailPoint tail = towards_tail(point.x);
        const double radius = std::sqrt(tail.u), azimuth = kPi * (point.y - 0.5), p1 = radius * std::cos(azimuth);
        const double share = 0.5 * (1.0 + stretched.z);
        const double p2 = (1.0 - share) * std::sqrt(1.0 - p1 * p1) + share * radius * std::sin(azimuth);
        const glm::dvec3 n = p1 * t1 + p2 * t2 + std::sqrt(std::max(0.0, 1.0 - p1 * p1 - p2 * p2)) * stretched;
        const glm::dvec3 half = glm::normalize(glm::dvec3(alpha_ * n.x, alpha_ * n.y, std::max(0.0, n.z)));
        const double vh = glm::dot(v, half);
        const glm::dvec3 light = 2.0 * vh * half - v;
        if (light.z <= 0.0 || vh <= 0.0) continue;
        const double smith_light = std::sqrt(light.z * light.z * (1.0 - a2) + a2);
        const double weight = light.z * (nv + smith_view) / (light.z * smith_view + nv * smith_light) * tail.weight / kReflectionSamples;
        const double fresnel = std::pow(1.0 - vh, 5.0);
        samples_.push_back({-light.x, std::fabs(light.y), light.z, weight * (1.0 - fresnel), weight * fresnel});
        scale_ += samples_.back().scale;
        bias_ += samples_.back().bias;
    }
    for (const Sample& a : samples_)
        for (const Sample& b : samples_) {
            const double flat2 = (a.x - b.x) * (a.x - b.x) + (a.z - b.z) * (a.z - b.z);
            const double near = std::sqrt(flat2 + (a.y - b.y) * (a.y - b.y)), far = std::sqrt(flat2 + (a.y + b.y) * (a.y + b.y));
            const double distance = 0.5 * (distance_of_chord(near) + distance_of_chord(far));
            scale_spread_ += a.scale * b.scale * distance / (scale_ * scale_);
            bias_spread_ += a.bias * b.bias * distance / (bias_ * bias_);
            cross_spread_ += a.scale * b.bias * distance / (scale_ * bias_);
        }
}

double ProbeFit::axis_angle(double lean) const {
    return std::atan2((1.0 - lean) * std::sqrt(1.0 - n_dot_v_ * n_dot_v_), lean + (1.0 - lean) * n_dot_v_);
}

ProbeFit::Distances ProbeFit::distances_to(const FittedProbes& probes) const {
    Distances distances{};
    std::vector<MeanDistance> mean;
    std::array<WeightedDirection, kProbes> axes;
    for (size_t k = 0; k < size_t(kProbes); ++k) {
        const double angle = axis_angle(probes[k].lean);
        axes[k] = {std::sin(angle), 0.0, std::cos(angle)};
        mean.push_back(mean_distance(probes[k].roughness));
    }
    for (size_t k = 0; k < size_t(kProbes); ++k) {
        for (const Sample& s : samples_) {
            const double distance = mean[k](chord(axes[k], s.x, s.y, s.z));
            distances.scale[k] += s.scale * distance / scale_;
            distances.bias[k] += s.bias * distance / bias_;
        }
        // Half of a product of two probes is found from each side: the lobe's sampling leans to neither.
        const WeightedDirection& up = axes[k];
        for (const WeightedDirection& d : lobe_of(probes[k].roughness, kLobeSteps)) {
            const double x = d.x * up.z + d.z * up.x, z = d.z * up.z - d.x * up.x;
            for (size_t j = 0; j < size_t(kProbes); ++j) {
                const double half = 0.5 * d.weight * mean[j](chord(axes[j], x, d.y, z));
                distances.among[k][j] += half;
                distances.among[j][k] += half;
            }
        }
    }
    return distances;
}

double ProbeFit::weigh(FittedProbes& probes, const FittedProbes& expected) const {
    const Distances d = distances_to(probes);
    Vector expected_scale, expected_bias;
    for (size_t k = 0; k < size_t(kProbes); ++k) {
        expected_scale[k] = expected[k].scale_share;
        expected_bias[k] = expected[k].bias_share;
    }
    const Vector scale = best_shares(d.among, d.scale, expected_scale, kPull * distance_of_chord(alpha_)),
                 bias = best_shares(d.among, d.bias, expected_bias, kPull * distance_of_chord(alpha_));
    for (size_t k = 0; k < size_t(kProbes); ++k) {
        probes[k].scale_share = scale[k];
        probes[k].bias_share = bias[k];
    }
    const auto distance_of = [&](double f0) {
        const double s = f0 * scale_ / (f0 * scale_ + bias_), b = 1.0 - s;
        double sum = -(s * s * scale_spread_ + 2.0 * s * b * cross_spread_ + b * b * bias_spread_);
        for (size_t k = 0; k < size_t(kProbes); ++k) {
            sum += 2.0 * (s * scale[k] + b * bias[k]) * (s * d.scale[k] + b * d.bias[k]);
            for (size_t j = 0; j < size_t(kProbes); ++j) sum -= (s * scale[k] + b * bias[k]) * (s * scale[j] + b * bias[j]) * d.among[k][j];
        }
        return sum / distance_of_chord(alpha_);
    };
    return distance_of(1.0) + 0.25 * distance_of(double(shading::kDielectricF0));
}

double ProbeFit::roaming(const FittedProbe& probe, const FittedProbe& expected) const {
    const double turn = (axis_angle(probe.lean) - axis_angle(expected.lean)) / alpha_, lean = probe.lean - expected.lean;
    const double width = std::log(probe.roughness / expected.roughness);
    const double scale = probe.scale_share - expected.scale_share, bias = probe.bias_share - expected.bias_share;
    return 0.1 * turn * turn + 0.05 * lean * lean + 4.0 * width * width + scale * scale + bias * bias;
}

void ProbeFit::improve(FittedProbes& probes, const FittedProbes& expected, int steps) const {
    constexpr double kWall = 10.0;
    const double low = std::log(shading::kMinRoughness), high = std::log(shading::kFlatRoughness);
    const double chord_to_normal = 2.0 * std::sin(0.5 * std::acos(n_dot_v_));
    std::vector<double> x, step;
    for (const FittedProbe& probe : probes) {
        x.push_back(probe.lean);
        x.push_back(std::log(probe.roughness));
        // Seen along the normal every axis is the normal: leans are left as they are.
        step.push_back(chord_to_normal < 0.01 ? 0.0 : std::min(0.3 * alpha_ / chord_to_normal, 0.3));
        step.push_back(0.15);
    }
    const auto probes_of = [&](const std::vector<double>& at, double& outside) {
        FittedProbes moved{};
        const auto held = [&](double value, double least, double most) {
            const double inside = std::clamp(value, least, most);
            outside += (value - inside) * (value - inside);
            return inside;
        };
        for (size_t k = 0; k < size_t(kProbes); ++k) {
            moved[k].lean = held(at[2 * k], Table::kLeastLean, Table::kLeastLean + Table::kLeanRange);
            moved[k].roughness = std::exp(held(at[2 * k + 1], low, high));
        }
        return moved;
    };
    const auto cost = [&](const std::vector<double>& at) {
        double outside = 0.0;
        FittedProbes moved = probes_of(at, outside);
        double sum = weigh(moved, expected) + kWall * outside;
        for (size_t k = 0; k < size_t(kProbes); ++k) sum += kPull * roaming(moved[k], expected[k]);
        return sum;
    };
    simplex_descent(cost, x, step, steps);
    double outside = 0.0;
    probes = probes_of(x, outside);
    weigh(probes, expected);
    const auto nearer_to_normal = [](const FittedProbe& a, const FittedProbe& b) { return a.lean > b.lean; };
    std::stable_sort(probes.begin(), probes.end(), nearer_to_normal);
}

}  // namespace rawtexel::reference
