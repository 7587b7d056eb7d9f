#include "scenes/gltf_deform.h"

#include <glm/gtc/type_ptr.hpp>

#include <numeric>

namespace rawtexel::scenes {
namespace {

/// Adds weight * values, `channels` floats for each, to the leading channels of `attribute`.
template <class Vector>
void add_scaled(std::vector<Vector>& attribute, std::span<const float> values, int channels, float weight) {
    for (size_t i = 0; i < attribute.size(); ++i)
        for (int c = 0; c < channels; ++c) attribute[i][c] += weight * values[i * size_t(channels) + size_t(c)];
}

/// The matrix that turns normals: inverse transposed, as cofactors, which exist for singular matrices too; the determinant's sign is left
/// out.
glm::dmat3 normal_matrix(const glm::dmat3& m) {
    const glm::dmat3 cofactors(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
    return glm::dot(m[0], cofactors[0]) < 0.0 ? -cofactors : cofactors;
}

/// All joint sets of the primitive: JOINTS_n with WEIGHTS_n, four each.
struct Influences {
    std::vector<std::vector<uint32_t>> joints;
    std::vector<std::vector<float>> weights;
};

void check_count(const GltfDocument& document, const Accessor& accessor, const AttributeMap& attributes, const Accessors& accessors,
                 const std::string& what) {
    const uint64_t expected = accessors.at(attributes.at("POSITION")).count;
    if (accessor.count != expected)
        document.fail(what + " has " + std::to_string(accessor.count) + " elements (allowed: as many as POSITION, " +
                      std::to_string(expected) + ")");
}

Influences read_influences(const GltfDocument& document, const Accessors& accessors, const AttributeMap& attributes, size_t joint_count,
                           std::span<const uint32_t> vertices, const std::string& what) {
    Influences influences;
    for (int set = 0;; ++set) {
        const std::string number = std::to_string(set);
        const auto joints = attributes.find("JOINTS_" + number), weights = attributes.find("WEIGHTS_" + number);
        if (joints == attributes.end() || weights == attributes.end()) break;
        const std::string joints_name = what + ".attributes." + joints->first, weights_name = what + ".attributes." + weights->first;
        const Accessor &joint_accessor = accessors.at(joints->second), &weight_accessor = accessors.at(weights->second);
        check_count(document, joint_accessor, attributes, accessors, joints_name);
        check_count(document, weight_accessor, attributes, accessors, weights_name);
        if (joint_accessor.type != "VEC4") document.fail(joints_name + " is " + joint_accessor.type + " (allowed: VEC4)");
        influences.joints.push_back(accessors.read_integers(joint_accessor, vertices, joints_name));
        influences.weights.push_back(accessors.read_floats(weight_accessor, vertices, {weights_name, {4}, Integers::Normalized}));
        for (size_t i = 0; i < influences.joints.back().size(); ++i)
            if (influences.joints.back()[i] >= joint_count)
                document.fail(joints_name + " holds " + std::to_string(influences.joints.back()[i]) + " at element " +
                              std::to_string(vertices[i / 4]) + " (allowed: 0 to " + std::to_string(joint_count - 1) + ")");
    }
    return influences;
}

/// The joints' matrices mixed by the vertex's weights; weights that add up to nothing follow the first joint.
glm::dmat4 mixed_matrix(const Influences& influences, const SkinPose& pose, size_t vertex) {
    glm::dmat4 sum(0.0);
    double total = 0.0;
    for (size_t set = 0; set < influences.joints.size(); ++set)
        for (size_t k = 4 * vertex; k < 4 * vertex + 4; ++k) {
            const double weight = influences.weights[set][k];
            sum += weight * pose[influences.joints[set][k]];
            total += weight;
        }
    return total > 0.0 ? sum / total : pose[influences.joints[0][4 * vertex]];
}

glm::vec3 unit_or_zero(const glm::dvec3& v) {
    const double length = glm::length(v);
    return length > 0.0 ? glm::vec3(v / length) : glm::vec3(0.0f);
}

}  // namespace

void apply_morph_targets(const GltfDocument& document, const Accessors& accessors, const std::vector<AttributeMap>& targets,
                         std::span<const float> weights, std::span<const uint32_t> vertices, const std::string& what, shading::Mesh& mesh) {
    for (size_t target = 0; target < targets.size() && target < weights.size(); ++target) {
        for (const auto& [name, index] : targets[target]) {
            const std::string place = what + ".targets[" + std::to_string(target) + "]." + name;
            const Accessor& accessor = accessors.at(index);
            if (accessor.count <= vertices.back())
                document.fail(place + " has " + std::to_string(accessor.count) + " elements (allowed: as many as POSITION)");
            if (weights[target] == 0.0f) continue;
            const auto add = [&](auto& attribute, std::vector<int> components) {
                if (attribute.empty()) return;
                const auto values = accessors.read_floats(accessor, vertices, {place, std::move(components), Integers::Any});
                add_scaled(attribute, values, accessor.components, weights[target]);
            };
            if (name == "POSITION") add(mesh.positions, {3});
            if (name == "NORMAL") add(mesh.normals, {3});
            if (name == "TANGENT") add(mesh.tangents, {3});
            if (name == "TEXCOORD_0") add(mesh.uv[0], {2});
            if (name == "TEXCOORD_1") add(mesh.uv[1], {2});
            if (name == "COLOR_0") add(mesh.colors, {3, 4});
        }
    }
}

SkinPose skin_pose(const GltfDocument& document, const Accessors& accessors, int skin, std::span<const glm::dmat4> world) {
    const tinygltf::Skin& source = document.model.skins[size_t(skin)];
    const std::string what = "skins[" + std::to_string(skin) + "]";
    if (source.joints.empty()) document.fail(what + " has no joints (at least 1 is needed)");
    std::vector<float> inverse_bind;
    if (source.inverseBindMatrices >= 0) {
        const Accessor& accessor = accessors.at(source.inverseBindMatrices);
        if (accessor.count < source.joints.size())
            document.fail(what + ".inverseBindMatrices has " + std::to_string(accessor.count) + " elements (allowed: at least " +
                          std::to_string(source.joints.size()) + ", one for each joint)");
        std::vector<uint32_t> elements(source.joints.size());
        std::iota(elements.begin(), elements.end(), 0u);
        inverse_bind = accessors.read_floats(accessor, elements, {what + ".inverseBindMatrices", {16}, Integers::No});
    }
    SkinPose pose;
    for (size_t joint = 0; joint < source.joints.size(); ++joint) {
        const glm::dmat4& node = world[size_t(source.joints[joint])];
        pose.push_back(inverse_bind.empty() ? node : node * glm::dmat4(glm::make_mat4(&inverse_bind[16 * joint])));
    }
    return pose;
}

void apply_skin(const GltfDocument& document, const Accessors& accessors, const AttributeMap& attributes, const SkinPose& pose,
                std::span<const uint32_t> vertices, const std::string& what, shading::Mesh& mesh) {
    const Influences influences = read_influences(document, accessors, attributes, pose.size(), vertices, what);
    if (influences.joints.empty()) document.fail(what + " has a skin but no JOINTS_0 and WEIGHTS_0");
    size_t mirrored = 0;
    for (size_t i = 0; i < mesh.positions.size(); ++i) {
        const glm::dmat4 matrix = mixed_matrix(influences, pose, i);
        const glm::dmat3 linear(matrix);
        mirrored += glm::determinant(linear) < 0.0;
        mesh.positions[i] = glm::vec3(matrix * glm::dvec4(mesh.positions[i], 1.0));
        if (!mesh.normals.empty()) mesh.normals[i] = unit_or_zero(normal_matrix(linear) * glm::dvec3(mesh.normals[i]));
        if (!mesh.tangents.empty()) mesh.tangents[i] = glm::vec4(unit_or_zero(linear * glm::dvec3(mesh.tangents[i])), mesh.tangents[i].w);
    }
    // Mirrored, the triangles would turn their backs: an instance's negative determinant is not there to tell.
    if (2 * mirrored > mesh.positions.size()) {
        for (size_t t = 0; t + 2 < mesh.indices.size(); t += 3) std::swap(mesh.indices[t + 1], mesh.indices[t + 2]);
        for (glm::vec4& tangent : mesh.tangents) tangent.w = -tangent.w;
    }
}

}  // namespace rawtexel::scenes
