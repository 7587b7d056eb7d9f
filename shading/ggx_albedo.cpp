#include "shading/ggx_albedo.h"

#include "shading/brdf.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rawtexel::shading {
namespace {

/// Gauss-Legendre nodes and weights on [0, 1] (Newton's method on the Legendre polynomial).
template <int N>
struct GaussLegendre {
    double node[N], weight[N];
    GaussLegendre() {
        for (int i = 0; i < N; ++i) {
            double x = std::cos(std::numbers::pi * (i + 0.75) / (N + 0.5)), derivative = 1.0;
            for (int step = 0; step < 100; ++step) {
                double p0 = 1.0, p1 = x;
                for (int k = 2; k <= N; ++k) {
                    const double p2 = ((2.0 * k - 1.0) * x * p1 - (k - 1.0) * p0) / k;
                    p0 = p1;
                    p1 = p2;
                }
                derivative = N * (x * p1 - p0) / (x * x - 1.0);
                const double change = p1 / derivative;
                x -= change;
                if (std::fabs(change) < 1e-15) break;
            }
            node[i] = 0.5 * (1.0 - x);
            weight[i] = 1.0 / ((1.0 - x * x) * derivative * derivative);
        }
    }
};

/// (1 - x)^5.
double schlick(double x) {
    const double k = 1.0 - x;
    return k * k * k * k * k;
}

/// Mean of n.l over the zonal lobe (n = v = r) of `alpha`: integral of c^2 over that of c, both over g^2, g = offset - slope c.
double mean_cosine(double alpha) {
    const double slope = (1.0 - alpha * alpha) / 2.0, offset = 1.0 - slope, g = offset - slope;
    if (slope < 1e-3) return 2.0 / 3.0;
    const double first = (offset / g - 1.0 + std::log(g / offset)) / (slope * slope);
    const double second =
        (offset * offset * (1.0 / g - 1.0 / offset) + 2.0 * offset * std::log(g / offset) + offset - g) / (slope * slope * slope);
    return second / first;
}

/// Roughness of the zonal lobe whose mean direction is as long.
double roughness_of_mean(double length) {
    double low = kMinRoughness, high = 1.0;
    for (int step = 0; step < 40; ++step) {
        const double middle = 0.5 * (low + high);
        (mean_cosine(middle * middle) > length ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

/// The share of the way from the mirror direction to the normal, along the chord, at which the mean direction lies.
double lean_of(const GgxReflection& reflection, double n_dot_v) {
    const double sine = std::sqrt(1.0 - n_dot_v * n_dot_v);
    const double turned = sine * reflection.mean_up - n_dot_v * reflection.mean_outwards;
    return turned / (turned + reflection.mean_outwards);
}

void fill_entry(double n_dot_v, double roughness, float* entry) {
    using Table = GgxReflectionTable;
    // Along the normal there is no direction to lean to: the limit is taken just beside it.
    const double view = std::min(std::max(n_dot_v, double(kMinNdotV)), 0.9999), alpha = std::max(roughness * roughness, double(kMinAlpha));
    const GgxReflection reflection = integrate_ggx_reflection(view, alpha);
    const double t = std::clamp((roughness - kMirrorRoughness) / (kMeanRoughness - kMirrorRoughness), 0.0, 1.0),
                 mean_share = t * t * (3.0 - 2.0 * t);
    const double length = std::hypot(reflection.mean_outwards, reflection.mean_up);
    entry[Table::kScale] = float(reflection.scale);
    entry[Table::kBias] = float(reflection.bias);
    entry[Table::kLean] = float(mean_share * lean_of(reflection, view));
    entry[Table::kRoughness] = float(roughness + mean_share * (roughness_of_mean(length) - roughness));
}

}  // namespace

GgxReflection integrate_ggx_reflection(double n_dot_v, double alpha) {
    // Visible normals of the GGX distribution, Heitz 2018 "Sampling the GGX Distribution of Visible Normals", taken as a quadrature. A
    // point of the unit disk is (radius, azimuth); its height h over the disk is the variable, 2 radius dradius = 2 h dh, which gathers
    // nodes at the rim, where light meets the horizon. Half of the azimuths do: the plane of incidence is a mirror.
    static constexpr int kHeights = 48, kAzimuths = 12;
    static const GaussLegendre<kHeights> heights;
    const double nv = std::min(n_dot_v, 1.0), alpha2 = alpha * alpha;
    const double smith_view = std::sqrt(nv * nv * (1.0 - alpha2) + alpha2);

    // The view direction in the stretched frame, where the surface is a hemisphere.
    const double view_x = std::sqrt(1.0 - nv * nv);
    const double length = std::hypot(alpha * view_x, nv), stretched_x = alpha * view_x / length, stretched_z = nv / length;
    const double half_share = 0.5 * (1.0 + stretched_z);
    GgxReflection sum{};
    for (int i = 0; i < kHeights; ++i) {
        const double height = heights.node[i], radius = std::sqrt(1.0 - height * height);
        for (int j = 0; j < kAzimuths; ++j) {
            const double azimuth = std::numbers::pi * ((j + 0.5) / kAzimuths - 0.5);
            // Across the plane of incidence and within it, moved so that the hidden half of the hemisphere is left out.
            const double across = radius * std::cos(azimuth);
            const double within = (1.0 - half_share) * std::sqrt(1.0 - across * across) + half_share * radius * std::sin(azimuth);
            const double along = std::sqrt(std::max(0.0, 1.0 - across * across - within * within));
            const double hx = alpha * (along * stretched_x - within * stretched_z), hy = alpha * across;
            const double hz = std::max(along * stretched_z + within * stretched_x, 0.0), norm = std::sqrt(hx * hx + hy * hy + hz * hz);
            const double v_dot_h = (view_x * hx + nv * hz) / norm, n_dot_l = 2.0 * v_dot_h * hz / norm - nv;
            if (n_dot_l <= 0.0 || v_dot_h <= 0.0) continue;
            // Masking of light given masking of view: f n.l / density = F G2 / G1.
            const double smith_light = std::sqrt(n_dot_l * n_dot_l * (1.0 - alpha2) + alpha2);
            const double share = n_dot_l * (nv + smith_view) / (n_dot_l * smith_view + nv * smith_light);
            const double weight = heights.weight[i] * 2.0 * height / kAzimuths * share, fresnel = schlick(v_dot_h);
            sum.scale += weight * (1.0 - fresnel);
            sum.bias += weight * fresnel;
            sum.mean_outwards += weight * (view_x - 2.0 * v_dot_h * hx / norm);
            sum.mean_up += weight * n_dot_l;
        }
    }
    sum.mean_outwards /= sum.scale + sum.bias;
    sum.mean_up /= sum.scale + sum.bias;
    return sum;
}

const GgxReflectionTable& ggx_reflection_table() {
    static const GgxReflectionTable table = [] {
        using Table = GgxReflectionTable;
        Table made;
        for (int r = 0; r < Table::kRoughnesses; ++r)
            for (int v = 0; v < Table::kViews; ++v) {
                const double view = v / double(Table::kViews - 1), roughness = r / double(Table::kRoughnesses - 1);
                fill_entry(view * view, roughness, &made.values[size_t(Table::kChannels * (v + Table::kViews * r))]);
            }
        return made;
    }();
    return table;
}

}  // namespace rawtexel::shading
