#include "tests/reference/shading/environment.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rawtexel::reference {
namespace {

constexpr double kPi = std::numbers::pi;

}  // namespace

glm::dvec3 latlong_radiance(const shading::Image& image, const glm::dvec3& d) {
    const double u = 0.5 + std::atan2(d.x, -d.z) / (2.0 * kPi), v = std::atan2(std::hypot(d.x, d.z), d.y) / kPi;
    const double x = u * image.width - 0.5, y = std::clamp(v * image.height - 0.5, 0.0, image.height - 1.0);
    const int left = int(std::floor(x)), top = int(std::floor(y));
    const auto texel = [&](int column, int row) {
        const float* p = image.pixel((column % image.width + image.width) % image.width, std::min(row, image.height - 1));
        return glm::dvec3(p[0], p[1], p[2]);
    };
    return glm::mix(glm::mix(texel(left, top), texel(left + 1, top), x - left),
                    glm::mix(texel(left, top + 1), texel(left + 1, top + 1), x - left), y - top);
}

glm::dvec3 direction_of_latlong(double u, double v) {
    const double azimuth = (u - 0.5) * 2.0 * kPi, polar = v * kPi;
    return {std::sin(polar) * std::sin(azimuth), std::cos(polar), -std::sin(polar) * std::cos(azimuth)};
}

glm::dvec2 hammersley(uint32_t i, uint32_t n) {
    uint32_t reversed = 0;
    for (int bit = 0; bit < 32; ++bit) reversed |= (i >> bit & 1u) << (31 - bit);
    return {(i + 0.5) / n, (reversed + 0.5) / 4294967296.0};
}

glm::dvec3 tangent_of(const glm::dvec3& normal) {
    return glm::normalize(glm::cross(std::fabs(normal.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0), normal));
}

glm::dvec3 spiral_direction(int k, int n) {
    const double z = 1.0 - 2.0 * (k + 0.5) / n, radius = std::sqrt(1.0 - z * z), azimuth = 2.399963229728653 * k;
    return {radius * std::cos(azimuth), z, radius * std::sin(azimuth)};
}

glm::dvec3 sampled_lobe(const shading::Image& image, const glm::dvec3& normal, double alpha, int count) {
    const glm::dvec3 tangent = tangent_of(normal), bitangent = glm::cross(normal, tangent);
    glm::dvec3 sum(0.0);
    double weight = 0.0;
    for (int i = 0; i < count; ++i) {
        // Half vectors of density D(h) n.h; the light is the view, which is the normal, mirrored at them.
        const glm::dvec2 point = hammersley(uint32_t(i), uint32_t(count));
        const double cosine2 = (1.0 - point.x) / (1.0 + (alpha * alpha - 1.0) * point.x), n_dot_l = 2.0 * cosine2 - 1.0;
        if (n_dot_l <= 0.0) continue;
        const double sine = std::sqrt(1.0 - n_dot_l * n_dot_l), azimuth = 2.0 * kPi * point.y;
        sum += latlong_radiance(image, (tangent * std::cos(azimuth) + bitangent * std::sin(azimuth)) * sine + normal * n_dot_l) * n_dot_l;
        weight += n_dot_l;
    }
    return sum / weight;
}

ImageIntegral::ImageIntegral(const shading::Image& image, int points_per_texel) {
    const int width = image.width * points_per_texel, height = image.height * points_per_texel;
    for (int y = 0; y < height; ++y) {
        const double solid_angle = (std::cos(kPi * y / height) - std::cos(kPi * (y + 1) / height)) * 2.0 * kPi / width;
        for (int x = 0; x < width; ++x) {
            const glm::dvec3 direction = direction_of_latlong((x + 0.5) / width, (y + 0.5) / height);
            points_.push_back({direction, latlong_radiance(image, direction) * solid_angle, solid_angle});
        }
    }
}

