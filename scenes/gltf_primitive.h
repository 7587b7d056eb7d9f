// One primitive of a glTF mesh as an indexed triangle list (glTF 2.0, 3.7.2).
#pragma once

#include "scenes/accessor.h"
#include "scenes/gltf_deform.h"
#include "scenes/gltf_notices.h"

#include "shading/scene.h"

#include <optional>
#include <span>

namespace rawtexel::scenes {

struct PrimitiveRequest {
    int mesh = 0, primitive = 0;
    std::span<const float> morph_weights;
    const SkinPose* pose = nullptr;                   ///< null: not skinned
    const shading::TextureMap* normal_map = nullptr;  ///< null: no tangents are needed
};

/// The mesh with the vertices that its triangles use, in the file's order; its material is the caller's to set. nullopt for points and
/// lines, and where no triangle is left. Throws InputError.
std::optional<shading::Mesh> read_primitive(const GltfDocument& document, const Accessors& accessors, const PrimitiveRequest& request,
                                            GltfNotices& notices);

}  // namespace rawtexel::scenes
