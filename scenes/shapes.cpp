#include "scenes/shapes.h"

#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <vector>

namespace rawtexel::scenes {
namespace {

constexpr float kTau = 2.0f * glm::pi<float>();

/// The part of `v` that lies in the plane across `normal`.
glm::vec3 tangent_direction(glm::vec3 normal, glm::vec3 v) {
    const glm::vec3 flat = v - normal * glm::dot(normal, v);
    if (glm::dot(flat, flat) > 1e-12f) {
        return settled_unit(flat);
    }
    const glm::vec3 other = std::abs(normal.x) < 0.5f ? glm::vec3(1, 0, 0) : glm::vec3(0, 0, 1);
    return settled_unit(other - normal * glm::dot(normal, other));
}

void append_triangle(shading::Mesh& mesh, uint32_t a, uint32_t b, uint32_t c) {
    const glm::vec3 &pa = mesh.positions[a], &pb = mesh.positions[b], &pc = mesh.positions[c];
    if (pa != pb && pb != pc && pc != pa) {
        mesh.indices.insert(mesh.indices.end(), {a, b, c});
    }
}

/// Normals of a polyline (radius, y) to its right-hand side, one per segment.
std::vector<glm::vec2> segment_normals(std::span<const glm::vec2> profile) {
    std::vector<glm::vec2> normals;
    for (size_t i = 0; i + 1 < profile.size(); ++i) {
        const glm::vec2 d = glm::normalize(profile[i + 1] - profile[i]);
        normals.emplace_back(d.y, -d.x);
    }
    return normals;
}

/// The normal of segment `i` at the corner it shares with segment `j`: the mean of both unless the corner is sharp.
glm::vec2 corner_normal(const std::vector<glm::vec2>& normals, size_t i, size_t j, float cos_crease) {
    const bool smooth = glm::dot(normals[i], normals[j]) > cos_crease;
    return smooth ? glm::normalize(normals[i] + normals[j]) : normals[i];
}

}  // namespace

glm::vec3 settled_unit(glm::vec3 v) {
    for (int i = 0;; ++i) {
        const glm::dvec3 exact(v);
        const double length = glm::length(exact);
        const glm::vec3 next(exact / length);
        if (next == v) return v;
        if (i < 2) {
            v = next;
            continue;
        }
        // Rounding left the length so far from 1 that the small components move again: a bit of the middle one brings it near enough.
        const glm::vec3 size = glm::abs(v);
        const float middle = std::max(std::min(size.x, size.y), std::min(std::max(size.x, size.y), size.z));
        float& component = v[size.x == middle ? 0 : size.y == middle ? 1 : 2];
        component = std::nextafter(component, length > 1.0 ? 0.0f : 2.0f * component);
    }
}

uint32_t append_point(shading::Mesh& mesh, const ShapePoint& point) {
    const glm::vec3 normal = settled_unit(point.normal);
    mesh.positions.push_back(point.position);
    mesh.normals.push_back(normal);
    mesh.tangents.emplace_back(tangent_direction(normal, point.along_u), point.mirrored ? -1.0f : 1.0f);
    mesh.uv[0].push_back(point.uv);
    return uint32_t(mesh.positions.size() - 1);
}

void append_patch(shading::Mesh& mesh, int columns, int rows, const std::function<ShapePoint(float s, float t)>& at) {
    assert(columns > 0 && rows > 0);
    const auto first = uint32_t(mesh.positions.size());
    for (int row = 0; row <= rows; ++row) {
        for (int column = 0; column <= columns; ++column) {
            append_point(mesh, at(float(column) / float(columns), float(row) / float(rows)));
        }
    }
    const auto pitch = uint32_t(columns + 1);
    for (uint32_t row = 0; row < uint32_t(rows); ++row) {
        for (uint32_t column = 0; column < uint32_t(columns); ++column) {
            const uint32_t low = first + row * pitch + column, high = low + pitch;
            append_triangle(mesh, low, low + 1, high + 1);
            append_triangle(mesh, low, high + 1, high);
        }
    }
}

void append_rectangle(shading::Mesh& mesh, glm::vec3 corner, glm::vec3 right, glm::vec3 up, glm::vec2 uv0, glm::vec2 uv1) {
    const glm::vec3 normal = glm::cross(right, up);
    append_patch(mesh, 1, 1, [&](float s, float t) {
        return ShapePoint{corner + s * right + t * up, normal, right, glm::mix(uv0, uv1, glm::vec2(s, t))};
    });
}

void append_sphere(shading::Mesh& mesh, float radius, int around, int rings, glm::vec2 repeat) {
    append_patch(mesh, around, rings, [&](float s, float t) {
        // Poles and seam are exact, so that triangles there close and vanish as they should.
        const float longitude = s == 1.0f ? 0.0f : kTau * s;
        const float latitude = glm::pi<float>() * (t - 0.5f);
        const float ring = t == 0.0f || t == 1.0f ? 0.0f : std::cos(latitude);
        const glm::vec3 normal(ring * std::sin(longitude), std::sin(latitude), ring * std::cos(longitude));
        return ShapePoint{radius * normal, normal, glm::vec3(std::cos(longitude), 0.0f, -std::sin(longitude)),
                          repeat * glm::vec2(s, 1.0f - t)};
    });
}

void append_rounded_box(shading::Mesh& mesh, glm::vec3 center, glm::vec3 half_extent, float radius, float metres_per_uv) {
    const glm::vec3 inner = half_extent - radius;
    assert(radius > 0.0f && inner.x > 0.0f && inner.y > 0.0f && inner.z > 0.0f);
    struct Face {
        glm::vec3 right, up;
    };
    static constexpr std::array<Face, 6> kFaces{Face{{1, 0, 0}, {0, 1, 0}}, {{-1, 0, 0}, {0, 1, 0}}, {{0, 0, -1}, {0, 1, 0}},
                                                {{0, 0, 1}, {0, 1, 0}},     {{1, 0, 0}, {0, 0, -1}}, {{1, 0, 0}, {0, 0, 1}}};
    for (const Face& face : kFaces) {
        const glm::vec3 outward = glm::cross(face.right, face.up);
        const float half_width = glm::dot(glm::abs(face.right), half_extent), half_height = glm::dot(glm::abs(face.up), half_extent);
        const std::array<float, 4> xs{-half_width, radius - half_width, half_width - radius, half_width};
        const std::array<float, 4> ys{-half_height, radius - half_height, half_height - radius, half_height};
        append_patch(mesh, 3, 3, [&](float s, float t) {
            const float x = xs[size_t(std::lround(3.0f * s))], y = ys[size_t(std::lround(3.0f * t))];
            // A point of the sharp box, pulled back to `radius` around the inner box.
            const glm::vec3 sharp = face.right * x + face.up * y + outward * glm::dot(glm::abs(outward), half_extent);
            const glm::vec3 core = glm::clamp(sharp, -inner, inner);
            const glm::vec3 normal = glm::normalize(sharp - core);
            const glm::vec2 metres(x + glm::dot(face.right, center), -y - glm::dot(face.up, center));
            return ShapePoint{center + core + radius * normal, normal, face.right, metres / metres_per_uv};
        });
    }
}

void append_lathe(shading::Mesh& mesh, std::span<const glm::vec2> profile, int around, float repeat, float metres_per_uv, float crease) {
    assert(profile.size() >= 2);
    const std::vector<glm::vec2> normals = segment_normals(profile);
    const float cos_crease = std::cos(glm::radians(crease));
    float length = 0.0f;
    for (size_t i = 0; i < normals.size(); ++i) {
        const glm::vec2 begin = profile[i], end = profile[i + 1];
        const glm::vec2 normal_begin = i > 0 ? corner_normal(normals, i, i - 1, cos_crease) : normals[i];
        const glm::vec2 normal_end = i + 1 < normals.size() ? corner_normal(normals, i, i + 1, cos_crease) : normals[i];
        const float next_length = length + glm::distance(begin, end);
        append_patch(mesh, around, 1, [&](float s, float t) {
            const float angle = s == 1.0f ? 0.0f : kTau * s;
            const float sine = std::sin(angle), cosine = std::cos(angle);
            const glm::vec2 point = t == 0.0f ? begin : end, normal = t == 0.0f ? normal_begin : normal_end;
            return ShapePoint{{point.x * sine, point.y, point.x * cosine},
                              {normal.x * sine, normal.y, normal.x * cosine},
                              {cosine, 0.0f, -sine},
                              {repeat * s, -(t == 0.0f ? length : next_length) / metres_per_uv}};
        });
        length = next_length;
    }
}

void append_tube(shading::Mesh& mesh, std::span<const glm::vec3> path, float radius_begin, float radius_end, int around, float repeat,
                 float metres_per_uv) {
    assert(path.size() >= 2);
    const size_t last = path.size() - 1;
    std::vector<float> lengths(path.size());
    std::vector<glm::vec3> sides(path.size()), directions(path.size());
    // A side vector carried along the path, so that the bar does not twist.
    glm::vec3 side(0.0f);
    for (size_t i = 0; i <= last; ++i) {
        directions[i] = glm::normalize(path[std::min(i + 1, last)] - path[i > 0 ? i - 1 : 0]);
        side = tangent_direction(directions[i], i > 0 ? side : directions[i]);
        sides[i] = side;
        lengths[i] = i > 0 ? lengths[i - 1] + glm::distance(path[i - 1], path[i]) : 0.0f;
    }
    append_patch(mesh, around, int(last), [&](float s, float t) {
        const auto i = size_t(std::lround(t * float(last)));
        const float angle = s == 1.0f ? 0.0f : kTau * s;
        const glm::vec3 across = glm::cross(sides[i], directions[i]);
        const glm::vec3 normal = sides[i] * std::cos(angle) - across * std::sin(angle);
        const glm::vec3 along_u = -sides[i] * std::sin(angle) - across * std::cos(angle);
        return ShapePoint{
            path[i] + glm::mix(radius_begin, radius_end, t) * normal, normal, along_u, {repeat * s, -lengths[i] / metres_per_uv}};
    });
}

void append_torus(shading::Mesh& mesh, float major_radius, float minor_radius, int around, int across, glm::vec2 repeat) {
    append_patch(mesh, around, across, [&](float s, float t) {
        const float angle = s == 1.0f ? 0.0f : kTau * s, turn = t == 1.0f ? 0.0f : kTau * t;
        const glm::vec3 outward(std::sin(angle), 0.0f, std::cos(angle));
        const glm::vec3 normal = outward * std::cos(turn) + glm::vec3(0, std::sin(turn), 0);
        return ShapePoint{major_radius * outward + minor_radius * normal,
                          normal,
                          {std::cos(angle), 0.0f, -std::sin(angle)},
                          repeat * glm::vec2(s, 1.0f - t)};
    });
}

void append_mesh(shading::Mesh& mesh, const shading::Mesh& part, const glm::mat4& transform) {
    const auto first = uint32_t(mesh.positions.size());
    const glm::mat3 linear(transform);
    const glm::mat3 normal_transform = glm::transpose(glm::inverse(linear));
    const bool mirrors = glm::determinant(linear) < 0.0f;
    for (size_t i = 0; i < part.positions.size(); ++i) {
        const glm::vec3 normal = settled_unit(normal_transform * part.normals[i]);
        const glm::vec4 tangent = part.tangents[i];
        mesh.positions.emplace_back(transform * glm::vec4(part.positions[i], 1.0f));
        mesh.normals.push_back(normal);
        mesh.tangents.emplace_back(tangent_direction(normal, linear * glm::vec3(tangent)), mirrors ? -tangent.w : tangent.w);
    }
    mesh.uv[0].insert(mesh.uv[0].end(), part.uv[0].begin(), part.uv[0].end());
    mesh.colors.insert(mesh.colors.end(), part.colors.begin(), part.colors.end());
    for (size_t i = 0; i < part.indices.size(); i += 3) {
        const uint32_t a = first + part.indices[i], b = first + part.indices[i + 1], c = first + part.indices[i + 2];
        mesh.indices.insert(mesh.indices.end(), {a, mirrors ? c : b, mirrors ? b : c});
    }
}

void drop_unused_points(shading::Mesh& mesh) {
    constexpr uint32_t kUnused = UINT32_MAX;
    std::vector<uint32_t> number(mesh.positions.size(), kUnused);
    for (const uint32_t index : mesh.indices) number[index] = 0;
    uint32_t used = 0;
    for (uint32_t& n : number) n = n == kUnused ? kUnused : used++;
    const auto compact = [&](auto& attribute) {
        if (attribute.empty()) return;
        for (size_t i = 0; i < number.size(); ++i)
            if (number[i] != kUnused) attribute[number[i]] = attribute[i];
        attribute.resize(used);
    };
    compact(mesh.positions);
    compact(mesh.normals);
    compact(mesh.tangents);
    for (auto& uv : mesh.uv) compact(uv);
    compact(mesh.colors);
    for (uint32_t& index : mesh.indices) index = number[index];
}

void tint(shading::Mesh& mesh, const std::function<glm::vec3(glm::vec3 position, glm::vec3 normal)>& color) {
    for (size_t i = mesh.colors.size(); i < mesh.positions.size(); ++i) {
        mesh.colors.emplace_back(color(mesh.positions[i], mesh.normals[i]), 1.0f);
    }
}

}  // namespace rawtexel::scenes
