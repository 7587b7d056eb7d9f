#include "scenes/tangents.h"

#include "scenes/mikktspace.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <tuple>

namespace rawtexel::scenes {
namespace {

using shading::Mesh;

/// False where no triangle said anything, and where the triangles' tangents stood on the vertex's plane: what projection left of them is
/// noise.
bool is_usable(const glm::vec3& tangent, const glm::vec3& normal) {
    return std::abs(glm::dot(tangent, tangent) - 1.0f) < 1e-3f && std::abs(glm::dot(tangent, normal)) < 1e-2f;
}

uint32_t copy_vertex(Mesh& mesh, uint32_t vertex) {
    const auto append = [vertex](auto& attribute) {
        if (attribute.empty()) return;
        const auto value = attribute[vertex];  // not a reference into what may move
        attribute.push_back(value);
    };
    append(mesh.positions);
    append(mesh.normals);
    append(mesh.tangents);
    for (auto& uv : mesh.uv) append(uv);
    append(mesh.colors);
    return uint32_t(mesh.positions.size() - 1);
}

/// Gives every vertex the tangent of its corners; where they differ, copies of the vertex take the further tangents.
void assign_corners(Mesh& mesh, const std::vector<glm::vec4>& corners) {
    const auto key = [&](uint32_t i) {
        const glm::vec4& t = corners[i];
        return std::tuple(mesh.indices[i], t.x, t.y, t.z, t.w);
    };
    std::vector<uint32_t> order(corners.size());
    std::iota(order.begin(), order.end(), 0u);
    std::ranges::sort(order, [&](uint32_t a, uint32_t b) { return std::tuple(key(a), a) < std::tuple(key(b), b); });

    mesh.tangents.assign(mesh.positions.size(), glm::vec4(1.0f, 0.0f, 0.0f, 1.0f));
    std::vector<uint32_t> vertex_of(corners.size());
    for (size_t k = 0; k < order.size(); ++k) {
        const uint32_t corner = order[k], before = k > 0 ? order[k - 1] : corner;
        const bool first_of_vertex = k == 0 || mesh.indices[before] != mesh.indices[corner];
        if (first_of_vertex)
            vertex_of[corner] = mesh.indices[corner];
        else
            vertex_of[corner] = key(before) == key(corner) ? vertex_of[before] : copy_vertex(mesh, mesh.indices[corner]);
        mesh.tangents[vertex_of[corner]] = corners[corner];
    }
    mesh.indices = std::move(vertex_of);
}

}  // namespace

glm::vec3 perpendicular_to(const glm::vec3& normal) {
    const glm::vec3 axis = std::abs(normal.x) < 0.5f ? glm::vec3(1.0f, 0.0f, 0.0f) : glm::vec3(0.0f, 1.0f, 0.0f);
    return glm::normalize(axis - normal * glm::dot(axis, normal));
}

void generate_tangents(Mesh& mesh, int uv_set, const glm::mat3x2& uv_from_vertex) {
    assert(uv_set >= 0 && uv_set < 2);
    assert(mesh.normals.size() == mesh.positions.size() && mesh.uv[size_t(uv_set)].size() == mesh.positions.size());
    std::vector<glm::vec2> uv = mesh.uv[size_t(uv_set)];
    if (uv_from_vertex != glm::mat3x2{1, 0, 0, 1, 0, 0})
        for (glm::vec2& coordinate : uv) coordinate = uv_from_vertex * glm::vec3(coordinate, 1.0f);

    std::vector<glm::vec4> corners = mikktspace_tangents({mesh.positions, mesh.normals, uv, mesh.indices});
    for (size_t i = 0; i < corners.size(); ++i) {
        // MikkTSpace has v up, glTF down: the bitangent turns round.
        corners[i].w = corners[i].w == 0.0f ? 1.0f : -corners[i].w;
        const glm::vec3& normal = mesh.normals[mesh.indices[i]];
        if (!is_usable(glm::vec3(corners[i]), normal)) corners[i] = glm::vec4(perpendicular_to(normal), corners[i].w);
    }
    assign_corners(mesh, corners);
}

const shading::TextureMap* map_with_tangents(std::span<const shading::Material> materials, uint32_t index) {
    const shading::Material& material = materials[index];
    if (material.layers) {
        for (const uint32_t layer : material.layers->materials)
            if (const auto* map = map_with_tangents(materials, layer)) return map;
        return nullptr;
    }
    const shading::TextureMap& map = material.maps[shading::kNormal];
    return map.texture >= 0 && !material.triplanar ? &map : nullptr;
}

}  // namespace rawtexel::scenes
