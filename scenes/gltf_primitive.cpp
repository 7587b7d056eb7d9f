#include "scenes/gltf_primitive.h"

#include "scenes/gltf_frames.h"
#include "scenes/message_text.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace rawtexel::scenes {
namespace {

/// Triangles of a strip alternate so that all face the same way; a fan starts each with its edge (3.7.2.1).
std::vector<uint32_t> triangle_list(std::vector<uint32_t> vertices, int mode) {
    if (mode == TINYGLTF_MODE_TRIANGLES) {
        vertices.resize(vertices.size() / 3 * 3);
        return vertices;
    }
    std::vector<uint32_t> triangles;
    for (size_t i = 0; i + 2 < vertices.size(); ++i) {
        if (mode == TINYGLTF_MODE_TRIANGLE_FAN)
            triangles.insert(triangles.end(), {vertices[i + 1], vertices[i + 2], vertices[0]});
        else
            triangles.insert(triangles.end(), {vertices[i], vertices[i + 1 + i % 2], vertices[i + 2 - i % 2]});
    }
    return triangles;
}

/// Renumbers `triangles` to the vertices in use, which come back in ascending order.
std::vector<uint32_t> compact(std::vector<uint32_t>& triangles) {
    const size_t extent = size_t(*std::ranges::max_element(triangles)) + 1;
    std::vector<uint32_t> used;
    // Few triangles of a large shared buffer must not cost its whole length.
    if (extent / 16 > triangles.size()) {
        used = triangles;
        std::ranges::sort(used);
        used.erase(std::ranges::unique(used).begin(), used.end());
        for (uint32_t& vertex : triangles) vertex = uint32_t(std::ranges::lower_bound(used, vertex) - used.begin());
        return used;
    }
    std::vector<uint32_t> number(extent, 0);
    for (const uint32_t vertex : triangles) number[vertex] = 1;
    for (uint32_t vertex = 0; vertex < extent; ++vertex)
        if (std::exchange(number[vertex], uint32_t(used.size()))) used.push_back(vertex);
    for (uint32_t& vertex : triangles) vertex = number[vertex];
    return used;
}

class PrimitiveReader {
  public:
    PrimitiveReader(const GltfDocument& document, const Accessors& accessors, const PrimitiveRequest& request, GltfNotices& notices)
        : document_(document),
          accessors_(accessors),
          request_(request),
          notices_(notices),
          source_(document.model.meshes[size_t(request.mesh)].primitives[size_t(request.primitive)]),
          name_("meshes[" + std::to_string(request.mesh) + "].primitives[" + std::to_string(request.primitive) + "]") {}

    std::optional<shading::Mesh> read() {
        if (source_.mode < TINYGLTF_MODE_TRIANGLES) {
            notices_.say_once("points and lines are left out");
            return std::nullopt;
        }
        shading::Mesh mesh;
        mesh.name = mesh_name();
        std::vector<uint32_t> vertices = read_vertices();
        if (source_.mode == TINYGLTF_MODE_TRIANGLES ? vertices.size() % 3 != 0 : vertices.size() < 3)
            notices_.say_once("incomplete triangles are left out");
        mesh.indices = triangle_list(std::move(vertices), source_.mode);
        if (mesh.indices.empty()) return std::nullopt;
        const std::vector<uint32_t> used = compact(mesh.indices);
        read_attributes(mesh, used);
        if (!request_.morph_weights.empty())
            apply_morph_targets(document_, accessors_, source_.targets, request_.morph_weights, used, name_, mesh);
        if (request_.pose) apply_skin(document_, accessors_, source_.attributes, *request_.pose, used, name_, mesh);
        check_finite(mesh);
        complete_frames(mesh, request_.normal_map, *document_.memory);
        return mesh;
    }

  private:
    std::string mesh_name() const {
        const tinygltf::Mesh& owner = document_.model.meshes[size_t(request_.mesh)];
        const std::string name = owner.name.empty() ? "mesh " + std::to_string(request_.mesh) : one_line(owner.name);
        return owner.primitives.size() == 1 ? name : name + " " + std::to_string(request_.primitive);
    }

    uint64_t vertex_count() const {
        const auto position = source_.attributes.find("POSITION");
        if (position == source_.attributes.end()) document_.fail(name_ + " has no POSITION (it is required)");
        return accessors_.at(position->second).count;
    }