glm::dvec3 ImageIntegral::lobe(const glm::dvec3& normal, double alpha) const {
    glm::dvec3 sum(0.0);
    double weight = 0.0;
    for (const Point& point : points_) {
        const double n_dot_l = glm::dot(normal, point.direction);
        if (n_dot_l <= 0.0) continue;
        const double n_dot_h2 = 0.5 * (1.0 + n_dot_l), d = n_dot_h2 * (alpha * alpha - 1.0) + 1.0;
        const double w = n_dot_l / (d * d);
        sum += point.light * w;
        weight += point.solid_angle * w;
    }
    return sum / weight;
}

glm::dvec3 ImageIntegral::reflected(const Surface& surface) const {
    glm::dvec3 sum(0.0);
    for (const Point& point : points_)
        if (glm::dot(surface.normal, point.direction) > 0.0) sum += point.light * brdf_cosine(surface, point.direction);
    return sum;
}

glm::dvec3 reflected_light(const shading::Image& image, const Surface& s, int count) {
    const double alpha = std::max(s.roughness * s.roughness, 1e-3), a2 = alpha * alpha, nv = glm::dot(s.normal, s.view);
    const double vx = std::sqrt(std::max(0.0, 1.0 - nv * nv)), smith_view = std::sqrt(nv * nv * (1.0 - a2) + a2);
    const glm::dvec3 f0 = glm::mix(glm::dvec3(0.04), s.base, s.metallic), diffuse = (1.0 - s.metallic) * s.base;
    const glm::dvec3 v(vx, 0.0, nv), tangent = vx > 1e-6 ? glm::normalize(s.view - s.normal * nv) : tangent_of(s.normal);
    const glm::dvec3 bitangent = glm::cross(s.normal, tangent);
    const auto radiance = [&](const glm::dvec3& l) { return latlong_radiance(image, tangent * l.x + bitangent * l.y + s.normal * l.z); };
    const auto fresnel = [&](double v_dot_h) { return f0 + (1.0 - f0) * std::pow(1.0 - v_dot_h, 5.0); };

    const glm::dvec3 stretched = glm::normalize(glm::dvec3(alpha * vx, 0.0, nv)), t1(0, 1, 0), t2 = glm::cross(stretched, t1);
    glm::dvec3 sum(0.0);
    for (int i = 0; i < count; ++i) {
        const glm::dvec2 point = hammersley(uint32_t(i), uint32_t(count));
        const double radius = std::sqrt(point.x), azimuth = 2.0 * kPi * point.y;

        // Cosine-weighted light: the disk's point raised to the hemisphere.
        const glm::dvec3 even(radius * std::cos(azimuth), radius * std::sin(azimuth), std::sqrt(1.0 - point.x));
        if (s.metallic < 1.0) sum += radiance(even) * (1.0 - fresnel(std::sqrt(std::max(0.0, 0.5 + 0.5 * glm::dot(v, even))))) * diffuse;

        // A visible normal, and light mirrored at it.
        const double p1 = radius * std::cos(azimuth), share = 0.5 * (1.0 + stretched.z);
        const double p2 = (1.0 - share) * std::sqrt(1.0 - p1 * p1) + share * radius * std::sin(azimuth);
        const glm::dvec3 n = p1 * t1 + p2 * t2 + std::sqrt(std::max(0.0, 1.0 - p1 * p1 - p2 * p2)) * stretched;
        const glm::dvec3 half = glm::normalize(glm::dvec3(alpha * n.x, alpha * n.y, std::max(0.0, n.z)));
        const double vh = glm::dot(v, half);
        const glm::dvec3 light = 2.0 * vh * half - v;
        if (light.z <= 0.0) continue;
        const double smith_light = std::sqrt(light.z * light.z * (1.0 - a2) + a2);
        const double weight = light.z * (nv + smith_view) / (light.z * smith_view + nv * smith_light);  // G2 / G1
        sum += radiance(light) * weight * fresnel(vh);
    }
    return sum / double(count);
}

}  // namespace rawtexel::reference
