#include "unlit_reference.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace rawtexel::shading::reference {
namespace {

struct Ray {
    glm::dvec3 origin, direction;
};

Ray camera_ray(const Camera& camera, int width, int height, double x, double y) {
    const double across = 2.0 * x / width - 1.0, up = 1.0 - 2.0 * y / height;
    const glm::dmat4 world_from_camera(camera.world_from_camera);
    glm::dvec3 origin(0.0), direction(0.0, 0.0, -1.0);
    if (camera.type == Camera::Type::Perspective) {
        const double half_height = std::tan(0.5 * double(camera.vertical_fov));
        direction = glm::dvec3(across * half_height * width / height, up * half_height, -1.0);
    } else {
        origin = glm::dvec3(across * double(camera.xmag), up * double(camera.ymag), 0.0);
    }
    return {glm::dvec3(world_from_camera * glm::dvec4(origin, 1.0)), glm::dvec3(world_from_camera * glm::dvec4(direction, 0.0))};
}

struct Triangle {
    glm::dvec3 p[3];
    const Mesh* mesh;
    const uint32_t* vertex;
};

struct Hit {
    double distance, b1, b2;
};

/// Where the ray meets the triangle's plane, barycentrics unbounded.
std::optional<Hit> meet_plane(const Ray& ray, const Triangle& t) {
    const glm::dvec3 e1 = t.p[1] - t.p[0], e2 = t.p[2] - t.p[0], normal = glm::cross(e1, e2);
    const double along = glm::dot(normal, ray.direction);
    if (along == 0.0) return std::nullopt;
    const double distance = glm::dot(normal, t.p[0] - ray.origin) / along;
    const glm::dvec3 at = ray.origin + distance * ray.direction - t.p[0];
    const double area2 = glm::dot(normal, normal);
    return Hit{distance, glm::dot(glm::cross(at, e2), normal) / area2, glm::dot(glm::cross(e1, at), normal) / area2};
}

template <class V>
V interpolated(const Hit& hit, const V& f0, const V& f1, const V& f2) {
    return f0 + hit.b1 * (f1 - f0) + hit.b2 * (f2 - f0);
}

glm::dvec2 coordinates(const Triangle& t, const TextureMap& map, const Hit& hit) {
    const auto& set = t.mesh->uv[size_t(map.uv_set)];
    const glm::dmat3x2 transform(map.uv_from_vertex);
    const auto at = [&](int k) { return transform * glm::dvec3(set[t.vertex[k]], 1.0); };
    return interpolated(hit, at(0), at(1), at(2));
}

int wrapped(texunit::Wrap wrap, int64_t index, int size) {
    const auto positive = [](int64_t value, int64_t period) { return (value % period + period) % period; };
    if (wrap == texunit::Wrap::Repeat) return int(positive(index, size));
    if (wrap == texunit::Wrap::ClampToEdge) return int(std::clamp<int64_t>(index, 0, size - 1));
    const int64_t in_period = positive(index, 2 * int64_t(size));
    return int(in_period < size ? in_period : 2 * int64_t(size) - 1 - in_period);
}

glm::dvec4 texel(texunit::Texture& texture, const texunit::SamplerState& sampler, int level, int64_t x, int64_t y) {
    const int width = texunit::level_extent(texture.shape().width, level), height = texunit::level_extent(texture.shape().height, level);
    const auto value = texture.texel(level, 0, wrapped(sampler.wrap_s, x, width), wrapped(sampler.wrap_t, y, height));
    return {value[0], value[1], value[2], value[3]};
}

glm::dvec4 level_value(texunit::Texture& texture, const texunit::SamplerState& sampler, texunit::Kernel kernel, int level,
                       const glm::dvec2& uv) {
    double x = uv.x * texunit::level_extent(texture.shape().width, level), y = uv.y * texunit::level_extent(texture.shape().height, level);
    if (kernel == texunit::Kernel::Nearest) return texel(texture, sampler, level, int64_t(std::floor(x)), int64_t(std::floor(y)));
    x -= 0.5;
    y -= 0.5;
    const auto x0 = int64_t(std::floor(x)), y0 = int64_t(std::floor(y));
    const double fx = x - double(x0), fy = y - double(y0);
    const auto row = [&](int64_t j) {
        return (1.0 - fx) * texel(texture, sampler, level, x0, j) + fx * texel(texture, sampler, level, x0 + 1, j);
    };
    return (1.0 - fy) * row(y0) + fy * row(y0 + 1);
}

/// Vulkan 16.5.7: the longer of the two footprint vectors, in texels of level 0.
double level_of_detail(const texunit::Texture& texture, const glm::dvec2& ddx, const glm::dvec2& ddy) {
    const glm::dvec2 extent(texture.shape().width, texture.shape().height);
    return std::log2(std::max(glm::length(ddx * extent), glm::length(ddy * extent)));
}

glm::dvec4 sampled(texunit::Texture& texture, const texunit::SamplerState& sampler, const glm::dvec2& uv, const glm::dvec2& ddx,
                   const glm::dvec2& ddy) {
    const double lod = level_of_detail(texture, ddx, ddy);
    const texunit::Kernel kernel = lod <= 0.0 ? sampler.magnify : sampler.minify;
    const int last = texture.shape().levels - 1;
    const double level = std::clamp(lod, 0.0, double(last));
    if (sampler.mip == texunit::MipMode::None) return level_value(texture, sampler, kernel, 0, uv);
    if (sampler.mip == texunit::MipMode::Nearest) return level_value(texture, sampler, kernel, int(std::ceil(level + 0.5) - 1.0), uv);
    const int fine = int(std::floor(level)), coarse = std::min(fine + 1, last);
    const double blend = level - fine;
    return (1.0 - blend) * level_value(texture, sampler, kernel, fine, uv) + blend * level_value(texture, sampler, kernel, coarse, uv);
}

glm::dvec3 color_of(const Scene& scene, const Triangle& t, const Hit& hit, const Ray (&across)[4], double step) {
    const Material& material = scene.materials[t.mesh->material];
    glm::dvec4 color(material.base_color);
    if (!t.mesh->colors.empty()) {
        const auto at = [&](int k) { return glm::dvec4(t.mesh->colors[t.vertex[k]]); };
        color *= interpolated(hit, at(0), at(1), at(2));
    }
    const TextureMap& map = material.maps[kBaseColor];
    if (map.texture < 0) return glm::dvec3(color);
    // Derivatives by central differences in the triangle's plane.
    glm::dvec2 beside[4];
    for (int i = 0; i < 4; ++i) beside[i] = coordinates(t, map, *meet_plane(across[i], t));
    const glm::dvec2 ddx = (beside[1] - beside[0]) / (2.0 * step), ddy = (beside[3] - beside[2]) / (2.0 * step);
    texunit::Texture& texture = *scene.textures[size_t(map.texture)].texture;
    return glm::dvec3(color * sampled(texture, map.sampler, coordinates(t, map, hit), ddx, ddy));
}

}  // namespace