    /// The vertices in the order in which they are drawn.
    std::vector<uint32_t> read_vertices() const {
        const uint64_t count = vertex_count();
        if (count > INT32_MAX) document_.fail(name_ + " has " + std::to_string(count) + " vertices (allowed: below 2^31)");
        if (source_.indices < 0) {
            document_.memory->spend(count * sizeof(uint32_t));
            std::vector<uint32_t> all(count);
            std::iota(all.begin(), all.end(), 0u);
            return all;
        }
        std::vector<uint32_t> indices = accessors_.read_indices(accessors_.at(source_.indices), name_ + ".indices");
        const auto bad = std::ranges::find_if(indices, [&](uint32_t i) { return i >= count; });
        if (bad != indices.end())
            document_.fail(name_ + ".indices holds " + std::to_string(*bad) + " at element " + std::to_string(bad - indices.begin()) +
                           " (allowed: 0 to " + std::to_string(count - 1) + ")");
        // A strip or fan triples: three indices for each triangle.
        document_.memory->spend(indices.size() * 3 * sizeof(uint32_t));
        return indices;
    }

    /// The floats of attribute `name` of the used vertices; empty when the primitive has none.
    std::vector<float> floats(const std::string& name, std::vector<int> components, Integers integers,
                              std::span<const uint32_t> used) const {
        const auto attribute = source_.attributes.find(name);
        if (attribute == source_.attributes.end()) return {};
        const std::string what = name_ + ".attributes." + name;
        const Accessor& accessor = accessors_.at(attribute->second);
        if (accessor.count != vertex_count())
            document_.fail(what + " has " + std::to_string(accessor.count) + " elements (allowed: as many as POSITION, " +
                           std::to_string(vertex_count()) + ")");
        return accessors_.read_floats(accessor, used, {what, std::move(components), integers});
    }

    template <class Vector>
    static std::vector<Vector> vectors(const std::vector<float>& values) {
        constexpr size_t n = size_t(Vector::length());
        std::vector<Vector> result(values.size() / n);
        for (size_t i = 0; i < values.size(); ++i) result[i / n][int(i % n)] = values[i];
        return result;
    }

    void read_attributes(shading::Mesh& mesh, std::span<const uint32_t> used) {
        mesh.positions = vectors<glm::vec3>(floats("POSITION", {3}, Integers::Any, used));
        mesh.normals = vectors<glm::vec3>(floats("NORMAL", {3}, Integers::Any, used));
        mesh.tangents = vectors<glm::vec4>(floats("TANGENT", {4}, Integers::Any, used));
        mesh.uv[0] = vectors<glm::vec2>(floats("TEXCOORD_0", {2}, Integers::Any, used));
        mesh.uv[1] = vectors<glm::vec2>(floats("TEXCOORD_1", {2}, Integers::Any, used));
        const std::vector<float> colors = floats("COLOR_0", {3, 4}, Integers::Normalized, used);
        mesh.colors = colors.size() == 3 * used.size() ? opaque(vectors<glm::vec3>(colors)) : vectors<glm::vec4>(colors);
        tell_of_unread_attributes();
    }

    static std::vector<glm::vec4> opaque(const std::vector<glm::vec3>& colors) {
        std::vector<glm::vec4> result;
        for (const glm::vec3& color : colors) result.emplace_back(color, 1.0f);
        return result;
    }

    /// Finite attributes may still overflow when they are deformed.
    void check_finite(const shading::Mesh& mesh) const {
        const auto finite = [](const glm::vec3& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); };
        if (!std::ranges::all_of(mesh.positions, finite))
            document_.fail(name_ + " leaves the range of single precision when it is deformed");
    }

    void tell_of_unread_attributes() {
        for (const auto& [name, accessor] : source_.attributes) {
            const bool further_uv = name.starts_with("TEXCOORD_") && name != "TEXCOORD_0" && name != "TEXCOORD_1";
            const bool further_color = name.starts_with("COLOR_") && name != "COLOR_0";
            if (further_uv) notices_.say_once("texture coordinates beyond the second set are left out");
            if (further_color) notices_.say_once("vertex colours beyond the first set are left out");
        }
    }

    const GltfDocument& document_;
    const Accessors& accessors_;
    const PrimitiveRequest& request_;
    GltfNotices& notices_;
    const tinygltf::Primitive& source_;
    std::string name_;
};

}  // namespace

std::optional<shading::Mesh> read_primitive(const GltfDocument& document, const Accessors& accessors, const PrimitiveRequest& request,
                                            GltfNotices& notices) {
    return PrimitiveReader(document, accessors, request, notices).read();
}

}  // namespace rawtexel::scenes
