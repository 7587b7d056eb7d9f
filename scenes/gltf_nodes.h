// The node hierarchy (glTF 2.0, 3.5): checked to be a forest, flattened to world matrices.
#pragma once

#include "scenes/gltf_document.h"

#include <glm/glm.hpp>

#include <vector>

namespace rawtexel::scenes {

struct GltfNodes {
    std::vector<int> parent;        ///< of every node, -1 for roots
    std::vector<glm::dmat4> local;  ///< of every node: its transform to its parent
    std::vector<glm::dmat4> world;  ///< of every node, whether the scene shows it or not
    std::vector<int> shown;         ///< nodes of the scene, parents before children, children in order
};

/// Of the document's default scene, else its first; without scenes every root is shown. Any depth. Throws InputError for cycles, nodes with
/// two parents and transforms that are not finite or not affine.
GltfNodes flatten_nodes(const GltfDocument& document);

}  // namespace rawtexel::scenes
