#include "scenes/gltf_nodes.h"

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace rawtexel::scenes {
namespace {

constexpr int kNone = -1;

std::string name_of(size_t node) { return "nodes[" + std::to_string(node) + "]"; }

glm::dmat4 local_matrix(const GltfDocument& document, size_t index) {
    const tinygltf::Node& node = document.model.nodes[index];
    if (!node.matrix.empty()) {
        const glm::dmat4 matrix = glm::make_mat4(node.matrix.data());
        const bool affine = matrix[0].w == 0.0 && matrix[1].w == 0.0 && matrix[2].w == 0.0 && matrix[3].w == 1.0;
        if (!affine) document.fail(name_of(index) + ".matrix is not affine (its fourth row must be 0, 0, 0, 1)");
        return matrix;
    }
    glm::dmat4 matrix(1.0);
    if (!node.translation.empty()) matrix = glm::translate(matrix, glm::make_vec3(node.translation.data()));
    if (!node.rotation.empty()) {
        const glm::dquat rotation(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]);  // w first
        const double length = glm::length(rotation);
        if (!(length > 0.0)) document.fail(name_of(index) + ".rotation is zero (a unit quaternion was expected)");
        matrix *= glm::mat4_cast(rotation / length);
    }
    if (!node.scale.empty()) matrix = glm::scale(matrix, glm::make_vec3(node.scale.data()));
    return matrix;
}

/// Every node's parent, kNone for roots.
std::vector<int> find_parents(const GltfDocument& document) {
    std::vector<int> parents(document.model.nodes.size(), kNone);
    for (size_t i = 0; i < parents.size(); ++i)
        for (const int child : document.model.nodes[i].children) {
            int& parent = parents[size_t(child)];
            if (parent != kNone)
                document.fail(name_of(size_t(child)) + " has two parents (" + name_of(size_t(parent)) + " and " + name_of(i) + ")");
            parent = int(i);
        }
    return parents;
}

/// Appends `root` and its descendants, parents before children, children in order.
void append_tree(const GltfDocument& document, int root, std::vector<int>& order) {
    std::vector<int> open = {root};
    while (!open.empty()) {
        const int node = open.back();
        open.pop_back();
        order.push_back(node);
        const std::vector<int>& children = document.model.nodes[size_t(node)].children;
        open.insert(open.end(), children.rbegin(), children.rend());
    }
}

void check_finite(const GltfDocument& document, const glm::dmat4& matrix, size_t node) {
    constexpr double kLargest = std::numeric_limits<float>::max();
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            if (!(std::abs(matrix[column][row]) <= kLargest))
                document.fail(name_of(node) + " has a transform too large for single precision");
}

std::vector<int> scene_roots(const GltfDocument& document, const std::vector<int>& roots) {
    const tinygltf::Model& model = document.model;
    if (model.scenes.empty()) return roots;
    return model.scenes[size_t(std::max(model.defaultScene, 0))].nodes;
}

}  // namespace

GltfNodes flatten_nodes(const GltfDocument& document) {
    const std::vector<int> parents = find_parents(document);
    std::vector<int> roots, all;
    for (size_t i = 0; i < parents.size(); ++i)
        if (parents[i] == kNone) roots.push_back(int(i));
    for (const int root : roots) append_tree(document, root, all);
    if (all.size() < parents.size()) {
        // With one parent each, nodes that hang from no root hang from each other.
        std::vector<bool> reached(parents.size(), false);
        for (const int node : all) reached[size_t(node)] = true;
        const auto stray = std::ranges::find(reached, false);
        document.fail(name_of(size_t(stray - reached.begin())) + " is in a cycle of nodes (they must form trees)");
    }

    GltfNodes nodes;
    nodes.parent = parents;
    nodes.local.resize(parents.size());
    nodes.world.resize(parents.size());
    for (const int node : all) {
        const glm::dmat4& local = nodes.local[size_t(node)] = local_matrix(document, size_t(node));
        const int parent = parents[size_t(node)];
        nodes.world[size_t(node)] = parent == kNone ? local : nodes.world[size_t(parent)] * local;
        check_finite(document, nodes.world[size_t(node)], size_t(node));
    }
    for (const int root : scene_roots(document, roots)) {
        if (parents[size_t(root)] != kNone)
            document.fail("the scene names " + name_of(size_t(root)) + " (which is a child of " + name_of(size_t(parents[size_t(root)])) +
                          ", allowed: roots)");
        append_tree(document, root, nodes.shown);
    }
    std::vector<int> sorted = nodes.shown;
    std::ranges::sort(sorted);
    if (const auto twice = std::ranges::adjacent_find(sorted); twice != sorted.end())
        document.fail("the scene names " + name_of(size_t(*twice)) + " twice");
    return nodes;
}

}  // namespace rawtexel::scenes