glm::dvec3 unlit_radiance(const Scene& scene, const Camera& camera, int width, int height, double x, double y,
                          const glm::dvec3& background) {
    constexpr double kStep = 1e-3;
    const Ray ray = camera_ray(camera, width, height, x, y);
    double nearest = std::numeric_limits<double>::infinity();
    Triangle seen{};
    Hit seen_hit{};
    for (const Instance& instance : scene.instances) {
        const Mesh& mesh = scene.meshes[instance.mesh];
        const glm::dmat4 world_from_object(instance.world_from_object);
        for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
            Triangle t{{}, &mesh, &mesh.indices[i]};
            for (int k = 0; k < 3; ++k) t.p[k] = glm::dvec3(world_from_object * glm::dvec4(mesh.positions[t.vertex[k]], 1.0));
            const double facing =
                glm::dot(glm::cross(t.p[1] - t.p[0], t.p[2] - t.p[0]), ray.direction) * glm::determinant(glm::dmat3(world_from_object));
            if (facing >= 0.0 && !scene.materials[mesh.material].double_sided) continue;
            const std::optional<Hit> hit = meet_plane(ray, t);
            if (!hit || hit->distance < double(camera.znear) || hit->distance >= nearest) continue;
            if (hit->b1 < 0.0 || hit->b2 < 0.0 || hit->b1 + hit->b2 > 1.0) continue;
            nearest = hit->distance;
            seen = t;
            seen_hit = *hit;
        }
    }
    if (!seen.mesh) return background;
    const Ray across[4] = {camera_ray(camera, width, height, x - kStep, y), camera_ray(camera, width, height, x + kStep, y),
                           camera_ray(camera, width, height, x, y - kStep), camera_ray(camera, width, height, x, y + kStep)};
    return color_of(scene, seen, seen_hit, across, kStep);
}

}  // namespace rawtexel::shading::reference
