// Meshes that move, at rest: morph targets at their default weights, skins in the pose that the nodes have in the file.
#pragma once

#include "scenes/accessor.h"

#include "shading/scene.h"

#include <map>
#include <span>
#include <string>
#include <vector>

namespace rawtexel::scenes {

using AttributeMap = std::map<std::string, int>;  ///< name to accessor, as tinygltf keeps it

/// Adds each target times its weight to the mesh's attributes (glTF 2.0, 3.7.2.2). `vertices` are the elements that the mesh's
/// vertices come from; `what` names the primitive in messages.
void apply_morph_targets(const GltfDocument& document, const Accessors& accessors, const std::vector<AttributeMap>& targets,
                         std::span<const float> weights, std::span<const uint32_t> vertices, const std::string& what, shading::Mesh& mesh);

/// Per joint the matrix from bound mesh space to the world: joint node times inverse bind matrix.
using SkinPose = std::vector<glm::dmat4>;

/// `world` has the world matrix of every node. Throws InputError when the inverse bind matrices do not fit.
SkinPose skin_pose(const GltfDocument& document, const Accessors& accessors, int skin, std::span<const glm::dmat4> world);

/// Moves the mesh into the world by its joints and weights (3.7.3.1).
void apply_skin(const GltfDocument& document, const Accessors& accessors, const AttributeMap& attributes, const SkinPose& pose,
                std::span<const uint32_t> vertices, const std::string& what, shading::Mesh& mesh);

}  // namespace rawtexel::scenes
