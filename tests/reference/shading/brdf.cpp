#include "tests/reference/shading/brdf.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rawtexel::reference {
namespace {

constexpr double kPi = std::numbers::pi;

struct Terms {
    double distribution, visibility, fresnel_weight;
};

Terms specular_terms(const Surface& s, const glm::dvec3& light) {
    const glm::dvec3 half = glm::normalize(s.view + light);
    const double nl = std::max(glm::dot(s.normal, light), 0.0), nv = std::max(glm::dot(s.normal, s.view), 1e-4);
    const double nh = std::max(glm::dot(s.normal, half), 0.0), vh = std::max(glm::dot(s.view, half), 0.0);
    const double alpha = std::max(s.roughness * s.roughness, 1e-3), a2 = alpha * alpha;
    const double d = nh * nh * (a2 - 1.0) + 1.0;
    return {a2 / (kPi * d * d), 0.5 / (nl * std::sqrt(nv * nv * (1.0 - a2) + a2) + nv * std::sqrt(nl * nl * (1.0 - a2) + a2) + 1e-7),
            std::pow(1.0 - vh, 5.0)};
}

double window(double distance, double range) {
    return range > 0.0 ? std::max(std::min(1.0 - std::pow(distance / range, 4.0), 1.0), 0.0) : 1.0;
}

double cone(const shading::Light& light, const glm::dvec3& to_light) {
    const double scale = 1.0 / std::max(0.001, std::cos(double(light.inner_cone)) - std::cos(double(light.outer_cone)));
    const double cosine = glm::dot(glm::dvec3(light.direction), -to_light);
    const double ramp = std::clamp((cosine - std::cos(double(light.outer_cone))) * scale, 0.0, 1.0);
    return ramp * ramp;
}

}  // namespace

glm::dvec3 brdf_cosine(const Surface& s, const glm::dvec3& light) {
    const double nl = glm::dot(s.normal, light);
    if (nl <= 0.0) return glm::dvec3(0.0);
    const Terms t = specular_terms(s, light);
    const glm::dvec3 f0 = glm::mix(glm::dvec3(0.04), s.base, s.metallic), fresnel = f0 + (1.0 - f0) * t.fresnel_weight;
    return ((1.0 - fresnel) * (1.0 - s.metallic) * s.base / kPi + t.distribution * t.visibility * fresnel) * nl;
}

glm::dvec3 punctual_radiance(const Surface& s, const shading::Light& light) {
    const glm::dvec3 color = glm::dvec3(light.color) * double(light.intensity);
    if (light.type == shading::Light::Type::Directional) return brdf_cosine(s, -glm::dvec3(light.direction)) * color;
    const glm::dvec3 offset = glm::dvec3(light.position) - s.position;
    const double distance = glm::length(offset);
    const glm::dvec3 to_light = offset / distance;
    const double spot = light.type == shading::Light::Type::Spot ? cone(light, to_light) : 1.0;
    return brdf_cosine(s, to_light) * color * (spot * window(distance, double(light.range)) / (distance * distance));
}

glm::dvec3 directional_albedo(Surface s, double n_dot_v) {
    s.normal = {0, 0, 1};
    s.view = {std::sqrt(1.0 - n_dot_v * n_dot_v), 0.0, n_dot_v};
    const double alpha = std::max(s.roughness * s.roughness, 1e-3), a2 = alpha * alpha;
    const glm::dvec3 f0 = glm::mix(glm::dvec3(0.04), s.base, s.metallic);

    // Specular: half vectors of density D n.h, light of density D n.h / (4 v.h). Diffuse: cosine-weighted light.
    constexpr int kPolar = 600, kAzimuth = 300;
    glm::dvec3 sum(0.0);
    for (int i = 0; i < kPolar; ++i) {
        // u = 1 - (1 - t)^2 gathers points at the lobe's tail, where shadowing bends the integrand.
        const double t = (i + 0.5) / kPolar, u = t * (2.0 - t), weight = 2.0 * (1.0 - t) / (kPolar * kAzimuth);
        for (int j = 0; j < kAzimuth; ++j) {
            const double azimuth = kPi * (j + 0.5) / kAzimuth;
            const double hz = std::sqrt((1.0 - u) / (1.0 + (a2 - 1.0) * u)), hr = std::sqrt(std::max(0.0, 1.0 - hz * hz));
            const glm::dvec3 half(hr * std::cos(azimuth), hr * std::sin(azimuth), hz);
            const double vh = glm::dot(s.view, half);
            const glm::dvec3 light = 2.0 * vh * half - s.view;
            if (vh > 0.0 && light.z > 0.0) {
                const Terms terms = specular_terms(s, light);
                sum += (f0 + (1.0 - f0) * terms.fresnel_weight) * (terms.visibility * light.z * 4.0 * vh / hz * weight);
            }
            const double cosine = 1.0 - t, sine = std::sqrt(1.0 - cosine * cosine);
            const Terms diffuse = specular_terms(s, {sine * std::cos(azimuth), sine * std::sin(azimuth), cosine});
            sum += (1.0 - (f0 + (1.0 - f0) * diffuse.fresnel_weight)) * (1.0 - s.metallic) * s.base * weight;
        }
    }
    return sum;
}

}  // namespace rawtexel::reference
