#include "scenes/gltf_frames.h"

#include "scenes/tangents.h"

#include <cmath>

namespace rawtexel::scenes {
namespace {

using shading::Mesh;

glm::dvec3 face_normal(const Mesh& mesh, size_t first_index) {
    const auto at = [&](size_t k) { return glm::dvec3(mesh.positions[mesh.indices[first_index + k]]); };
    return glm::cross(at(1) - at(0), at(2) - at(0));
}

glm::vec3 unit_or(const glm::dvec3& v, const glm::vec3& otherwise) {
    const double length = glm::length(v);
    return length > 0.0 && std::isfinite(length) ? glm::vec3(v / length) : otherwise;
}

constexpr glm::vec3 kAnyNormal{0.0f, 0.0f, 1.0f};

void normalize_normals(Mesh& mesh) {
    std::vector<glm::dvec3> from_faces;  // made only when a normal is missing
    for (size_t i = 0; i < mesh.normals.size(); ++i) {
        const glm::dvec3 given(mesh.normals[i]);
        if (glm::dot(given, given) == 0.0 && from_faces.empty()) {
            from_faces.resize(mesh.positions.size(), glm::dvec3(0.0));
            for (size_t t = 0; t < mesh.indices.size(); t += 3)
                for (size_t k = 0; k < 3; ++k) from_faces[mesh.indices[t + k]] += face_normal(mesh, t);
        }
        mesh.normals[i] = unit_or(given, from_faces.empty() ? kAnyNormal : unit_or(from_faces[i], kAnyNormal));
    }
}

template <class Attribute>
void split_by_index(std::vector<Attribute>& attribute, const std::vector<uint32_t>& indices) {
    if (attribute.empty()) return;
    std::vector<Attribute> split;
    split.reserve(indices.size());
    for (const uint32_t i : indices) split.push_back(attribute[i]);
    attribute = std::move(split);
}

/// Gives every triangle vertices of its own and its own normal.
void make_flat(Mesh& mesh) {
    split_by_index(mesh.positions, mesh.indices);
    for (auto& uv : mesh.uv) split_by_index(uv, mesh.indices);
    split_by_index(mesh.colors, mesh.indices);
    for (size_t i = 0; i < mesh.indices.size(); ++i) mesh.indices[i] = uint32_t(i);
    mesh.normals.resize(mesh.positions.size());
    for (size_t t = 0; t < mesh.indices.size(); t += 3) {
        const glm::vec3 normal = unit_or(face_normal(mesh, t), kAnyNormal);
        for (size_t k = 0; k < 3; ++k) mesh.normals[t + k] = normal;
    }
}

/// Unit tangents with a sign of exactly one; a tangent that is zero becomes any perpendicular.
void normalize_tangents(Mesh& mesh) {
    for (size_t i = 0; i < mesh.tangents.size(); ++i) {
        glm::vec4& tangent = mesh.tangents[i];
        const glm::vec3 direction = unit_or(glm::dvec3(tangent), perpendicular_to(mesh.normals[i]));
        tangent = glm::vec4(direction, tangent.w < 0.0f ? -1.0f : 1.0f);
    }
}

uint64_t vertex_bytes(const Mesh& mesh) {
    return sizeof(glm::vec3) * 2 + sizeof(glm::vec4) * (mesh.colors.empty() ? 1 : 2) +
           sizeof(glm::vec2) * (size_t(!mesh.uv[0].empty()) + size_t(!mesh.uv[1].empty()));
}

}  // namespace

void complete_frames(Mesh& mesh, const shading::TextureMap* normal_map, MemoryAllowance& memory) {
    normalize_normals(mesh);
    if (!normal_map) {
        mesh.tangents.clear();
        return;
    }
    // Tangents of a file mean nothing without its normals.
    if (mesh.normals.empty()) mesh.tangents.clear();
    const size_t uv_set = size_t(normal_map->uv_set);
    const bool generate = mesh.tangents.empty() && !mesh.uv[uv_set].empty();
    // At worst every corner becomes a vertex.
    if (generate || mesh.normals.empty()) memory.spend(mesh.indices.size() * vertex_bytes(mesh));
    if (mesh.normals.empty()) make_flat(mesh);
    if (generate) generate_tangents(mesh, int(uv_set), normal_map->uv_from_vertex);
    normalize_tangents(mesh);
}

}  // namespace rawtexel::scenes
